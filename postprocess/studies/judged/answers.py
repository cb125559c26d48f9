"""Answers of the laws for contacts of all kinds, beside the program on fine grids.

Computed values are kept apart from the answers, so that changed laws are judged at once.
"""

import cmath
import math
import warnings
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import ehlwave
from ehlwave.errors import EhlwaveError
from ehlwave.programs.case_input import case_groups, case_keys
from studies.atlas.waves import pattern
from studies.judged.any_contact import contact
from studies.judged.drawn_contacts import Drawn
from studies.judged.runs import kept, solved
from studies.programs import Groups
from studies.sweeps import Row, write_rows

ACCURACY, LINE_ACCURACY = 0.01, 0.002
"""Accuracy of the computed response, which films and friction exceed; of contacts of lines."""
MARCH_SIZES, MARCH_LINE, FEWEST_POINTS, LENGTH, SMALL = (96, 144), 576, 16, 4.0, 0.01
COARSER, SAFETY = 2 / 3, 2.0
"""Cells of marches, and Ai over the film; share of the cells on the coarser grid, and the error of
the change by moving heat over its difference on that grid."""
QUANTITIES = ("central", "smallest", "friction", "response")
UNKNOWN, AT_ONCE = 0.02, 20
"""Error of a computed value that judges nothing, unless the error of the package is larger; number
of contacts between two prints."""


def computed(number: int, folder: Path) -> Row:
    """Return the contact of a number, with computed films, friction and response.

    Responses of warm contacts are the linear limit plus the change by moving heat.
    """
    kind, one = contact(number)
    wave = {"wavelength_over_a": one.wavelength_over_a, "angle_deg": one.angle_deg}
    row: Row = {"kind": kind, **one.keys, "is_hot": one.heat, **wave}
    asked, lengths = one.contact(), pattern(*wave.values())
    group = {"orientation": "custom", "response": "harmonic", **lengths}
    accuracy = LINE_ACCURACY if asked.conditions.is_line else ACCURACY
    found = _solved(asked, {"waviness": group, "solver": {"accuracy": accuracy}}, folder)
    if found is None:
        return row
    row |= _films_of(found)
    names = ("harmonic_extrapolated_real", "harmonic_extrapolated_imaginary")
    true = complex(*(found[name] for name in names))
    plain = complex(found["harmonic_real"], found["harmonic_imaginary"])
    own = found["harmonic_error"] * abs(plain)
    if one.heat and one.angle_deg < 90:
        more = _moving_heat(asked, lengths, folder)
        if more is None:
            return row
        true, own = true + more[0], own + more[1]
    return row | {"real": true.real, "imaginary": true.imag, "response_own": own}


def _films_of(found: Row) -> Row:
    scale = found["central_film_moes"] / found["central_film"]
    parts = ("mesh", "domain", "meniscus", "algebraic")
    row: Row = {
        "central": found["central_film_moes"],
        "central_own": sum(found[f"film_error_{part}"] or 0.0 for part in parts),
        "smallest": found["minimum_film"] * scale,
        "smallest_own": found["minimum_film_error"],
    }
    if found["friction_coefficient"]:
        row["friction"] = abs(found["friction_coefficient"])
        row["friction_own"] = found["friction_error"]
    return row


def _moving_heat(
    asked: ehlwave.Contact, lengths: dict[str, float], folder: Path
) -> tuple[complex, float] | None:
    """Return the change of the response by temperatures that move with the oil, and its error."""
    group = {"orientation": "custom", "response": "both", "amplitude_over_film": SMALL, **lengths}
    is_line, changes = asked.conditions.is_line, []
    size = MARCH_LINE
    if not is_line:
        need = FEWEST_POINTS * LENGTH / min(length for length in lengths.values() if length > 0)
        size = next((size for size in MARCH_SIZES if size >= need), MARCH_SIZES[-1])
    for cells in (round(COARSER * size), size):
        grid = {"cells_x": cells} if is_line else {"cells_x": cells, "cells_y": cells}
        heat = {"wave_temperatures": "carried"}
        found = _solved(asked, {"waviness": group, "heat": heat, "grid": grid}, folder)
        if found is None:
            return None
        marched = cmath.rect(found["amplitude_ratio_fit"], found["phase_fit"])
        changes.append(marched - complex(found["harmonic_real"], found["harmonic_imaginary"]))
    return changes[1], SAFETY * abs(changes[1] - changes[0])


