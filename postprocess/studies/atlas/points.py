"""What the sweeps of the atlas came to, as contacts and their responses."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from scipy.spatial import cKDTree

from ehlwave.atlas import load_atlas
from ehlwave.atlas.kinds import LINE, ROLLING, SLIDING, Kind
from ehlwave.atlas.ranges import CONTACT_RANGES
from ehlwave.atlas.sliding import MODULUS_PA, conditions_of
from ehlwave.formula import wave_and_direction
from ehlwave.read import read_results

LARGEST_CORRECTION = 0.03
"""Of a response by extrapolation, in units of Ai: beyond it the grid was too coarse."""

SAME_CASE = 1e-3
"""Distance, in logarithms of the keys, of cases that differ by rounding alone."""

LARGEST_RISE = 3.0
"""Of the mean film: what is far above is of long waves that the load, not the oil, balances."""

LARGEST_PRESSURE = 1.02
"""P at the centre; more than that is of a spike elsewhere."""

LEFT_BY_EXTRAPOLATION = 0.25
"""Of the correction, as the next grid finds it."""


def read_points(
    paths: Sequence[Path], rises: Path | None = None, kind: Kind = ROLLING
) -> xr.Dataset:
    """Return contacts and the responses of each, without `error`, of finished sweeps.

    Film and pressure responses are those at mesh size 0; films are extrapolated likewise. With
    `rises`, the results of :func:`studies.atlas.design.write_rises`, oblique waves have the rise
    of the mean film, too; without them it is NaN.
    """
    results = read_results(paths)
    table = results.to_dataframe().reset_index(drop=True)
    film = table["harmonic_extrapolated_real"] + 1j * table["harmonic_extrapolated_imaginary"]
    table["correction"] = np.abs(film - table["harmonic_real"] - 1j * table["harmonic_imaginary"])
    table = table[np.isfinite(table["correction"]) & (table["correction"] < LARGEST_CORRECTION)]
    if kind is SLIDING:
        table["stress_modulus_pa2"] = table["eyring_stress_pa"] * MODULUS_PA
    keys = list(kind.ranges)
    groups = table.groupby(keys, sort=True)
    contacts = groups.first().reset_index()
    order = np.argsort(groups.ngroup().to_numpy(), kind="stable")
    table, counts = table.iloc[order], groups.size().to_numpy()
    wave, along = wave_and_direction(table["wavelength_x_over_a"], table["wavelength_y_over_a"])
    angle = np.degrees(np.arccos(np.sqrt(along)))
    points = {
        "wavelength_over_a": wave.astype(np.float32),
        "angle_deg": angle.astype(np.float32),
        "film_real": table["harmonic_extrapolated_real"].to_numpy(np.float32),
        "film_imaginary": table["harmonic_extrapolated_imaginary"].to_numpy(np.float32),
        "pressure_real": table["harmonic_pressure_extrapolated_real"].to_numpy(np.float32),
        "pressure_imaginary": table["harmonic_pressure_extrapolated_imaginary"].to_numpy(
            np.float32
        ),
        "discretisation": (LEFT_BY_EXTRAPOLATION * table["correction"]).to_numpy(np.float32),
    }
    data = {name: ("point", values) for name, values in points.items()}
    data["responses"] = "contact", counts.astype(np.int16)
    if kind is LINE:
        del data["angle_deg"]
    if kind is not SLIDING:
        data["mean_rise"] = "point", _rises(table, rises)
    else:
        rolling = _rolling(contacts, counts, wave, angle)
        data["rolling_real"] = "point", rolling.real.astype(np.float32)
        data["rolling_imaginary"] = "point", rolling.imag.astype(np.float32)
    data |= {name: ("contact", values) for name, values in _films(contacts, kind).items()}
    origin = {
        key: str(results[key].values[0]) for key in ("program_version", "git_revision", "compiler")
    }
    return xr.Dataset(data, attrs={"kind": kind.name, **origin})


def _rolling(
    contacts: pd.DataFrame, counts: np.ndarray, wave: np.ndarray, angle: np.ndarray
) -> np.ndarray:
    """Return the transfers in pure rolling that the atlas of rolling contacts has."""
    atlas, ends = load_atlas(), np.cumsum(counts)
    found = np.empty(wave.size, dtype=complex)
    for index, end in enumerate(ends):
        own = slice(end - counts[index], end)
        chart = atlas.at({key: float(contacts[key][index]) for key in CONTACT_RANGES})
        found[own] = chart.film_response(wave[own], angle[own])
    return found


def _rises(table: pd.DataFrame, oblique: Path | None) -> np.ndarray:
    """Return what each wave adds to the mean film; of products of cosines, that of one wave."""
    rise = (table["mean_film_rise"] / table["amplitude_over_film"]).to_numpy(np.float32)
    is_product = (table["wavelength_x_over_a"] > 0) & (table["wavelength_y_over_a"] > 0)
    rise[is_product] = np.nan
    if oblique is not None:
        single = read_results(oblique).to_dataframe()
        single = single[np.isfinite(single["mean_film_rise"])]
        distance, which = cKDTree(_places(single)).query(_places(table))
        found = (single["mean_film_rise"] / single["amplitude_over_film"]).to_numpy(np.float32)
        matches = is_product.to_numpy() & (distance < SAME_CASE)
        rise[matches] = found[which[matches]]
    rise[np.abs(rise) > LARGEST_RISE] = np.nan
    return rise


def _places(table: pd.DataFrame) -> np.ndarray:
    """Return what tells cases apart."""
    keys = [*CONTACT_RANGES, "wavelength_x_over_a", "wavelength_y_over_a"]
    return np.log(np.maximum(table[keys].to_numpy(float), 1e-9))


def _films(contacts: pd.DataFrame, kind: Kind) -> dict[str, np.ndarray]:
    """Return the keys of contacts and the logarithms of their films, and of friction.

    Films grow with finer grids, smallest ones too; the estimated error is what is missing.
    """
    base = kind.references(contacts)
    central = contacts["central_film_moes"] * (1 + contacts["central_film_error"])
    smallest = contacts["minimum_film"] * (1 + contacts["minimum_film_error"])
    smallest_moes = smallest * contacts["central_film_moes"] / contacts["central_film"]
    discretisation = (
        LEFT_BY_EXTRAPOLATION * contacts[["central_film_error", "minimum_film_error"]].to_numpy()
    )
    numbers = {name: contacts[name].to_numpy(np.float32) for name in kind.ranges}
    if "pressure_ratio" in kind.films:
        numbers |= _centre(contacts)
    if "friction_ratio" in kind.films:
        numbers |= _frictions(contacts, base[:, 2], discretisation[:, 0])
    return numbers | {
        "film_ratio": np.log(central / base[:, 0]).to_numpy(np.float32),
        "minimum_ratio": np.log(smallest_moes / central * base[:, 0] / base[:, 1]).to_numpy(
            np.float32
        ),
        "film_ratio_discretisation": np.hypot(
            discretisation[:, 0], contacts["domain_error"]
        ).astype(np.float32),
        "minimum_ratio_discretisation": discretisation[:, 1].astype(np.float32),
    }


def _centre(contacts: pd.DataFrame) -> dict[str, np.ndarray]:
    """Return film and pressure at the centre; of the latter the largest, but for a spike."""
    pressure = np.log(np.minimum(contacts["max_pressure"], LARGEST_PRESSURE)).to_numpy(np.float32)
    film = contacts["central_film"] * (1 + contacts["central_film_error"])
    return {
        "central_film": film.to_numpy(np.float32),
        "pressure_ratio": pressure,
        "pressure_ratio_discretisation": np.zeros(pressure.size, np.float32),
    }


def _frictions(
    contacts: pd.DataFrame, expected: np.ndarray, film_error: np.ndarray
) -> dict[str, np.ndarray]:
    """Return ln of the mean shear stress over the expected one, and its error.

    The stress is as the logarithm of the film, so that it errs at most as the film does.
    """
    hertz_pa = np.array(
        [c.alphabar / c.oil.pressure_viscosity_per_pa for c in conditions_of(contacts)]
    )
    mean = contacts["friction_coefficient"] * hertz_pa / 1.5 / contacts["eyring_stress_pa"]
    return {
        "friction_ratio": np.log(np.abs(mean) / expected).to_numpy(np.float32),
        "friction_ratio_discretisation": film_error.astype(np.float32),
    }
