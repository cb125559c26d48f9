"""The atlas of contacts that roll, to which contacts that slide are compared."""

from dataclasses import replace
from functools import cache

from ehlwave.atlas.chart import Chart
from ehlwave.atlas.coordinates import beyond_limits, contact_coordinates, rolling_references
from ehlwave.atlas.kind import FILMS, Kind, shipped
from ehlwave.atlas.networks import Networks
from ehlwave.atlas.ranges import CONTACT_RANGES
from ehlwave.atlas.shape import Shape
from ehlwave.atlas.stored import read_stored
from ehlwave.contact.conditions import Conditions

ROLLING = Kind(
    "rolling",
    CONTACT_RANGES,
    contact_coordinates,
    Shape.of_keys,
    FILMS,
    rolling_references,
    beyond=beyond_limits,
)


REFERENCE = shipped(ROLLING).with_name("rolling_reference.nc")
"""The networks of rolling contacts that the atlas of sliding ones was fitted to, of M 20 to 2000.

Newer ones differ from them by more than its error bars allow for.
"""


def rolling_chart(contact: Conditions) -> Chart:
    """Return the chart of the same contact in pure rolling that contacts that slide refer to."""
    return Chart(reference_networks(), replace(contact, slip_parameter=1.0).atlas_keys())


@cache
def reference_networks() -> Networks:
    """Return what contacts that slide are compared to."""
    return Networks(read_stored(REFERENCE), ROLLING)
