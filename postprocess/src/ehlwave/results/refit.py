"""Refit eq. (18) over all points and per orientation, on V and on V2."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import xarray as xr

from ehlwave.choices import REPLICATES, SEED
from ehlwave.results.bootstrap import bootstrap_coefficients, percentile_intervals
from ehlwave.results.fit import (
    NO_INTERVAL,
    FitError,
    Interval,
    fit_formula,
    point_weights,
    rms_residual,
)
from ehlwave.results.points import VARIABLES, Variable, condition_index, of_orientation
from ehlwave.results.schema import DIMENSION, ORIENTATIONS

NAN = float("nan")

INTERVAL_CONDITIONS = 4
"""Operating conditions from which on intervals are given: three have ten different samples."""

FEW_CONDITIONS = 8
"""Operating conditions below which a warning names the intervals as too narrow."""


@dataclass(frozen=True)
class RefitSettings:
    """How intervals are made.

    Parameters
    ----------
    replicates : int
        Bootstrap samples.
    seed : int
        Seed of the random numbers that draw them.
    confidence : float
        Probability content of the intervals.

    Examples
    --------
    >>> import ehlwave
    >>> ehlwave.RefitSettings(replicates=200)
    RefitSettings(replicates=200, seed=20000, confidence=0.95)
    """

    replicates: int = REPLICATES
    seed: int = SEED
    confidence: float = 0.95


@dataclass(frozen=True)
class RefitRow:
    """The fit of a group of points on a variable; NaN where something is not defined.

    Parameters
    ----------
    group : str
        ``"all"`` or an orientation.
    variable : {"f_v", "f_v2"}
        Abscissa of the fit.
    points, conditions : int
        Number of points, and of different operating conditions among them.
    rms_paper, rms_refit : float
        Root mean square residual with the paper's coefficients, and with those fitted.
    c1, c2 : float
        Coefficients of eq. (18).
    c1_bootstrap, c2_bootstrap : pair of float
        Their intervals by the bootstrap over operating conditions.
    c1_profile, c2_profile : pair of float
        Their intervals by the profile of the sum of squares.
    samples : int
        Bootstrap samples that determined both coefficients.
    tightness : float
        rms(V2)/rms(V) after the refit, the same in the two rows of a group: above 1 the points lie
        closer to a single curve on V than on V2.
    note : str
        Missing parts, and the reasons.

    Examples
    --------
    >>> import ehlwave
    >>> grid = {"load_parameter_m": [10, 20, 50], "wavelength_over_a": [1, 2, 4]}
    >>> study = ehlwave.Study(grid, lubricant_parameter_l=5, radius_ratio_d=1,
    ...     cells_x=64, cells_y=64, orientation="transverse", response="harmonic")
    >>> results = study.run()
    >>> points = ehlwave.select_points(results, "harmonic")
    >>> row = ehlwave.refit_groups(points, ehlwave.RefitSettings(replicates=20))[0]
    >>> print(row.group, row.variable, f"rms {row.rms_paper:.2f}, refitted {row.rms_refit:.2f}")
    all f_v rms 0.08, refitted 0.07
    """

    group: str
    variable: Variable
    points: int
    conditions: int
    rms_paper: float
    rms_refit: float = NAN
    c1: float = NAN
    c2: float = NAN
    c1_bootstrap: Interval = NO_INTERVAL
    c2_bootstrap: Interval = NO_INTERVAL
    c1_profile: Interval = NO_INTERVAL
    c2_profile: Interval = NO_INTERVAL
    samples: int = 0
    tightness: float = NAN
    note: str = ""


def refit_groups(
    points: xr.Dataset,
    settings: RefitSettings | None = None,
    variables: Sequence[Variable] = VARIABLES,
) -> list[RefitRow]:
    """Fit eq. (18) for every group of points, on f(r) V and on f(r) V2.

    Points with an error estimate are weighted by it, see :func:`ehlwave.results.fit.point_weights`.

    Parameters
    ----------
    points : xarray.Dataset
        Resolved points from :func:`ehlwave.results.points.select_points`.
    settings : RefitSettings, optional
        Of the intervals.
    variables : sequence of {"f_v", "f_v2"}
        Abscissas of the fits; ``tightness`` needs both.

    Returns
    -------
    list of RefitRow
        A row for each variable (V, V2) for ``all`` points, for each orientation of the paper, and
        for any other orientation that occurs. Groups without enough points have a note instead of
        coefficients.

    Examples
    --------
    >>> import ehlwave
    >>> grid = {"load_parameter_m": [10, 20, 50], "wavelength_over_a": [1, 2, 4]}
    >>> study = ehlwave.Study(grid, lubricant_parameter_l=5, radius_ratio_d=1,
    ...     cells_x=64, cells_y=64, orientation="transverse", response="harmonic")
    >>> results = study.run()
    >>> points = ehlwave.select_points(results, "harmonic")
    >>> rows = ehlwave.refit_groups(points, ehlwave.RefitSettings(replicates=20))
    >>> [(row.group, row.variable) for row in rows[:4]]
    [('all', 'f_v'), ('all', 'f_v2'), ('transverse', 'f_v'), ('transverse', 'f_v2')]
    """
    chosen = settings or RefitSettings()
    others = sorted(set(points["orientation"].values.tolist()) - set(ORIENTATIONS))
    groups = {"all": points}
    groups |= {name: of_orientation(points, name) for name in (*ORIENTATIONS, *others)}
    rows: list[RefitRow] = []
    for name, members in groups.items():
        pair = {variable: _fit_row(name, variable, members, chosen) for variable in variables}
        rms = {variable: row.rms_refit for variable, row in pair.items()}
        tightness = _quotient(rms.get("f_v2", NAN), rms.get("f_v", NAN))
        rows += [replace(row, tightness=tightness) for row in pair.values()]
    return rows


def _fit_row(
    group: str, variable: Variable, points: xr.Dataset, settings: RefitSettings
) -> RefitRow:
    x, ratio = points[variable].values, points["deformed_ratio"].values
    condition = condition_index(points)
    row = RefitRow(
        group=group,
        variable=variable,
        points=points.sizes[DIMENSION],
        conditions=np.unique(condition).size,
        rms_paper=rms_residual(x, ratio),
    )
    try:
        weight = point_weights(x, ratio, points["deformed_error"].values)
        fit = fit_formula(x, ratio, settings.confidence, weight)
    except FitError as error:
        return replace(row, note=str(error))
    row = replace(
        row,
        rms_refit=fit.rms,
        c1=fit.c1,
        c2=fit.c2,
        c1_profile=fit.c1_interval,
        c2_profile=fit.c2_interval,
    )
    if np.unique(condition).size < INTERVAL_CONDITIONS or fit.c1 < 0:
        return replace(row, c1_profile=NO_INTERVAL, c2_profile=NO_INTERVAL, note=_no_interval(row))
    try:
        samples = bootstrap_coefficients(
            x, ratio, condition, settings.replicates, settings.seed, weight
        )
    except FitError as error:
        return replace(row, note=str(error))
    c1_bootstrap, c2_bootstrap = percentile_intervals(samples, settings.confidence)
    return replace(row, c1_bootstrap=c1_bootstrap, c2_bootstrap=c2_bootstrap, samples=len(samples))


def refit_warnings(rows: Sequence[RefitRow]) -> list[str]:
    """Return notes for readers of the fit over all points.

    Parameters
    ----------
    rows : sequence of RefitRow
        From :func:`refit_groups`.
    """
    found = []
    for row in rows:
        if row.group != "all" or row.variable != "f_v" or not np.isfinite(row.c1):
            continue
        if row.conditions < FEW_CONDITIONS:
            found.append(
                f"{row.conditions} operating condition(s): intervals are too narrow or absent "
                f"below {FEW_CONDITIONS}: vary load, oil or shape"
            )
        kinds = [one.group for one in rows if one.variable == "f_v" and one.points]
        if len(kinds) == 2:
            found.append(
                f"{kinds[1]} waves only: the coefficients hold for this orientation; add "
                "others for a single curve"
            )
        if row.c1 < 0:
            found.append(_above_one(row))
    return found


def _no_interval(row: RefitRow) -> str:
    if row.conditions < INTERVAL_CONDITIONS:
        return (
            f"no intervals ({row.conditions} operating condition(s); {INTERVAL_CONDITIONS} needed)"
        )
    return f"no intervals ({_above_one(row)})"


def _above_one(row: RefitRow) -> str:
    name = "f V" if row.variable == "f_v" else "f V2"
    below = f"{-row.c1 / row.c2:.3g}" if row.c2 > 0 else "infinity"
    return f"c1 < 0: the curve is above 1 for {name} below {below}; add points there"


def _quotient(numerator: float, denominator: float) -> float:
    return numerator / denominator if denominator > 0 else NAN
