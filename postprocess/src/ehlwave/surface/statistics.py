"""Roughness and film thickness, before and after, their errors, and reasons for doubt."""

import math
from dataclasses import dataclass

import numpy as np

from ehlwave.contact.conditions import Conditions
from ehlwave.surface.amplitude import (
    LARGEST_RISE,
    expected_nonlinearity,
    lowest_film,
    rise_error,
    validated_amplitude,
)
from ehlwave.surface.averaged_film import (
    FLOOR,
    SMALL_RISE,
    averaged_error,
    averaged_film,
    is_covered,
)
from ehlwave.surface.surface import Heights

LINEAR_LIMIT = 0.3
"""Amplitude over film above which a linear prediction is a first estimate."""


@dataclass(frozen=True)
class FilmStatistics:
    """Lengths in m. Film thicknesses and ratios are None when the smooth film is unknown."""

    rq_before_m: float
    rq_after_m: float
    """`rq_before_m`, `rq_after_m`: root mean square roughness about the mean."""
    rz_before_m: float
    rz_after_m: float
    """`rz_before_m`, `rz_after_m`: from the lowest to the highest point."""
    mean_film_m: float | None = None
    """Film at the rough contact's centre: the smooth central film and `mean_rise_m`, if used."""
    mean_rise_m: float | None = None
    """Rise of the mean film by the roughness. None: the transfer has no rises, or the amplitude is
    above their tested range.
    """
    mean_rise_by: str | None = None
    """``"second order"``, or ``"averaged flow"`` for larger rises in pure rolling."""
    mean_film_error: float | None = None
    """Relative error of the mean film; None: not known."""
    minimum_film_m: float | None = None
    """At the highest deformed point, by :func:`ehlwave.surface.amplitude.lowest_film`: marches have
    more there than the mean film less that point. None where the surfaces touch."""
    surfaces_touch: bool | None = None
    """Whether it is below the boundary film. Without one: whether the highest deformed point is
    above the mean film; marches then touch somewhere in the contact, if not at its centre."""
    boundary_film_m: float | None = None
    """Film at which solids begin to bear, as given."""
    lambda_ratio_before: float | None = None
    lambda_ratio_after: float | None = None
    """`lambda_ratio_before`, `lambda_ratio_after`: mean film over Rq before (the usual ratio) and
    after (in the contact)."""
    lambda_errors: dict[str, float] | None = None
    """Relative errors of `lambda_ratio_after` by ``"film"``, the smooth film, ``"responses"``, the
    linear responses, ``"amplitude"``, the nonlinear part, and ``"rise"``. A rise that is not used
    counts in full. None: the transfer has no errors.
    """
    lambda_error: float | None = None
    """Their sum."""
    amplitude_over_film: float | None = None
    """sqrt(2) Rq before over the smooth film: the amplitude of a cosine of the same Rq."""
    extrapolated: bool | None = None
    """Whether that is above the amplitudes that predictions were compared with."""


@dataclass(frozen=True)
class Components:
    """Statistics of the sum of all harmonic components."""

    rise: float | None = None
    """(Mean film less smooth film) times the film, over Rq squared; None: not known."""
    error: float | None = None
    """Root mean square error of the deformed heights over Rq before; None: not known."""


