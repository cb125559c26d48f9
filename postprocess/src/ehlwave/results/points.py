"""Choose the cases that enter a figure or a fit."""

from collections import Counter
from typing import Literal

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave.choices import RATIO_COLUMNS, Ratio, chosen
from ehlwave.errors import ResultsError
from ehlwave.results.schema import (
    CONVERGED,
    DIMENSION,
    EDGES,
    INACCURATE,
    ORIENTATIONS,
    SMOOTH,
    STATUSES,
    UNRESOLVED,
)

Variable = Literal["f_v", "f_v2"]

VARIABLES: tuple[Variable, Variable] = ("f_v", "f_v2")
CONDITION = ("load_parameter_m", "lubricant_parameter_l", "radius_ratio_d")


def select_points(
    results: xr.Dataset,
    ratio: Ratio = "fit",
    *,
    include_unresolved: bool = False,
    include_inaccurate: bool = False,
    edges: str | None = None,
) -> xr.Dataset:
    """Return the wavy cases with a usable amplitude, with the quantities of Figures 1 and 2.

    Parameters
    ----------
    results : xarray.Dataset
        From :func:`ehlwave.results.read.read_results`.
    ratio : {"fit", "sampled", "harmonic"}
        Ad/Ai from the harmonic fit, from the largest and smallest sample, eq. (14), or from the
        linear response to small waves, extrapolated to mesh size 0 where two grids allow it.
        Longitudinal waviness has no time signal, so where its fit is NaN the (exact) sampled value
        is taken. Cases without a transient have their linear response in place of the fit.
    include_unresolved : bool
        Keep also cases that converged on a grid too coarse for them.
    include_inaccurate : bool
        Keep also cases whose estimated error is above the accuracy that was asked for.
    edges : {"flooded", "truncated"}, optional
        Only cases with these edges of the domain; films differ by some per cent between the two.

    Returns
    -------
    xarray.Dataset
        The chosen cases with all their columns, and over ``case``, dimensionless: ``f_v`` = f(r) V
        and ``f_v2`` = f(r) V2, eqs. (15) to (17), ``deformed_ratio`` = Ad/Ai as chosen,
        ``deformed_error`` = its estimated discretisation error, from coarser grids of the same case
        (``'coarse_grid'``) or as the plan expects it (``'model'``), NaN: not known, and
        ``is_point_resolved`` (bool).

    Raises
    ------
    ResultsError
        If nothing is left; the message counts the points. If both edges are left.

    Examples
    --------
    >>> import ehlwave
    >>> grid = {"load_parameter_m": [10, 20, 50], "wavelength_over_a": [1, 2, 4]}
    >>> study = ehlwave.Study(grid, lubricant_parameter_l=5, radius_ratio_d=1,
    ...     cells_x=64, cells_y=64, orientation="transverse", response="harmonic")
    >>> results = study.run()
    >>> points = ehlwave.select_points(results, "harmonic")
    >>> points.sizes["case"], bool(points["is_point_resolved"].all())
    (9, True)
    """
    chosen(ratio, "ratio", RATIO_COLUMNS)
    if edges is not None:
        chosen(edges, "edges", EDGES)
    deformed, error = _chosen_ratio(results, ratio)
    status = results["status"]
    solved = (CONVERGED, INACCURATE) if include_inaccurate else (CONVERGED,)
    resolved = status.isin(solved) & (results["is_resolved"] != 0)
    candidates = results.assign(
        f_v=_column(results["f_r"] * results["v"], "f(r) V"),
        f_v2=_column(results["f_r"] * results["v2"], "f(r) V2"),
        deformed_ratio=_column(deformed, f"Ad/Ai ({ratio})"),
        deformed_error=_column(error, "estimated discretisation error of Ad/Ai"),
        is_point_resolved=_column(resolved, "converged on a fine enough grid"),
    )
    usable = (results["orientation"] != SMOOTH) & np.isfinite(deformed)
    for name in VARIABLES:
        usable &= np.isfinite(candidates[name]) & (candidates[name] > 0)
    usable &= status.isin((*solved, UNRESOLVED)) if include_unresolved else resolved
    if edges is not None:
        others = int(usable.sum())
        usable &= results["edges"] == edges
        if others and not usable.any():
            raise ResultsError(
                f"no usable points: all {others} have other edges of the domain than {edges}: "
                "leave edges (--edges) out"
            )
    if not usable.any():
        raise ResultsError(_nothing_usable(results, ratio, include_unresolved))
    _refuse_mixed_edges(results["edges"].values[usable.values])
    return candidates.isel({DIMENSION: np.flatnonzero(usable)})


