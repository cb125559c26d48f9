"""Reduced pressure between rigid bodies: Reynolds' equation of a gap 1 + xi^2 + zeta^2.

Lengths are x = xi sqrt(2 Rx h) and y = zeta sqrt(2 Ry h), so that the profile depends on D alone:
d/dxi (g^3 dQ/dxi) + D d/dzeta (g^3 dQ/dzeta) = 12 dg/dxi where Q > 0, and nowhere else.
"""

from __future__ import annotations

import math
from functools import cache, lru_cache
from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import NDArray

from ehlwave.duals import Dual, valued

Floats = NDArray[np.float64]

OUTLET = 0.4753868
"""xi where the film of a line contact ruptures, Swift and Stieber."""
PLACES = 1001
CELLS = (60, 30)
"""Along both angles of an ellipse: films within 0.2 % of four times the cells."""
LAST_XI, FARTHEST = 1.2, 0.999
"""End behind the contact; end of the angles elsewhere, over 90 degrees: 640 in xi and zeta."""


class Profile(NamedTuple):
    """Q at places, and the weights of a sum over the contact."""

    q: Floats
    weights: Floats


@cache
def line_profile() -> Profile:
    """Return Q of a line contact at places tan(theta) = xi."""
    theta = np.linspace(-math.pi / 2, math.atan(OUTLET), PLACES)[1:]

    def integral(t: Floats) -> Floats:
        fourth = 3 * t / 8 + np.sin(2 * t) / 4 + np.sin(4 * t) / 32
        return np.asarray(t / 2 + np.sin(2 * t) / 4 - (1 + OUTLET**2) * fourth)

    q = np.maximum(12 * (integral(theta) - integral(np.array(-math.pi / 2))), 0)
    return Profile(q, np.gradient(theta) / np.cos(theta) ** 2)


def ellipse_profile(radius_ratio_d: float) -> Profile:
    """Return Q of an elliptical contact, by finite volumes that are even in two angles.

    Parameters
    ----------
    radius_ratio_d : float
        D = Rx/Ry.
    """
    matrix, _, _, weights = _equations(float(valued(radius_ratio_d)))
    q = _known_pressures(float(valued(radius_ratio_d)))
    if not isinstance(radius_ratio_d, Dual):
        return Profile(q, weights)
    full = np.flatnonzero(q > 0)
    by_d = (_equations(1.0)[0] - _equations(0.0)[0]) @ q  # the matrix is linear in D
    slope = np.zeros_like(q)
    slope[full] = -scipy.sparse.linalg.spsolve(matrix[full][:, full].tocsc(), by_d[full])
    return Profile(Dual(q, radius_ratio_d.slopes[:, None] * slope), weights)


@lru_cache(maxsize=256)
def _known_pressures(radius_ratio_d: float) -> Floats:
    matrix, source, start, _ = _equations(radius_ratio_d)
    return _with_rupture(matrix, source, start)


def _equations(radius_ratio_d: float) -> tuple[scipy.sparse.csr_array, Floats, Floats, Floats]:
    """Return A and s of A q = s, the places of a first guess, and the weights of a sum."""
    last = math.pi / 2 * FARTHEST
    x, xi = _faces_and_centres(np.linspace(-last, math.atan(LAST_XI), CELLS[0] + 1))
    y, zeta = _faces_and_centres(np.linspace(0, last, CELLS[1] + 1))
    dx, dy = np.diff(x)[:, None], np.diff(y)
    # conductance of all faces; the first along zeta is the line of symmetry
    along = (1 + x[:, None] ** 2 + zeta**2) ** 3 / _distances(x, xi)[:, None] * dy
    across = radius_ratio_d * (1 + xi[:, None] ** 2 + y**2) ** 3 / _distances(y, zeta) * dx
    across[:, 0] = 0
    diagonal = along[1:] + along[:-1] + across[:, 1:] + across[:, :-1]
    n = CELLS[1]
    matrix = scipy.sparse.diags_array(
        [
            diagonal.ravel(),
            *(2 * [-along[1:-1].ravel()]),
            *(2 * [-np.pad(across[:, 1:-1], ((0, 0), (0, 1))).ravel()[:-1]]),
        ],
        offsets=[0, n, -n, 1, -1],
    ).tocsr()
    source = np.broadcast_to(-12 * np.diff(x**2)[:, None] * dy, diagonal.shape).ravel()
    start = np.broadcast_to(xi[:, None] < OUTLET, diagonal.shape).ravel()
    return matrix, source, start, 2 * (dx * dy).ravel()


def _faces_and_centres(angles: Floats) -> tuple[Floats, Floats]:
    return np.tan(angles), np.tan((angles[1:] + angles[:-1]) / 2)


def _distances(faces: Floats, centres: Floats) -> Floats:
    """Return distances of centres on both sides of each face, or from the boundary."""
    return np.diff(np.concatenate((faces[:1], centres, faces[-1:])))


def _with_rupture(matrix: scipy.sparse.csr_array, source: Floats, is_full: Floats) -> Floats:
    """Return q >= 0 with A q >= s, one of both equal in each row, by active sets."""
    q = np.zeros_like(source)
    while True:
        full = np.flatnonzero(is_full)
        q[:] = 0
        q[full] = scipy.sparse.linalg.spsolve(matrix[full][:, full].tocsc(), source[full])
        after = np.where(is_full, q > 0, matrix @ q < source)
        if (after == is_full).all():
            return q
        is_full = after
