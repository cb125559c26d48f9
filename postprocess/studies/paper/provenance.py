"""Provenance of a study: stages, times, versions, settings."""

import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from ehlwave.results.points import count_by_status
from ehlwave.results.schema import DIMENSION
from studies.section import Section, Table
from studies.stages import read_stage, read_stages

PACKAGES = ("ehlwave", "numpy", "scipy", "lmfit", "xarray", "h5py", "matplotlib")
PROGRAM = ("program_version", "compiler", "compiler_flags", "library_versions", "mpi_library")


def section(folder: Path, sweeps: list[str]) -> Section:
    """Return the stages with their run times, the versions and the settings of each sweep."""
    results = {name: read_stage(folder, name) for name in sweeps}
    stages = read_stages(folder)
    inputs = {name: str(data["effective_input"].values[0]) for name, data in results.items()}
    found = Section("Settings, versions and run time")
    if len(stages):
        found.text.append(
            f"Run time of the stages: {stages['seconds'].sum() / 3600:.2f} hours of wall time on "
            f"at most {stages['ranks'].max()} ranks, set-up and build not counted. A stage "
            "that was interrupted counts with all its starts."
        )
    settings = pd.DataFrame(inputs.items(), columns=["sweep", "input"])
    caption = "Effective input of the first case of each sweep"
    found.tables = [
        sweep_table(results),
        Table("stages", "Run time of each stage, s", stages),
        version_table(results),
        Table("settings", caption, settings, is_long=True),
    ]
    return found


def sweep_table(results: dict[str, xr.Dataset]) -> Table:
    """Return counts, status, computing time and work of each sweep."""
    rows = []
    for name, data in results.items():
        counts = count_by_status(data).items()
        row = {
            "sweep": name,
            "cases": data.sizes[DIMENSION],
            "status": ", ".join(f"{count} {status}" for status, count in counts),
            "seconds of all cases": float(np.nansum(data["seconds"])),
            "largest MiB": float(np.nanmax(data["peak_memory_mib"])),
            "revision": ", ".join(np.unique(data["git_revision"])),
        }
        rows.append(row)
    return Table("sweeps", "The sweeps of the study", pd.DataFrame(rows))


def version_table(results: dict[str, xr.Dataset]) -> Table:
    """Return compilers, libraries and Python packages."""
    rows = []
    for name in PROGRAM:
        values = {str(value) for data in results.values() for value in data[name].values}
        rows.append((name.replace("_", " "), "; ".join(sorted(values - {""}))))
    rows.append(("Python", platform.python_version()))
    for package in PACKAGES:
        try:
            rows.append((package, version(package)))
        except PackageNotFoundError:
            rows.append((package, "not installed as a package"))
    return Table("versions", "Versions", pd.DataFrame(rows, columns=["what", "version"]))
