"""Gaussian-process interpolation between scattered points, in a product of two kernels.

Of a contact the coordinates are fixed while waves change, so the kernel is the product of one of
contacts and one of waves: with the first evaluated once, a wave costs one row of the second.
Rasmussen and Williams, *Gaussian Processes for Machine Learning* (2006), (2.25) and (5.8); Matern
5/2, (4.17).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

Floats = NDArray[np.float64]


def matern(distance: Floats) -> Floats:
    """Return the Matern 5/2 correlation at a distance in units of the length scale."""
    r = np.sqrt(5.0) * distance
    return np.asarray((1 + r + r**2 / 3) * np.exp(-r))


def correlation(a: Floats, b: Floats, scales: Floats) -> Floats:
    """Return the correlation of points a, shape (n, k), with points b, (m, k): shape (n, m)."""
    a, b = a / scales, b / scales
    squared = (a**2).sum(1)[:, None] + (b**2).sum(1)[None, :] - 2 * a @ b.T
    return matern(np.sqrt(np.maximum(squared, 0)))


@dataclass(frozen=True)
class Scattered:
    """Where values are known.

    Attributes
    ----------
    contacts : ndarray, shape (c, k)
        Coordinates of contacts.
    of_contact : ndarray of int, shape (n,)
        The contact of each point.
    waves : ndarray, shape (n, j)
        Coordinates of the waves; j = 0 for what depends on the contact alone.
    noise : ndarray, shape (n,)
        Standard error of each value over the spread of the process.
    """

    contacts: Floats
    of_contact: NDArray[np.intp]
    waves: Floats
    noise: Floats


@dataclass(frozen=True)
class Scales:
    """Lengths over which values change: of the coordinates of contacts and of waves."""

    contacts: Floats
    waves: Floats


def covariance(points: Scattered, scales: Scales) -> Floats:
    """Return the matrix of correlations between all points, with their noise, shape (n, n)."""
    between = correlation(points.contacts, points.contacts, scales.contacts)
    matrix = between[np.ix_(points.of_contact, points.of_contact)]
    if points.waves.shape[1]:
        matrix *= correlation(points.waves, points.waves, scales.waves)
    matrix[np.diag_indices_from(matrix)] += points.noise**2
    return matrix


class Process:
    """Values over contacts and waves, several at once."""

    def __init__(self, points: Scattered, values: Floats, scales: Scales) -> None:
        """Take values, shape (n, outputs), of mean 0 far from all points."""
        self.points, self.scales = points, scales
        factor = cho_factor(
            covariance(points, scales), lower=True, overwrite_a=True, check_finite=False
        )
        self.weights = cho_solve(factor, values, check_finite=False)

    def at_contact(self, contact: Floats) -> Floats:
        """Return the weights of all points, (n, outputs), for a contact of coordinates (k,)."""
        near = correlation(contact[None, :], self.points.contacts, self.scales.contacts)[0]
        return near[self.points.of_contact, None] * self.weights

    def at_waves(self, weights: Floats, waves: Floats) -> Floats:
        """Return values for waves, coordinates of shape (m, j), with the weights of a contact."""
        return correlation(waves, self.points.waves, self.scales.waves) @ weights


def likelihood(points: Scattered, values: Floats, scales: Scales) -> float:
    """Return the negative logarithm of the likelihood of the values, their spread at its best."""
    lower, _ = factor = cho_factor(covariance(points, scales), lower=True, overwrite_a=True)
    n, outputs = values.shape
    squares = np.sum(values * cho_solve(factor, values), axis=0) / n
    return float(outputs * np.log(np.diag(lower)).sum() + 0.5 * n * np.log(squares).sum())
