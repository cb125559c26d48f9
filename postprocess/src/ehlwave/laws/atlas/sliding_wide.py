"""Contacts that slide beyond the ranges of the usual atlas, down to a surface at rest, S = 0."""

from collections.abc import Mapping

from numpy.typing import ArrayLike

from ehlwave.contact.conditions import MOES_KEYS, Conditions
from ehlwave.duals import np, to_float
from ehlwave.laws.atlas.chart import Chart
from ehlwave.laws.atlas.coordinates import Floats, beyond_limits, hertz_film
from ehlwave.laws.atlas.kind import FILMS, Kind
from ehlwave.laws.atlas.ranges import SLIDING_WIDE_RANGES, THINNEST_SLIDING_FILM
from ehlwave.laws.atlas.rolling import WIDE, rolling_chart
from ehlwave.laws.atlas.sliding import (
    beyond_thinning,
    conditions_of,
    sliding_coordinates,
    sliding_references,
    sliding_state,
    thinning_of,
)
from ehlwave.laws.atlas.sliding_shape import SlidingShape

SLOWEST = 0.005
"""S below which the complementary wave is taken as there: at rest it has no wave number."""

THINNED = -0.25
"""Power of 1 + T by which films are thinner under slip, about."""

SLOWEST_LAUNCH = 0.18
"""S0 in ((S^2 + S0^2)/(1 + S0^2))^(1/2), by which the law launches it: of ln S there is no end."""


class WideSlidingShape(SlidingShape):
    """Responses of contacts that slide, as the wide atlas sees them: S may be 0.

    The law has coefficients of its own, fitted to its points: beyond the usual ranges 5 % of the
    responses differ by more than 0.18 of Ai, with the usual coefficients by 0.24.
    """

    POWERS = (0.245, 0.187, 0.641, 0.639, 0.274, 0.34, 0.073)
    LENGTH = (0.182, 0.263, 0.532)

    def _slips(self) -> tuple[Floats, ...]:
        """Return S - 1 and its absolute value."""
        return self._slip - 1, np.abs(self._slip - 1)

    @staticmethod
    def _rolls(contact: Conditions) -> Chart:
        """Return the chart of a contact in pure rolling."""
        return rolling_chart(contact, WIDE)

    @property
    def _moving(self) -> Floats:
        return np.maximum(self._slip, SLOWEST)

    @property
    def _launching(self) -> Floats:
        return np.hypot(self._slip, SLOWEST_LAUNCH) / np.hypot(1, SLOWEST_LAUNCH)


def wide_sliding_references(keys: Mapping[str, ArrayLike]) -> Floats:
    """Return references as in the usual atlas, for films of :data:`WIDE`."""
    return sliding_references(keys, WIDE)


def film_under_slip(keys: Mapping[str, float]) -> float:
    """Return about the film of a contact over the Hertz approach."""
    film = to_float(hertz_film(*(keys[key] for key in MOES_KEYS)))
    return film * (1 + thinning_of(conditions_of(keys)[0])) ** THINNED


def beyond_sliding(keys: Mapping[str, float]) -> str:
    """Return the excess of a contact over the atlas; '' if none."""
    beyond = beyond_limits(keys) or beyond_thinning(keys)
    if beyond:
        return beyond
    film = film_under_slip(keys)
    if film < THINNEST_SLIDING_FILM * (1 - 1e-9):
        return (
            f"a film under slip of about {film:.3g} times the Hertz approach (of at least "
            f"{THINNEST_SLIDING_FILM:g}: thinner films have inlets too steep)"
        )
    return ""


SLIDING_WIDE = Kind(
    "sliding_wide",
    SLIDING_WIDE_RANGES,
    sliding_coordinates,
    WideSlidingShape.of_keys,
    (*FILMS, "friction_ratio", "pressure_ratio"),
    wide_sliding_references,
    sliding_state,
    beyond_sliding,
)
