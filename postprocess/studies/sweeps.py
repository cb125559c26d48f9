"""Studies as sweeps: the files that ``scripts/run-sweep`` is given, and the rows of its results."""

import argparse
import csv
import hashlib
import io
import lzma
import math
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ehlwave.errors import ResultsError
from ehlwave.results.read import read_results
from ehlwave.surface import Surface, simulation_surface, write_simulation_surface
from ehlwave.writing import Writer
from studies.programs import Groups, namelist, paper_edges

Row = dict[str, Any]


def write_sweep(
    folder: Path, name: str, rows: Iterable[Mapping[str, object]], groups: Groups
) -> Path:
    """Write ``name``.nml and the CSV file of its cases; return the path of the former.

    The edges of the domain are the paper's unless the groups set them.

    Parameters
    ----------
    folder : Path
        Is made when absent. The results become ``name``.h5 there.
    name : str
        Of the files.
    rows : iterable of mappings
        Values of each case by key; missing values are empty cells, which leave the default.
    groups : mapping
        Shared keys of all cases, by group and key; ``sweep`` may hold further keys of that group.
    """
    write_rows(folder / f"{name}.csv", rows)
    # A relative path counts from the folder in which the program is started.
    files = {
        "case_file": f"{folder.resolve()}/{name}.csv",
        "output": f"{folder.resolve()}/{name}.h5",
    }
    path = folder / f"{name}.nml"
    text = namelist({**paper_edges(groups), "sweep": {**files, **groups.get("sweep", {})}})
    return Writer().text(path, text)


def read_sweep(folder: Path, name: str, cases: int | None = None) -> list[Row]:
    """Return the cases of a sweep in the order of its rows; NaN for missing numbers.

    Raises ResultsError if it has not been run, or has another number of cases than `cases`.
    """
    path = folder / f"{name}.h5"
    if not path.is_file():
        raise ResultsError(f"{path}: no such file; run the sweep {folder / name}.nml first")
    rows = read_results([path]).to_dataframe().to_dict("records")
    if cases not in (None, len(rows)):
        raise ResultsError(f"{path}: {len(rows)} cases in place of {cases}: of an older sweep file")
    return rows


def fields_file(folder: Path, name: str, row: Row) -> Path:
    """Return where the fields of a case are, if its sweep keeps them (``&output fields``)."""
    return folder / f"{name}.store" / "fields" / f"{row['case_id']}.h5"


def surface_file(folder: Path, surface: Surface) -> Path:
    """Return where a surface is for the simulation.

    A sweep identifies a case by its input, in which the surface is a path: the name identifies the
    heights.
    """
    heights = hashlib.sha256(surface.height.tobytes() + str(surface.step_x_m).encode())
    return folder / f"{Path(surface.name).stem}-{heights.hexdigest()[:8]}.h5"


def write_surface(folder: Path, surface: Surface, repeats: int = 1) -> Path:
    """Write a surface, repeated so many times, and return its path."""
    path = surface_file(folder, surface)
    write_simulation_surface(simulation_surface(surface, "none", repeats), path)
    return path


def flat(groups: Groups) -> Row:
    """Return the keys of all groups as a row of a CSV file."""
    return {key: value for keys in groups.values() for key, value in keys.items()}


def write_rows(path: Path, rows: Iterable[Mapping[str, object]], digits: int = 0) -> None:
    """Write rows as CSV, their keys as columns; NaN and missing values become empty cells.

    Numbers have so many `digits`, or all of them. A path that ends with .xz is compressed.
    """
    rows = list(rows)
    columns = dict.fromkeys(key for row in rows for key in row)
    file = io.StringIO(newline="")
    writer = csv.DictWriter(file, columns, lineterminator="\n")
    writer.writeheader()
    writer.writerows({key: _cell(cell, digits) for key, cell in row.items()} for row in rows)
    if path.suffix == ".xz":
        Writer().data(path, lzma.compress(file.getvalue().encode()))
    else:
        Writer().text(path, file.getvalue())


def run_command(
    parser: argparse.ArgumentParser,
    work: Callable[[argparse.Namespace], int | None],
    arguments: Sequence[str] | None = None,
) -> int:
    """Run a study's command; return its status, or 1 with a message on standard error."""
    options = parser.parse_args(arguments)
    try:
        return work(options) or 0
    except (ResultsError, OSError) as error:
        print(f"{parser.prog}: error: {error}", file=sys.stderr)
        return 1


def _cell(value: object, digits: int) -> object:
    if isinstance(value, bool):
        return ".true." if value else ".false."
    if isinstance(value, float):
        if math.isnan(value):
            return ""
        return f"{value:.{digits}g}" if digits else repr(float(value))
    return value
