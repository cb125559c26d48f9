"""The commands behind ``scripts/study stability``: write the sweep, judge its outcome."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from ehlwave.results.figures import write_figure
from ehlwave.writing import Writer
from studies.command import maps
from studies.command.options import step_parser
from studies.stability.cases import (
    OUTSIDE,
    corner_cases,
    full_cases,
    quick_cases,
    sliding_cases,
    starved_cases,
    steady_cases,
    wavy_cases,
)
from studies.stability.figures import parameter_map, steady_map
from studies.stability.run import read_rows, write_cases
from studies.stability.table import summary, write_table
from studies.sweeps import run_command

_SETS = {
    "quick": quick_cases,
    "steady": steady_cases,
    "wavy": wavy_cases,
    "full": lambda: [*full_cases(), *corner_cases()],
    "corner": corner_cases,
    "sliding": sliding_cases,
    "starved": starved_cases,
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the sweep, or table and maps; return 1 when a case failed or claims too much."""
    parser = step_parser(maps.stability, __doc__)
    parser.add_argument("step", choices=("cases", "report"))
    parser.add_argument("folder", type=Path, help="of all files; made when absent")
    parser.add_argument("--cases", choices=_SETS, help="default: full")
    parser.set_defaults(cases="full")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only every Nth case")
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> int:
    cases = _SETS[options.cases]()[:: options.every]
    if options.step == "cases":
        print(write_cases(options.folder, cases, options.limit))
        return 0
    rows = read_rows(options.folder, cases)
    write_table(options.folder / "stability.csv", rows)
    text = summary(rows)
    Writer().text(options.folder / "summary.txt", text + "\n")
    families = {row.case.family for row in rows}
    if "steady" in families:
        write_figure(steady_map(rows), options.folder, "steady")
    if families - {"steady", OUTSIDE}:
        write_figure(parameter_map(rows), options.folder, "parameters")
    print(text)
    return int(any(row.is_bad for row in rows))


if __name__ == "__main__":
    sys.exit(main())
