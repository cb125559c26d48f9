"""Tables on the better formula: ladder, parameters, small V, f(r), limits, residuals."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pandas as pd

from ehlwave.contact.formula import power_ratio
from studies.folds import grouped_folds
from studies.paper.candidates import PAPER, REFITTED, ROUNDED, Candidate, Parameters
from studies.paper.cases import DIRECTIONS
from studies.paper.crossvalidation import (
    Mask,
    Score,
    bootstrapped,
    fitted,
    held_out,
    residuals,
    rms,
    rms_standard_error,
)
from studies.paper.fit_points import Floats, Points
from studies.section import Table

SMALL_V = (0.1, 0.2, 0.4, 0.8, 1.5, 3.0)


def ladder_table(scores: Sequence[Score], points: Points) -> Table:
    """Return the errors of all candidates: fitted, held out, and on each hard split."""
    rows = [
        {
            "formula": score.candidate.name,
            "meaning": score.candidate.text,
            "parameters": score.count,
            "rms fitted": rms(score.residual),
            "rms held out": rms(score.cv),
            "standard error": rms_standard_error(score.cv, points.condition),
            **{name: rms(residual) for name, residual in score.hard.items()},
            "largest held out": np.abs(score.cv).max(),
        }
        for score in scores
    ]
    caption = (
        "Errors of Ad/Ai (root mean square). Held out: 12 folds of whole operating conditions "
        "(standard error over conditions); then all of one D, all of one L (each in turn, then "
        "only the ends), the largest loads held out. "
        "The first and last have no fitted parameter: their errors are those of the same points."
    )
    return Table("formula_ladder", caption, pd.DataFrame(rows))


def parameter_table(candidate: Candidate, points: Points, rounded: Sequence[float]) -> Table:
    """Return parameters with 95 % bootstrap intervals (conditions drawn), and as rounded."""
    samples = bootstrapped(candidate, points)
    low, high = np.quantile(samples, [0.025, 0.975], axis=0)
    columns = {
        "parameter": candidate.names,
        "fitted": fitted(candidate, points),
        "low": low,
        "high": high,
        "rounded": rounded,
    }
    caption = f"{candidate.text}: 95 % intervals from {len(samples)} samples of conditions."
    return Table("formula_parameters", caption, pd.DataFrame(columns))


def small_v_table(points: Points) -> Table:
    """Return computed Ad/Ai less (18), and less the recommended formula, in bins of f(r) V < 3."""
    old, new = (-residuals(form, np.empty(0), points) for form in (PAPER, ROUNDED))
    rows = []
    for name, where in (
        ("L = 12.05", np.isclose(points.lubricant, 12.05)),
        ("all L", np.ones(points.size, dtype=bool)),
    ):
        for low, high in pairwise(SMALL_V):
            # f V comes from rounded wavelengths, so those meant to lie on an edge may not.
            chosen = where & (points.f_v >= low * 0.999) & (points.f_v < high * 0.999)
            if not chosen.any():
                continue
            row = {
                "points of": name,
                "f(r) V": f"{low:g} to {high:g}",
                "points": chosen.sum(),
                "mean": old[chosen].mean(),
                "standard error": old[chosen].std(ddof=1) / np.sqrt(chosen.sum()),
                "largest": old[chosen].max(),
                "mean error bar": points.error[chosen].mean(),
                "mean, recommended": new[chosen].mean(),
                "largest |.|, recommended": np.abs(new[chosen]).max(),
            }
            rows.append(row)
    caption = "Computed Ad/Ai less formula (18) at small V: positive where (18) is too small."
    return Table("formula_small_v", caption, pd.DataFrame(rows))


def free_factors(points: Points, lubricant: float) -> tuple[Floats, Floats]:
    """Return f at each of ``DIRECTIONS`` at a given L, f(0) = 1, and 95 % bootstrap intervals.

    From x = C f (lambda/a) (gamma M)^(1/2) in (1 + x^n)^(-1/n); C, n and the f are free.
    Shapes (9,) and (2, 9).
    """

    def curve(c: Parameters, p: Points) -> Floats:
        factor = np.exp(c[0] + np.append(0.0, c[2:]))[p.direction]
        return power_ratio(factor * p.shorter * np.sqrt(p.load), np.clip(c[1], 0.2, 60))

    names = ("ln C", "n", *(f"ln f({r:g})" for r in DIRECTIONS[1:]))
    start = (-1.8, 2.5, 0.0, 0.0, 0.0, 0.0, 0.3, 0.6, 0.7, 0.7)
    candidate = Candidate("f at each r", "", names, start, curve)
    chosen = points[points.lubricant == lubricant]
    best = fitted(candidate, chosen)
    samples = bootstrapped(candidate, chosen, replicates=40)
    interval = np.quantile(np.exp(samples[:, 2:]), [0.025, 0.975], axis=0)
    ones = np.ones((2, 1))
    return np.exp(np.append(0.0, best[2:])), np.hstack([ones, interval])


def residual_table(points: Points, residual: Floats) -> Table:
    """Return (18), (18) refitted and the held-out residuals of the recommended formula by group."""
    old = residuals(PAPER, np.empty(0), points)
    refit = residuals(REFITTED, fitted(REFITTED, points), points)
    groups = {
        "L": points.lubricant,
        "D": points.radius_ratio,
        "M": points.load_m,
        "r": np.array(DIRECTIONS)[points.direction],
    }
    rows = []
    for name, values in groups.items():
        for value in np.unique(values):
            at = values == value
            row = {
                "group": f"{name} = {value:g}",
                "points": at.sum(),
                "rms (18)": rms(old[at]),
                "rms (18) refitted": rms(refit[at]),
                "rms recommended, held out": rms(residual[at]),
                "mean recommended": residual[at].mean(),
            }
            rows.append(row)
    caption = "Errors of Ad/Ai by group; mean: formula less computed."
    return Table("formula_residuals", caption, pd.DataFrame(rows))


def worst_table(points: Points, residual: Floats, count: int = 10) -> Table:
    """Return the points with the largest held-out residuals of the recommended formula."""
    order = np.argsort(-np.abs(residual))[:count]
    worst = points[order]
    columns = {
        "M": worst.load_m,
        "L": worst.lubricant,
        "D": worst.radius_ratio,
        "r": [f"{DIRECTIONS[number]:g}" for number in worst.direction],
        "lambda/a": worst.shorter,
        "computed Ad/Ai": worst.ratio,
        "formula": worst.ratio + residual[order],
    }
    caption = "Points the recommended formula misses most."
    return Table("formula_worst", caption, pd.DataFrame(columns))


def limits_table(points: Points) -> Table:
    """Return local slopes of Ad/Ai between neighbouring wavelengths, by L and direction.

    At long waves (both Ad/Ai below 0.3) d ln(Ad/Ai)/d ln V; at short waves (1 - Ad/Ai between 0.02
    and 0.3) d ln(1 - Ad/Ai)/d ln V.
    """
    low, high = _neighbours(points)
    step = np.log(high.shorter / low.shorter)
    y_low, y_high = (np.clip(some.ratio, 1e-9, 1 - 1e-9) for some in (low, high))
    long_slope = np.log(y_high / y_low) / step
    short_slope = np.log((1 - y_high) / (1 - y_low)) / step
    is_long = (y_low < 0.3) & (y_high < 0.3)
    is_short = np.all([(1 - y > 0.02) & (1 - y < 0.3) for y in (y_low, y_high)], axis=0)
    rows = []
    for lubricant in np.unique(points.lubricant):
        for r in (0.0, 1.0, np.inf):
            at = (low.lubricant == lubricant) & (low.direction == DIRECTIONS.index(r))
            long, short = (
                _quartiles(long_slope[at & is_long]),
                _quartiles(short_slope[at & is_short]),
            )
            rows.append((lubricant, f"{r:g}", *long, *short))
    columns = ("L", "r", "pairs, large V", "slope", "lower quartile", "upper quartile",
               "pairs, small V", "power", "lower quartile ", "upper quartile ")  # fmt: skip
    caption = (
        "Limits. Slope: d ln(Ad/Ai)/d ln V where Ad/Ai < 0.3 (recommended formula: tends to -1; "
        "(18): to -2). Power: d ln(1 - Ad/Ai)/d ln V where 0.02 < 1 - Ad/Ai < 0.3 (recommended: "
        "tends to n = 1.5 + 10/L; (18): to 1)."
    )
    return Table("formula_limits", caption, pd.DataFrame(rows, columns=columns))


def resolved_table(points: Points, trained: Mask, candidates: Sequence[Candidate]) -> Table:
    """Return errors at the points that are not ``trained``, at conditions held out of the fits."""
    folds = grouped_folds(points.condition)
    found = {
        candidate.name: held_out(candidate, points, folds, trained)[~trained]
        for candidate in candidates
    }
    caption = (
        "The sweep at L = 12.05 with more wavelengths, no point of which is in any fit; conditions "
        "held out of the dense sweep in 12 folds."
    )
    return Table("formula_resolved", caption, _error_rows(found))


def fresh_table(points: Points, fresh: Points, candidates: Sequence[Candidate]) -> Table:
    """Return errors at conditions and directions that were looked at after all else was fixed."""
    found = {
        candidate.name: residuals(candidate, fitted(candidate, points), fresh)
        for candidate in candidates
    }
    caption = (
        f"Fresh conditions: {np.unique(fresh.condition).size} with other M, L and D and partly "
        "other directions than the dense sweep, computed after the formula was chosen."
    )
    return Table("formula_fresh", caption, _error_rows(found))


def _error_rows(found: dict[str, Floats]) -> pd.DataFrame:
    """Return the errors of formulas from their residuals."""
    rows = [
        {"formula": name, "points": left.size, "rms": rms(left), "largest": np.abs(left).max()}
        for name, left in found.items()
    ]
    return pd.DataFrame(rows)


def _neighbours(points: Points) -> tuple[Points, Points]:
    """Return pairs of points of the same condition and direction with neighbouring wavelengths."""
    order = np.lexsort((points.shorter, points.direction, points.condition))
    first, second = points[order[:-1]], points[order[1:]]
    same = (first.condition == second.condition) & (first.direction == second.direction)
    longer = second.shorter > 1.05 * first.shorter
    return first[same & longer], second[same & longer]


def _quartiles(values: Floats) -> tuple[float, ...]:
    """Return how many there are, median, lower and upper quartile; these NaN without values."""
    if not values.size:
        return 0, np.nan, np.nan, np.nan
    return values.size, *np.quantile(values, [0.5, 0.25, 0.75])
