"""``scripts/study NAME [OPTIONS]``."""

import argparse
import inspect
import os
import sys
from functools import partial

from studies.command import atlas, checks, full, maps, robustness  # noqa: F401 - fill the table
from studies.command.options import STUDIES
from studies.command.steps import StoppedError, pass_signals_on

_ABOUT = """Run a study: build what it needs, compute, compare, write tables and figures.

An interrupted study goes on with the same command. EHLWAVE_CASE and EHLWAVE_SWEEP name other
programs than those that are built.
"""
_STATUS = "Options of a study: scripts/study NAME --help. Exit status: as said there; 2 bad usage."
_SHAPE = partial(argparse.RawDescriptionHelpFormatter, max_help_position=22, width=100)


def parser() -> argparse.ArgumentParser:
    """Return the parser with all studies."""
    top = argparse.ArgumentParser(
        "scripts/study", "%(prog)s NAME [OPTIONS]", _ABOUT, _STATUS, formatter_class=_SHAPE
    )
    names = top.add_subparsers(dest="study", metavar="NAME", title="studies", required=True)
    for name, study in sorted(STUDIES.items()):
        about = inspect.getdoc(study.run) or ""
        one = names.add_parser(
            name,
            prog=f"scripts/study {name}",
            help=about.split("\n")[0].replace("%", "%%"),
            description=about,
            formatter_class=_SHAPE,
            allow_abbrev=False,
        )
        for option, keywords in study.options:
            one.add_argument(option, **keywords)
    return top


def main() -> int:
    """Run a study; return its exit status."""
    options = parser().parse_args()
    if at_once := getattr(options, "at_once", None):
        os.environ["EHLWAVE_RANKS"] = str(at_once)
    pass_signals_on()
    try:
        return STUDIES[options.study].run(options)
    except StoppedError as stopped:
        return stopped.status


if __name__ == "__main__":
    sys.exit(main())
