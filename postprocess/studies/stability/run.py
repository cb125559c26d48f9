"""The cases as a sweep, and cases that must be refused, which no sweep accepts, individually."""

from collections.abc import Sequence
from pathlib import Path

from studies import programs, sweeps
from studies.stability.cases import OUTSIDE, Case
from studies.stability.outcome import Row, compare, judge, judge_refusal

NAME = "cases"
"""Name of the sweep's files."""


def write_cases(folder: Path, cases: Sequence[Case], limit_seconds: float) -> Path:
    """Write the sweep of the cases; return the path of its file.

    A case that takes longer than `limit_seconds` is given up and counts as failed.
    """
    rows = [sweeps.flat(case.groups) for case in cases if case.family != OUTSIDE]
    limit = {"largest_case_seconds": limit_seconds}
    return sweeps.write_sweep(folder, NAME, rows, {"sweep": limit})


def read_rows(folder: Path, cases: Sequence[Case]) -> list[Row]:
    """Return the outcomes: cases of the sweep from its results, the others by new runs."""
    swept = [case for case in cases if case.family != OUTSIDE]
    found = sweeps.read_sweep(folder, NAME, len(swept)) if swept else []
    rows = [judge(case, result) for case, result in zip(swept, found, strict=True)]
    compare(rows)
    return rows + [judge_refusal(case, plan(case)) for case in cases if case.family == OUTSIDE]


def plan(case: Case) -> programs.Outcome:
    """Have ``ehlwave-case`` plan a case."""
    return programs.run_case(case.groups, "--plan")
