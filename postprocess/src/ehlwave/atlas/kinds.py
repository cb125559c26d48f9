"""What the atlases of contacts that roll and of those that slide differ in."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import xarray as xr
from numpy.typing import ArrayLike

from ehlwave.atlas.coordinates import Floats, Shape, contact_coordinates
from ehlwave.atlas.ranges import CONTACT_RANGES, SLIDING_RANGES
from ehlwave.atlas.sliding import SlidingShape, sliding_coordinates


@dataclass(frozen=True)
class Kind:
    """An atlas by what its contacts do.

    Attributes
    ----------
    name : str
        Of the file, and its attribute ``kind``.
    ranges : mapping
        Smallest and largest value of each key of a contact.
    coordinates : callable
        Coordinates of contacts, shape (c, k), by columns named as their keys.
    shape : callable
        What turns responses into numbers, by the same and the attributes of the file.
    films : tuple of str
        What is interpolated of contacts: ln of central over Moes' film and ln of smallest over
        central film, under slip both less those of pure rolling, and ln of the mean shear stress
        over that of :func:`ehlwave.atlas.sliding.mean_stress`.
    """

    name: str
    ranges: Mapping[str, tuple[float, float]]
    coordinates: Callable[[Mapping[str, ArrayLike]], Floats]
    shape: Callable[[Mapping[str, ArrayLike], Mapping[str, Any]], Shape]
    films: tuple[str, ...]


_FILMS = ("film_ratio", "minimum_ratio")
ROLLING = Kind("rolling", CONTACT_RANGES, contact_coordinates, Shape.of_keys, _FILMS)
SLIDING = Kind(
    "sliding",
    SLIDING_RANGES,
    sliding_coordinates,
    SlidingShape.of_keys,
    (*_FILMS, "friction_ratio"),
)
KINDS = {kind.name: kind for kind in (ROLLING, SLIDING)}


def kind_of(data: xr.Dataset) -> Kind:
    """Return the kind of an atlas; files without a word roll."""
    return KINDS[data.attrs.get("kind", ROLLING.name)]
