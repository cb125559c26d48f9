"""Up to which amplitude predictions were compared with marches, and what amplitude adds to errors.

Amplitudes are over the film of the smooth contact.
"""

from ehlwave.contact.conditions import Conditions

VALIDATED_ROLLING, VALIDATED_SLIDING = 0.62, 0.3
"""Largest amplitude over film of a march that a prediction was compared with: the sputtered pattern
(``record/microgeometry``), under slip the waves of ``scripts/study transients``."""

ROLLING_FACTOR = 0.05
SLIP_FACTORS = (68.0, 18.0)
"""Relative change of Ad/Ai over (amplitude/film)^2, and the same over (S - 1)^2: of Newtonian oils
with S > 1, of others. Those of ``src/case/linear_range.f90``, with which a test compares them."""

PROFILE_FACTOR = 0.15
"""Difference of a marched from a predicted profile over Rq and (amplitude/film)^2: 6 per cent at
0.61 (``record/microgeometry``). Most of it are higher harmonics, which Ad/Ai does not show."""

RISE_ERRORS = {"rolling": 0.067, "sliding": 0.12, "line": 0.017}
"""Of the rise of the mean film over the film, per (amplitude/film)^2: 95 % of the waves in contacts
that the networks have not seen (``scripts/study atlas --validate``)."""

LARGEST_RISE = 0.5
"""Of the film: a larger change in second order says that the series does not hold."""


def validated_amplitude(conditions: Conditions) -> float:
    """Return the largest amplitude over film up to which predictions were compared with marches."""
    return VALIDATED_ROLLING if conditions.slip_parameter == 1 else VALIDATED_SLIDING


def expected_nonlinearity(conditions: Conditions, amplitude: float) -> float:
    """Return the relative error of the deformed Rq that this amplitude over film makes."""
    slip = conditions.slip_parameter
    is_worst = conditions.oil.name == "Newtonian" and slip > 1
    factor = ROLLING_FACTOR + SLIP_FACTORS[0 if is_worst else 1] * (slip - 1) ** 2
    return max(factor, PROFILE_FACTOR) * amplitude**2


def rise_error(conditions: Conditions, amplitude: float) -> float:
    """Return the error of the rise of the mean film, over the film."""
    kind = "line" if conditions.is_line else "rolling"
    kind = kind if conditions.slip_parameter == 1 else "sliding"
    return RISE_ERRORS[kind] * amplitude**2