def _solved(asked: ehlwave.Contact, more: Groups, folder: Path) -> Row | None:
    groups = case_groups(case_keys(asked.conditions, asked.heat))
    shared: Groups = {"solver": {"threads": 1}, "output": {"mean_rise": False}}
    for name, values in (*shared.items(), *more.items()):
        groups[name] = {**groups.get(name, {}), **values}
    return solved(groups, folder)


CONTACT = frozenset(("number", "kind", "is_hot", "wavelength_over_a", "angle_deg", *QUANTITIES))
COMPUTED = CONTACT | {"real", "imaginary", *(f"{name}_own" for name in QUANTITIES)}


def answered(row: Row) -> Row:
    """Return the row with the answers of the laws and their errors, or its refusals."""
    keys: dict[str, Any] = {name: row[name] for name in row if name not in COMPUTED}
    asked = Drawn(keys, row["is_hot"], row["wavelength_over_a"], row["angle_deg"]).contact()
    c = asked.conditions
    return row | {
        **{"m": c.m, "l": c.l, "d": c.d, "oil": c.oil.name},
        **_asked("film", lambda: _film_of(asked.film(by="laws"))),
        **_asked("response", lambda: _response_of(asked, row)),
    }


def _asked(name: str, answer: Callable[[], Row]) -> Row:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return answer()
    except EhlwaveError as error:
        return {f"{name}_refused": str(error)[:160]}


def _film_of(film: ehlwave.Film) -> Row:
    return {
        "central_law": film.central_moes,
        "central_law_error": film.central_error,
        "smallest_law": film.minimum_moes,
        "smallest_law_error": film.minimum_error,
        "friction_law": film.friction and abs(film.friction),
        "friction_law_error": film.friction_error,
    }


def _response_of(asked: ehlwave.Contact, row: Row) -> Row:
    found = asked.response(row["wavelength_over_a"], row["angle_deg"], by="laws")
    law = found.film
    answer = {"real_law": law.real, "imaginary_law": law.imag, "response_law_error": found.error}
    if "real" in row:
        true = complex(row["real"], row["imaginary"])
        # The law of starved contacts has amplitudes alone.
        off = abs(law - true) if found.has_phase else abs(abs(law) - abs(true))
        answer |= {"response_off": off}
    return answer | {"response_source": found.source[:40]}


def study(path: Path, count: int) -> list[Row]:
    """Compute so many contacts, ask the package, write the table; return the coverage.

    Every `AT_ONCE` contacts the coverage is printed; contacts that are known are kept.
    """
    found: list[Row] = []
    for first in range(0, count, AT_ONCE):
        numbers = range(first, min(first + AT_ONCE, count))
        found += [answered(row) for row in kept(path, numbers, computed, 1)]
        for row in coverage(found):
            print(row, flush=True)
    write_rows(path.with_suffix(".csv"), found, digits=5)
    return coverage(found)


def coverage(rows: Iterable[Row]) -> list[Row]:
    """Return the share of contacts within the errors of the package and of the computation."""
    rows = list(rows)
    return [judged([times_of(row, name) for row in rows], name) for name in QUANTITIES]


def judged(times: Sequence[float], name: str, part: str = "answers") -> Row:
    """Return the coverage of a quantity by deviations over errors; NaN are left out."""
    known = [one for one in times if math.isfinite(one)]
    count = len(known)
    return {
        "part": part,
        "law": name,
        "contacts": count,
        "within": sum(one <= 1 for one in known) / count if count else math.nan,
        "beyond_1.5": sum(one > 1.5 for one in known) / count if count else math.nan,
        "largest": max(known, default=math.nan),
    }


def times_of(row: Row, name: str) -> float:
    """Return the deviation of the package over the sum of both errors; NaN if it is unknown."""
    law, own = row.get(f"{name}_law_error"), row.get(f"{name}_own")
    if law is None or own is None or not own <= max(law, UNKNOWN):
        return math.nan
    if name == "response":
        return float(row["response_off"] / (law + own))
    return float(abs(row[f"{name}_law"] / row[name] - 1) / (law + own))
