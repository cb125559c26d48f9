"""Harmonic tables from sweeps, to be read by :func:`ehlwave.laws.table_read.read_table`."""

from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from ehlwave.contact.scales import ellipticity
from ehlwave.laws.table_keys import carried_columns
from ehlwave.laws.table_read import table_rows
from ehlwave.writing import Writer


def harmonic_table(points: xr.Dataset) -> pd.DataFrame:
    """Return a harmonic table of the points of a sweep.

    Parameters
    ----------
    points : xarray.Dataset
        From :func:`ehlwave.results.points.select_points`. The transfer is ``harmonic_real`` and
        ``harmonic_imaginary`` (linear response) where a file has them; else Ad/Ai with the phase
        ``phase_fit``; else Ad/Ai without a phase.

    Returns
    -------
    pandas.DataFrame
        Columns as for :func:`ehlwave.laws.table_read.read_table`, sorted; a wavelength of 0 means
        no variation. ``mean_rise`` where linear responses have it, ``transfer_error`` where the
        results have error estimates.
    """
    d = points["radius_ratio_d"].values
    kappa = np.array([ellipticity(float(value)) for value in d])
    transfer = _transfer(points)
    keys = {
        "M": points["load_parameter_m"].values,
        "L": points["lubricant_parameter_l"].values,
        "D": d,
        "slip_parameter": points["slip_parameter"].values,
        "lambda_x_over_a": points["wavelength_x_over_a"].values,
        "lambda_y_over_b": points["wavelength_y_over_a"].values * kappa,
    }
    carried = carried_columns(points)
    columns = keys | carried | {"transfer_real": transfer.real, "transfer_imag": transfer.imag}
    if "error_estimate" in points:
        columns["transfer_error"] = points["error_estimate"].values * np.abs(transfer)
    if "mean_film_rise" in points:
        columns["mean_rise"] = _mean_rise(points)
    table = pd.DataFrame(columns).sort_values(list(keys), ignore_index=True)
    table_rows(table, "results")  # refuses files that deform --table would refuse
    return table


def _transfer(points: xr.Dataset) -> NDArray[np.complex128]:
    ratio = points["deformed_ratio"].values.astype(complex)
    if "phase_fit" in points:
        ratio *= np.exp(1j * np.nan_to_num(points["phase_fit"].values))
    if "harmonic_real" not in points or "harmonic_imaginary" not in points:
        return ratio
    linear = points["harmonic_real"].values + 1j * points["harmonic_imaginary"].values
    return np.where(np.isfinite(linear), linear, ratio)


def _mean_rise(points: xr.Dataset) -> NDArray[np.float64]:
    """Return the rise of the mean film by a wave, over the film, per square of amplitude over film.

    A product of cosines is two waves that interfere along its crests, where the response is taken:
    their effect on the mean of a whole surface does not follow, and stays NaN.
    """
    rise = (points["mean_film_rise"] / points["amplitude_over_film"]).values
    is_product = (points["wavelength_x_over_a"] > 0) & (points["wavelength_y_over_a"] > 0)
    if "oblique" in points:
        is_product &= points["oblique"] == 0
    return np.where(is_product.values, np.nan, rise)


def write_harmonic_table(path: Path, points: xr.Dataset, writer: Writer | None = None) -> int:
    """Write :func:`harmonic_table` as CSV; return the number of waves."""
    table = harmonic_table(points)
    (writer or Writer()).table(path, table, float_format="%.10g")
    return len(table)