def _refuse_mixed_edges(edges: NDArray[np.str_]) -> None:
    counts = {name: int(np.sum(edges == name)) for name in EDGES}
    if all(counts.values()):
        found = " and ".join(f"{count} cases with {name} edges" for name, count in counts.items())
        raise ResultsError(
            f"{found} of the domain, which differ by some per cent: choose one of them (edges, or "
            "--edges)"
        )


def _chosen_ratio(results: xr.Dataset, ratio: Ratio) -> tuple[xr.DataArray, xr.DataArray]:
    """Return Ad/Ai as chosen and its absolute discretisation error, NaN where there is none."""
    linear = _optional(results, "harmonic_extrapolated").fillna(
        _optional(results, "harmonic_ratio")
    )
    linear_error = linear * _optional(results, "harmonic_error")
    if ratio == "harmonic":
        return linear, linear_error
    deformed = results[RATIO_COLUMNS[ratio]].astype(float)
    if ratio == "sampled":
        return deformed, xr.full_like(deformed, np.nan)
    no_signal = (results["orientation"] == "longitudinal") & deformed.isnull()
    deformed = deformed.where(~no_signal, results[RATIO_COLUMNS["sampled"]])
    error = deformed * _optional(results, "amplitude_ratio_error")
    return deformed.fillna(linear), error.where(deformed.notnull(), linear_error)


def _optional(results: xr.Dataset, name: str) -> xr.DataArray:
    """Return a column that older files do not have; NaN there."""
    if name in results:
        return results[name].astype(float)
    return xr.full_like(results["amplitude_ratio_fit"].astype(float), np.nan)


def resolved_only(points: xr.Dataset) -> xr.Dataset:
    """Return the resolved of some points, possibly none."""
    return points.isel({DIMENSION: np.flatnonzero(points["is_point_resolved"])})


def of_orientation(points: xr.Dataset, orientation: str) -> xr.Dataset:
    """Return the points of an orientation, possibly none."""
    return points.isel({DIMENSION: np.flatnonzero(points["orientation"] == orientation)})


def condition_index(points: xr.Dataset) -> NDArray[np.intp]:
    """Return for each point the number, from 0, of its operating condition (M, L, D)."""
    table = np.stack([points[name].values for name in CONDITION], axis=1)
    return np.unique(table, axis=0, return_inverse=True)[1].reshape(-1)


def count_by_status(results: xr.Dataset) -> dict[str, int]:
    """Return the number of cases of each status that occurs, known statuses first."""
    counts = Counter(str(status) for status in results["status"].values)
    order = [*STATUSES, *sorted(set(counts) - set(STATUSES))]
    return {status: counts[status] for status in order if counts[status]}


def remarks(points: xr.Dataset) -> list[str]:
    """Return notes on points for readers of a figure or fit."""
    found = []
    orientation = points["orientation"].values
    if other := int(np.sum(~np.isin(orientation, ORIENTATIONS))):
        found.append(f"{other} point(s) of other orientations are in fits over all, in no panel")
    if slipping := int(np.sum(points["slip_parameter"].values != 1)):
        found.append(f"{slipping} point(s) with slip: the formula was found for pure rolling")
    if "film_over_flooded" in points and (
        starved := int(np.isfinite(points["film_over_flooded"].values.astype(float)).sum())
    ):
        found.append(f"{starved} point(s) with too little oil: the formula is for flooded contacts")
    columns = ["orientation", "wavelength_x_over_a", "wavelength_y_over_a", "slip_parameter"]
    names = [*CONDITION, *columns, "case_id"]
    keys = Counter(zip(*(points[name].values.tolist() for name in names), strict=True))
    if repeated := sum(count - 1 for count in keys.values()):
        found.append(f"{repeated} point(s) repeat a case_id at the same condition; all are kept")
    return found


def _column(values: xr.DataArray, long_name: str) -> xr.Variable:
    return xr.Variable((DIMENSION,), values.values, {"units": "1", "long_name": long_name})


def _nothing_usable(results: xr.Dataset, ratio: Ratio, include_unresolved: bool) -> str:
    counts = ", ".join(f"{count} {status}" for status, count in count_by_status(results).items())
    wanted = "converged" if include_unresolved else "converged and resolved"
    return (
        f"no usable points: none of the {results.sizes[DIMENSION]} cases ({counts or 'no cases'}) "
        f"is wavy, {wanted}, with a finite {RATIO_COLUMNS[ratio]}"
    )
