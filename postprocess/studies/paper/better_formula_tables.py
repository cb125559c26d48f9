"""Tables on the better formula: ladder, parameters, small V, f(r), limits, residuals."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ehlwave_post.formula import power_ratio
from studies.paper.candidates import (
    PAPER,
    REFITTED,
    ROUNDED,
    Candidate,
    Parameters,
)
from studies.paper.crossvalidation import (
    Mask,
    Score,
    bootstrapped,
    fitted,
    grouped_folds,
    held_out,
    rms,
    rms_standard_error,
)
from studies.paper.fit_points import DIRECTIONS, Floats, Points
from studies.section import Cell, Table

SMALL_V = (0.1, 0.2, 0.4, 0.8, 1.5, 3.0)


def ladder_table(scores: Sequence[Score], points: Points) -> Table:
    """Return the errors of all candidates: fitted, held out, and on each hard split."""
    splits = list(scores[0].hard)
    columns = ("formula", "meaning", "parameters", "rms fitted", "rms held out", "standard error")
    rows = [
        (
            score.candidate.name,
            score.candidate.text,
            score.count,
            rms(score.residual),
            rms(score.cv),
            rms_standard_error(score.cv, points.condition),
            *(rms(score.hard[name]) for name in splits),
            float(np.max(np.abs(score.cv))),
        )
        for score in scores
    ]
    caption = (
        "Errors of Ad/Ai (root mean square). Held out: 12 folds of whole operating conditions "
        "(standard error over conditions); then all of one D, all of one L (each in turn, then "
        "only the ends), the largest loads held out. "
        "The first and last have no fitted parameter: their errors are those of the same points."
    )
    return Table("formula_ladder", caption, (*columns, *splits, "largest held out"), rows)


def parameter_table(candidate: Candidate, points: Points, rounded: Sequence[float]) -> Table:
    """Return parameters with 95 % bootstrap intervals (conditions drawn), and as rounded."""
    samples = bootstrapped(candidate, points)
    best = fitted(candidate, points, np.ones(points.ratio.size, dtype=bool))
    low, high = np.quantile(samples, [0.025, 0.975], axis=0)
    rows = list(zip(candidate.names, best, low, high, rounded, strict=True))
    columns = ("parameter", "fitted", "low", "high", "rounded")
    caption = f"{candidate.text}: 95 % intervals from {len(samples)} samples of conditions."
    return Table("formula_parameters", caption, columns, rows)


def small_v_table(points: Points) -> Table:
    """Return computed Ad/Ai less (18), and less the recommended formula, in bins of f(r) V < 3."""
    none = np.empty(0)
    old, new = (points.ratio - form.curve(none, points) for form in (PAPER, ROUNDED))
    rows: list[Sequence[Cell]] = []
    for name, where in (
        ("L = 12.05", np.isclose(points.lubricant, 12.05)),
        ("all L", np.ones(points.ratio.size, dtype=bool)),
    ):
        for low, high in pairwise(SMALL_V):
            # f V comes from rounded wavelengths, so those meant to lie on an edge may not.
            chosen = where & (points.f_v >= low * 0.999) & (points.f_v < high * 0.999)
            if chosen.any():
                rows.append(
                    (
                        name,
                        f"{low:g} to {high:g}",
                        int(chosen.sum()),
                        float(old[chosen].mean()),
                        float(old[chosen].std(ddof=1) / np.sqrt(chosen.sum())),
                        float(old[chosen].max()),
                        float(np.mean(points.error[chosen])),
                        float(new[chosen].mean()),
                        float(np.abs(new[chosen]).max()),
                    )
                )
    columns = ("points of", "f(r) V", "points", "mean", "standard error", "largest",
               "mean error bar", "mean, recommended", "largest |.|, recommended")  # fmt: skip
    caption = "Computed Ad/Ai less formula (18) at small V: positive where (18) is too small."
    return Table("formula_small_v", caption, columns, rows)


def free_factors(points: Points, lubricant: float) -> tuple[Floats, Floats]:
    """Return f at each of ``DIRECTIONS`` at one L, f(0) = 1, and 95 % bootstrap intervals.

    From x = C f (lambda/a) (gamma M)^(1/2) in (1 + x^n)^(-1/n); C, n and the f are free.
    Shapes (9,) and (2, 9).
    """

    def curve(c: Parameters, p: Points) -> Floats:
        factor = np.exp(c[0] + np.append(0.0, c[2:]))[p.direction]
        return power_ratio(factor * p.shorter * np.sqrt(p.load), np.clip(c[1], 0.2, 60))

    names = ("ln C", "n", *(f"ln f({r:g})" for r in DIRECTIONS[1:]))
    start = (-1.8, 2.5, 0.0, 0.0, 0.0, 0.0, 0.3, 0.6, 0.7, 0.7)
    candidate = Candidate("f at each r", "", names, start, curve)
    chosen = subset(points, points.lubricant == lubricant)
    best = fitted(candidate, chosen, np.ones(chosen.ratio.size, dtype=bool))
    samples = bootstrapped(candidate, chosen, replicates=40)
    interval = np.quantile(np.exp(samples[:, 2:]), [0.025, 0.975], axis=0)
    ones = np.ones((2, 1))
    return np.exp(np.append(0.0, best[2:])), np.hstack([ones, interval])


def residual_table(points: Points, residual: Floats) -> Table:
    """Return (18), (18) refitted and the held-out residuals of the recommended formula by group."""
    old = PAPER.curve(np.empty(0), points) - points.ratio
    everything = np.ones(points.ratio.size, dtype=bool)
    refit = REFITTED.curve(fitted(REFITTED, points, everything), points) - points.ratio
    direction = np.array(DIRECTIONS)[points.direction]
    groups = (("L", points.lubricant), ("D", points.radius_ratio), ("M", points.load_m),
              ("r", direction))  # fmt: skip
    rows = []
    for name, values in groups:
        for value in np.unique(values):
            at = values == value
            mean = float(residual[at].mean())
            errors = (rms(old[at]), rms(refit[at]), rms(residual[at]))
            rows.append((f"{name} = {value:g}", int(at.sum()), *errors, mean))
    columns = ("group", "points", "rms (18)", "rms (18) refitted", "rms recommended, held out",
               "mean recommended")  # fmt: skip
    caption = "Errors of Ad/Ai by group; mean: formula less computed."
    return Table("formula_residuals", caption, columns, rows)


def worst_table(points: Points, residual: Floats, count: int = 10) -> Table:
    """Return the points with the largest held-out residuals of the recommended formula."""
    order = np.argsort(-np.abs(residual))[:count]
    rows = [
        (
            float(points.load_m[i]),
            float(points.lubricant[i]),
            float(points.radius_ratio[i]),
            f"{DIRECTIONS[points.direction[i]]:g}",
            float(points.shorter[i]),
            float(points.ratio[i]),
            float(points.ratio[i] + residual[i]),
        )
        for i in order
    ]
    columns = ("M", "L", "D", "r", "lambda/a", "computed Ad/Ai", "formula")
    return Table("formula_worst", "Points the recommended formula misses most.", columns, rows)


def limits_table(points: Points) -> Table:
    """Return local slopes of Ad/Ai between neighbouring wavelengths, by L and direction.

    At long waves (both Ad/Ai below 0.3) d ln(Ad/Ai)/d ln V; at short ones (1 - Ad/Ai between 0.02
    and 0.3) d ln(1 - Ad/Ai)/d ln V.
    """
    pairs = _neighbours(points)
    low, high = pairs[:, 0], pairs[:, 1]
    step = np.log(points.shorter[high] / points.shorter[low])
    y = np.clip(points.ratio, 1e-9, 1 - 1e-9)
    long_slope = np.log(y[high] / y[low]) / step
    short_slope = np.log((1 - y[high]) / (1 - y[low])) / step
    is_long = (y[low] < 0.3) & (y[high] < 0.3)
    is_short = np.all([(1 - y[i] > 0.02) & (1 - y[i] < 0.3) for i in (low, high)], axis=0)
    rows: list[Sequence[Cell]] = []
    for lubricant in np.unique(points.lubricant):
        for number, r in enumerate(DIRECTIONS):
            at = (points.lubricant[low] == lubricant) & (points.direction[low] == number)
            if r in (0.0, 1.0, np.inf):
                rows.append(
                    (
                        float(lubricant),
                        f"{r:g}",
                        *_quartiles(long_slope[at & is_long]),
                        *_quartiles(short_slope[at & is_short]),
                    )
                )
    columns = ("L", "r", "pairs, large V", "slope", "lower quartile", "upper quartile",
               "pairs, small V", "power", "lower quartile ", "upper quartile ")  # fmt: skip
    caption = (
        "Limits. Slope: d ln(Ad/Ai)/d ln V where Ad/Ai < 0.3 (recommended formula: tends to -1; "
        "(18): to -2). Power: d ln(1 - Ad/Ai)/d ln V where 0.02 < 1 - Ad/Ai < 0.3 (recommended: "
        "tends to n = 1.5 + 10/L; (18): to 1)."
    )
    return Table("formula_limits", caption, columns, rows)


def resolved_table(points: Points, trained: Mask, candidates: Sequence[Candidate]) -> Table:
    """Return errors at the points that are not ``trained``, at conditions held out of the fits."""
    folds = grouped_folds(points.condition)
    rows = []
    for candidate in candidates:
        residual = held_out(candidate, points, folds, trained)[~trained]
        largest = float(np.abs(residual).max())
        rows.append((candidate.name, residual.size, rms(residual), largest))
    columns = ("formula", "points", "rms", "largest")
    caption = (
        "The sweep at L = 12.05 with more wavelengths, no point of which is in any fit; conditions "
        "held out of the dense sweep in 12 folds."
    )
    return Table("formula_resolved", caption, columns, rows)


def fresh_table(points: Points, fresh: Points, candidates: Sequence[Candidate]) -> Table:
    """Return errors at conditions and directions that were looked at after all else was fixed."""
    everything = np.ones(points.ratio.size, dtype=bool)
    rows = []
    for candidate in candidates:
        parameters = fitted(candidate, points, everything)
        residual = candidate.curve(parameters, fresh) - fresh.ratio
        largest = float(np.abs(residual).max())
        rows.append((candidate.name, residual.size, rms(residual), largest))
    columns = ("formula", "points", "rms", "largest")
    caption = (
        f"Fresh conditions: {np.unique(fresh.condition).size} with other M, L and D and partly "
        "other directions than the dense sweep, computed after the formula was chosen."
    )
    return Table("formula_fresh", caption, columns, rows)


def subset(points: Points, chosen: Mask) -> Points:
    """Return some of the points."""
    return Points(**{name: values[chosen] for name, values in vars(points).items()})


def _neighbours(points: Points) -> np.ndarray:
    """Return pairs of points of one condition and direction with neighbouring wavelengths."""
    order = np.lexsort((points.shorter, points.direction, points.condition))
    first, second = order[:-1], order[1:]
    same = (points.condition[first] == points.condition[second]) & (
        points.direction[first] == points.direction[second]
    )
    longer = points.shorter[second] > 1.05 * points.shorter[first]
    return np.stack([first, second], axis=1)[same & longer]


def _quartiles(values: Floats) -> tuple[Cell, ...]:
    if not values.size:
        return 0, None, None, None
    low, middle, high = (float(q) for q in np.quantile(values, [0.25, 0.5, 0.75]))
    return values.size, middle, low, high
