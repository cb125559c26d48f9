"""Values of the keys of an input file, each of its kind."""

import re
from collections.abc import Callable
from typing import Any

from ehlwave.inputs.keys import StudyKeys
from ehlwave.inputs.namelist import Namelist
from ehlwave.inputs.namelist_tokens import shown
from ehlwave.inputs.namelist_values import Value, plain, real, truth, whole, word

_READINGS = {"SupportsFloat": real, "SupportsIndex": whole, "bool": truth}
_CHOICE = re.compile(r"[\"'](\w+)[\"']")


def values_of(file: Namelist) -> dict[str, dict[str, Any]]:
    """Return the values of all keys by group.

    A value has the kind of its key, whole numbers of the key ``load_n`` are numbers. Raises
    SurfaceError for lists, for values of another kind and for words that are no choice of the key.
    """
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


def _choice(value: Value, choices: list[str]) -> str:
    chosen = word(value).lower()
    if chosen not in choices:
        raise ValueError(
            f"'{shown(value.text)}' is not one of the choices: write one of {', '.join(choices)}"
        )
    return chosen
