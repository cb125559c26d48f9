"""The atlas of line contacts that roll, to which those that slide are compared."""

from dataclasses import replace
from functools import cache

from ehlwave.contact.conditions import Conditions
from ehlwave.duals import np, to_float
from ehlwave.laws.atlas.chart import Chart
from ehlwave.laws.atlas.kind import FILMS, Kind, shipped
from ehlwave.laws.atlas.line import (
    LineShape,
    beyond_line_limits,
    line_coordinates,
    line_references,
)
from ehlwave.laws.atlas.networks import Networks
from ehlwave.laws.atlas.ranges import LINE_RANGES
from ehlwave.laws.atlas.stored import read_stored

LINE = Kind(
    "line",
    LINE_RANGES,
    line_coordinates,
    LineShape.of_keys,
    FILMS,
    line_references,
    beyond=beyond_line_limits,
)

COMPUTED = replace(
    LINE, ranges={key: (low / 1.15, high) for key, (low, high) in LINE_RANGES.items()}
)
"""Its contacts lie a little below the ranges, too: responses change most at their lower ends."""


def rolling_line_chart(contact: Conditions) -> Chart:
    """Return the chart of the same line contact in pure rolling, from the atlas of this package.

    Where those that slide are computed a little below the ranges, it is known as well.
    """
    keys = contact.atlas_keys()
    place = {key: to_float(np.clip(keys[key], *ends)) for key, ends in COMPUTED.ranges.items()}
    return Chart(_networks(), place)


@cache
def _networks() -> Networks:
    return Networks(read_stored(shipped(LINE)), COMPUTED)
