"""Life of a rough contact over the life of a smooth contact, and the share of a surface at risk.

Ioannides and Harris (1985), Journal of Tribology 107, theory eq. (B6): the logarithm of the
probability of survival after N cycles goes as N^e times the integral of <tau - tau_u>^c z^(-h)
over the volume. c, h and e come from Lundberg and Palmgren (1947) for point contacts; line contacts
have e = 9/8. The factor of the integral is unknown, so only ratios count.
"""

import numpy as np
import scipy
import xarray as xr
from numpy.typing import NDArray

from ehlwave.errors import StressError

Floats = NDArray[np.float64]

STRESS_POWER, DEPTH_POWER, CYCLE_POWER = 31 / 3, 7 / 3, 10 / 9
"""c, h and e of point contacts."""

LINE_CYCLE_POWER = 9 / 8
"""e of line contacts."""


def life_integral_ratio(
    rough: xr.DataArray,
    smooth: xr.DataArray,
    limit_pa: float = 0.0,
    stress_power: float = STRESS_POWER,
    depth_power: float = DEPTH_POWER,
) -> float:
    """Return the integral of Ioannides and Harris of a rough over a smooth contact.

    Parameters
    ----------
    rough, smooth : DataArray
        The stress that counts, Pa, over ``z`` and any other dimensions on even grids, over which
        the mean is taken. The surface itself, z = 0, is left out: the integral ends at the first
        depth above 0.
    limit_pa : float
        tau_u, below which stress does nothing.
    stress_power, depth_power : float
        c and h.

    Returns
    -------
    float
        1 where neither is above the limit, infinite where only the rough contact is.

    Raises
    ------
    StressError
        If a stress has fewer than two depths above 0.
    """
    scale = max(float(rough.max()), float(smooth.max())) - limit_pa
    if scale <= 0:
        return 1.0
    parts = [_integral(one, limit_pa, scale, stress_power, depth_power) for one in (rough, smooth)]
    if parts[1] == 0:
        return 1.0 if parts[0] == 0 else float("inf")
    return parts[0] / parts[1]


def life_ratio(integral_ratio: float, cycle_power: float = CYCLE_POWER) -> float:
    """Return the life of the rough contact over the smooth contact's, at equal probabilities."""
    return integral_ratio ** (-1 / cycle_power) if integral_ratio > 0 else float("inf")


def share_at_risk(factor: xr.DataArray) -> float:
    """Return the share of the surface where Dang Van's factor is 1 or more at some depth."""
    worst = factor.max("z") if "z" in factor.dims else factor
    return float((worst >= 1).mean())


def _integral(
    stress: xr.DataArray, limit_pa: float, scale: float, stress_power: float, depth_power: float
) -> float:
    """Return the integral over depth of the mean over places, stresses in units of the scale."""
    if "z" not in stress.dims or int((stress["z"] > 0).sum()) < 2:
        raise StressError("stress: two depths above 0 are needed, along the dimension z")
    below = stress.isel(z=np.flatnonzero(stress["z"].values > 0)).transpose("z", ...)
    depths = np.asarray(below["z"].values, dtype=float)
    excess = np.maximum(np.asarray(below.values, dtype=float) - limit_pa, 0) / scale
    means = (excess**stress_power).reshape(depths.size, -1).mean(axis=1)
    return float(scipy.integrate.trapezoid(means * depths**-depth_power, depths))
