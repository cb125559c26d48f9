"""Sweeps of this study, run by ``ehlwave-sweep`` where they are not finished."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import xarray as xr

from ehlwave.errors import ResultsError
from ehlwave.results.read import read_results
from ehlwave.results.schema import CONVERGED, UNRESOLVED
from studies.programs import Groups, run
from studies.sweeps import write_sweep


def swept(
    folder: Path, name: str, groups: Groups, rows: Sequence[Mapping[str, object]]
) -> xr.Dataset:
    """Return the results of one case for each row, with `groups` in common.

    Raises ResultsError if a case fails; unresolved ones are for the caller to judge.
    """
    return run_sweep(write_sweep(folder, name, rows, groups), folder / f"{name}.h5")


def run_sweep(path: Path, output: Path) -> xr.Dataset:
    """Return the results of the sweep file `path`, which go to `output`.

    Raises ResultsError if a case fails.
    """
    outcome = run("sweep", path, "--output", output)
    if outcome.returncode not in (0, 1):
        raise ResultsError(f"{path}: {(outcome.stderr or outcome.stdout).strip()[-500:]}")
    results = read_results([output])
    bad = ~results["status"].isin((CONVERGED, UNRESOLVED))
    if bool(bad.any()):
        first = results.isel(case=int(bad.argmax()))
        raise ResultsError(
            f"{output}: {int(bad.sum())} case(s) failed, the first with status "
            f"{first['status'].item()}: {first['message'].item()}"
        )
    return results
