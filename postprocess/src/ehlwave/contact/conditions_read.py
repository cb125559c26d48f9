"""Operating conditions from the command line or from an input file of ``ehlwave-case``."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import f90nml

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_from_keys import OIL_KEYS, OIL_OVER_FLOODED, conditions_from_keys
from ehlwave.errors import SurfaceError, printable
from ehlwave.slip import merged, refuse_both

KNOWN_LAWS = {"viscosity_law": "roelands", "density_law": "dowson_higginson"}
"""Laws of :class:`ehlwave.contact.medium.Oil`; files may name others."""

LAW_PREFIXES = ("mcewen_", "yasutomi_", "doolittle_", "tait_")
"""Of the parameters of other laws."""


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

FLOW_LAWS = {"newtonian": "Newtonian", "eyring": "Ree-Eyring", "carreau": "Carreau"}
"""Oils by the ``flow_law`` of files."""


def read_conditions(words: Sequence[str]) -> Conditions:
    """Return conditions from words as given to ``--conditions``.

    Parameters
    ----------
    words : sequence of str
        Each is ``KEY=VALUE`` or the name of an input file of ``ehlwave-case``, whose groups
        ``&conditions``, ``&lubricant`` and ``&inlet`` are used. Later words override earlier ones.

    Raises
    ------
    SurfaceError
        If a file cannot be read or a key is unknown, missing or meaningless.
    """
    given = read_keys(words)
    conditions = conditions_from_keys(given.keys, place=_place(words))
    oil = replace(
        conditions.oil,
        other_laws=tuple(given.other_laws),
        other_keys=tuple(given.parameters.items()),
    )
    return replace(conditions, oil=oil)


def read_keys(words: Sequence[str]) -> "GivenKeys":
    """Return what words say, as :func:`read_conditions` takes them; refuse a wrong flow law."""
    keys: dict[str, Any] = {}
    others: list[str] = []
    law: str | None = None
    parameters: dict[str, float] = {}
    typed = [word.partition("=") for word in words]
    refuse_both({name.strip(): value for name, mark, value in typed if mark}, _place(words))
    for word in words:
        name, separator, value = word.partition("=")
        if separator and not Path(word).exists():
            keys = merged(keys, {name.strip(): value.strip()})
        else:
            file = _from_file(Path(word))
            refuse_both(file.keys, f"conditions {word}")
            keys = merged(keys, file.keys)
            others, parameters, law = file.other_laws, file.parameters, file.flow_law
    name = conditions_from_keys(keys, place=_place(words)).oil.name
    if law is not None and FLOW_LAWS.get(law) != name:
        raise SurfaceError(
            f"{_place(words)}: flow_law = '{law}', but the keys are those of a {name} oil: "
            "give the stress of the law that is meant (eyring_stress_pa, or carreau_modulus_pa and "
            "carreau_exponent), or change flow_law"
        )
    return GivenKeys(keys, others, parameters, law)


def _place(words: Sequence[str]) -> str:
    return f"conditions {' '.join(words)}"


class GivenKeys(NamedTuple):
    """Content of an input: known keys, other laws of the oil, their numbers."""

    keys: dict[str, Any]
    other_laws: list[str]
    parameters: dict[str, float]
    flow_law: str | None


def _from_file(path: Path) -> GivenKeys:
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
    inlet = groups.get("inlet", {})
    for key in inlet:
        if key != OIL_OVER_FLOODED:
            reason = OTHER_INLET_KEYS.get(str(key), "no law of starved contacts knows this key")
            raise SurfaceError(
                f"conditions {path}: &inlet {printable(str(key))}: {reason}; or compute the "
                "contact with ehlwave-case"
            )
    keys = dict(groups["conditions"]) | dict(inlet)
    lubricant = groups.get("lubricant", {})
    others = [
        f"{key} = '{lubricant[key]}'"
        for key, known in KNOWN_LAWS.items()
        if str(lubricant.get(key, known)).lower() != known
    ]
    parameters = {
        key: float(value)
        for key, value in lubricant.items()
        if key.startswith(LAW_PREFIXES) and isinstance(value, (int, float))
    }
    known = {key: lubricant[key] for key in OIL_KEYS if key in lubricant}
    law = lubricant.get("flow_law")
    return GivenKeys(keys | known, others, parameters, None if law is None else str(law).lower())
