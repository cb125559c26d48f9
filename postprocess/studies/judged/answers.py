"""Answers of the package for contacts of all kinds, beside the program on fine grids.

Films and friction come first, responses second.
"""

import cmath
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import ehlwave
from ehlwave.errors import EhlwaveError
from ehlwave.programs.case_input import case_groups, case_keys
from studies.atlas.waves import pattern
from studies.judged.any_contact import contact, cost
from studies.judged.runs import kept, solved
from studies.sweeps import Row, write_rows

FINE, WARM = (256, 256), (192, 192)
LINE = {"cells_x": 6144, "x_min": -9.0, "x_max": 2.5}
HEAVY_M, HEAVY, CENTRAL_ACCURACY = 3000.0, (512, 256), 0.003
"""Grids of films, with heat, of line and of heavy contacts; accuracy of another central film. The
usual domain of line contacts takes 0.2 % off central films."""
WAVE_SIZES, WAVE_LINE, FEWEST_POINTS, LENGTH = (256, 384, 512), 4096, 16, 4.0
MARCH_SIZES, MARCH_LINE, SMALL = (64, 96, 128), 512, 0.01
"""Cells of waves and of marches, and Ai over the film."""
QUANTITIES = ("central", "smallest", "friction", "response")
UNKNOWN, AT_ONCE = 0.02, 20
"""Error of a computed value that judges nothing, unless the error of the package is larger; number
of contacts between two prints."""


def films(number: int, folder: Path) -> Row:
    """Return films and friction of the package and of the program, Moes scale."""
    kind, one = contact(number)
    asked = one.contact()
    row: Row = {"kind": kind, **_named(one.keys), "is_hot": one.heat}
    c = asked.conditions
    row |= {"m": c.m, "l": c.l, "d": c.d, "oil": c.oil.name}
    try:
        film = asked.film()
    except EhlwaveError as error:
        return row | {"refused": str(error)[:160]}
    is_computed = "computed" in film.source
    row |= {"is_computed": is_computed, **_film_of(film)}
    cells = WARM if one.heat else HEAVY if c.m > HEAVY_M else FINE
    grid = LINE if c.is_line else {"cells_x": cells[0], "cells_y": cells[1]}
    found = _known([_solved(asked, {"grid": grid}, folder)])
    if not found or _own(found[0]) > 0.5 * film.central_error:
        found += _known([_solved(asked, {"solver": {"accuracy": CENTRAL_ACCURACY}}, folder)])
    if not found:
        return row
    best = min(found, key=_own)
    row |= {"central": best["central_film_moes"], "central_own": _own(best)}
    best = min(found, key=lambda run: float(run["minimum_film_error"] or math.inf))
    scale = best["central_film_moes"] / best["central_film"]
    row |= {"smallest": best["minimum_film"] * scale, "smallest_own": best["minimum_film_error"]}
    best = min(found, key=lambda run: float(run["friction_error"] or math.inf))
    if film.friction is not None and best["friction_coefficient"]:
        size = abs(best["friction_coefficient"])
        row |= {"friction": size, "friction_own": best["friction_error"]}
    return row


def _own(run: Row) -> float:
    """Return the error of the central film by mesh, domain and meniscus."""
    parts = (run.get(f"film_error_{part}") for part in ("mesh", "domain", "meniscus", "algebraic"))
    return sum(part for part in parts if part is not None and math.isfinite(part))


def _known(runs: Sequence[Row | None]) -> list[Row]:
    return [run for run in runs if run is not None and run["is_resolved"]]


def _film_of(film: ehlwave.Film) -> Row:
    return {
        "central_law": film.central_moes,
        "central_law_error": film.central_error,
        "smallest_law": film.minimum_moes,
        "smallest_law_error": film.minimum_error,
        "friction_law": film.friction and abs(film.friction),
        "friction_law_error": film.friction_error,
    }


def _named(keys: dict[str, Any]) -> Row:
    return {name: float(f"{value:.6g}") for name, value in keys.items() if value is not None}


