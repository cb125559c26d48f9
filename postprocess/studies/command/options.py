"""The table of studies, and the options that they have in common."""

import argparse
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from studies.command.steps import ROOT

Run = Callable[[argparse.Namespace], int]
Option = tuple[str, dict[str, Any]]
"""The arguments of :meth:`argparse.ArgumentParser.add_argument`."""


class Study(NamedTuple):
    """A study; its help is the docstring of the function that runs it."""

    run: Run
    options: tuple[Option, ...]


STUDIES: dict[str, Study] = {}
"""All studies by name."""


def study(name: str, *options: Option) -> Callable[[Run], Run]:
    """Put a function into the table. It is given the options and returns the exit status."""

    def entered(run: Run) -> Run:
        STUDIES[name] = Study(run, options)
        return run

    return entered


def step_parser(run: Run, about: str | None) -> argparse.ArgumentParser:
    """Return the parser of the steps of a study, with the options of the study."""
    name, options = next((name, one.options) for name, one in STUDIES.items() if one.run is run)
    parser = argparse.ArgumentParser(f"a step of scripts/study {name}", description=about)
    for words, keywords in options:
        parser.add_argument(words, **keywords)
    return parser


def value_of(pattern: str, make: Callable[[str], Any], what: str) -> Callable[[str], Any]:
    """Return a reader of a value of this pattern that refuses any other."""

    def read(text: str) -> Any:  # noqa: ANN401
        if not re.fullmatch(pattern, text):
            raise argparse.ArgumentTypeError(f"wants {what}, not '{text}'")
        return make(text)

    return read


COUNT = value_of("[1-9][0-9]{0,8}", int, "a whole number above 0")
NUMBER = value_of("[0-9]{1,9}", int, "a whole number")
POSITIVE = value_of(r"(?=.*[1-9])[0-9]{1,9}(\.[0-9]+)?", float, "a number above 0")
PATH = value_of("(?s).+", lambda text: Path(text).resolve(), "a name")
METHOD = value_of("auto|newton|fas|petsc", str, "auto, newton, fas or petsc")
PART = value_of("[1-9][0-9]{0,5}/[1-9][0-9]{0,5}", str, "a part as 2/8")
KINDS = {"METHOD": METHOD, "N": COUNT, "SECONDS": COUNT, "COUNT": NUMBER, "MINUTES": POSITIVE}
KINDS |= {"I/N": PART}
"""Type of an option, by the word that its help has for the value; others are paths."""


def option(name: str, value: str, about: str, default: object = None) -> Option:
    """Return an option with a value; a string as default is looked at as if it had been given."""
    kind = KINDS.get(value, PATH)
    return name, {"type": kind, "metavar": value, "help": _shown(about), "default": default}


def flag(name: str, about: str, **keywords: str) -> Option:
    """Return an option without a value; with ``dest`` and ``const`` one of several."""
    action = "store_const" if keywords else "store_true"
    return name, {"action": action, "help": _shown(about), **keywords}


def choices(name: str, all_of_them: tuple[str, ...], about: str) -> Option:
    """Return an option that may be given several times."""
    about = f"{about}, may be given several times: {', '.join(all_of_them)}"
    return name, {"action": "append", "choices": all_of_them, "metavar": "NAME", "help": about}


def output(folder: str, about: str = "") -> Option:
    """Return the option of the folder that a study writes."""
    shown = f"default build/{folder}{about and '; ' + about}"
    return option("--output", "DIR", shown, ROOT / "build" / folder)


def at_once(name: str = "--ranks", about: str = "") -> Option:
    """Return the option of how many cases of a sweep run at the same time."""
    about = about or "default: the cores you may use, or the tasks of the batch job"
    flags, keywords = option(name, "N", about, os.environ.get("EHLWAVE_RANKS"))
    return flags, {**keywords, "dest": "at_once"}


def given(options: argparse.Namespace, *names: str) -> list[str]:
    """Return the words of those options that have a value, to be passed on."""
    values = {name: getattr(options, name.replace("-", "_")) for name in names}
    pairs = [(f"--{name}", str(value)) for name, value in values.items() if value is not None]
    return [word for pair in pairs for word in pair]


def _shown(text: str) -> str:
    return text.replace("%", "%%")
