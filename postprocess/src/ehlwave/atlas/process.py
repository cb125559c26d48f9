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
    return Correlation(b, scales)(a)


class Correlation:
    """Correlation with points that stay, shape (m, k)."""

    def __init__(self, points: Floats, scales: Floats) -> None:
        """Scale the points once."""
        self._scales, self._points = scales, points / scales
        self._squares = (self._points**2).sum(1)[None, :]

    def __call__(self, places: Floats) -> Floats:
        """Return their correlation with places of shape (n, k): shape (n, m)."""
        a = places / self._scales
        squared = (a**2).sum(1)[:, None] + self._squares - 2 * a @ self._points.T
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
    """

    contacts: Floats
    of_contact: NDArray[np.intp]
    waves: Floats

    def __getitem__(self, index: NDArray[np.intp]) -> "Scattered":
        """Return a choice of the points."""
        return Scattered(self.contacts, self.of_contact[index], self.waves[index])


@dataclass(frozen=True)
class Scales:
    """Lengths over which values change, of the coordinates of contacts and of waves.

    And the standard error of values, over the spread of the process.
    """

    contacts: Floats
    waves: Floats
    noise: float = 0.0

    @classmethod
    def of_logs(cls, logs: Floats, contacts: int) -> "Scales":
        """Return what :meth:`logs` are of."""
        values = np.exp(logs)
        return cls(values[:contacts], values[contacts:-1], float(values[-1]))

    def logs(self) -> Floats:
        """Return the logarithms of all numbers: of contacts, of waves, the noise."""
        return np.log([*self.contacts, *self.waves, self.noise])


def covariance(points: Scattered, scales: Scales) -> Floats:
    """Return the matrix of correlations between all points, with the noise, shape (n, n)."""
    between = correlation(points.contacts, points.contacts, scales.contacts)
    matrix = between[np.ix_(points.of_contact, points.of_contact)]
    if points.waves.shape[1]:
        matrix *= correlation(points.waves, points.waves, scales.waves)
    matrix[np.diag_indices_from(matrix)] += scales.noise**2
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
        self._waves = Correlation(points.waves, scales.waves)

    def at_contact(self, contact: Floats) -> Floats:
        """Return the weights of all points, (n, outputs), for a contact of coordinates (k,)."""
        near = correlation(contact[None, :], self.points.contacts, self.scales.contacts)[0]
        return near[self.points.of_contact, None] * self.weights

    def at_waves(self, weights: Floats, waves: Floats) -> Floats:
        """Return values for waves, coordinates of shape (m, j), with the weights of a contact."""
        return np.asarray(self._waves(waves) @ weights)


def likelihood(points: Scattered, values: Floats, scales: Scales) -> tuple[float, Floats]:
    """Return the negative logarithm of the likelihood of the values, their spread at its best.

    And its derivatives with respect to the logarithms of the scales (Rasmussen and Williams, 5.9).
    """
    matrix = covariance(points, scales)
    lower, _ = factor = cho_factor(matrix, lower=True)
    n, outputs = values.shape
    weights = cho_solve(factor, values)
    squares = np.sum(values * weights, axis=0) / n
    cost = outputs * np.log(np.diag(lower)).sum() + 0.5 * n * np.log(squares).sum()
    inner = 0.5 * outputs * cho_solve(factor, np.eye(n)) - 0.5 * (weights / squares) @ weights.T
    parts = (  # the diagonal counts nothing: places are no distance from themselves
        (points.contacts[points.of_contact], scales.contacts),
        (points.waves, scales.waves),
    )
    slopes = []
    for places, lengths in parts:
        steepness = inner * matrix * _steepness(places / lengths)
        for place in (places / lengths).T:
            slopes.append(np.sum(steepness * (place[:, None] - place[None, :]) ** 2))
    slopes.append(2 * scales.noise**2 * np.trace(inner))
    return float(cost), np.array(slopes)


def _steepness(places: Floats) -> Floats:
    """Return -d ln(correlation)/d(r^2/2) between places in units of the length scales."""
    squared = (places**2).sum(1)[:, None] + (places**2).sum(1)[None, :] - 2 * places @ places.T
    r = np.sqrt(5.0 * np.maximum(squared, 0))
    return np.asarray(5 / 3 * (1 + r) / (1 + r + r**2 / 3))
