"""The programs ``ehlwave-case`` and ``ehlwave-sweep``: their paths and input.

Needs the standard library alone.
"""

import os
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ehlwave.errors import ProgramError

Groups = Mapping[str, Mapping[str, Any]]
"""An input file: values by group and key; a sequence is a list of values."""


def find_program(name: str) -> Path:
    """Return where ``ehlwave-case`` or ``ehlwave-sweep`` is, by its whole name.

    In this order: the folder ``EHLWAVE_PROGRAMS``; ``PATH``; the build tree that this package is in
    the source tree of (``build/native``, then ``build/release``); the folder of the wheel.

    Raises ProgramError if there is none.
    """
    folder = os.environ.get("EHLWAVE_PROGRAMS")
    if folder:
        path = Path(folder, name)
        if not os.access(path, os.X_OK):
            raise ProgramError(
                f"EHLWAVE_PROGRAMS = {folder}: has no program {name}; "
                "give the folder that has it, as build/release/drivers, or unset the variable"
            )
        return path
    if found := shutil.which(name):
        return Path(found)
    here = Path(__file__).resolve()
    built = [
        here.parents[4] / "build" / preset / "drivers" / name for preset in ("native", "release")
    ]
    wheel = here.parents[2] / "ehlwave_programs" / "bin" / name
    for path in (*built, wheel):
        if os.access(path, os.X_OK):
            return path
    raise ProgramError(
        f"no program {name}: build it (scripts/build), put its folder on PATH, or name that folder "
        "in EHLWAVE_PROGRAMS"
    )


def has_programs() -> bool:
    """Return whether both programs are installed."""
    try:
        return bool(find_program("ehlwave-case") and find_program("ehlwave-sweep"))
    except ProgramError:
        return False


def find_run_sweep() -> Path | None:
    """Return where the script ``run-sweep`` is; None if there is none, as beside the wheels.

    In this order: the folder ``EHLWAVE_PROGRAMS``; the source tree of this package; ``PATH``.
    """
    folders = [Path(__file__).resolve().parents[4] / "scripts"]
    if folder := os.environ.get("EHLWAVE_PROGRAMS"):
        folders.insert(0, Path(folder))
    for place in folders:
        if os.access(place / "run-sweep", os.X_OK):
            return place / "run-sweep"
    found = shutil.which("run-sweep")
    return None if found is None else Path(found)


def namelist(groups: Groups) -> str:
    """Return the text of an input file, one key per line; lists become comma-separated values.

    Raises ProgramError if a text has a line break, which no input file can hold.
    """
    lines = []
    for group, keys in groups.items():
        lines += [f"&{group}", *(f"  {key} = {_written(keys[key], key)}" for key in keys), "/"]
    return "\n".join(lines) + "\n"


def _written(value: object, key: str) -> str:
    """Return a value as Fortran reads it: quotes within a text are doubled."""
    if hasattr(value, "tolist"):  # numbers of numpy
        value = value.tolist()
    if isinstance(value, bool):
        return ".true." if value else ".false."
    if isinstance(value, (str, Path)):
        text = str(value)
        if "\n" in text or "\r" in text:
            raise ProgramError(f"{key} = {text!r}: has a line break, which no input file can hold")
        return "'" + text.replace("'", "''") + "'"
    if isinstance(value, Sequence):
        return ", ".join(_written(one, key) for one in value)
    return str(value)
