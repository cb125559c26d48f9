"""Harmonic tables from sweeps, to be read by :func:`ehlwave_post.deform.table_read.read_table`."""

from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from ehlwave_post.deform.conditions import ellipticity

COLUMNS = (
    "M",
    "L",
    "D",
    "slip_parameter",
    "lambda_x_over_a",
    "lambda_y_over_b",
    "amplitude_ratio",
)


def harmonic_table(points: xr.Dataset) -> pd.DataFrame:
    """Return a harmonic table of the points of a sweep: amplitude ratios, no phase.

    Parameters
    ----------
    points : xarray.Dataset
        From :func:`ehlwave_post.points.select_points`.

    Returns
    -------
    pandas.DataFrame
        Columns ``COLUMNS``, sorted; a wavelength of 0 stands for no variation.
    """
    d = points["radius_ratio_d"].values
    kappa = np.array([ellipticity(float(value)) for value in d])
    columns = (
        points["load_parameter_m"].values,
        points["lubricant_parameter_l"].values,
        d,
        points["slip_parameter"].values,
        points["wavelength_x_over_a"].values,
        points["wavelength_y_over_a"].values * kappa,
        points["deformed_ratio"].values,
    )
    table = pd.DataFrame(dict(zip(COLUMNS, columns, strict=True)))
    return table.sort_values(list(COLUMNS[:-1]), ignore_index=True)


def write_harmonic_table(path: Path, points: xr.Dataset) -> int:
    """Write :func:`harmonic_table` as CSV; return the number of waves."""
    table = harmonic_table(points)
    table.to_csv(path, index=False, float_format="%.10g")
    return len(table)
