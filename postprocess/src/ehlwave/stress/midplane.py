"""Stresses of smooth Hertz contacts in the plane along rolling through the middle, any ellipse.

Sums of waves: the transform of the pressure is 2 pi ph a b (sin s - s cos s)/s^3 with
s^2 = (a kx)^2 + (b ky)^2. The sum repeats after many semi-axes, and ends where waves are short.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ehlwave.choices import POISSON_RATIO
from ehlwave.stress.hertz import NEARLY_CIRCULAR, hertz_circle_stress, hertz_line_stress
from ehlwave.stress.waves import wave_stress

Floats = NDArray[np.float64]
Stresses = dict[str, Floats]

PERIOD = 16.0
"""In semi-axes; along x no less than a quarter of that in the longer one."""

SHORTEST = 0.12
"""Wavelength, in semi-axes, at which the sum ends: 1e-3 ph of the pressure near the edge."""


def hertz_midplane_stress(
    x_m: Floats,
    z_m: Floats,
    semi_axes_m: tuple[float, float],
    hertz_pa: float,
    friction: float = 0.0,
    poisson_ratio: float = POISSON_RATIO,
) -> Stresses:
    """Return the stresses at y = 0 below an elliptical or a line contact, shape (z, x), Pa.

    Parameters
    ----------
    x_m, z_m : ndarray
        Places and depths.
    semi_axes_m : pair of float
        Along x and along y; the latter infinite of a line contact.
    hertz_pa, friction, poisson_ratio : float
        Largest pressure; traction on the body along +x over the pressure; Poisson's ratio.
    """
    a, b = semi_axes_m
    if math.isinf(b):
        places = x_m[None, :], z_m[:, None]
        return hertz_line_stress(*places, a, hertz_pa, friction, poisson_ratio)
    if abs(1 - a / b) < NEARLY_CIRCULAR and friction == 0:
        return hertz_circle_stress(x_m[None, :], 0.0, z_m[:, None], a, hertz_pa, poisson_ratio)
    period_x, period_y = max(PERIOD * a, PERIOD / 4 * b), PERIOD * b
    kx = 2 * np.pi * np.arange(round(period_x / (SHORTEST * a))) / period_x
    ky = 2 * np.pi * np.arange(round(period_y / (SHORTEST * b))) / period_y
    s = np.hypot(kx[:, None] * a, ky * b)
    s[0, 0] = 1
    shape = (np.sin(s) - s * np.cos(s)) / s**3
    shape[0, 0] = 1 / 3
    count = np.outer(np.where(kx > 0, 2, 1), np.where(ky > 0, 2, 1))
    weight = 2 * np.pi * a * b * hertz_pa * shape * count / (period_x * period_y)
    kx[0] = 1e-9 / a  # the mean of long waves in all directions: of half along x
    turn = np.exp(1j * np.outer(kx, x_m))
    found: dict[str, list[Floats]] = {}
    for depth in z_m:
        waves = wave_stress("pressure_pa", kx[:, None], ky, depth, poisson_ratio)
        if friction != 0:
            pulled = wave_stress("traction_x_pa", kx[:, None], ky, depth, poisson_ratio)
            waves = {name: waves[name] + friction * pulled[name] for name in waves}
        for name in ("sxx", "syy", "szz", "sxz"):
            line = (weight * waves[name]).sum(axis=1)
            if name in ("sxx", "syy"):
                line[0] += weight[0, 0] * _half(waves, name)
            found.setdefault(name, []).append((line @ turn).real)
    none = np.zeros((z_m.size, x_m.size))
    stresses = {name: np.array(lines) for name, lines in found.items()}
    return stresses | {"sxy": none, "syz": none}


def _half(waves: dict[str, NDArray[np.complex128]], name: str) -> complex:
    """Return the factor from a mean of long waves along x to a mean over all directions."""
    both = (waves["sxx"][0, 0] + waves["syy"][0, 0]) / 2
    return complex(both - waves[name][0, 0])
