"""Largest amplitude at which predictions were compared with marches, and errors by amplitude.

Amplitudes are over the film of the smooth contact.
"""

import math

from ehlwave.contact.conditions import Conditions
from ehlwave.error_bars import bar
from ehlwave.laws.atlas.atlas import kind_for, thinned_kind

VALIDATED_ROLLING, VALIDATED_SLIDING = 1.5, 0.95
"""Largest amplitude over film at which predictions were compared with marches of several rough maps
(``record/lambda``), rolling and under slight slip."""

SLIGHT_SLIP, VALIDATED_FASTER = 0.1, 0.3
"""Largest deviation of S from 1 of those marches, and the largest amplitude under more slip, of
the marched waves that the manual compares with linear responses."""

ROLLING_FACTOR = bar("linear.rolling")
SLIP_FACTORS = (bar("linear.slip_newtonian"), bar("linear.slip_others"))
"""Relative change of Ad/Ai over (amplitude/film)^2, and the same over (S - 1)^2: of Newtonian oils
with S > 1, of others. A test compares them with ``src/case/linear_range.f90``."""

ROUNDING = 1e-9
"""Rounding of S, where S - 1 is compared."""

PROFILE_FACTOR = bar("profile.second_order")
"""Relative difference of predicted from marched Rq over (amplitude/film)^2. Most of it are higher
harmonics, which Ad/Ai does not show."""

RISE_KINDS = ("rolling", "rolling_wide", "sliding", "sliding_wide")
RISE_KINDS += ("line", "line_sliding", "line_newtonian")
RISE_ERRORS = {kind: bar(f"rise.{kind}") for kind in RISE_KINDS}
"""Error of the rise of the mean film over the film, per (amplitude/film)^2, by kind of atlas."""

LOWEST_WIDTH = 0.39
"""Width of :func:`lowest_film` over the film (``record/lambda``)."""

LARGEST_RISE = 0.5
"""Share of the film: a larger change in second order means that the series does not hold."""


def validated_amplitude(conditions: Conditions) -> float:
    """Return the largest amplitude over film up to which predictions were compared with marches."""
    slip = abs(conditions.slip_parameter - 1)
    if slip == 0:
        return VALIDATED_ROLLING
    return VALIDATED_SLIDING if slip <= SLIGHT_SLIP + ROUNDING else VALIDATED_FASTER


def expected_nonlinearity(conditions: Conditions, amplitude: float) -> float:
    """Return the relative error of the deformed Rq that this amplitude over film makes."""
    slip = conditions.slip_parameter
    is_worst = conditions.oil.name == "Newtonian" and slip > 1
    factor = ROLLING_FACTOR + SLIP_FACTORS[0 if is_worst else 1] * (slip - 1) ** 2
    return max(factor, PROFILE_FACTOR) * amplitude**2


def rise_error(conditions: Conditions, amplitude: float) -> float:
    """Return the error of the rise of the mean film, over the film."""
    kind = "sliding"
    if conditions.has_atlas:
        kind = (thinned_kind(conditions) or kind_for(conditions)).name
    return RISE_ERRORS[kind] * amplitude**2


def lowest_film_slope(linear: float, width: float = LOWEST_WIDTH) -> float:
    """Return the derivative of :func:`lowest_film` by the linear prediction."""
    return 1 / (1 + math.exp(-linear / width))


def lowest_film(linear: float, width: float = LOWEST_WIDTH) -> float:
    """Return the lowest film from the linear prediction of it, both over the smooth film.

    High points are flattened more than by linear responses: the film bends away from 0.
    """
    bend = math.log1p(math.exp(-abs(linear) / width)) + max(0.0, -linear) / width
    return linear + width * (bend - math.log1p(math.exp(-1 / width)))
