"""Common parts of command lines: nearest words, names of options, slide-to-roll ratios."""

import argparse
import re
import sys
from collections.abc import Iterator
from typing import NoReturn, TextIO

from ehlwave.errors import did_you_mean
from ehlwave.inputs.slip import RATIO


class Parser(argparse.ArgumentParser):
    """A parser that suggests the nearest command or option for an unknown word."""

    def print_help(self, file: TextIO | None = None) -> None:  # type: ignore[override]
        """Print the help; raises OSError where it cannot be written, as any output does."""
        print(self.format_help(), end="", file=file or sys.stdout, flush=True)

    def error(self, message: str) -> NoReturn:
        """Print the error and the nearest word, and end with status 2."""
        chosen = re.search(r"invalid choice: '([^']*)' \(choose from (.*)\)", message)
        if chosen:
            message += did_you_mean(chosen[1], re.findall(r"'([^']+)'", chosen[2]))
        elif message.startswith("unrecognized arguments: "):
            for word in message.split(": ", 1)[1].split():
                if word.startswith("--"):
                    message += did_you_mean(word.split("=")[0], set(_options(self)))
        super().error(message)


def _options(parser: argparse.ArgumentParser) -> Iterator[str]:
    """Yield the options of a parser and of its commands."""
    for action in parser._actions:
        yield from action.option_strings
        if isinstance(action, argparse._SubParsersAction):
            for command in action.choices.values():
                yield from _options(command)


def add_ratio(parser: argparse.ArgumentParser) -> None:
    """Add ``--slide-to-roll-ratio`` to a command that takes ``--conditions``."""
    parser.add_argument(
        f"--{RATIO.replace('_', '-')}",
        metavar="SRR",
        help="(u1 - u2)/mean speed; surface 1 is the rough one. Replaces it in --conditions",
    )


def with_ratio(options: argparse.Namespace) -> None:
    """Put a slide-to-roll ratio, if given, among the words of the conditions."""
    ratio = getattr(options, RATIO, None)
    if ratio is not None and getattr(options, "conditions", None):
        options.conditions = [*options.conditions, f"{RATIO}={ratio}"]


def as_options(message: str, options: argparse.Namespace) -> str:
    """Return a message that names arguments of Python, with the options of a command line.

    ``decimal='comma'`` becomes ``--decimal comma``, ``fill_missing=True`` ``--fill-missing``.
    """
    names = [name for name in vars(options) if name not in ("run", "writer")]
    pattern = rf"(?<![\w'-])({'|'.join(map(re.escape, names))})=('[^']*'|True\b|[-+.\w]*\w)?"

    def option(found: re.Match[str]) -> str:
        value = (found[2] or "").strip("'")
        return f"--{found[1].replace('_', '-')}" + (
            f" {value}" if value not in ("", "True") else ""
        )

    return re.sub(pattern, option, message)
