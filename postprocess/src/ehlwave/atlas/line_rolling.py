"""The atlas of line contacts that roll, to which those that slide are compared."""

from functools import cache

import numpy as np

from ehlwave.atlas.chart import Chart
from ehlwave.atlas.kind import FILMS, Kind, shipped
from ehlwave.atlas.line import LineShape, line_coordinates, line_references
from ehlwave.atlas.networks import Networks
from ehlwave.atlas.ranges import LINE_RANGES
from ehlwave.atlas.stored import read_stored
from ehlwave.contact.conditions import Conditions

LINE = Kind("line", LINE_RANGES, line_coordinates, LineShape.of_keys, FILMS, line_references)


def rolling_line_chart(contact: Conditions) -> Chart:
    """Return the chart of the same line contact in pure rolling, from the atlas of this package.

    The atlas that slides is computed a little below the ranges, too: the next inside stands there.
    """
    keys = contact.atlas_keys()
    place = {key: float(np.clip(keys[key], *ends)) for key, ends in LINE_RANGES.items()}
    return Chart(_networks(), place)


@cache
def _networks() -> Networks:
    return Networks(read_stored(shipped(LINE)), LINE)
