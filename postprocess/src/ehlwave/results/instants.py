"""Fields of a march at an instant, from a file with ``&output fields_every``."""

import numpy as np
import xarray as xr

from ehlwave.errors import ResultsError
from ehlwave.results.case_file import FIELDS, check_field, whole_domain

TIME = "field_time"
"""Times of the stored fields, T = t us/(2a)."""


def has_instants(case: xr.Dataset) -> bool:
    """Return whether a file has fields over time."""
    return TIME in case and all(f"{name}_over_time" in case for name in FIELDS)


def at_instant(case: xr.Dataset, time: float, scale: float = 1.0) -> xr.Dataset:
    """Return a case with film and pressure at the stored instant nearest to a time.

    Parameters
    ----------
    case : xarray.Dataset
        From :func:`ehlwave.read_case`.
    time : float
        In the unit of the time axis of :func:`ehlwave.case_figure`.
    scale : float
        This unit over 2a/us; 1 for T itself.

    Raises
    ------
    ResultsError
        If the file has no fields over time, or the time lies outside them.
    """
    times = instants(case) * scale
    half = float(np.diff(times).max()) / 2 if times.size > 1 else 0.0
    if not times[0] - half <= time <= times[-1] + half:
        raise ResultsError(
            f"time = {time:g} is outside the stored fields, {times[0]:.4g} to {times[-1]:.4g}"
        )
    return fields_at(case, int(np.argmin(np.abs(times - time))))


def instants(case: xr.Dataset) -> np.ndarray:
    """Return the times T of the stored fields; ResultsError if the file has none."""
    if not has_instants(case):
        raise ResultsError(
            "the file has fields of one instant only: run ehlwave-case with "
            "&output fields_every = N /, which keeps them every N time steps of a march"
        )
    check_field(case, TIME, (TIME,))
    for name in FIELDS:
        check_field(case, f"{name}_over_time", (TIME, "y", "x"))
    return np.asarray(case[TIME].values, dtype=float)


def fields_at(case: xr.Dataset, number: int) -> xr.Dataset:
    """Return a case with film and pressure of one stored instant, whose T is ``instant``."""
    chosen = {name: case[f"{name}_over_time"].isel({TIME: number}, drop=True) for name in FIELDS}
    found = case.assign(chosen | {"instant": float(case[TIME][number])})
    found.encoding |= case.encoding
    return whole_domain(found)
