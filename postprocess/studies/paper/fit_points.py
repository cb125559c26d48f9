"""The points that formulas are fitted to, as plain arrays."""

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from ehlwave.contact.formula import wave_and_direction, wavelength_ratio
from ehlwave.results.points import condition_index
from studies.paper.cases import DIRECTIONS

Floats = NDArray[np.float64]
Points = np.recarray
"""Variables of formulas, one value per point and field; see :func:`points_of`."""


def points_of(selected: xr.Dataset) -> Points:
    """Return the points of :func:`ehlwave.results.points.select_points` for fitting, dimensionless.

    ``wave`` is lambda_n/a and ``along`` cos^2(theta), see
    :func:`ehlwave.contact.formula.wave_and_direction`; ``shorter`` min(lambda_x, lambda_y)/a, the
    wavelength of eq. (15); ``load`` gamma M; ``direction`` the number of the nearest of
    ``DIRECTIONS``; ``condition`` the number of (M, L, D); ``error`` the error bar of ``ratio`` =
    Ad/Ai,0 where unknown.
    """
    wave_x = selected["wavelength_x_over_a"].values
    wave_y = selected["wavelength_y_over_a"].values
    wave, along = wave_and_direction(wave_x, wave_y)
    angle = np.arctan(wavelength_ratio(wave_x, wave_y))
    distance = np.abs(angle[:, None] - np.arctan(DIRECTIONS)[None, :])
    pair = np.stack([wave_x, wave_y])
    fields = {
        "load_m": selected["load_parameter_m"].values,
        "lubricant": selected["lubricant_parameter_l"].values,
        "radius_ratio": selected["radius_ratio_d"].values,
        "gamma": selected["gamma"].values,
        "kappa": selected["kappa"].values,
        "lambdabar": selected["lambdabar"].values,
        "load": selected["gamma"].values * selected["load_parameter_m"].values,
        "wave_x": wave_x,
        "wave_y": wave_y,
        "wave": wave,
        "shorter": np.where(pair == 0, np.inf, pair).min(axis=0),
        "along": along,
        "direction": distance.argmin(axis=1),
        "f_v": selected["f_v"].values,
        "ratio": selected["deformed_ratio"].values,
        "error": np.nan_to_num(selected["deformed_error"].values),
        "condition": condition_index(selected),
    }
    return pd.DataFrame(fields).to_records(index=False)
