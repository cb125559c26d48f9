"""The chapter of the report on waviness under slip."""

import itertools
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.contact.formula import recommended_ratio
from ehlwave.contact.two_waves import two_waves
from studies.section import Picture, Section, Table
from studies.two_waves import figures
from studies.two_waves.cases import REDUCED_MODULUS_PA
from studies.two_waves.eyring import eyring_points, eyring_table
from studies.two_waves.fit import PACKAGED, Law, amplitude_error, fitted, held_out, rms
from studies.two_waves.passing import WINDOW, Passing, passings
from studies.two_waves.points import Pairs, Rolling, rolling_points, slip_points
from studies.two_waves.shapes import MARCHES

Complex = NDArray[np.complex128]
Mask = NDArray[np.bool_]

ALLOWED = 0.04
"""Rms error of |a + c|/Ai at conditions that are not in the fit."""

SMALL = 0.1
"""Responses below it count as small."""

BANDS = (0.0, 0.5, 0.75, 0.9, 0.97, 1.03, 1.1, 1.25, 1.5, 2.0)
"""Bands of S."""


def section(folder: Path) -> Section:
    """Return the chapter, from ``two_waves.h5`` and ``two_waves_fresh.h5`` in the folder.

    ``dense.h5`` adds waves in pure rolling; shapes and pictures are there if their sweeps are.
    Raises as :func:`ehlwave.results.read.read_results`.
    """
    own = folder / "two_waves.h5"
    rolled = [path for path in (own, folder / "dense.h5") if path.exists()]
    rolling, pairs = rolling_points(*rolled), slip_points(own)
    fresh = slip_points(folder / "two_waves_fresh.h5")
    law = fitted(rolling, pairs)
    left_rolling, left_pairs = held_out(rolling, pairs)
    errors = _errors(law, (pairs, left_pairs), fresh)
    found = Section("What sliding does to waviness", _text(errors, pairs, fresh))
    found.tables = [
        errors,
        _bands(pairs, left_pairs),
        _coefficients(law),
        _rolling(rolling, left_rolling),
        eyring_table(pairs),
    ]
    found.pictures = [
        Picture(
            "two_waves_predicted",
            "Film response under slip by the law, from fits without its operating condition "
            "(left) and at fresh conditions (right), against the computed one.",
            figures.predicted_figure((pairs.film, left_pairs), (fresh.film, PACKAGED.film(fresh))),
        ),
        Picture(
            "two_waves_amplitudes",
            "Attenuated and complementary wave against the wave parameter of pure rolling; "
            "colour: S. Newtonian (top) and Ree-Eyring oil (bottom).",
            figures.amplitude_figure(pairs),
        ),
        Picture(
            "two_waves_eyring",
            "Attenuated wave of transverse patterns deep in the Eyring regime (B > 100) against "
            "(tau0/E')(lambda/h)^2; the line is the incompressible oil.",
            figures.eyring_figure(*eyring_points(pairs)),
        ),
    ]
    if (folder / "sliding_along.h5").exists():
        found.pictures.insert(
            1,
            Picture(
                "two_waves_along",
                "Film along the contact, Y = 0, over Ai at one instant: computed, and its two "
                "waves. Newtonian (left) and Ree-Eyring oil (right), S = 1.3.",
                figures.along_figure(folder),
            ),
        )
    if (folder / f"{MARCHES}.h5").exists():
        passed = passings(folder)
        found.tables += [_passed(passed), _profiles(passed)]
        found.pictures.append(
            Picture(
                "two_waves_passing",
                "A ridge across rolling, 5 per cent of the film high, and a round dimple as deep, "
                "sliding through the contact: film less the smooth one over the height along "
                "Y = 0, simulated and predicted from both waves.",
                figures.passing_figure(passed),
            )
        )
    return found


