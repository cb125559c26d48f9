"""``scripts/study NAME [OPTIONS]``."""

import argparse
import inspect
import os
import sys
from functools import partial

from studies.command import atlas, checks, costs, full, laws, maps, robustness  # noqa: F401 - fill the table
from studies.command.options import STUDIES
from studies.command.steps import StoppedError, pass_signals_on

_ABOUT = """Run a study: build what it needs, compute, compare, write tables and figures.

An interrupted study goes on with the same command. EHLWAVE_CASE and EHLWAVE_SWEEP name other
programs than those that are built.
"""
_STATUS = "Options of a study: scripts/study NAME --help. Exit status: as said there; 2 bad usage."
_SHAPE = partial(argparse.RawDescriptionHelpFormatter, max_help_position=20, width=100)


def parser() -> argparse.ArgumentParser:
    """Return the parser with all studies."""
    helps = {name: inspect.getdoc(study.run) or "" for name, study in sorted(STUDIES.items())}
    listed = "\n".join(f"{name:14} {text.splitlines()[0]}" for name, text in helps.items())
    top = argparse.ArgumentParser(
        "scripts/study", "%(prog)s NAME [OPTIONS]", _ABOUT, _STATUS, formatter_class=_SHAPE
    )
    shown = {"title": "studies", "description": listed, "help": argparse.SUPPRESS}
    names = top.add_subparsers(dest="study", metavar="NAME", required=True, **shown)
    for name, text in helps.items():
        words = {"prog": f"scripts/study {name}", "description": text, "allow_abbrev": False}
        one = names.add_parser(name, formatter_class=_SHAPE, **words)
        for option, keywords in STUDIES[name].options:
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
