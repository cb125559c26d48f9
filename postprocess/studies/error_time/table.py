"""Run the table with ``ehlwave-case`` and keep it in a CSV file; rows that are there stay."""

import csv
import json
import math
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable
from dataclasses import asdict, fields
from pathlib import Path

from ehlwave_post.errors import ResultsError
from studies import programs
from studies.error_time.runs import METHODS, WAVY, Extent, Run, all_runs

OUTCOMES = (
    "status",
    "is_resolved",
    "central_film",
    "minimum_film",
    "amplitude_ratio_fit",
    "amplitude_ratio",
    "formula_ratio",
    "central_film_error",
    "minimum_film_error",
    "inlet_resolution",
    "points_per_wave_x",
    "points_per_wave_y",
    "kappa",
    "gamma",
    "time_steps",
    "nonlinear_steps",
    "linear_steps",
    "seconds",
    "work_units",
)
"""Taken from the JSON object of a run."""

KEYS = tuple(field.name for field in fields(Run))
Row = dict[str, float | str]


def available_methods(program: Path) -> tuple[str, ...]:
    """Return the methods that this build takes; say on standard error which are left out."""
    taken = []
    for method in METHODS:
        outcome = _call(program, Run(*WAVY[0], 32, method=method), "--plan")
        if outcome.returncode == 0:
            taken.append(method)
        else:
            _say(f"method '{method}' is left out: {_last(outcome.stderr)}")
    return tuple(taken)


def run_table(program: Path, path: Path, extent: Extent, minutes: float) -> list[Row]:
    """Run what the table at `path` lacks, for at most `minutes`, and return the whole table.

    Parameters
    ----------
    program : Path
        ``ehlwave-case``.
    path : Path
        CSV file; made when absent, appended to after every run.
    extent : Extent
        How much is run.
    minutes : float
        No run is started after this time.

    Raises
    ------
    ResultsError
        When the program cannot be run, refuses a run, or the table at `path` has other columns.
    """
    try:
        methods = available_methods(program)
    except OSError as error:
        message = f"{program}: {error.strerror}; build it first (scripts/build release)"
        raise ResultsError(message) from error
    if not methods:
        raise ResultsError(f"{program} takes none of the methods {', '.join(METHODS)}, see above")
    table = read_table(path) if path.exists() else []
    done = {tuple(row[name] for name in KEYS) for row in table}
    runs = [run for run in all_runs(extent, methods) if tuple(asdict(run).values()) not in done]
    _say(f"{len(runs)} runs to do, {len(table)} are in {path}")
    start = time.monotonic()
    total, spent = sum(run.effort for run in runs), 0.0
    for number, run in enumerate(runs, 1):
        if time.monotonic() - start > 60 * minutes:
            left = len(runs) - number + 1
            _say(f"stopped after {minutes:g} min with {left} runs left; start again to go on")
            break
        row = run_one(program, run)
        table.append(row)
        _append(path, row)
        spent += run.effort
        left = (time.monotonic() - start) * (total / spent - 1) / 60
        _say(
            f"{number}/{len(runs)}  {run.contact.title}, {run.cells} cells, {run.method}, "
            f"{run.deformation}: {row['status']}, {row['seconds']:.3g} s; about {left:.0f} min left"
        )
    return table


def run_one(program: Path, run: Run) -> Row:
    """Run one case; the row holds its inputs and outcome, NaN for what it did not give."""
    outcome = _call(program, run, "--json", "--quiet")
    if outcome.returncode not in (0, 1):
        raise ResultsError(f"{program} refuses a run of the table: {_last(outcome.stderr)}")
    answer = json.loads(_last(outcome.stdout))
    row: Row = asdict(run)
    for name in OUTCOMES:
        value = answer.get(name)
        if name == "status":
            row[name] = str(value)
        else:
            row[name] = math.nan if value is None else float(value)
    return row


def read_table(path: Path) -> list[Row]:
    """Read the table; numbers become floats."""
    with path.open(newline="", encoding="utf-8") as file:
        reader = csv.DictReader(file)
        if tuple(reader.fieldnames or ()) != (*KEYS, *OUTCOMES):
            message = f"{path} is not a table of this version: move it away to start a new one"
            raise ResultsError(message)
        return [{name: _value(text) for name, text in row.items()} for row in reader]


def write_rows(path: Path, rows: Iterable[Row]) -> None:
    """Write rows that have the same columns, numbers with six digits."""
    rows = [
        {name: f"{cell:.6g}" if isinstance(cell, float) else cell for name, cell in row.items()}
        for row in rows
    ]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]) if rows else [], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def _value(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text


def _append(path: Path, row: Row) -> None:
    is_new = not path.exists()
    with path.open("a", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, [*KEYS, *OUTCOMES], lineterminator="\n")
        if is_new:
            writer.writeheader()
        writer.writerow(row)


def _call(program: Path, run: Run, *options: str) -> subprocess.CompletedProcess[str]:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "case.nml")
        path.write_text(programs.namelist(run.groups), encoding="utf-8")
        command = [program, path, *options]
        return subprocess.run(command, capture_output=True, text=True, check=False)


def _last(text: str) -> str:
    lines = text.strip().splitlines()
    return lines[-1] if lines else "(no output)"


def _say(text: str) -> None:
    print(f"error-vs-time: {text}", file=sys.stderr, flush=True)
