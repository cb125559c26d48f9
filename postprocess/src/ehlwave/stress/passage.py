"""Stresses that material points feel of the ripple while they pass the contact.

A wave exp(i(kx (X - S t))) of a surface with the speed S meets a point of a body with the speed
S_b, which is at X at the time t = (X - xi)/S_b, as exp(i rho kx xi) times a phase of X alone,
rho = S/S_b: at each place X of the contact the stresses of all points of the body are a Fourier sum
over their coordinate rho xi. The sum has the waves of the centre; towards the edge of the contact
their pressure falls as the smooth pressure to the power of 1/8, as the linear responses of whole
contacts do.
"""

from collections.abc import Iterator
from itertools import repeat

import numpy as np
from numpy.typing import NDArray

from ehlwave.stress.waves import wave_stress
from ehlwave.surface.rough_pressure import Ripple

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
Stresses = dict[str, Floats]

EDGE_POWER = 1 / 8
"""Power of the smooth pressure, over its largest, with which the ripple falls to the edge."""


SLICES = 400
"""Slices of the contact along rolling, over which the ripple is summed."""


def edge_factor(x_over_a: Floats, y_over_b: Floats | float = 0.0) -> Floats:
    """Return by how much the ripple is smaller than at the centre; 0 outside the contact."""
    inside = np.maximum(1 - np.square(x_over_a) - np.square(y_over_b), 0)
    return np.asarray(np.where(inside > 0, inside ** (EDGE_POWER / 2), 0.0))


def edge_factor_below(x_over_a: Floats, z_over_a: Floats, b_over_a: float) -> Floats:
    """Return the stresses below the surface at y = 0, (x, z): effect of the ripple at a place.

    A place below the edge has the ripple on one side only. It is weighted as the normal stress
    below a pressure that falls like the ripple, int f 3 z^3/(2 pi R^5) dx dy: the integral over y,
    as far as the contact is wide, is closed, the integral over x a sum.
    """
    step = 2 / SLICES
    place = -1 + step * (np.arange(SLICES) + 0.5)
    width = b_over_a * np.sqrt(1 - place**2)
    deep = np.maximum(z_over_a, step)[None, :, None]
    square = (x_over_a[:, None, None] - place) ** 2 + deep**2
    far = np.isinf(b_over_a)
    across = 2.0 if far else width * (3 * square + 2 * width**2) / (square + width**2) ** 1.5
    found = (edge_factor(place) * deep**3 / (np.pi * square**2) * across).sum(axis=2) * step
    return np.where(z_over_a < 2 * step, edge_factor(x_over_a)[:, None], found)


def ripple_stresses(
    ripple: Ripple,
    places_m: Floats,
    depths_m: Floats,
    ratio: float,
    friction: float,
    poisson_ratio: float,
) -> Iterator[Stresses]:
    """Yield the stresses of points of a body at each place X in turn, from :func:`wave_stresses`.

    Yields
    ------
    dict of ndarray, shape (z, points, lines)
        By component, Pa; those that are nothing are left out.
    """
    # Waves that move with the body are the same for its points at every place.
    stays = not _carries(ripple) and (ratio == 1 or not ripple.moves)
    places, times = (places_m[:1], places_m.size) if stays else (places_m, 1)
    for total in wave_stresses(ripple, places, depths_m, ratio, friction, poisson_ratio):
        found = {name: ripple.over_points(value) for name, value in total.items()}
        yield from repeat(found, times)


def wave_stresses(
    ripple: Ripple,
    places_m: Floats,
    depths_m: Floats,
    ratio: float,
    friction: float,
    poisson_ratio: float,
) -> Iterator[dict[str, Complex]]:
    """Yield the amplitudes of the waves of stress that points feel at each place X in turn.

    Parameters
    ----------
    ripple : Ripple
        Of the surface.
    places_m, depths_m : ndarray
        Places in the contact, and depths.
    ratio : float
        rho, the speed of this surface over the body's speed.
    friction, poisson_ratio : float
        Traction on the body along +x over the pressure; Poisson's ratio.

    Yields
    ------
    dict of ndarray, shape (z, kx, ky)
        By component, Pa; those that are nothing are left out.
    """
    waves = ripple.waves
    material = friction, poisson_ratio
    own = _below(waves.number_x.astype(complex), waves.number_y, depths_m, *material)
    carries = _carries(ripple)
    other = _below(waves.psi, waves.number_y, depths_m, *material) if carries else {}
    for x_m in places_m:
        turn = np.exp(-1j * ratio * waves.number_x * x_m) * ripple.amplitude
        here = waves.attenuated * np.exp(1j * waves.number_x * x_m) * turn
        total = {name: factor * here for name, factor in own.items()}
        if carries:
            there = waves.complementary * waves.carried(x_m) * turn
            total = {name: value + other[name] * there for name, value in total.items()}
        yield total


def _carries(ripple: Ripple) -> bool:
    """Return whether the oil carries waves of the ripple."""
    return bool(np.any(np.abs(ripple.waves.complementary) > 0))


def _below(
    number_x: Complex, number_y: Floats, depths_m: Floats, friction: float, poisson_ratio: float
) -> dict[str, Complex]:
    """Return the stresses per pressure, (z, kx, ky), without components that are nothing."""
    along = np.where((number_x == 0) & (number_y == 0), 1.0, number_x)
    places = along, number_y, depths_m[:, None, None]
    found = wave_stress("pressure_pa", *places, poisson_ratio)
    if friction != 0:
        pulled = wave_stress("traction_x_pa", *places, poisson_ratio)
        found = {name: found[name] + friction * pulled[name] for name in found}
    return {name: values for name, values in found.items() if np.any(values != 0)}
