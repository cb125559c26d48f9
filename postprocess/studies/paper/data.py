"""The files of a full study and what its sections take from them."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from ehlwave_post.errors import ResultsError
from ehlwave_post.points import CONDITION
from ehlwave_post.read import read_results
from ehlwave_post.schema import DIMENSION

STAGES = "stages.csv"
POINT = (*CONDITION, "orientation", "wavelength_x_over_a", "wavelength_y_over_a")


@dataclass(frozen=True)
class Stage:
    """One line of ``stages.csv``: a finished part of ``scripts/reproduce --full``."""

    name: str
    seconds: float
    ranks: int
    revision: str


def read_stage(folder: Path, name: str) -> xr.Dataset:
    """Return the results of one sweep of the study.

    Raises
    ------
    ResultsError
        If the sweep has not been run, or not to its end.
    """
    path = folder / f"{name}.h5"
    if not path.is_file():
        raise ResultsError(f"{path}: no such file; scripts/reproduce --full makes it")
    results = read_results([path])
    pending = int((results["status"] == "pending").sum())
    if pending:
        raise ResultsError(f"{path}: {pending} case(s) have not been run yet; run the study again")
    return results


def read_stages(folder: Path) -> list[Stage]:
    """Return the finished parts of the study in the order in which they were first finished.

    A part that was done in several starts has their seconds added.
    """
    path = folder / STAGES
    if not path.is_file():
        return []
    stages: dict[str, Stage] = {}
    with path.open(newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            before = stages[row["stage"]].seconds if row["stage"] in stages else 0.0
            seconds = before + float(row["seconds"])
            stages[row["stage"]] = Stage(
                row["stage"], seconds, int(row["ranks"]), row["git_revision"]
            )
    return list(stages.values())


def point_keys(points: xr.Dataset) -> list[tuple[object, ...]]:
    """Return for each case what tells its point from others: M, L, D, orientation, wavelengths.

    Numbers are rounded to six digits: files may hold them in other last bits.
    """
    columns = []
    for name in POINT:
        values = points[name].values
        columns.append([_rounded(value) for value in values.tolist()])
    return list(zip(*columns, strict=True))


def matched(first: xr.Dataset, second: xr.Dataset) -> tuple[xr.Dataset, xr.Dataset]:
    """Return the points that are in both datasets, in the order of the first."""
    place = {key: index for index, key in enumerate(point_keys(second))}
    pairs = [(index, place[key]) for index, key in enumerate(point_keys(first)) if key in place]
    mine, theirs = (np.array([pair[side] for pair in pairs], dtype=int) for side in (0, 1))
    return first.isel({DIMENSION: mine}), second.isel({DIMENSION: theirs})


def _rounded(value: object) -> object:
    return float(f"{value:.6g}") if isinstance(value, float) else value
