"""The commands behind ``scripts/study lambda``: write the sweeps, compare with them.

The first prints the names of the sweeps.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from studies.command import checks
from studies.command.options import step_parser
from studies.lambda_ratio.compare import compare
from studies.lambda_ratio.judge import uncovered
from studies.lambda_ratio.report import write_report
from studies.lambda_ratio.simulate import CONTACTS, write_marches
from studies.sweeps import run_command

ALLOWED = 0.05
"""Share of the marches whose lambda ratio may be further off than the stated error."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Do one step; return 0, or 1 when stated errors are too small."""
    parser = step_parser(checks.lambda_ratio, __doc__)
    parser.add_argument("step", choices=("cases", "report"))
    parser.add_argument("folder", type=Path, help="of all files; made when absent")
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> int:
    contacts = options.contact or tuple(CONTACTS)
    if options.step == "cases":
        for contact in contacts:
            print(write_marches(options.folder, contact, options.cells).stem)
        return 0
    compared = pd.concat([compare(options.folder, one) for one in contacts], ignore_index=True)
    print(write_report(compared, options.folder))
    bad, marched = uncovered(compared)
    print(f"\n{bad} of {marched} lambda ratios are further off than their stated error")
    return int(bad > ALLOWED * marched)


if __name__ == "__main__":
    sys.exit(main())
