"""Kernels about some of the points of an atlas."""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cholesky, solve_triangular

from ehlwave.atlas.process import Correlation

Floats = NDArray[np.float64]

CENTRES = 1000
"""Points about which there are kernels."""

REACH = 5.0
"""Of the kernels, in units of the scatter of each coordinate."""

FREER = {2: 2.0}
"""Coordinates, by their places, along which the kernels reach farther: ln kappa."""

JITTER = 1e-6
"""On the diagonal of the correlations between centres."""


class Basis:
    """Kernels about centres, combined so that coefficients of variance 1 make numbers of it."""

    def __init__(self, centres: Floats, scales: Floats) -> None:
        """Factorise the correlations between the centres."""
        self._near = Correlation(centres, scales)
        matrix = self._near(centres) + JITTER * np.eye(len(centres))
        self._lower = cholesky(matrix, lower=True)

    def __call__(self, places: Floats) -> Floats:
        """Return the kernels at places, shape (n, centres)."""
        near = self._near(places)
        return np.asarray(solve_triangular(self._lower, near.T, lower=True).T)

    def of_kernels(self, coefficients: Floats) -> Floats:
        """Return coefficients, (centres, outputs), of the kernels themselves."""
        return np.asarray(solve_triangular(self._lower, coefficients, lower=True, trans="T"))


def kernel_scales(coordinates: Floats) -> Floats:
    """Return the lengths of the kernels."""
    reach = np.full(coordinates.shape[1], REACH)
    for place, factor in FREER.items():
        reach[place] *= factor
    return np.array([float(f"{value:.3g}") for value in reach * coordinates.std(axis=0)])


def chosen_centres(places: Floats, scales: Floats, count: int = CENTRES) -> NDArray[np.intp]:
    """Return the points that know most of the others: a pivoted Cholesky factorisation."""
    count = min(count, len(places) // 2)
    left, lower = np.ones(len(places)), np.zeros((len(places), count))
    chosen = np.zeros(count, dtype=np.intp)
    for k in range(count):
        chosen[k] = best = int(np.argmax(left))
        column = Correlation(places[[best]], scales)(places)[:, 0]
        column -= lower[:, :k] @ lower[best, :k]
        lower[:, k] = column / np.sqrt(left[best])
        left = np.maximum(left - lower[:, k] ** 2, 0)
    return chosen
