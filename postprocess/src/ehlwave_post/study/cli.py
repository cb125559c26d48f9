"""The command ``ehlwave-post report``."""

import argparse
from pathlib import Path
from typing import Any

from ehlwave_post.study.report import write_report

_TEXT = (
    "Write the report on a full study: a self-contained HTML page, its tables as CSV files and its "
    "figures as PDF and PNG."
)


def add_command(commands: Any) -> None:  # noqa: ANN401 - argparse's type is private
    """Add ``report`` to the commands of ``ehlwave-post``."""
    report = commands.add_parser("report", help="report on a full study", description=_TEXT)
    report.add_argument(
        "study", type=Path, metavar="STUDY", help="folder that scripts/reproduce --full wrote"
    )
    report.add_argument(
        "--output", type=Path, metavar="DIR", help="default: the folder report in STUDY"
    )
    report.set_defaults(run=_report)


def _report(options: argparse.Namespace) -> None:
    output = options.output or options.study / "report"
    written = write_report(options.study, output, lambda text: print(text, flush=True))
    print(f"{written[0]}: {len(written) - 1} tables and figures beside it")