def _solved(asked: ehlwave.Contact, more: dict[str, Row], folder: Path) -> Row | None:
    groups = case_groups(case_keys(asked.conditions, asked.heat))
    shared: dict[str, Row] = {"solver": {"threads": 1}, "output": {"mean_rise": False}}
    for source in (shared, more):
        for name, values in source.items():
            groups[name] = {**groups.get(name, {}), **values}
    return solved(groups, folder)


def waves(number: int, folder: Path) -> Row:
    """Return the response of the laws and of the program, with its march where the contact warms.

    Responses of marches carry heat: the limit of frozen temperatures, plus their difference.
    """
    kind, one = contact(number)
    asked, wave = one.contact(), (one.wavelength_over_a, one.angle_deg)
    c = asked.conditions
    row: Row = {"kind": kind, "wavelength_over_a": wave[0], "angle_deg": wave[1]}
    row |= {"is_hot": one.heat, "oil": c.oil.name, "slip_parameter": c.slip_parameter}
    try:
        response = asked.response(*wave, by="laws")
    except EhlwaveError as error:
        return row | {"refused": str(error)[:160]}
    row |= {"real_law": response.film.real, "imaginary_law": response.film.imag}
    row |= {"response_law_error": response.error, "source": response.source[:40]}
    lengths = pattern(*wave)
    is_marched = one.heat and wave[1] < 90
    group = {"orientation": "custom", "response": "both" if is_marched else "harmonic", **lengths}
    more: dict[str, Row] = {"waviness": group, "grid": _grid(c.is_line, lengths, is_marched)}
    if is_marched:
        group["amplitude_over_film"] = SMALL
        more["heat"] = {"wave_temperatures": "carried"}
    found = _solved(asked, more, folder)
    if found is None or not found["is_resolved"]:
        return row
    true = complex(found["harmonic_extrapolated_real"], found["harmonic_extrapolated_imaginary"])
    plain = complex(found["harmonic_real"], found["harmonic_imaginary"])
    if is_marched:
        true += cmath.rect(found["amplitude_ratio_fit"], found["phase_fit"]) - plain
    own = found["harmonic_error"] * abs(plain)
    # The law of starved contacts has amplitudes alone.
    off = abs(response.film - true) if response.has_phase else abs(abs(response.film) - abs(true))
    row |= {"real": true.real, "imaginary": true.imag, "response_own": own}
    return row | {"response_off": off}


def _grid(is_line: bool, lengths: dict[str, float], is_marched: bool) -> Row:
    if is_line:
        return {"cells_x": MARCH_LINE if is_marched else WAVE_LINE}
    need = FEWEST_POINTS * LENGTH / min(length for length in lengths.values() if length > 0)
    sizes = MARCH_SIZES if is_marched else WAVE_SIZES
    cells = next((size for size in sizes if size >= need), sizes[-1])
    return {"cells_x": cells, "cells_y": cells}


def study(path: Path, count: int, folder: Path) -> list[Row]:
    """Compute so many contacts, quick kinds first; write both tables; return the coverage.

    Every `AT_ONCE` contacts the coverage is printed; rows that are known are kept.
    """
    numbers = sorted(range(count), key=cost)
    found: list[Row] = []
    for first in range(0, count, AT_ONCE):
        part = numbers[first : first + AT_ONCE]
        film_rows = kept(path, part, films, 1)
        wave_rows = kept(path.with_name(f"{path.stem}_waves.jsonl"), part, waves, 1)
        found += [*film_rows, *wave_rows]
        for name in QUANTITIES:
            print(judged(found, name), flush=True)
    for name, kind in (("answers", films), ("answers_waves", waves)):
        rows = kept(path.with_name(f"{name}.jsonl"), numbers, kind, 1)
        write_rows(folder / f"{name}.csv", rows, digits=5)
    return [judged(found, name) for name in QUANTITIES]


def judged(rows: Sequence[Row], name: str) -> Row:
    """Return the share of contacts within the errors of the package and of the computation."""
    times = [times_of(row, name) for row in rows]
    known = [one for one in times if math.isfinite(one)]
    count = len(known)
    return {
        "part": "answers",
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
