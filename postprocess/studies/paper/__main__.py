"""``python -m studies.paper STUDY``: the report on a full study, run by its last stage."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from studies.paper.report import write_report
from studies.sweeps import run_command


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the report; return 0, or 1 with a message on standard error."""
    parser = argparse.ArgumentParser(
        prog="report",
        description="Write the report on a full study: a self-contained HTML page, its tables as "
        "CSV files and its figures as PDF and PNG.",
    )
    parser.add_argument(
        "study", type=Path, metavar="STUDY", help="folder that scripts/reproduce --full wrote"
    )
    parser.add_argument("--output", type=Path, metavar="DIR", help="default: report in STUDY")
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> None:
    output = options.output or options.study / "report"
    written = write_report(options.study, output, lambda text: print(text, flush=True))
    print(f"{written[0]}: {len(written) - 1} tables and figures beside it")


if __name__ == "__main__":
    sys.exit(main())