def without_simulation(pairs: Pairs) -> Complex:
    """Return a + c from the operating conditions alone: corrected film, maximum Hertz pressure."""
    film = np.full(len(pairs.table), np.nan + 0j)
    for _, rows in pairs.table.groupby(["condition", "slip", "flow_law"]):
        one = rows.iloc[0]
        keys = {
            "load_parameter_m": one["m"],
            "lubricant_parameter_l": one["l"],
            "radius_ratio_d": one["d"],
            "pressure_viscosity_per_pa": one["pressure_viscosity_per_pa"],
        }
        if one["flow_law"] == "eyring":
            keys |= {
                "eyring_stress_pa": one["eyring_stress_pa"],
                "reduced_modulus_pa": REDUCED_MODULUS_PA,
            }
        waves = (rows["wavelength_x_over_a"].to_numpy(), rows["wavelength_y_over_a"].to_numpy())
        contact = conditions_from_keys(keys, needs_lengths=False)
        both = two_waves(contact, float(one["slip"]), *waves)
        film[rows.index] = both.at(0.0)
    return film


def _errors(law: Law, trained: tuple[Pairs, Complex], fresh: Pairs) -> Table:
    pairs, left = trained
    everywhere = np.ones(len(pairs.table), dtype=bool)
    newtonian = (pairs.table["flow_law"] == "newtonian").to_numpy()
    usual = (np.abs(pairs.table["slip"] - 1) <= 0.5).to_numpy()
    lasting = np.ones(len(fresh.table), dtype=bool)
    rows = [
        ("conditions held out of the fit", *_error(pairs, left, everywhere)),
        ("of them Newtonian", *_error(pairs, left, newtonian)),
        ("Ree-Eyring", *_error(pairs, left, ~newtonian)),
        ("0.5 <= S <= 1.5", *_error(pairs, left, usual)),
        ("fitted", *_error(pairs, law.film(pairs), everywhere)),
        ("fitted, computed transfer R", *_error(pairs, law.film(pairs, pairs.rolling), everywhere)),
        ("as installed, film by formula", *_error(pairs, without_simulation(pairs), everywhere)),
        ("one half of what enters, c = (1 - a)/2", *_error(pairs, _half(pairs), everywhere)),
        ("fresh conditions, as installed", *_error(fresh, PACKAGED.film(fresh), lasting)),
        (
            "fresh conditions, as installed, film by formula",
            *_error(fresh, without_simulation(fresh), lasting),
        ),
    ]
    names = ["points", "number", "conditions", "rms of |a + c|/Ai", "rms of a + c", "largest"]
    caption = "Error of the predicted film response under slip"
    return Table("two_waves_errors", caption, pd.DataFrame(rows, columns=names))


def _half(pairs: Pairs) -> Complex:
    """Return a + c with half of the missing part launched, and carried with the oil."""
    return pairs.attenuated + 0.5 * (1 - pairs.attenuated) * np.exp(1j * pairs.mismatch)


def _error(pairs: Pairs, film: Complex, chosen: Mask) -> tuple[int, int, float, float, float]:
    left, computed = film[chosen], pairs.film[chosen]
    conditions = pairs.table["condition"][chosen].nunique()
    largest = float(np.max(np.abs(np.abs(left) - np.abs(computed))))
    return (
        int(chosen.sum()),
        conditions,
        amplitude_error(left, computed),
        rms(left - computed),
        largest,
    )


def _bands(pairs: Pairs, left: Complex) -> Table:
    rows = []
    slip = pairs.table["slip"].to_numpy()
    for low, high in itertools.pairwise(BANDS):
        chosen = (slip > low) & (slip <= high)
        if chosen.any():
            rows.append((f"{low:g} to {high:g}", *_error(pairs, left, chosen)))
    names = ["S", "number", "conditions", "rms of |a + c|/Ai", "rms of a + c", "largest"]
    caption = "The same at held-out conditions, by slip: both ways from pure rolling to large slip"
    return Table("two_waves_slip", caption, pd.DataFrame(rows, columns=names))


def _coefficients(law: Law) -> Table:
    names = ["p", "p1", "p2", "q", "q1", "q2", "r", "d0", "d1", "d2"]
    rows = list(zip(names, law.launch, PACKAGED.launch, strict=True))
    for letter, values, installed in (
        ("amplitude", law.amplitude, PACKAGED.amplitude),
        ("phase", law.phase, PACKAGED.phase),
    ):
        rows += [
            (f"{letter} {index}", *pair)
            for index, pair in enumerate(zip(values, installed, strict=True))
        ]
    data = pd.DataFrame(rows, columns=["coefficient", "fitted here", "installed"])
    caption = "Coefficients of the law, and of the rolling transfer it begins with"
    return Table("two_waves_coefficients", caption, data, is_long=True)


