"""The answer first: lambda ratio and film of a prediction in a line, and their meaning."""

import math
from dataclasses import asdict, dataclass
from typing import Any

from ehlwave.shown import spread
from ehlwave.surface.pair import PairStatistics
from ehlwave.surface.statistics import FilmStatistics

UM = 1e6
BOUNDARY_BELOW, FULL_FROM = 1.0, 3.0
"""Lambda ratios: Hamrock, Schmid and Jacobson, *Fundamentals of Fluid Film Lubrication*, 2nd ed.
(2004), film parameter: boundary below 1, elastohydrodynamic from 3; between them mixed."""

LIMITS_TEXT = (
    f"boundary below {BOUNDARY_BELOW:g}, mixed to {FULL_FROM:g}, full film above: the usual limits "
    "(Hamrock, Schmid and Jacobson 2004), made for the roughness of both surfaces as made"
)
REGIMES = ("boundary", "mixed", "full film")


@dataclass(frozen=True)
class Answer:
    """Lambda ratio with the deformed roughness, and its meaning.

    Attributes
    ----------
    lambda_ratio : float or None
        Mean film over Rq in the contact; None: the film is not known. Infinite of smooth surfaces.
    lambda_error : float or None
        Relative; None: not known.
    mean_film_m, rq_m : float or None
        Its parts.
    regimes : tuple of str
        ``"boundary"``, ``"mixed"``, ``"full film"``: all that the error leaves open; none
        where it is not known.
    surfaces_touch, extrapolated : bool
        As of :class:`ehlwave.surface.statistics.FilmStatistics`.
    of_both : bool
        Whether it applies to two rough surfaces.
    """

    lambda_ratio: float | None
    lambda_error: float | None
    mean_film_m: float | None
    rq_m: float
    regimes: tuple[str, ...]
    surfaces_touch: bool
    extrapolated: bool
    of_both: bool = False

    def text(self) -> str:
        """Return the answer as a line."""
        if self.lambda_ratio is None or self.mean_film_m is None:
            return (
                "lambda is not known without the film: give central_film_m, or radius_x_m with M, "
                "L and D"
            )
        if math.isinf(self.lambda_ratio):
            return (
                f"lambda is infinite: nothing of the roughness is left; full film. Mean film "
                f"{self.mean_film_m * UM:.4g} um"
            )
        error = "error not known"
        if self.lambda_error is not None:
            error = (
                spread(self.lambda_error, f"{self.lambda_ratio * (1 + self.lambda_error):.2g}")
                if self.lambda_error < 1
                else "no better than an order of magnitude"
            )
        means = f": {' or '.join(self.regimes)}" if self.regimes else ""
        said = (
            f"lambda = {self.lambda_ratio:.3g}, {error}{means}. Mean film "
            f"{self.mean_film_m * UM:.4g} um, Rq in the contact {self.rq_m * UM:.4g} um"
        )
        if self.of_both:
            said += " of both surfaces"
        notes = [*(["extrapolated"] * self.extrapolated)]
        notes += ["the surfaces touch"] * self.surfaces_touch
        return f"{said} ({', '.join(notes)})" if notes else said

    def summary(self) -> dict[str, Any]:
        """Return the answer as numbers and words."""
        limits = {"boundary_below": BOUNDARY_BELOW, "full_film_from": FULL_FROM}
        return {"text": self.text(), **asdict(self), "limits": {**limits, "source": LIMITS_TEXT}}


def regimes_of(ratio: float, error: float | None) -> tuple[str, ...]:
    """Return the regimes that a lambda ratio can be of, within its relative error; None: none."""
    if math.isinf(ratio):
        return REGIMES[-1:]
    if error is None:
        return ()
    low, high = ratio * (1 - error), ratio * (1 + error)
    first, last = (int(end >= BOUNDARY_BELOW) + int(end >= FULL_FROM) for end in (low, high))
    return REGIMES[first : last + 1]


def answer_of(statistics: FilmStatistics) -> Answer:
    """Return the answer of a surface."""
    s = statistics
    ratio = s.lambda_ratio_after
    return Answer(
        lambda_ratio=ratio,
        lambda_error=s.lambda_error,
        mean_film_m=s.mean_film_m,
        rq_m=s.rq_after_m,
        regimes=() if ratio is None else regimes_of(ratio, s.lambda_error),
        surfaces_touch=bool(s.surfaces_touch),
        extrapolated=bool(s.extrapolated),
    )


def answer_of_two(pair: PairStatistics) -> Answer:
    """Return the answer of two surfaces that pass each other."""
    return Answer(
        lambda_ratio=pair.lambda_ratio_after,
        lambda_error=pair.lambda_error,
        mean_film_m=pair.mean_film_m,
        rq_m=pair.rq_after_m,
        regimes=regimes_of(pair.lambda_ratio_after, pair.lambda_error),
        surfaces_touch=pair.surfaces_touch,
        extrapolated=pair.extrapolated,
        of_both=True,
    )
