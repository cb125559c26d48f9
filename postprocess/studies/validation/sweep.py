"""Sweeps of this study, by ``ehlwave-sweep``: what is finished is kept."""

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path

import xarray as xr

from ehlwave_post.errors import ResultsError
from ehlwave_post.read import read_results
from ehlwave_post.schema import CONVERGED, UNRESOLVED
from studies.programs import Groups, namelist, run

Rows = Sequence[Mapping[str, object]]


def swept(folder: Path, name: str, groups: Groups, rows: Rows) -> xr.Dataset:
    """Return the results of one case for each row, run in `folder` unless they are there.

    Parameters
    ----------
    folder : Path
        Gets ``<name>.csv``, ``<name>.nml`` and ``<name>.h5``.
    groups : mapping
        The keys that all cases have in common.
    rows : sequence of mappings
        The keys of each case, the same for all.

    Raises
    ------
    ResultsError
        If a case fails; unresolved ones are for the caller to judge.
    """
    with (folder / f"{name}.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    sweep = {"sweep": {"case_file": f"{name}.csv", "output": f"{name}.h5"}}
    return run_sweep(folder, name, namelist({**sweep, **groups}))


def run_sweep(folder: Path, name: str, text: str) -> xr.Dataset:
    """Return the results of the sweep of which `text` is the input; its output is ``<name>.h5``.

    Raises
    ------
    ResultsError
        If a case fails.
    """
    (folder / f"{name}.nml").write_text(text, encoding="utf-8")
    outcome = run("sweep", f"{name}.nml", folder=folder)
    if outcome.returncode not in (0, 1):
        raise ResultsError(f"{name}: {(outcome.stderr or outcome.stdout).strip()[-500:]}")
    results = read_results([folder / f"{name}.h5"])
    bad = ~results["status"].isin((CONVERGED, UNRESOLVED))
    if bool(bad.any()):
        first = results.isel(case=int(bad.argmax()))
        raise ResultsError(
            f"{name}: {int(bad.sum())} case(s) failed, the first with status "
            f"{first['status'].item()}: {first['message'].item()}"
        )
    return results
