"""Runs of a contact of the sample on four grids."""

import json
import os
from pathlib import Path
from typing import Any

from ehlwave.writing import Writer, keep_own_file
from studies import programs
from studies.all_keys.draw import Row
from studies.calibrate.contacts import classes_of, drawn, scaled, widened

LARGEST_COST = 4e7
"""Expected work units times cells of a finer run, at most: about five seconds. It is counted, so
the sample does not depend on the machine."""
LONGEST_S = 1800
"""Time of a run that does not end by itself: an error."""
FILES = ("viscosity_table", "oil_profile")
"""Keys of files, whose text belongs to a contact."""
VALUES = (
    *("central_film", "minimum_film", "friction_coefficient", "rolling_resistance"),
    *("harmonic_ratio", "harmonic_real", "harmonic_imaginary"),
    *("harmonic_real_2", "harmonic_imaginary_2", "amplitude_ratio_fit", "amplitude_ratio_fit_2"),
)
DATA = (
    *("status", "rung", "is_resolved", "gamma", "load_parameter_m", "lubricant_parameter_l"),
    *("radius_ratio_d", "slip_parameter", "max_pressure", "domain_x_min", "cells_x", "cells_y"),
    *("wavelength_x_over_a", "wavelength_y_over_a", "points_per_wave_x", "points_per_wave_y"),
    *("inlet_resolution", "scheme", "film_error_basis", "harmonic_error_basis"),
    *("amplitude_error_basis", "harmonic_approach", "warning", "total_work_units", "seconds"),
)


def computed(number: int, known: dict[str, str], folder: Path) -> Row:
    """Return the contact of a number, and its results on all grids."""
    row = drawn(number, known, folder)
    classes = classes_of(row)
    marches = bool({"march", "periodic"} & set(classes))
    base = solved(row, known, folder)
    runs: dict[str, Row | None] = {"base": base}
    if base["central_film"] is not None:
        for name, factor in (("double", 2), ("fourfold", 4)):
            if _cost(base, factor, marches) <= LARGEST_COST:
                runs[name] = solved(scaled(row, factor), known, folder)
        if not marches and _cost(base, 2, marches) <= LARGEST_COST:
            runs["wide"] = solved(widened(row), known, folder)
    files = {key: Path(row[key]).read_text(encoding="utf-8") for key in FILES if key in row}
    return {"number": number, "row": row | files, "classes": classes, "runs": runs}


def _cost(base: Row, factor: int, marches: bool) -> float:
    """Return the expected cost of a run on so many times the cells along each side."""
    sides = (base["cells_y"] > 1) + 1 + marches
    cells = base["cells_x"] * max(1, base["cells_y"])
    return float(base["total_work_units"] * cells * factor**sides)


def solved(row: Row, known: dict[str, str], folder: Path) -> Row:
    """Return what the sample keeps of a run, of a contact with files as paths or as texts."""
    groups: dict[str, dict[str, Any]] = {}
    for key, value in row.items():
        if key in FILES and "\n" in value:
            value = folder / f"{key}.csv"
            keep_own_file(value, row[key].encode())
        groups.setdefault(known[key], {})[key] = value if key not in FILES else str(value)
    groups.setdefault("solver", {})["threads"] = 1
    path = folder / "case.nml"
    keep_own_file(path, programs.namelist(groups).encode())
    outcome = programs.run("case", path, "--json", "--quiet", seconds=LONGEST_S)
    if outcome.returncode not in (0, 1):
        raise RuntimeError(f"{row}: exit status {outcome.returncode}: {outcome.stderr}")
    found: Row = programs.last_line(outcome)
    errors = {key: value for key, value in found.items() if "error" in key and value is not None}
    plain = {key: found[key] for key in (*VALUES, *DATA) if found.get(key) is not None}
    return dict.fromkeys(VALUES) | plain | errors


def numbers_of(part: tuple[int, int], count: int) -> range:
    """Return the numbers of contacts that a part of several computes."""
    index, parts = part
    return range(index - 1, count, parts)


def part_of(text: str | None) -> tuple[int, int]:
    """Return the part of the work: given as i/n, else of the rank in a batch job, else all."""
    if text:
        index, parts = map(int, text.split("/"))
        return index, parts
    rank, ranks = os.environ.get("SLURM_PROCID"), os.environ.get("SLURM_NTASKS")
    return (int(rank) + 1, int(ranks)) if rank and ranks else (1, 1)


def extend(
    folder: Path, part: tuple[int, int], count: int, known: dict[str, str], recorded: set[int]
) -> None:
    """Compute the missing contacts of a part, and keep each when it is done."""
    done = recorded | {row["number"] for row in kept(folder)}
    own = Writer().folder(folder / f"part-{part[0]}-of-{part[1]}")
    for number in numbers_of(part, count):
        if number not in done:
            found = json.dumps(computed(number, known, own))
            keep_own_file(own / f"{number}.json", found.encode())


def kept(folder: Path) -> list[Row]:
    """Return all contacts that are done, by their numbers."""
    rows = [json.loads(path.read_text()) for path in folder.glob("part-*/[0-9]*.json")]
    return sorted(rows, key=lambda row: row["number"])
