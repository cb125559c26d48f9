"""The atlas: read from its file, ready for contacts."""

import json
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.line_contact import ROLLS_ALONE
from ehlwave.duals import math
from ehlwave.errors import RangeError, ResultsError
from ehlwave.laws.atlas.advice import STRESS, refuse_outside, thinned_text
from ehlwave.laws.atlas.chart import Chart
from ehlwave.laws.atlas.kind import Kind, shipped
from ehlwave.laws.atlas.kinds import (
    KINDS,
    LINE,
    LINE_NEWTONIAN,
    LINE_SLIDING,
    ROLLING,
    SLIDING,
    SLIDING_WIDE,
    WIDE,
)
from ehlwave.laws.atlas.networks import Networks
from ehlwave.laws.atlas.stored import Stored, read_stored

FORMAT_NAME = "ehlwave-atlas 3"


def ranges_text(kind: Kind) -> str:
    """Return the ranges of a kind, as its file has them."""
    return json.dumps({key: list(ends) for key, ends in kind.ranges.items()})


class Atlas(Networks):
    """Computed responses and films, interpolated by networks between contacts and waves.

    Parameters
    ----------
    data : Stored
        As :func:`read_stored` reads it; ``scripts/study atlas`` makes it.

    Examples
    --------
    >>> import ehlwave
    >>> atlas = ehlwave.load_atlas()
    >>> low, high = atlas.kind.ranges["load_parameter_m"]
    >>> print(f"{atlas.kind.name}: M from {low:g} to {high:g}")
    rolling: M from 20 to 2000
    """

    def __init__(self, data: Stored) -> None:
        """Take the networks."""
        said = str(data.attrs.get("format"))
        if said != FORMAT_NAME:
            former = said.startswith(FORMAT_NAME.split()[0])
            raise ResultsError(
                f"a former atlas, {said!r}, with other ranges; this version reads "
                f"{FORMAT_NAME!r}: scripts/study atlas makes one"
                if former
                else f"not an atlas of ehlwave (format {said!r})"
            )
        kind = KINDS[data.attrs["kind"]]
        if data.attrs.get("ranges") != ranges_text(kind):
            raise ResultsError(
                f"an atlas with the ranges {data.attrs.get('ranges')}; this version needs "
                f"{ranges_text(kind)}: make it by scripts/study atlas"
            )
        super().__init__(data, kind)

    def at(self, keys: Mapping[str, float]) -> Chart:
        """Return the chart of a contact.

        Parameters
        ----------
        keys : mapping
            Parameters of its kind: :mod:`ehlwave.laws.atlas.ranges`.

        Raises
        ------
        RangeError
            If a parameter lies outside its range.

        Examples
        --------
        >>> import ehlwave
        >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10,
        ...                           radius_ratio_d=1)
        >>> chart = contact.atlas().at(contact.conditions.atlas_keys())
        >>> found = chart.responses(0.5, 0.0)
        >>> print(f"{abs(complex(found.film)):.2f} within {float(found.error):.2f}")
        0.92 within 0.01
        """
        return Chart(self, keys)


SHIPPED = shipped(ROLLING)
"""The atlas of contacts that roll."""


def kind_for(conditions: Conditions) -> Kind:
    """Return the kind of atlas that a contact is looked up in.

    Contacts that roll or slide beyond the ranges of the usual atlas have a wider atlas, which is
    less accurate.

    A Ree-Eyring oil under slip has an atlas of its own, and line contacts have both; for the atlas
    all others roll.

    Raises
    ------
    RangeError
        Of a line contact under slip in an oil that is neither Ree-Eyring's nor Newtonian.
    """
    keys, rolls = conditions.atlas_keys(), conditions.rolls
    if conditions.is_line and not conditions.has_atlas:
        raise RangeError(ROLLS_ALONE)
    if conditions.has_sliding_atlas and not rolls:
        usual, wide = _sliding_kinds(conditions)
        return usual if usual.holds(keys) else wide
    if conditions.is_line:
        return LINE if rolls or not conditions.is_newtonian_line else LINE_NEWTONIAN
    return ROLLING if ROLLING.holds(keys) else WIDE


def thinned_kind(conditions: Conditions) -> Kind | None:
    """Return the kind of atlas that has the film of an oil that thins in pure rolling, too.

    None under slip, where :func:`kind_for` has it, and where there is none.
    """
    if not conditions.rolls or not conditions.has_sliding_atlas:
        return None
    keys = conditions.atlas_keys()
    kinds = _sliding_kinds(conditions)
    return next((kind for kind in kinds if kind.holds(keys) and not kind.beyond(keys)), None)


def _sliding_kinds(conditions: Conditions) -> tuple[Kind, Kind]:
    return (LINE_SLIDING, LINE_SLIDING) if conditions.is_line else (SLIDING, SLIDING_WIDE)


def atlas_for(conditions: Conditions, atlas: Atlas | None = None) -> Atlas:
    """Return the atlas of :func:`kind_for`: this one if it is of the kind, else the shipped one."""
    kind = kind_for(conditions)
    families = (ROLLING, WIDE), (SLIDING, SLIDING_WIDE)
    of_kind = next((family for family in families if kind in family), (kind,))
    return atlas if atlas is not None and atlas.kind in of_kind else load_atlas(shipped(kind))


def chart_of(conditions: Conditions, atlas: Atlas | None = None) -> Chart:
    """Return the chart of a contact, in the atlas of :func:`atlas_for`.

    In pure rolling a shear-thinning oil has the film of the atlas of sliding contacts. Its
    responses are Newtonian, with an error to match: they change less than the film.

    Raises
    ------
    RangeError
        If it lies outside; the message names the range in the user's own quantities. If its oil
        has laws of viscosity or density that the atlas does not hold, or thins more in the inlet
        than an atlas of Newtonian oils can answer for.
    """
    if conditions.oil.other_laws:
        raise RangeError(_of_other_laws(conditions))
    found = atlas_for(conditions, atlas)
    refuse_outside(conditions, found.kind)
    keys, kind = conditions.atlas_keys(), thinned_kind(conditions)
    if kind is not None:
        return Chart(found, keys, thinned=Chart(load_atlas(shipped(kind)), keys))
    loss = 0.0 if STRESS in found.kind.ranges else conditions.film_loss
    if math.isinf(loss):
        raise RangeError(thinned_text(conditions))
    return Chart(found, keys, loss)


@lru_cache(maxsize=8)
def load_atlas(path: str | Path = SHIPPED) -> Atlas:
    """Return the atlas of a file, by default the package's atlas of rolling contacts.

    Each file is read once a process.

    Parameters
    ----------
    path : path
        File of ``scripts/study atlas``.

    Raises
    ------
    ResultsError
        If it cannot be read, is no atlas, or has a wrong checksum.

    Examples
    --------
    >>> import ehlwave
    >>> ehlwave.load_atlas().kind.name
    'rolling'
    """
    return Atlas(read_stored(path))


def _of_other_laws(conditions: Conditions) -> str:
    """Return why an oil does not match the atlas."""
    return (
        f"{', '.join(conditions.oil.other_laws)}: the atlas holds Roelands' oil without a limit of "
        "the stress; give a harmonic table, or compute the contact with ehlwave-case"
    )
