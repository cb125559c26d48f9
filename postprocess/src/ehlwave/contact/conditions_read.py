"""Operating conditions from the command line or from an input file of ``ehlwave-case``."""

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.contact.file_keys import (
    FLOW_LAW,
    KNOWN_LAWS,
    LAW_PREFIXES,
    LIMIT,
    LIMIT_WIDTH,
    NOT_USED,
    OWN_COEFFICIENT,
    TEMPERATURE,
    keys_of_file,
    notices,
)
from ehlwave.contact.heat_data import Heat, heat_of_keys
from ehlwave.errors import SurfaceError
from ehlwave.inputs.key_classes import HEAT_DATA
from ehlwave.inputs.slip import merged, refuse_both
from ehlwave.quantities import number

FLOW_LAWS = {"newtonian": "Newtonian", "eyring": "Ree-Eyring", "carreau": "Carreau"}
"""Oils by the ``flow_law`` of files."""

BESIDES = (*HEAT_DATA, TEMPERATURE, *KNOWN_LAWS, FLOW_LAW, LIMIT, LIMIT_WIDTH, *NOT_USED)
"""Keys that :func:`ehlwave.contact.conditions_from_keys.conditions_from_keys` does not take."""

ALPHA = "pressure_viscosity_per_pa"


@dataclass(frozen=True)
class Given:
    """Command-line words: conditions, their keys, heat, and messages about unused keys."""

    conditions: Conditions
    keys: dict[str, Any]
    heat: Heat | None
    notices: list[str]


def read_conditions(words: Sequence[str]) -> Conditions:
    """Return conditions from words as given to ``--conditions``.

    Parameters
    ----------
    words : sequence of str
        Each is ``KEY=VALUE`` or the name of an input file of ``ehlwave-case``. Later words override
        earlier ones. Keys that would change an answer are used, refused, or warned of.

    Raises
    ------
    SurfaceError
        If a file cannot be read, a key is unknown, missing or meaningless, or there is heat.
    """
    given = read_given(words)
    if given.heat is not None:
        raise SurfaceError(
            f"{_place(words)}: gives &heat, which is not taken here: leave it out, or use "
            "ehlwave.Contact(..., heat=ehlwave.Heat(...))"
        )
    for notice in given.notices:
        warnings.warn(notice, stacklevel=2)
    return given.conditions


def read_given(words: Sequence[str]) -> Given:
    """Return the conditions of words, as for :func:`read_conditions`, with heat."""
    return given_of(_every_key(words), _place(words))


def given_of(every: Mapping[str, Any], place: str) -> Given:
    """Return the conditions of keys of an input file; `place` names the file in messages."""
    keys = {
        key: value
        for key, value in every.items()
        if key not in BESIDES and not key.startswith(LAW_PREFIXES)
    }
    conditions = conditions_from_keys(keys, place=place)
    _check_flow_law(every.get(FLOW_LAW), conditions.oil.name, place)
    laws, parameters = _other_laws(every, not conditions.rolls, place)
    viscosity = str(every.get("viscosity_law", "")).lower()
    if viscosity in OWN_COEFFICIENT and ALPHA not in keys:
        raise SurfaceError(
            f"{place}: viscosity_law = '{viscosity}' has no {ALPHA}: give it besides, as "
            f"{ALPHA}=VALUE: the alpha of ehlwave-case --plan"
        )
    heat = None
    if any(key in every for key in HEAT_DATA):
        heat = heat_of_keys(every, place)
        if laws:
            raise SurfaceError(f"{place}: &heat and {laws[0]}: the laws of heat do not know both")
    oil = replace(conditions.oil, other_laws=laws, other_keys=parameters)
    conditions = replace(conditions, oil=oil)
    if laws and not conditions.film_source.startswith("given"):
        conditions = replace(conditions, central_film_error=None)
    return Given(conditions, keys, heat, notices(every))


def _every_key(words: Sequence[str]) -> dict[str, Any]:
    """Return the keys of all words; later words override earlier words."""
    keys: dict[str, Any] = {}
    typed = [word.partition("=") for word in words]
    refuse_both({name.strip(): value for name, mark, value in typed if mark}, _place(words))
    for word in words:
        name, separator, value = word.partition("=")
        if separator and not Path(word).exists():
            keys = merged(keys, {name.strip(): value.strip()})
        else:
            found = keys_of_file(Path(word))
            refuse_both(found, f"conditions {word}")
            keys = merged(keys, found)
    return keys


def _place(words: Sequence[str]) -> str:
    return f"conditions {' '.join(words)}"


def _check_flow_law(law: Any, name: str, place: str) -> None:  # noqa: ANN401 - as in the file
    """Refuse a flow law that differs from the keys."""
    if law is not None and FLOW_LAWS.get(str(law).lower()) != name:
        raise SurfaceError(
            f"{place}: flow_law = '{str(law).lower()}', but the keys describe a {name} oil: "
            "change flow_law, or give the keys of this law (eyring_stress_pa, or "
            "carreau_modulus_pa and carreau_exponent)"
        )


def _other_laws(
    every: Mapping[str, Any], slides: bool, place: str
) -> tuple[tuple[str, ...], tuple[tuple[str, float], ...]]:
    """Return the laws of the oil that no prediction covers, and their parameters.

    A limit of the stress matters where surfaces slide: in pure rolling the mean stress is 0.
    """
    laws = [
        f"{key} = '{every[key]}'"
        for key, known in KNOWN_LAWS.items()
        if str(every.get(key, known)).lower() != known
    ]
    parameters = {
        key: number(value, key, place)
        for key, value in every.items()
        if key.startswith(LAW_PREFIXES) and key != "viscosity_table"
    }
    limit = number(every.get(LIMIT, 0.0), LIMIT, place)
    if not 0 <= limit <= 1:
        raise SurfaceError(f"{place}: {LIMIT} = {limit:g} must lie in 0 to 1")
    if limit and slides:
        laws.append(f"{LIMIT} = {limit:g}")
    return tuple(laws), tuple(parameters.items())
