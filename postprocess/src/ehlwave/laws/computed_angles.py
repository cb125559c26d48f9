"""Computed responses between directions: tables over ln wavelength, refined over the angle."""

from collections.abc import Callable

import numpy as np
import scipy

from ehlwave.laws.transfer import Waves

FIRST_ANGLES = (0.0, 45.0, 90.0)
MOST_ANGLES = 9


def map_of(
    parts: Callable[[float], Waves], logs: Waves, tolerance: float
) -> Callable[[Waves, Waves], Waves]:
    """Return interpolation over angles, refined until its error is known.

    Responses are even about both axes, so that a spline over the angle has no slope there.
    """
    tables = {angle: parts(angle) for angle in FIRST_ANGLES}
    open_ = [(0.0, 45.0), (45.0, 90.0)]
    while open_ and len(tables) < MOST_ANGLES:
        low, high = open_.pop(0)
        middle = (low + high) / 2
        new = parts(middle)
        expected = _over_angles(tables)(np.array([middle]))[0]
        error = np.abs((expected[0] + 1j * expected[1]) - (new[0] + 1j * new[1]))
        new[2] += error / 4
        tables[middle] = new
        if error.max() > 4 * tolerance:
            open_ += [(low, middle), (middle, high)]
    for low, high in open_:  # a missing response counts as a difference of two
        for end in (low, high):
            other = high if end == low else low
            gap = tables[low][:2] - tables[high][:2]
            tables[other][2] += np.hypot(*gap) / 4
    angles = np.linspace(0, 90, 91)
    fine = _over_angles(tables)(angles)

    def interpolate(log: Waves, angle: Waves) -> Waves:
        u = np.clip((log - logs[0]) / (logs[1] - logs[0]), 0, logs.size - 1)
        v = np.clip(angle, 0, 90)
        i, j = np.minimum(u.astype(int), logs.size - 2), np.minimum(v.astype(int), 89)
        u, v = u - i, v - j
        low = fine[j, :, i] * (1 - u)[:, None] + fine[j, :, i + 1] * u[:, None]
        high = fine[j + 1, :, i] * (1 - u)[:, None] + fine[j + 1, :, i + 1] * u[:, None]
        return np.asarray((low * (1 - v)[:, None] + high * v[:, None]).T)

    return interpolate


def _over_angles(tables: dict[float, Waves]) -> Callable[[Waves], Waves]:
    """Return interpolation over angles of tables: splines of films, straight lines of errors."""
    angles = np.array(sorted(tables))
    values = np.stack([tables[angle] for angle in angles])
    spline = scipy.interpolate.CubicSpline(angles, values[:, :2], bc_type="clamped")

    def at(angle: Waves) -> Waves:
        k = np.clip(np.searchsorted(angles, angle) - 1, 0, angles.size - 2)
        share = ((angle - angles[k]) / (angles[k + 1] - angles[k]))[:, None, None]
        rest = values[k, 2:] * (1 - share) + values[k + 1, 2:] * share
        return np.concatenate([spline(angle), rest], axis=1)

    return at
