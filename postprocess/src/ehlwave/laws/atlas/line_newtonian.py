"""Line contacts that slide in a Newtonian oil: they have the film of those that roll.

Waves follow :class:`ehlwave.laws.atlas.line_sliding_shape.LineSlidingShape` without thinning.
"""

from collections.abc import Mapping
from functools import lru_cache

from numpy.typing import ArrayLike

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.duals import np, to_float
from ehlwave.laws.atlas.coordinates import Floats, columns
from ehlwave.laws.atlas.line_rolling import rolling_line_chart
from ehlwave.laws.atlas.line_sliding import LINE_SLIDING_RANGES
from ehlwave.laws.atlas.line_sliding_shape import LineSlidingShape
from ehlwave.laws.atlas.ranges import LINE_RANGES

LINE_NEWTONIAN_RANGES = LINE_RANGES | {"slip_parameter": LINE_SLIDING_RANGES["slip_parameter"]}
"""Smallest and largest value of each key of a line contact that slides, of a Newtonian oil."""


def newtonian_conditions_of(keys: Mapping[str, ArrayLike]) -> list[Conditions]:
    """Return the conditions of line contacts given by columns named as their keys."""
    table = map(np.atleast_1d, columns(keys, LINE_NEWTONIAN_RANGES))
    return [_conditions(*map(to_float, row)) for row in zip(*table, strict=True)]


@lru_cache(maxsize=8192)
def _conditions(*values: float) -> Conditions:
    keys = {"radius_ratio_d": 0.0} | dict(zip(LINE_NEWTONIAN_RANGES, values, strict=True))
    return conditions_from_keys(keys, "atlas", needs_lengths=False)


def line_newtonian_references(keys: Mapping[str, ArrayLike]) -> Floats:
    """Return central and smallest film in pure rolling, Moes scale, and P = 1, shape (c, 3)."""
    charts = map(rolling_line_chart, newtonian_conditions_of(keys))
    return np.array([(*chart.computed_films(), 1.0) for chart in charts])


class LineNewtonianShape(LineSlidingShape):
    """Responses of line contacts that slide in a Newtonian oil."""

    CONDITIONS_OF = staticmethod(newtonian_conditions_of)
