"""The atlas of contacts that roll, to which contacts that slide are compared."""

from dataclasses import replace
from functools import cache

from ehlwave.contact.conditions import Conditions
from ehlwave.laws.atlas.chart import Chart
from ehlwave.laws.atlas.constriction import constriction
from ehlwave.laws.atlas.coordinates import beyond_limits, contact_coordinates, rolling_references
from ehlwave.laws.atlas.kind import FILMS, Kind, shipped
from ehlwave.laws.atlas.networks import Networks
from ehlwave.laws.atlas.ranges import CONTACT_RANGES, WIDE_RANGES
from ehlwave.laws.atlas.shape import Shape
from ehlwave.laws.atlas.stored import read_stored

ROLLING = Kind(
    "rolling", CONTACT_RANGES, contact_coordinates, Shape.of_keys, FILMS, rolling_references
)
WIDE = Kind(
    "rolling_wide",
    WIDE_RANGES,
    contact_coordinates,
    Shape.of_keys,
    FILMS,
    rolling_references,
    beyond=beyond_limits,
    smallest=constriction,
)


def rolling_chart(contact: Conditions, kind: Kind = ROLLING) -> Chart:
    """Return the chart of the same contact in pure rolling, from an atlas of this package."""
    return Chart(_networks(kind.name), replace(contact, slip_parameter=1.0).atlas_keys())


@cache
def _networks(name: str) -> Networks:
    kind = WIDE if name == WIDE.name else ROLLING
    return Networks(read_stored(shipped(kind)), kind)
