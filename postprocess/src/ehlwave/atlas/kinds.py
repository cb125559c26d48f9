"""What the atlases of contacts that roll, of those that slide and of line contacts differ in."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from numpy.typing import ArrayLike

from ehlwave.atlas.coordinates import Floats, contact_coordinates, rolling_references
from ehlwave.atlas.line import LineShape, line_coordinates, line_references
from ehlwave.atlas.ranges import CONTACT_RANGES, LINE_RANGES, SLIDING_RANGES
from ehlwave.atlas.shape import Shape
from ehlwave.atlas.sliding import sliding_coordinates, sliding_references, sliding_state
from ehlwave.atlas.sliding_shape import SlidingShape

Keys = Mapping[str, ArrayLike]


def _keys_alone(keys: Keys, _: Floats, __: Mapping[str, Floats]) -> Keys:
    return keys


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
        What turns responses into numbers, by the same.
    films : tuple of str
        What is known of contacts: ln of the central film over its reference; ln of the
        smallest over the central film, less that of their references; ln of the mean shear stress
        over its reference; ln of the pressure at the centre over that of Hertz.
    references : callable
        What these are relative to, shape (c, films), by the same columns: films in the Moes scale,
        of Moes' formula or, under slip, in pure rolling; the stress of
        :func:`ehlwave.atlas.sliding.mean_stress`.
    state : callable
        What ``shape`` takes of contacts, from their keys, the references and the numbers of their
        films.
    """

    name: str
    ranges: Mapping[str, tuple[float, float]]
    coordinates: Callable[[Keys], Floats]
    shape: Callable[[Keys], Shape]
    films: tuple[str, ...]
    references: Callable[[Keys], Floats]
    state: Callable[[Keys, Floats, Mapping[str, Floats]], Keys] = _keys_alone


_FILMS = ("film_ratio", "minimum_ratio")
ROLLING = Kind(
    "rolling", CONTACT_RANGES, contact_coordinates, Shape.of_keys, _FILMS, rolling_references
)
SLIDING = Kind(
    "sliding",
    SLIDING_RANGES,
    sliding_coordinates,
    SlidingShape.of_keys,
    (*_FILMS, "friction_ratio", "pressure_ratio"),
    sliding_references,
    sliding_state,
)
LINE = Kind("line", LINE_RANGES, line_coordinates, LineShape.of_keys, _FILMS, line_references)
KINDS = {kind.name: kind for kind in (ROLLING, SLIDING, LINE)}
