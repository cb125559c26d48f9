"""``python -m studies.paper STUDY``: the report on a full study, what its last stage runs."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from ehlwave_post.errors import ResultsError
from studies.paper.report import write_report


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the report; return 0, or 1 with a message on standard error."""
    parser = argparse.ArgumentParser(
        prog="python -m studies.paper",
        description="Write the report on a full study: a self-contained HTML page, its tables as "
        "CSV files and its figures as PDF and PNG.",
    )
    parser.add_argument(
        "study", type=Path, metavar="STUDY", help="folder that scripts/reproduce --full wrote"
    )
    parser.add_argument("--output", type=Path, metavar="DIR", help="default: report in STUDY")
    options = parser.parse_args(arguments)
    output = options.output or options.study / "report"
    try:
        written = write_report(options.study, output, lambda text: print(text, flush=True))
    except (ResultsError, OSError) as error:
        print(f"report: error: {error}", file=sys.stderr)
        return 1
    print(f"{written[0]}: {len(written) - 1} tables and figures beside it")
    return 0


if __name__ == "__main__":
    sys.exit(main())
