"""Input files of ``ehlwave-case`` for contacts of this package."""

from collections.abc import Mapping
from typing import Any

from ehlwave.contact.conditions import MOES_KEYS, Conditions
from ehlwave.contact.data_errors import DATA_ERRORS
from ehlwave.contact.heat_data import Heat
from ehlwave.contact.oil_keys import CARREAU_KEYS
from ehlwave.contact.starvation import OIL_OVER_FLOODED
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.inputs.key_classes import HEAT_DATA
from ehlwave.inputs.slip import SLIP
from ehlwave.programs.programs import namelist

OF_PREDICTIONS = ("semi_axis_a_m", "central_film_m", *DATA_ERRORS)
"""Keys of contacts that the program does not have."""

FLOW_LAWS = {"eyring_stress_pa": "eyring", CARREAU_KEYS[0]: "carreau"}
OWN_ALPHA = ("mcewen", "yasutomi", "doolittle", "table")
"""Viscosity laws whose alpha follows from their own parameters."""

GROUPS = {
    "conditions": """radius_x_m radius_y_m reduced_modulus_pa load_n load_n_per_m mean_speed_m_per_s
        viscosity_pa_s load_parameter_m lubricant_parameter_l radius_ratio_d slip_parameter""",
    "heat": " ".join((*HEAT_DATA, "levels wave_temperatures")),
    "inlet": OIL_OVER_FLOODED,
    "waviness": """orientation wavelength_over_a wavelength_x_over_a wavelength_y_over_a
        amplitude_over_film response""",
    "grid": "cells_x cells_y",
    "solver": "accuracy scheme",
    "output": "mean_rise",
}
"""Groups of the keys; all others belong to ``&lubricant``. A test compares with the program."""

_GROUP_OF = {key: group for group, keys in GROUPS.items() for key in keys.split()}


def case_keys(conditions: Conditions, heat: Heat | None = None) -> dict[str, Any]:
    """Return the keys of ``ehlwave-case`` for the smooth contact: conditions, oil, inlet and heat.

    Parameters
    ----------
    conditions : Conditions
        Its slip parameter replaces the argument.
    heat : Heat, optional
        Heat data; needs dimensional conditions.

    Raises
    ------
    RangeError
        If the central film is given, which a computed contact cannot take.
    SurfaceError
        If there is heat without dimensional conditions.

    Examples
    --------
    >>> import ehlwave
    >>> from ehlwave.programs.case_input import case_keys
    >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10, radius_ratio_d=1,
    ...     slide_to_roll_ratio=0.2)
    >>> case_keys(contact.conditions)["slip_parameter"]
    1.1
    """
    c = conditions
    if c.has_given_film:
        raise RangeError(
            "central_film_m is given, and a computed contact has a film of its own: remove it"
        )
    given = dict(c.given) or dict(zip(MOES_KEYS, (c.m, c.l, c.d), strict=True))
    keys: dict[str, Any] = {key: given[key] for key in given if key not in OF_PREDICTIONS}
    if MOES_KEYS[0] in keys:
        keys.pop("radius_x_m", None)
        if heat is not None:
            raise SurfaceError("heat needs dimensional conditions (viscosity_pa_s, ...)")
    keys.pop(OIL_OVER_FLOODED, None)
    keys[SLIP] = c.slip_parameter
    keys["pressure_viscosity_per_pa"] = c.oil.pressure_viscosity_per_pa
    keys["roelands_index"] = c.oil.roelands_index
    for key, law in FLOW_LAWS.items():
        if key in keys:
            keys["flow_law"] = law
    keys |= _other_laws(c)
    if c.is_starved:
        keys[OIL_OVER_FLOODED] = c.oil_over_flooded
    return keys if heat is None else keys | heat.keys()


def _other_laws(c: Conditions) -> dict[str, Any]:
    """Return the laws of the oil that only the program has, with their parameters."""
    found: dict[str, Any] = {}
    for text in c.oil.other_laws:
        key, _, value = text.partition(" = ")
        found[key] = value.strip("'") if "'" in value else float(value)
    if not found:
        return found
    found |= dict(c.oil.other_keys)
    law = found.get("viscosity_law", "roelands")
    kept = dict.fromkeys(("pressure_viscosity_per_pa", "roelands_index"))
    if law in OWN_ALPHA:
        return found | kept
    return found if law == "roelands" else found | {"roelands_index": None}


def case_groups(keys: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Return keys by their groups in an input file; keys without a value (None) are left out.

    Examples
    --------
    >>> from ehlwave.programs.case_input import case_groups
    >>> case_groups({"load_parameter_m": 100, "accuracy": 0.01})
    {'conditions': {'load_parameter_m': 100}, 'solver': {'accuracy': 0.01}}
    """
    groups: dict[str, dict[str, Any]] = {}
    for key, value in keys.items():
        if value is not None:
            groups.setdefault(_GROUP_OF.get(key, "lubricant"), {})[key] = value
    return groups


def case_text(keys: Mapping[str, Any]) -> str:
    """Return the input file of a case."""
    return namelist(case_groups(keys))
