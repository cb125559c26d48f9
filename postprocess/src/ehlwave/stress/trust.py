"""Where stresses of predicted contacts are not to be trusted."""

import math
from collections.abc import Sequence

from ehlwave.error_bars import bar
from ehlwave.shown import percent
from ehlwave.surface.predict import Deformed
from ehlwave.surface.ripple import hertz_pressure_of
from ehlwave.surface.rough_pressure import Ripple

MODEL_ERROR = bar("stress.model")
"""Relative: waves of the centre and Hertz pressure replace the whole contact."""

LINEAR_LIMIT = 0.3
"""Amplitude over film up to which the prediction is held to marches."""

LEAST_LAMBDA_RATIO = 3.0
"""Film over the deformed roughness of both surfaces, below which asperities may touch."""


def doubts(
    surfaces: Sequence[Deformed], ripples: Sequence[Ripple], amplitude: float, bar: float
) -> list[str]:
    """Return where the prediction is not to be trusted."""
    conditions = surfaces[0].conditions
    found = [text for surface in surfaces for text in surface.warnings if "slip is" not in text]
    if amplitude > LINEAR_LIMIT:
        found.append(
            f"the amplitude is {amplitude:.2g} of the film, above {LINEAR_LIMIT}: pressures are "
            "linear in it and only a first estimate"
        )
    ratios = [surface.statistics.lambda_ratio_after for surface in surfaces]
    squares = sum(ratio**-2 for ratio in ratios if ratio is not None and ratio > 0)
    if squares * LEAST_LAMBDA_RATIO**2 > 1:
        found.append(
            "the film is less than three times the deformed roughness: asperities may touch, where "
            "the pressure is as in dry contacts"
        )
    if reach(ripples, hertz_pressure_of(conditions)) == 0:
        lowest = _lowest(ripples)
        found.append(
            f"the ripple falls to {lowest * 1e-9:.3g} GPa, below -ph: the oil cannot bear tension, "
            "and the rest does not follow from small waves"
        )
    if bar > MODEL_ERROR:
        found.append(f"the error bars of the responses are {percent(bar)} of the ripple")
    return found


def reach(ripples: Sequence[Ripple], hertz_pa: float) -> float:
    """Return how far from the centre the pressure is above 0 everywhere, in semi-axes."""
    return math.sqrt(max(0.0, 1 - (min(0.0, _lowest(ripples)) / hertz_pa) ** 2))


def _lowest(ripples: Sequence[Ripple]) -> float:
    """Return the lowest pressure of the ripples, Pa."""
    return min(float(ripple.pressure().min()) for ripple in ripples)
