"""Settings that differ between the atlases: rolling, sliding and line contacts."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from numpy.typing import ArrayLike

from ehlwave.laws.atlas.coordinates import Floats
from ehlwave.laws.atlas.shape import Shape

Keys = Mapping[str, ArrayLike]


def _keys_alone(keys: Keys, _: Floats, __: Mapping[str, Floats]) -> Keys:
    return keys


def _unlimited(_: Mapping[str, float]) -> str:
    return ""


ROUNDING = 1e-9
"""Relative, of the ends of ranges."""

FILMS = ("film_ratio", "minimum_ratio")
"""Films of all kinds of contacts, see :attr:`Kind.films`."""


@dataclass(frozen=True)
class Kind:
    """An atlas by the motion of its contacts.

    Attributes
    ----------
    name : str
        Of the file, and its attribute ``kind``.
    ranges : mapping
        Smallest and largest value of each key of a contact.
    coordinates : callable
        Coordinates of contacts, shape (c, k), by columns named as their keys.
    shape : callable
        Conversion of responses into numbers, by the same.
    films : tuple of str
        Data of contacts: ln of the central film over its reference; ln of the smallest over the
        central film, less the same ratio of their references; ln of the mean shear stress over its
        reference; ln of the pressure at the centre over the Hertz pressure.
    references : callable
        References of these values, shape (c, films), by the same columns: films in the Moes scale,
        of Moes' formula or, under slip, in pure rolling; the stress of
        :func:`ehlwave.laws.atlas.sliding.mean_stress`.
    state : callable
        Input of ``shape`` for contacts, from their keys, the references and the numbers of their
        films.
    beyond : callable
        Excess of a contact, though within the ranges, from its keys; '' if none.
    smallest : callable or None
        Smallest over central film and its relative error, from the keys and from this ratio of the
        networks.
    """

    name: str
    ranges: Mapping[str, tuple[float, float]]
    coordinates: Callable[[Keys], Floats]
    shape: Callable[[Keys], Shape]
    films: tuple[str, ...]
    references: Callable[[Keys], Floats]
    state: Callable[[Keys, Floats, Mapping[str, Floats]], Keys] = _keys_alone
    beyond: Callable[[Mapping[str, float]], str] = _unlimited
    smallest: Callable[[Mapping[str, float], float], tuple[float, float]] | None = None

    def holds(self, keys: Mapping[str, float]) -> bool:
        """Return whether a contact lies within the ranges, by its keys."""
        return all(is_within(keys[key], *ends) for key, ends in self.ranges.items())


def is_within(value: float, low: float, high: float) -> bool:
    """Return whether a value lies between two positive ends, but for rounding."""
    return low * (1 - ROUNDING) <= value <= high * (1 + ROUNDING)


def shipped(kind: Kind) -> Path:
    """Return the file of this package."""
    return Path(__file__).with_name(f"{kind.name}.nc")
