"""What a study was computed with: stages, times, versions, settings."""

import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import numpy as np
import xarray as xr

from ehlwave_post.points import count_by_status
from ehlwave_post.schema import DIMENSION
from studies.paper.data import read_stage, read_stages
from studies.section import Section, Table

PACKAGES = ("ehlwave-post", "numpy", "scipy", "lmfit", "xarray", "h5py", "matplotlib")


def section(folder: Path, sweeps: list[str]) -> Section:
    """Return the stages with their run times, the versions and the settings of each sweep."""
    results = {name: read_stage(folder, name) for name in sweeps}
    stages = read_stages(folder)
    total = sum(stage.seconds for stage in stages)
    text = []
    if stages:
        text.append(
            f"Run time of the stages: {total / 3600:.2f} hours of wall time on at most "
            f"{max(stage.ranks for stage in stages)} ranks, set-up and build not counted. A stage "
            "that was interrupted counts with all its starts."
        )
    return Section(
        "Settings, versions and run time",
        text,
        [
            sweep_table(results),
            Table(
                "stages",
                "Run time of each stage, s",
                ("stage", "seconds", "ranks", "revision"),
                [(stage.name, stage.seconds, stage.ranks, stage.revision) for stage in stages],
            ),
            version_table(results),
            Table(
                "settings",
                "Effective input of the first case of each sweep",
                ("sweep", "input"),
                [(name, str(data["effective_input"].values[0])) for name, data in results.items()],
                is_long=True,
            ),
        ],
    )


def sweep_table(results: dict[str, xr.Dataset]) -> Table:
    """Return counts, status, computing time and work of each sweep."""
    rows = []
    for name, data in results.items():
        counts = ", ".join(f"{count} {status}" for status, count in count_by_status(data).items())
        revisions = ", ".join(sorted(set(data["git_revision"].values.tolist())))
        seconds = data["seconds"].values
        memory = float(np.nanmax(data["peak_memory_mib"].values))
        rows.append(
            (name, data.sizes[DIMENSION], counts, float(np.nansum(seconds)), memory, revisions)
        )
    columns = ("sweep", "cases", "status", "seconds of all cases", "largest MiB", "revision")
    return Table("sweeps", "The sweeps of the study", columns, rows)


def version_table(results: dict[str, xr.Dataset]) -> Table:
    """Return compilers, libraries and Python packages."""
    rows: list[tuple[str, str]] = []
    for name in (
        "program_version",
        "compiler",
        "compiler_flags",
        "library_versions",
        "mpi_library",
    ):
        values = {str(value) for data in results.values() for value in data[name].values.tolist()}
        rows.append((name.replace("_", " "), "; ".join(sorted(values - {""}))))
    rows.append(("Python", platform.python_version()))
    for package in PACKAGES:
        try:
            rows.append((package, version(package)))
        except PackageNotFoundError:
            rows.append((package, "not installed as a package"))
    return Table("versions", "Versions", ("what", "version"), rows)
