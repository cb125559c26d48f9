"""The command behind ``scripts/study validation``: published data beside this program."""

import argparse
import sys
from collections.abc import Sequence

from studies.command import checks
from studies.command.options import step_parser
from studies.sweeps import run_command
from studies.validation.page import PARTS, write_validation


def main(arguments: Sequence[str] | None = None) -> int:
    """Run what is missing, write the page; return 0, or 1 with a message."""
    names = [name for name, _ in PARTS]
    parser = step_parser(checks.validation, __doc__)

    def work(options: argparse.Namespace) -> None:
        written = write_validation(
            options.output / "runs",
            options.output,
            options.part or names,
            lambda text: print(text, flush=True),
        )
        print(f"{written[0]}: {len(written) - 1} tables and figures beside it")

    return run_command(parser, work, arguments)


if __name__ == "__main__":
    sys.exit(main())