def film_statistics(
    before: Heights,
    after: Heights,
    conditions: Conditions,
    known: Components,
    boundary_film_m: float | None = None,
) -> FilmStatistics:
    """Return the statistics of a surface before and after, by the film of the conditions."""
    rq_before, rq_after = _rms(before), _rms(after)
    heights = {
        "rq_before_m": rq_before,
        "rq_after_m": rq_after,
        "rz_before_m": float(before.max() - before.min()),
        "rz_after_m": float(after.max() - after.min()),
    }
    film = conditions.central_film_m
    if film is None:
        return FilmStatistics(**heights)
    amplitude = math.sqrt(2) * rq_before / film
    rise = None if known.rise is None else float(known.rise * (rq_before / film) ** 2)
    extrapolated = amplitude > validated_amplitude(conditions)
    boundary = (boundary_film_m or 0.0) / film
    crest = float(after.max()) - float(np.mean(after, dtype=np.float64))
    is_averaged = (
        rise is not None
        and conditions.rolls
        and is_covered(rq_before / film, crest / film, rq_after / film, rise)
    )
    rise_by, ratio = None, 1.0
    rise_part = rise_error(conditions, amplitude) + (0.0 if rise is None else abs(rise))
    largest = SMALL_RISE if is_averaged else LARGEST_RISE
    if rise is not None and not extrapolated and abs(rise) <= largest:
        rise_by, ratio = "second order", 1 + rise
        rise_part = rise_error(conditions, amplitude) / ratio
    elif rise is not None and is_averaged:
        rise_by, ratio = "averaged flow", averaged_film(after / film, rise, boundary or FLOOR)
        rise_part = averaged_error(rq_after / film, is_line=conditions.is_line)
    mean_film = film * ratio
    least = float(mean_film - after.max()) / film
    # High points are flattened more than by linear responses.
    bends = conditions.rolls and boundary > 0 and rise_by is not None
    is_above = lowest_film(least) > boundary and (least > 0 or bends)
    errors = None
    if known.error is not None and conditions.central_film_error is not None:
        errors = {
            "film": conditions.central_film_error,
            "responses": _quotient(known.error * rq_before, rq_after),
            "amplitude": expected_nonlinearity(conditions, amplitude),
            "rise": rise_part,
        }
    return FilmStatistics(
        **heights,
        mean_film_m=mean_film,
        mean_rise_m=None if rise_by is None else mean_film - film,
        mean_rise_by=rise_by,
        mean_film_error=None if errors is None else errors["film"] + errors["rise"],
        minimum_film_m=lowest_film(least) * film if is_above else None,
        surfaces_touch=not is_above,
        boundary_film_m=boundary_film_m,
        lambda_ratio_before=_quotient(mean_film, rq_before),
        lambda_ratio_after=_quotient(mean_film, rq_after),
        lambda_errors=errors,
        lambda_error=None if errors is None else sum(errors.values()),
        amplitude_over_film=amplitude,
        extrapolated=extrapolated,
    )


def doubts_of(statistics: FilmStatistics, conditions: Conditions) -> list[str]:
    """Return why numbers of a prediction are extrapolated, or not there."""
    found = []
    if statistics.extrapolated:
        limit = validated_amplitude(conditions)
        film = "the mean film is the smooth one, without its rise by the roughness"
        if statistics.mean_rise_by is not None:
            film = f"the mean film is of {statistics.mean_rise_by}"
        found.append(
            f"extrapolated: the amplitude, sqrt(2) Rq, is {statistics.amplitude_over_film:.2g} of "
            f"the film, above {limit:g}, the largest that predictions were compared with; {film}"
        )
    if statistics.surfaces_touch and statistics.boundary_film_m and statistics.mean_rise_by:
        found.append(
            "the surfaces touch: the smallest film falls to the boundary film; the load on the "
            "solids needs a march (ehlwave-case with &touching)"
        )
    elif statistics.surfaces_touch:
        found.append(
            "the surfaces touch: the highest deformed point is above the mean film, so that there "
            "is no smallest film; how they touch the prediction does not describe"
        )
    return found


def warnings_of(
    statistics: FilmStatistics, conditions: Conditions, is_for_rolling: bool
) -> list[str]:
    """Return notes for the reader of a prediction.

    `is_for_rolling`: the transfer holds for pure rolling.
    """
    found = []
    slip = conditions.slip_parameter
    if slip != 1 and is_for_rolling:
        found.append(
            f"slip is present (S = {slip:g}): the formula was made for pure rolling and judges "
            "none of the components; with sliding the roughness is usually flattened more"
        )
    if statistics.amplitude_over_film is None:
        found.append(
            "the film thickness is unknown: give central_film_m, or radius_x_m with M, L and D"
        )
        return found
    laws = conditions.oil.other_laws
    if laws and conditions.central_film_error is None:
        found.append(
            f"{', '.join(laws)}: the film comes from a formula for Roelands' oil without a limit "
            "of the stress, and its error is not known: give central_film_m"
        )
    ratio = statistics.amplitude_over_film
    if ratio > LINEAR_LIMIT and not statistics.extrapolated:
        found.append(
            f"the amplitude, sqrt(2) Rq, is {ratio:.2g} of the film, above {LINEAR_LIMIT}: the "
            "prediction is linear in the amplitude and is only a first estimate here"
        )
    return found + doubts_of(statistics, conditions)


def _rms(height: Heights) -> float:
    """Return the root mean square about the mean, in double precision without a copy."""
    mean = float(np.mean(height, dtype=np.float64))
    total = sum(
        float(np.sum(np.square(row - height.dtype.type(mean)), dtype=np.float64))
        for row in np.array_split(height, max(1, height.size // 2**16))
    )
    return math.sqrt(total / height.size)


def _quotient(numerator: float, denominator: float) -> float:
    return numerator / denominator if denominator > 0 else math.inf
