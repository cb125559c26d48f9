"""The points that formulas are fitted to, as plain arrays."""

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave_post.formula import wave_and_direction, wavelength_ratio
from ehlwave_post.points import condition_index

Floats = NDArray[np.float64]

DIRECTIONS = (0.0, 0.05, 0.2, 0.5, 1.0, 2.0, 5.0, 20.0, np.inf)


@dataclass(frozen=True)
class Points:
    """What formulas are made of, one value per point; all dimensionless, shape (n,).

    ``wave`` is lambda_n/a and ``along`` cos^2(theta), see
    :func:`ehlwave_post.formula.wave_and_direction`; ``load`` is gamma M; ``direction`` the number
    of the nearest of ``DIRECTIONS``; ``condition`` that of (M, L, D); ``error`` the error bar of
    ``ratio`` = Ad/Ai, 0 where not known.
    """

    load_m: Floats
    lubricant: Floats
    radius_ratio: Floats
    gamma: Floats
    kappa: Floats
    lambdabar: Floats
    wave_x: Floats
    wave_y: Floats
    f_v: Floats
    ratio: Floats
    error: Floats
    condition: NDArray[np.intp]
    wave: Floats
    along: Floats
    direction: NDArray[np.intp]

    @property
    def load(self) -> Floats:
        """Return gamma M."""
        return self.gamma * self.load_m

    @property
    def shorter(self) -> Floats:
        """Return min(lambda_x, lambda_y)/a, the wavelength of eq. (15)."""
        pair = np.stack([self.wave_x, self.wave_y])
        return np.asarray(np.where(pair == 0, np.inf, pair).min(axis=0))


def points_of(selected: xr.Dataset) -> Points:
    """Return the points of :func:`ehlwave_post.points.select_points` for fitting."""
    wave_x = selected["wavelength_x_over_a"].values
    wave_y = selected["wavelength_y_over_a"].values
    wave, along = wave_and_direction(wave_x, wave_y)
    angle = np.arctan(wavelength_ratio(wave_x, wave_y))
    distance = np.abs(angle[:, None] - np.arctan(DIRECTIONS)[None, :])
    return Points(
        load_m=selected["load_parameter_m"].values,
        lubricant=selected["lubricant_parameter_l"].values,
        radius_ratio=selected["radius_ratio_d"].values,
        gamma=selected["gamma"].values,
        kappa=selected["kappa"].values,
        lambdabar=selected["lambdabar"].values,
        wave_x=wave_x,
        wave_y=wave_y,
        f_v=selected["f_v"].values,
        ratio=selected["deformed_ratio"].values,
        error=np.nan_to_num(selected["deformed_error"].values),
        condition=condition_index(selected),
        wave=wave,
        along=along,
        direction=distance.argmin(axis=1),
    )
