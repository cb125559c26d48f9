"""Roughness and film thickness, before and after, and what makes a prediction doubtful."""

import math
from dataclasses import dataclass

import numpy as np

from ehlwave.deform.conditions import Conditions
from ehlwave.deform.surface import Heights

LINEAR_LIMIT = 0.3
"""Amplitude over film up to which the linear prediction was compared with simulations."""


@dataclass(frozen=True)
class FilmStatistics:
    """Lengths in m. Film thicknesses and ratios are None when the smooth film is unknown.

    Attributes
    ----------
    rq_before_m, rq_after_m : float
        Root mean square roughness about the mean.
    rz_before_m, rz_after_m : float
        From the lowest to the highest point.
    mean_film_m : float or None
        Of the rough contact's centre: the smooth central film and `mean_rise_m`, where it is known.
    mean_rise_m : float or None
        What the roughness adds to the mean film, to second order. None: the transfer has no rises.
    minimum_film_m : float or None
        Mean film less the highest deformed point. Negative: the surfaces would touch.
    lambda_ratio_before, lambda_ratio_after : float or None
        Mean film over Rq before (the usual ratio) and after (what is there in the contact).
    amplitude_over_film : float or None
        sqrt(2) Rq before over the smooth film: the amplitude of a cosine of the same Rq.
    """

    rq_before_m: float
    rq_after_m: float
    rz_before_m: float
    rz_after_m: float
    mean_film_m: float | None
    mean_rise_m: float | None = None
    minimum_film_m: float | None = None
    lambda_ratio_before: float | None = None
    lambda_ratio_after: float | None = None
    amplitude_over_film: float | None = None


def film_statistics(
    before: Heights, after: Heights, film_m: float | None, rise: float | None
) -> FilmStatistics:
    """Return the statistics of a surface before and after, for a smooth central film in m.

    `rise`: of the mean film over the smooth one, for Rq before equal to that.
    """
    rq_before, rq_after = _rms(before), _rms(after)
    mean_film, of_film = film_m, {}
    if film_m is not None:
        of_film["amplitude_over_film"] = math.sqrt(2) * rq_before / film_m
        if rise is not None:
            of_film["mean_rise_m"] = rise * rq_before**2 / film_m
        mean_film = film_m + of_film.get("mean_rise_m", 0.0)
        of_film |= {
            "minimum_film_m": mean_film - float(after.max()),
            "lambda_ratio_before": _quotient(mean_film, rq_before),
            "lambda_ratio_after": _quotient(mean_film, rq_after),
        }
    return FilmStatistics(
        rq_before_m=rq_before,
        rq_after_m=rq_after,
        rz_before_m=float(before.max() - before.min()),
        rz_after_m=float(after.max() - after.min()),
        mean_film_m=mean_film,
        **of_film,
    )


def warnings_of(statistics: FilmStatistics, conditions: Conditions) -> list[str]:
    """Return what the reader of a prediction should know before believing it."""
    found = []
    if conditions.slip_parameter != 1:
        found.append(
            f"slip is present (S = {conditions.slip_parameter:g}): formula (18) was made for pure "
            "rolling and judges none of the components; with sliding the roughness is usually "
            "flattened more"
        )
    if statistics.amplitude_over_film is None:
        found.append(
            "the film thickness is unknown: give central_film_m, or radius_x_m with M, L and D"
        )
        return found
    ratio = statistics.amplitude_over_film
    if ratio > LINEAR_LIMIT:
        found.append(
            f"the amplitude, sqrt(2) Rq, is {ratio:.2g} of the film, above {LINEAR_LIMIT}: the "
            "prediction is linear in the amplitude and is only a first estimate here"
        )
    if statistics.minimum_film_m is not None and statistics.minimum_film_m <= 0:
        found.append(
            "the minimum film is negative: the surfaces would touch, which the prediction does "
            "not describe"
        )
    return found


def _rms(height: Heights) -> float:
    """Return the root mean square about the mean, in double precision without a copy."""
    mean = float(np.mean(height, dtype=np.float64))
    total = sum(
        float(np.sum(np.square(row - height.dtype.type(mean)), dtype=np.float64))
        for row in np.array_split(height, max(1, height.size // 2**20))
    )
    return math.sqrt(total / height.size)


def _quotient(numerator: float, denominator: float) -> float:
    return numerator / denominator if denominator > 0 else math.inf
