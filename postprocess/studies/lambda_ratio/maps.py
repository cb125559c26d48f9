"""Rough maps: isotropic ones, and ones with lay along and across rolling."""

import numpy as np

from ehlwave.surface import Conditions, Surface, map_surface
from ehlwave.surface.prepare import taper
from studies.microgeometry.surfaces import Floats

STRETCH = {"isotropic": (1, 1), "longitudinal": (3, 1), "transverse": (1, 3)}
"""How many times as long as the shortest are features along x and y."""

LENGTH, WIDTH = 6.0, 4.5
"""Of a map, in units of a and b: wider than the domain."""

SHORTEST, LONGEST = 0.5, 3.0
"""Waves across the lay, in units of a."""

CORNER = 0.8
"""Waves per a above which amplitudes fall with the square of the frequency."""

POINTS_PER_A = 24


def rough_map(
    kind: str, seed: int, rq_m: float, conditions: Conditions, points_per_a: int = POINTS_PER_A
) -> Surface:
    """Return Gaussian heights of this Rq, periodic, faded to zero at both ends along x."""
    a_m = conditions.semi_axis_a_m
    wide = WIDTH * conditions.semi_axis_b_m / a_m
    nx, ny = round(LENGTH * points_per_a), 2 * round(wide * points_per_a / 2)
    noise = np.random.default_rng([seed, 40, list(STRETCH).index(kind)]).standard_normal((nx, ny))
    along, across = STRETCH[kind]
    qx, qy = (np.fft.fftfreq(count, 1 / points_per_a) for count in (nx, ny))
    q = np.hypot(along * qx[:, None], across * qy[None, :])
    spectrum = np.fft.fft2(noise) / (1 + (q / CORNER) ** 2)
    spectrum[(q > 1 / SHORTEST) | (q < 1 / LONGEST)] = 0
    heights: Floats = np.fft.ifft2(spectrum).real
    step = a_m / points_per_a
    faded = heights * rq_m / heights.std() * taper(nx)[:, None]
    return map_surface(faded, step, step, kind)
