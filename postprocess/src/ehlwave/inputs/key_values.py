"""Values of the keys of an input file, each of its kind and within its bounds."""

from collections.abc import Collection, Iterator
from typing import Any

from ehlwave.errors import SurfaceError, did_you_mean
from ehlwave.inputs.key_table import GROUP_OF, KEYS
from ehlwave.inputs.namelist import Entry, Namelist
from ehlwave.inputs.namelist_values import plain

FORMER_LIMIT = "limiting_stress_over_pressure"
"""A key of before version 2, in ``&lubricant``."""
MANDATORY = {"heat": "oil_conductivity_w_per_m_k", "touching": "film_m"}
"""Keys without which their groups are mistakes."""


def missing(group: str) -> str:
    """Return the message of a group without its mandatory key."""
    return f"&{group} needs {MANDATORY[group]}: give it, or remove the group"


def values_of(
    file: Namelist, other_groups: Collection[str] = (), other_keys: Collection[str] = ()
) -> dict[str, dict[str, Any]]:
    """Return the values of all keys by group, as the programs read them.

    A value has the kind of its key: ``load_n = 40`` is 40.0. Raises SurfaceError for the first key
    that the programs refuse, and for groups and keys that they do not know.

    Parameters
    ----------
    file : Namelist
        Groups and keys as written.
    other_groups, other_keys : collection of str
        Names that the programs do not know and that are read by the form of their values.
    """
    found: dict[str, dict[str, Any]] = {name: {} for name in file.groups}
    for name, key in KEYS.items():
        for entry in _entries(file, name):
            found[entry.group][entry.key] = file.value(entry, key.read)
    for entry in file.entries.values():
        if entry.key == FORMER_LIMIT and entry.group == "lubricant":
            raise file.problem(
                entry,
                "is replaced by shear_limit_over_pressure, which limits the stress in the "
                "equations: write that",
            )
        is_other = entry.key in other_keys and entry.key not in GROUP_OF
        if is_other or entry.group in other_groups:
            found[entry.group][entry.key] = file.value(entry, plain)
    for group in MANDATORY:
        if found.get(group, True) == {}:
            raise SurfaceError(f"{file.path}:{file.groups[group]}: {missing(group)}")
    _refuse_unknown(file, found, other_groups)
    return found


def _entries(file: Namelist, name: str) -> Iterator[Entry]:
    """Yield the entry of a key by its name or by its short name; both together are refused."""
    key = KEYS[name]
    entry = file.entries.get((key.group, name))
    short = file.entries.get((key.group, key.short)) if key.short else None
    if entry is not None and short is not None:
        raise file.problem(short, f"is the same key as {name}: give one of the two")
    for one in (entry, short):
        if one is not None:
            yield one


def _refuse_unknown(
    file: Namelist, found: dict[str, dict[str, Any]], other_groups: Collection[str]
) -> None:
    """Refuse the first group, then the first key, that nothing has read."""
    groups = dict.fromkeys([*GROUP_OF.values(), *other_groups])
    for group, line in file.groups.items():
        if group not in groups:
            near = did_you_mean(group, groups)
            raise SurfaceError(
                f"{file.path}:{line}: &{group} is no group of ehlwave-case{near}: "
                f"{'correct it' if near else 'remove it'}"
            )
    for entry in file.entries.values():
        if entry.key in found[entry.group]:
            continue
        homes = [GROUP_OF[one] for one in (entry.key, f"{entry.key}_2") if one in GROUP_OF]
        if homes:
            home = " or &".join(homes)
            text = f"'{entry.key}' in &{entry.group}: it belongs to &{home}, move it there"
        else:
            near = did_you_mean(entry.key, KEYS)
            step = "correct it" if near else "remove it"
            text = f"{entry.key}{near} in &{entry.group}: {step}"
        raise SurfaceError(f"{file.path}:{entry.line}: unknown key {text}")
