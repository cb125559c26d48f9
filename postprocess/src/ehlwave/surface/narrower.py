"""Advice on the largest part of the error of a lambda ratio."""

from ehlwave.surface.answer import answer_of
from ehlwave.surface.predict import Deformed

LEAST = 0.1
"""Relative error from which a decided answer has advice, too."""

ADVICE = {
    "film": "compute the contact (--by computed)",
    "responses": "compute the responses of this contact (--by computed, or --table)",
    "amplitude": "simulate the surface (ehlwave surface and ehlwave-case)",
    "rise": "simulate the surface (ehlwave surface and ehlwave-case)",
}
OIL = "measure viscosity and pressure-viscosity coefficient of the oil"


def narrower(result: Deformed) -> str:
    """Return the step that narrows the error of lambda most, '' where none is needed or known.

    Parameters
    ----------
    result : Deformed
        A prediction.
    """
    s = result.statistics
    if s.lambda_error is None or not s.lambda_errors:
        return ""
    if len(answer_of(s).regimes) < 2 and s.lambda_error < LEAST:
        return ""
    parts = dict(s.lambda_errors)
    oil = min(result.conditions.oil_error, parts.get("film", 0.0))
    steps = dict.fromkeys((OIL, *ADVICE.values()), 0.0)
    steps[OIL] = oil
    for name, part in parts.items():
        if name in ADVICE:
            steps[ADVICE[name]] += part - (oil if name == "film" else 0.0)
    best = max(steps, key=lambda step: steps[step])
    return f"{best}: {100 * steps[best]:.2g} of {100 * s.lambda_error:.2g} points of the error"
