"""Values of the keys of an input file, each of its kind."""

import re
from collections.abc import Callable
from typing import Any

from ehlwave.errors import SurfaceError
from ehlwave.inputs.keys import GROUP_OF, StudyKeys
from ehlwave.inputs.namelist import Entry, Namelist
from ehlwave.inputs.namelist_tokens import shown
from ehlwave.inputs.namelist_values import Value, plain, real, truth, whole, word

_READINGS = {"SupportsFloat": real, "SupportsIndex": whole, "bool": truth}
_CHOICE = re.compile(r"[\"'](\w+)[\"']")


def values_of(file: Namelist) -> dict[str, dict[str, Any]]:
    """Return the values of all keys by group.

    A value has the kind of its key: ``load_n = 40`` is 40.0. Raises SurfaceError for keys in the
    group of others, for lists, values of another kind and words that are no choice of the key.
    Keys and groups unknown to the programs are left to the caller.
    """
    for entry in file.entries.values():
        _check_group(file, entry)
    return file.values(reading_of)


def reading_of(key: str) -> Callable[[Value], Any]:
    """Return how a value of a key is read: by the kind of a known key, else by its own form."""
    hint = StudyKeys.__annotations__.get(key)
    if hint is None:
        return plain
    kind = str(getattr(hint, "__forward_arg__", hint))
    if kind.startswith("Literal"):
        return lambda value: _choice(value, _CHOICE.findall(kind))
    return _READINGS.get(kind, word)


def _check_group(file: Namelist, entry: Entry) -> None:
    """Refuse a key of another group; keys of surface 2 have the names of surface 1, too."""
    home = GROUP_OF.get(entry.key, entry.group)
    if entry.group in (home, GROUP_OF.get(f"{entry.key}_2")):
        return
    if entry.group in GROUP_OF.values():
        raise SurfaceError(
            f"{file.path}:{entry.line}: unknown key '{entry.key}' in &{entry.group}: it belongs to "
            f"&{home}, move it there"
        )


def _choice(value: Value, choices: list[str]) -> str:
    chosen = word(value).lower()
    if chosen not in choices:
        raise ValueError(
            f"'{shown(value.text)}' is not one of the choices: write one of "
            + ", ".join(f"'{choice}'" for choice in choices)
        )
    return chosen
