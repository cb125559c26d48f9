"""Fits of formulas, and their errors at operating conditions that they were not fitted to."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import isotonic_regression, least_squares

from studies.folds import SEED, Mask, grouped_folds
from studies.paper.candidates import Candidate, Parameters
from studies.paper.fit_points import Floats, Points


def fitted(candidate: Candidate, points: Points, start: Parameters | None = None) -> Parameters:
    """Return the parameters that fit the points best, by weighted least squares.

    The search begins at ``start``, or at the candidate's own.

    Residuals weigh s/sqrt(s^2 + e^2), e the error bar of a point and s the scatter of the
    unweighted fit, as in :func:`ehlwave.results.fit.point_weights`.
    """
    begin = np.array(candidate.start) if start is None else start
    if not begin.size:
        return begin
    first = _solution(candidate, points, np.ones(points.size), begin)
    scatter = rms(residuals(candidate, first, points))
    # Points that follow the formula exactly leave nothing to weigh.
    if scatter < np.finfo(float).eps:
        return first
    return _solution(candidate, points, scatter / np.hypot(scatter, points.error), first)


def residuals(candidate: Candidate, parameters: Parameters, points: Points) -> Floats:
    """Return formula minus Ad/Ai at every point."""
    return candidate.curve(parameters, points) - points.ratio


def _solution(
    candidate: Candidate, points: Points, weight: Floats, start: Parameters
) -> Parameters:
    def residual(c: Parameters) -> Floats:
        return weight * residuals(candidate, c, points)

    return least_squares(residual, start, method="lm", x_scale="jac").x


def hard_splits(points: Points) -> dict[str, list[Mask]]:
    """Return test sets that ask for extrapolation: each D, each L, each end of L, the largest M."""
    lubricant, radius = points.lubricant, points.radius_ratio
    least, most = lubricant.min(), lubricant.max()
    return {
        "each D": [radius == value for value in np.unique(radius)],
        "each L": [lubricant == value for value in np.unique(lubricant)],
        f"L = {least:g}": [lubricant == least],
        f"L = {most:g}": [lubricant == most],
        "M >= 1000": [points.load_m >= 1000],
    }


def held_out(
    candidate: Candidate, points: Points, folds: Sequence[Mask], trained: Mask | None = None
) -> Floats:
    """Return formula minus Ad/Ai at every point, from fits without the fold that the point is in.

    NaN where no fold has the point. Only ``trained`` points (all by default) enter the fits.
    """
    residual = np.full(points.size, np.nan)
    parameters = None
    for fold in folds:
        others = ~fold if trained is None else ~fold & trained
        # The fit of the fold before saves steps; where a search begins is not where it ends.
        parameters = fitted(candidate, points[others], parameters)
        residual[fold] = residuals(candidate, parameters, points[fold])
    return residual


def rms(residual: Floats) -> float:
    """Return the root mean square over the finite residuals; NaN if there is none."""
    known = residual[np.isfinite(residual)]
    return float(np.sqrt(np.mean(known**2))) if known.size else float("nan")


def rms_standard_error(residual: Floats, group: NDArray[Any]) -> float:
    """Return the standard error of :func:`rms`; groups, not points, count as independent."""
    squares = np.array([np.mean(residual[group == label] ** 2) for label in np.unique(group)])
    return float(np.std(squares, ddof=1) / np.sqrt(squares.size) / (2 * rms(residual)))


@dataclass(frozen=True)
class Score:
    """A candidate, its fit, and its errors (root mean squares of Ad/Ai, dimensionless).

    ``cv`` holds the residuals of grouped cross-validation, shape (n,), ``hard`` the residuals of
    :func:`hard_splits`, NaN where a split has no test.
    """

    candidate: Candidate
    residual: Floats
    cv: Floats
    hard: dict[str, Floats]

    @property
    def count(self) -> int:
        """Return the number of fitted parameters."""
        return len(self.candidate.names)


def scored(candidate: Candidate, points: Points) -> Score:
    """Return fit, cross-validation and hard splits of a candidate."""
    residual = residuals(candidate, fitted(candidate, points), points)
    cv = held_out(candidate, points, grouped_folds(points.condition))
    hard = {name: held_out(candidate, points, folds) for name, folds in hard_splits(points).items()}
    return Score(candidate, residual, cv, hard)


def one_standard_error_choice(
    scores: Sequence[Score], residuals: Sequence[Floats], group: NDArray[Any]
) -> Score:
    """Return the score with the fewest parameters within one standard error of the best.

    Parameters
    ----------
    scores : sequence of Score
        Only those with parameters take part.
    residuals : sequence of ndarray, shape (n,)
        Held-out residuals of each score; the choice is by their rms, among equally many parameters
        by the smaller rms.
    group : ndarray, shape (n,)
        Groups that were held out together, for the standard error.
    """
    fittable = [(score, r) for score, r in zip(scores, residuals, strict=True) if score.count]
    best = min((r for _, r in fittable), key=rms)
    limit = rms(best) + rms_standard_error(best, group)
    near = [(score, r) for score, r in fittable if rms(r) <= limit]
    return min(near, key=lambda pair: (pair[0].count, rms(pair[1])))[0]


def bootstrapped(
    candidate: Candidate, points: Points, replicates: int = 200, seed: int = SEED
) -> Floats:
    """Return the parameters fitted to samples of whole conditions, shape (replicates, k)."""
    members = [np.flatnonzero(points.condition == label) for label in np.unique(points.condition)]
    start = fitted(candidate, points)
    random = np.random.default_rng(seed)
    samples = []
    for _ in range(replicates):
        drawn = random.integers(len(members), size=len(members))
        # A condition drawn k times weighs as k copies of its residuals.
        weight = np.zeros(points.size)
        for label in drawn:
            weight[members[label]] += 1
        samples.append(_solution(candidate, points, np.sqrt(weight), start))
    return np.array(samples)


def monotone_limit(x: Floats, ratio: Floats) -> float:
    """Return the rms of the best of all curves that nowhere rise with x: a bound for formulas."""
    order = np.argsort(x, kind="stable")
    curve = isotonic_regression(ratio[order], increasing=False).x
    return rms(np.asarray(curve - ratio[order]))
