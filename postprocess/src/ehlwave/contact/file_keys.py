"""Keys of an input file of ``ehlwave-case``, by their use in predictions.

Predictions use a key, refuse it, report it as unused, or ignore it where no answer depends on it.
`CLASSIFIED` has every key of the program; a test compares it with ``--keys``.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ehlwave.contact.conditions_from_keys import KNOWN_KEYS
from ehlwave.contact.starvation import OIL_OVER_FLOODED
from ehlwave.errors import SurfaceError, printable
from ehlwave.inputs.key_classes import (
    HEAT_DATA,
    IN_LAWS,
    OF_OTHER_EFFECTS,
    OF_THE_SOLUTION,
    OF_WAVES,
    WITHOUT_EFFECT,
)
from ehlwave.inputs.key_values import MANDATORY, missing, values_of
from ehlwave.inputs.namelist import read_namelist

OF_ROUGHNESS = ("waviness", "waviness2", "surface", "surface2")
"""Groups whose keys are left out whole: predictions have waves and surfaces of their own."""

KNOWN_LAWS = {"viscosity_law": "roelands", "density_law": "dowson_higginson"}
"""Laws of :class:`ehlwave.contact.medium.Oil`; files may name others."""
LAW_PREFIXES = ("mcewen_", "yasutomi_", "doolittle_", "tait_", "viscosity_table")
"""Prefixes of the parameters of other laws."""
OWN_COEFFICIENT = ("mcewen", "yasutomi", "doolittle", "table")
"""Laws of viscosity that have no `pressure_viscosity_per_pa`."""
FLOW_LAW, TEMPERATURE = "flow_law", "temperature_k"
LIMIT, LIMIT_WIDTH = "shear_limit_over_pressure", "shear_limit_width"

_CHANGES = "the law of starved contacts is of layers that do not change in time"
OTHER_INLET_KEYS = {
    "oil_layer_m": f"give {OIL_OVER_FLOODED}, the layer over relative density times film at the "
    "centre of the flooded contact",
    "oil_profile": "the law of starved contacts is of layers that are the same all across",
    "oil_change_factor": _CHANGES,
    "oil_change_start": _CHANGES,
    "oil_change_length": _CHANGES,
}
"""Keys of ``&inlet`` that no law answers for, and why."""

NOT_USED: dict[str, tuple[float | str, str]] = {
    "edges": ("flooded", "films have flooded edges"),
    "load_balance": ("force_balance", "responses are those under a load that does not change"),
    "load_factor": (1, "films and responses hold for the load before its step"),
    "wave_temperatures": ("frozen", "waves are computed without heat, over the film with heat"),
}
"""Keys that predictions report as unused: the value without a message, and the assumption instead.
"""

LEFT_OUT = (
    OF_WAVES
    | OF_THE_SOLUTION
    | WITHOUT_EFFECT
    | {"amplitude_over_film", "amplitude_m", "end_time", "natural_frequency", "levels"}
)
"""Keys that no prediction depends on; `natural_frequency` goes with `load_balance`."""

USED = (*KNOWN_KEYS, *HEAT_DATA, *KNOWN_LAWS, FLOW_LAW, TEMPERATURE, LIMIT, LIMIT_WIDTH)


def is_classified(key: str) -> bool:
    """Return whether a key is classified for predictions."""
    named = (*USED, *OTHER_INLET_KEYS, *NOT_USED, *LEFT_OUT, *OF_OTHER_EFFECTS)
    return key in named or key.startswith(LAW_PREFIXES)


def keys_of_file(path: Path) -> dict[str, Any]:
    """Return the keys of an input file that answers may depend on, whatever their group.

    Raises SurfaceError if it cannot be read, or has groups or keys that are not known, or keys of
    ``&inlet`` that no law answers for.
    """
    place = f"conditions {path}"
    if not path.is_file():
        raise SurfaceError(
            f"{place}: no such file; give an input file of ehlwave-case or KEY=VALUE"
        )
    file = read_namelist(path)
    groups = values_of(file, other_keys=KNOWN_KEYS)
    if "conditions" not in groups:
        raise SurfaceError(f"{place}: has no group &conditions")
    _check_groups(groups, place)
    found: dict[str, Any] = {}
    for group, key in file.entries:
        if group in OF_ROUGHNESS:
            continue
        found[key] = groups[group][key]
    return {key: value for key, value in found.items() if key not in LEFT_OUT}


def _check_groups(groups: Mapping[str, Any], place: str) -> None:
    if "heat" in groups and MANDATORY["heat"] not in groups["heat"]:
        raise SurfaceError(f"{place}: {missing('heat')}")
    for group in sorted(set(groups) - IN_LAWS):
        raise SurfaceError(
            f"{place}: &{printable(group)}: no law has this effect: remove the group, or compute "
            "the contact with ehlwave-case"
        )
    for key in groups.get("inlet", {}):
        if key != OIL_OVER_FLOODED:
            reason = OTHER_INLET_KEYS.get(str(key), "no law of starved contacts has this key")
            raise SurfaceError(
                f"{place}: &inlet {printable(str(key))}: {reason}; or compute the contact with "
                "ehlwave-case"
            )


def notices(keys: Mapping[str, Any]) -> list[str]:
    """Return the messages about unused keys."""
    return [
        f"{key} = {printable(str(keys[key]))} is not used: {reason}"
        for key, (usual, reason) in NOT_USED.items()
        if key in keys and not _is_same(keys[key], usual)
    ]


def _is_same(value: object, usual: float | str) -> bool:
    """Return whether a value, typed or of a file, is the default."""
    text = str(value).lower()
    if isinstance(usual, str):
        return text == usual
    try:
        return float(text) == usual
    except ValueError:
        return False
