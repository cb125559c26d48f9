"""Run the stability map: ``python -m studies.stability PROGRAM --output DIR``."""

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from ehlwave_post.figures import write_figure
from studies.stability import (
    corner_cases,
    full_cases,
    parameter_map,
    quick_cases,
    steady_cases,
    steady_map,
    wavy_cases,
)
from studies.stability.outcome import Row
from studies.stability.run import run_cases
from studies.stability.table import bad_line, summary, write_table

_SETS = {
    "quick": quick_cases,
    "steady": steady_cases,
    "wavy": wavy_cases,
    "full": lambda: [*full_cases(), *corner_cases()],
    "corner": corner_cases,
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the cases, write table and maps; return 1 when a case failed or claims too much."""
    options = _parser().parse_args(arguments)
    cases = _SETS[options.cases]()[:: options.every]
    options.output.mkdir(parents=True, exist_ok=True)
    start = time.monotonic()

    rows: list[Row] = []

    def report(done: int, row: Row) -> None:
        rows.append(row)
        write_table(options.output / "stability.csv", rows)  # a long run may be cut short
        if row.is_bad:
            print(bad_line(row), flush=True)
        if done % 25 == 0 or done == len(cases):
            elapsed = time.monotonic() - start
            print(f"{done}/{len(cases)} cases, {elapsed:.0f} s", flush=True)

    run_cases(options.program, cases, options.limit, options.at_once, report)
    text = summary(rows)
    (options.output / "summary.txt").write_text(text + "\n", encoding="utf-8")
    if any(row.case.family == "steady" for row in rows):
        write_figure(steady_map(rows), options.output, "steady")
    if any(row.case.family not in ("steady", "outside") for row in rows):
        write_figure(parameter_map(rows), options.output, "parameters")
    print(text)
    return int(any(row.is_bad for row in rows))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="stability-map", description=__doc__)
    parser.add_argument("program", type=Path, help="ehlwave-case")
    parser.add_argument("--cases", choices=_SETS, default="full", help="default: full")
    parser.add_argument("--output", type=Path, default=Path(), metavar="DIR")
    parser.add_argument("--at-once", type=int, default=1, metavar="N", help="cases at a time")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only every Nth case")
    parser.add_argument(
        "--limit", type=float, default=900, metavar="SECONDS", help="time a case may take"
    )
    return parser


if __name__ == "__main__":
    sys.exit(main())
