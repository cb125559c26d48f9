"""Shared arguments of several commands; needs the standard library alone."""

import argparse
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

from ehlwave.choices import DECIMALS, FORM, FORMS, HOW, LAWS
from ehlwave.extras import load

BY = (
    "law that answers; by default the first that holds, and where none does the contact is "
    "computed. 'laws': nothing is computed"
)
"""Help of the option that names a law."""

CONTACT = "the contact: an input file, KEY=VALUE, or both; see below"
"""Help of the option that gives a contact."""

Run = Callable[[argparse.Namespace], None]


def add_drawn_output(parser: argparse.ArgumentParser, text: str) -> None:
    """Add the folder of figures; a missing package is named before anything is computed."""
    parser.add_argument("--output", type=_drawn, metavar="DIR", help=text)


def _drawn(folder: str) -> Path:
    load("matplotlib")
    return Path(folder)


def later(module: str, name: str) -> Run:
    """Return a function that imports its module when it is called, so that help needs none."""

    def run(options: argparse.Namespace) -> None:
        getattr(import_module(module), name)(options)

    return run


def add_output(parser: argparse.ArgumentParser) -> None:
    """Add the folder that files are written to."""
    parser.add_argument(
        "--output",
        type=Path,
        default=Path(),
        metavar="DIR",
        help="folder of the files (default: this one)",
    )
    add_overwrite(parser)


def add_overwrite(parser: argparse.ArgumentParser) -> None:
    """Add the option that lets outputs replace files that are not results of ours."""
    text = "also replace files that ehlwave did not write (never inputs)"
    parser.add_argument("--overwrite", action="store_true", help=text)


def add_reading(parser: argparse.ArgumentParser) -> None:
    """Add the options for data that a surface file lacks."""
    text = "unit of positions and of --step, where the file states none: m, mm, um, nm"
    parser.add_argument("--length-unit", metavar="UNIT", help=text)
    text = "unit of heights, where the file states none: m, mm, um, nm"
    parser.add_argument("--height-unit", metavar="UNIT", help=text)
    text = "channel of heights, or heading of their column, where the file has several"
    parser.add_argument("--channel", metavar="NAME", help=text)
    parser.add_argument(
        "--step", type=float, metavar="LENGTH", help="sampling step, for files without positions"
    )
    parser.add_argument(
        "--step-across",
        type=float,
        metavar="LENGTH",
        help="step between the rows of a map (default: --step)",
    )
    parser.add_argument(
        "--decimal",
        choices=DECIMALS,
        help="decimal mark of a text file, where the file does not decide it",
    )
    parser.add_argument(
        "--rolling-axis",
        choices=("x", "y"),
        default="x",
        help="rolling direction of a map: x along its rows, y across; of a trace: x if it was "
        "measured along rolling, y if across (longitudinal ridges)",
    )
    parser.add_argument(
        "--fill-missing",
        action="store_true",
        help="replace missing heights, and heights far outside all others, by their neighbours: at "
        "most a tenth of them",
    )
    parser.add_argument(
        "--form",
        choices=tuple(FORMS),
        default=FORM,
        help="polynomial to remove: nothing, offset, tilt (default), tilt and curvature",
    )


def add_laws(parser: argparse.ArgumentParser, *names: str) -> Any:  # noqa: ANN401 - a private type
    """Add the options that choose a law for waves; return their group, for others."""
    group = parser.add_mutually_exclusive_group()
    group.add_argument("--by", *names, choices=(*LAWS, *HOW), help=BY)
    group.add_argument(
        "--table", type=Path, metavar="FILE", help="harmonic table that answers for waves"
    )
    return group
