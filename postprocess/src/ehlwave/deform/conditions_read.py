"""Operating conditions from the command line or from an input file of ``ehlwave-case``."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import f90nml

from ehlwave.deform.conditions import OIL_KEYS, Conditions, conditions_from_keys
from ehlwave.errors import SurfaceError

KNOWN_LAWS = {"viscosity_law": "roelands", "density_law": "dowson_higginson"}
"""What :class:`ehlwave.medium.Oil` has; files may ask for others."""


def read_conditions(words: Sequence[str]) -> Conditions:
    """Return conditions from words as given to ``--conditions``.

    Parameters
    ----------
    words : sequence of str
        Each is ``KEY=VALUE`` or the name of an input file of ``ehlwave-case``, whose groups
        ``&conditions`` and ``&lubricant`` are used. Later words override earlier ones.

    Raises
    ------
    SurfaceError
        If a file cannot be read or a key is unknown, missing or meaningless.
    """
    keys, others = read_keys(words)
    conditions = conditions_from_keys(keys, place=f"conditions {' '.join(words)}")
    return replace(conditions, oil=replace(conditions.oil, other_laws=tuple(others)))


def read_keys(words: Sequence[str]) -> tuple[dict[str, Any], list[str]]:
    """Return the keys of words as :func:`read_conditions` takes them, and laws without a key."""
    keys: dict[str, Any] = {}
    others: list[str] = []
    for word in words:
        name, separator, value = word.partition("=")
        if separator and not Path(word).exists():
            keys[name.strip()] = value.strip()
        else:
            found, others = _from_file(Path(word))
            keys |= found
    return keys, others


def _from_file(path: Path) -> tuple[dict[str, Any], list[str]]:
    """Return the keys of a file, and its laws of the oil that have no place in them."""
    if not path.is_file():
        raise SurfaceError(
            f"conditions {path}: no such file; give an input file of ehlwave-case or KEY=VALUE"
        )
    try:
        # f90nml's parser reports bad syntax by whatever exception it stumbles into.
        groups = f90nml.read(path)
    except Exception as error:
        raise SurfaceError(f"conditions {path}: not a namelist file ({error})") from error
    if "conditions" not in groups:
        raise SurfaceError(f"conditions {path}: has no group &conditions")
    keys = dict(groups["conditions"])
    lubricant = groups.get("lubricant", {})
    others = [
        f"{key} = '{lubricant[key]}'"
        for key, known in KNOWN_LAWS.items()
        if str(lubricant.get(key, known)).lower() != known
    ]
    return keys | {key: lubricant[key] for key in OIL_KEYS if key in lubricant}, others
