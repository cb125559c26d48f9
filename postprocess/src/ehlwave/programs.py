"""The programs ``ehlwave-case`` and ``ehlwave-sweep``: where they are, what they are given.

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

    Raises
    ------
    ProgramError
        If there is none.
    """
    folder = os.environ.get("EHLWAVE_PROGRAMS")
    if folder:
        path = Path(folder, name)
        if not os.access(path, os.X_OK):
            raise ProgramError(f"EHLWAVE_PROGRAMS = {folder}: has no program {name}")
        return path
    if found := shutil.which(name):
        return Path(found)
    here = Path(__file__).resolve()
    built = [
        here.parents[3] / "build" / preset / "drivers" / name for preset in ("native", "release")
    ]
    wheel = here.parents[1] / "ehlwave_programs" / "bin" / name
    for path in (*built, wheel):
        if os.access(path, os.X_OK):
            return path
    raise ProgramError(
        f"no program {name}: build it (scripts/build), put its folder on PATH, or name that folder "
        "in EHLWAVE_PROGRAMS"
    )


def namelist(groups: Groups) -> str:
    """Return the text of an input file, one key a line; lists become comma-separated values."""

    def written(value: object) -> str:
        if isinstance(value, bool):
            return ".true." if value else ".false."
        if isinstance(value, (str, Path)):
            return f"'{value}'"
        if isinstance(value, Sequence):
            return ", ".join(written(one) for one in value)
        return str(value)

    lines = []
    for group, keys in groups.items():
        lines += [f"&{group}", *(f"  {key} = {written(value)}" for key, value in keys.items()), "/"]
    return "\n".join(lines) + "\n"
