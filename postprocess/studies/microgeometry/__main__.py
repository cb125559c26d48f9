"""The commands behind ``scripts/study microgeometry``: write the sweeps, compare with them.

The first prints the names of the sweeps.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from ehlwave.writing import Writer
from studies.command import checks
from studies.command.options import step_parser
from studies.microgeometry.compare import compare_speeds
from studies.microgeometry.report import write_report
from studies.microgeometry.simulate import (
    SPEEDS,
    conditions_at,
    write_surface,
    write_tables,
    write_waves,
)
from studies.microgeometry.surfaces import surfaces
from studies.microgeometry.traces import compare_traces, ratio_table, write_traces
from studies.sweeps import run_command

LINEAR_LIMIT = 0.3  # amplitude over film
ALLOWED = 0.10  # rms error over Rq, with tables and by default, below that amplitude
RATIO_ALLOWED = 0.03  # of lambda ratios in one call


def main(arguments: Sequence[str] | None = None) -> int:
    """Do one step; return 0, or 1 with a message, or when a prediction is too far off."""
    parser = step_parser(checks.microgeometry, __doc__)
    parser.add_argument("step", choices=("cases", "report"))
    parser.add_argument("folder", type=Path, help="of all files; made when absent")
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> int:
    chosen = surfaces(conditions_at(SPEEDS[0]).semi_axis_a_m).values()
    if options.step == "cases":
        if options.tables is None:
            print(write_waves(options.folder, options.cells).stem)
        for surface in chosen:
            print(write_surface(options.folder, surface, options.cells).stem)
        print(write_traces(options.folder, options.cells).stem)
        return 0
    if options.tables is None:
        write_tables(options.folder)
    tables = options.tables or options.folder
    found = [one for surface in chosen for one in compare_speeds(options.folder, surface, tables)]
    print(write_report(found, options.folder))
    ratios = compare_traces(options.folder)
    table = ratio_table(ratios)
    Writer().table(options.folder / "lambda_ratios.csv", table)
    print(table.to_string(index=False))
    bad = [one for one in found if one.amplitude_over_film < LINEAR_LIMIT]
    bad = [one for one in bad if not max(one.error("table"), one.error("default")) <= ALLOWED]
    for one in bad:
        name = f"{one.surface} at {one.speed:g} m/s"
        print(f"{name}: error with the harmonic table, or the atlas, above {ALLOWED:.0%} of Rq")
    far = [one for one in ratios if not abs(one.error) <= RATIO_ALLOWED]
    for one in far:
        print(f"{one.trace} in {one.contact}: lambda ratio off by {one.error:.1%}")
    return int(bool(bad or far))


if __name__ == "__main__":
    sys.exit(main())