def _rolling(rolling: Rolling, left: Complex) -> Table:
    t = rolling.table
    waves = (t["wavelength_x_over_a"].to_numpy(), t["wavelength_y_over_a"].to_numpy())
    four = recommended_ratio(*(t[name].to_numpy() for name in ("m", "l", "gamma")), *waves)
    computed = np.abs(rolling.film)
    small = computed < SMALL
    rows = []
    for name, film in (
        ("recommended formula, four numbers", four.astype(complex)),
        ("closer fit, as installed", PACKAGED.rolling(rolling)),
        ("closer fit, conditions held out", left),
    ):
        ratio = np.abs(film)
        share = ratio[small] / computed[small] if small.any() else np.array([np.nan])
        rows.append(
            (
                name,
                rms(ratio - computed),
                float(np.max(np.abs(ratio - computed))),
                float(np.mean(share)),
                float(np.max(share)),
                rms(film - rolling.film) if name.startswith("closer") else None,
            )
        )
    names = ["formula", "rms of Ad/Ai", "largest"]
    names += ["mean of formula/Ad below 0.1", "largest of it", "rms with phase"]
    caption = f"Pure rolling again: {len(t)} points at {t['condition'].nunique()} conditions"
    return Table("two_waves_rolling", caption, pd.DataFrame(rows, columns=names))


def _passed(passed: list[Passing]) -> Table:
    rows = [(one.name, one.slip, one.error("computed waves"), one.error("law")) for one in passed]
    names = ["shape", "S", "error, computed waves", "error, law"]
    caption = (
        "Sliding ridges, grooves, bumps and dimples, predicted: rms over Rq, |X| <= 0.5, Y = 0"
    )
    return Table("two_waves_passing", caption, pd.DataFrame(rows, columns=names))


def _profiles(passed: list[Passing]) -> Table:
    profiles = [
        pd.DataFrame(
            {"shape": one.name, "slip": one.slip, "x": one.x, "surface": one.surface} | one.lines
        )[np.abs(one.x) <= WINDOW]
        for one in passed
    ]
    caption = "Their profiles over the height"
    return Table("two_waves_profiles", caption, pd.concat(profiles), is_long=True)


def _text(errors: Table, pairs: Pairs, fresh: Pairs) -> list[str]:
    value = errors.data.set_index("points")["rms of |a + c|/Ai"]
    held, new = value["conditions held out of the fit"], value["fresh conditions, as installed"]
    verdict = "met" if max(held, new) <= ALLOWED else "not met"
    t = pairs.table
    return [
        "Under slip the film is a sum of two waves: one moves with the surface, the other with the "
        "oil. The first, and the wave number of the second, follow from the state of the contact "
        "centre; how much the inlet launches is the law fitted here: what it lets through in pure "
        "rolling, R, less what the attenuated wave takes, carried to the centre.",
        f"{len(t)} pairs of waves, rolling and sliding, at {t['condition'].nunique()} conditions "
        f"(M {t['m'].min():.3g} to {t['m'].max():.3g}, L {t['l'].min():.2g} to "
        f"{t['l'].max():.3g}, D {t['d'].min():.2g} to {t['d'].max():.2g}, S {t['slip'].min():.2g} "
        f"to {t['slip'].max():.3g}, tau0 1 to 30 MPa and Newtonian). The rms error of |a + c|/Ai "
        f"is {held:.3f} at conditions held out of the fit and {new:.3f} at "
        f"{fresh.table['condition'].nunique()} fresh ones; the criterion, {ALLOWED:g}, is "
        f"{verdict}. Launching one half, as is common, has {value.iloc[7]:.3f}. Where the centre's "
        f"film is that of the corrected formula in place of the computed one, it is "
        f"{value['as installed, film by formula']:.3f}.",
        "What limits one closed form: short waves at large slip in contacts of low pressure, in "
        "which viscosity grows slowly along the contact and the wave numbers at the centre do not "
        "stand for the way; and inlets that shear thins.",
    ]
