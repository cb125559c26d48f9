"""The files of a full study and the data of its sections."""

from pathlib import Path

import pandas as pd
import xarray as xr

from ehlwave.errors import ResultsError
from ehlwave.results.points import CONDITION
from ehlwave.results.read import read_results

STAGES = "stages.csv"
POINT = (*CONDITION, "wavelength_x_over_a", "wavelength_y_over_a")


def read_stage(folder: Path, name: str) -> xr.Dataset:
    """Return the results of a sweep of the study.

    Raises ResultsError if the sweep has not been run, or not to its end.
    """
    path = folder / f"{name}.h5"
    if not path.is_file():
        raise ResultsError(f"{path}: no such file; scripts/reproduce --full makes it")
    results = read_results([path])
    pending = int((results["status"] == "pending").sum())
    if pending:
        raise ResultsError(f"{path}: {pending} case(s) have not been run yet; run the study again")
    return results


def read_stages(folder: Path) -> pd.DataFrame:
    """Return the finished parts of the study in the order in which they were first finished.

    Columns: ``stage``, ``seconds``, ``ranks``, ``revision``. A part that was done in several starts
    has their seconds added.
    """
    path = folder / STAGES
    if not path.is_file():
        return pd.DataFrame(columns=["stage", "seconds", "ranks", "revision"])
    starts = pd.read_csv(path, dtype={"seconds": float, "git_revision": str})
    parts = starts.rename(columns={"git_revision": "revision"}).groupby("stage", sort=False)
    return parts.agg({"seconds": "sum", "ranks": "last", "revision": "last"}).reset_index()


def by_point(points: xr.Dataset) -> pd.DataFrame:
    """Return the points as rows, by their identifying columns: orientation, M, L, D, wavelengths.

    The numbers of this index are rounded to six digits: files may hold them in other last bits.
    """
    table = points.to_dataframe()
    rounded = [table[name].map("{:.6g}".format) for name in POINT]
    return table.set_index([table["orientation"], *rounded])
