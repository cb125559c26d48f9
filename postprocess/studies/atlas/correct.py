"""Coefficients of the kernels by which the law of the two waves is corrected."""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import minimize

from ehlwave.atlas.sliding_shape import FILM_NUMBERS, SlidingSeen

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]

PRIOR = np.array([0.7, 0.7, 0.7, 0.7, 0.7, 0.04, 0.04])
"""Standard deviations of the numbers of a film response."""

NOISE = 0.01
"""Of film responses, units of Ai: those that are off by more than twice that count less."""

STEPS, SHORTEST_STEP = 5, 0.1
"""Of Gauss and Newton's method, and the share of one that is still tried."""

LARGEST_MISS = 0.2
"""Of a response, units of Ai: what is farther off counts as if it was this."""

PRESSURE_PRIOR, PRESSURE_NOISE = 1.0, 0.03
"""Of the numbers of a pressure response."""

ERROR_PRIOR, ERROR_FREEDOM = 0.3, 4.0
"""Of ln of the error, and degrees of freedom of Student's distribution of errors over it."""

DIFFERENCE = 1e-4


def fitted_film(seen: SlidingSeen, film: Complex, basis: Floats, train: NDArray[np.intp]) -> Floats:
    """Return coefficients, (centres, 7), by which the waves of `train` have their responses.

    The most probable ones of independent normal coefficients, by Gauss and Newton's method;
    responses that are far off weigh less.
    """
    found = np.zeros((basis.shape[1], FILM_NUMBERS))
    part = basis[train]
    for _ in range(STEPS):
        value, slopes = _film_and_slopes(seen, basis @ found * PRIOR)
        miss, slopes = (film - value)[train], slopes[train] * PRIOR
        weight = _weight(miss, 2 * NOISE) / NOISE**2
        step = _newton_step(part, slopes, weight, miss, found)
        cost, share = _cost(miss), 1.0
        while share > SHORTEST_STEP:
            tried = seen.film(basis @ (found + share * step) * PRIOR)
            if _cost((film - tried)[train]) < cost:
                break
            share /= 2
        found = found + share * step
    return found


def _newton_step(
    part: Floats, slopes: Complex, weight: Floats, miss: Complex, found: Floats
) -> Floats:
    """Return the change of coefficients that the normal equations ask for."""
    count, numbers = found.shape
    normal = np.zeros((numbers, count, numbers, count))
    right = np.zeros((numbers, count))
    for i in range(numbers):
        right[i] = part.T @ (weight * (np.conj(slopes[:, i]) * miss).real) - found[:, i]
        for j in range(i + 1):
            both = weight * (np.conj(slopes[:, i]) * slopes[:, j]).real
            block = part.T @ (both[:, None] * part)
            normal[i, :, j], normal[j, :, i] = block, block.T
    matrix = normal.reshape(numbers * count, -1)
    matrix[np.diag_indices_from(matrix)] += 1
    factor = cho_factor(matrix, overwrite_a=True, check_finite=False)
    return cho_solve(factor, right.ravel(), check_finite=False).reshape(numbers, count).T


def _film_and_slopes(seen: SlidingSeen, numbers: Floats) -> tuple[Complex, Complex]:
    """Return responses and their derivatives by the numbers, shape (n, 7)."""
    value = seen.film(numbers)
    slopes = [
        (seen.film(numbers + DIFFERENCE * (np.arange(FILM_NUMBERS) == k)) - value) / DIFFERENCE
        for k in range(FILM_NUMBERS)
    ]
    return value, np.stack(slopes, axis=1)


def _weight(miss: Complex, scatter: float) -> Floats:
    return np.asarray(1 / np.sqrt(1 + (np.abs(miss) / scatter) ** 2))


def _cost(miss: Complex) -> float:
    return float(np.sum(np.minimum(np.abs(miss), LARGEST_MISS) ** 2))


def fitted_pressure(left: Complex, basis: Floats) -> Floats:
    """Return coefficients, (centres, 2), of what pressure responses are less those of the waves."""
    found, ridge = np.zeros(basis.shape[1], dtype=complex), np.eye(basis.shape[1])
    ridge *= (PRESSURE_NOISE / PRESSURE_PRIOR) ** 2
    for _ in range(STEPS):
        weighted = basis.T * _weight(basis @ found - left, PRESSURE_NOISE)
        found = np.linalg.solve(weighted @ basis + ridge, weighted @ left)
    return np.stack([found.real, found.imag], axis=1)


def fitted_error(misfit: Floats, basis: Floats) -> tuple[float, Floats]:
    """Return ln of a usual error and coefficients, (centres,), of what is added to it."""
    start = np.append(np.zeros(basis.shape[1]), np.log(np.median(misfit)))

    def cost(values: Floats) -> tuple[float, Floats]:
        log = basis @ values[:-1] + values[-1]
        ratio = misfit**2 * np.exp(-2 * log) / ERROR_FREEDOM
        total = np.sum(log + (ERROR_FREEDOM + 1) / 2 * np.log1p(ratio))
        total += np.sum(values[:-1] ** 2) / (2 * ERROR_PRIOR**2)
        slope = 1 - (ERROR_FREEDOM + 1) * ratio / (1 + ratio)
        slopes = np.append(basis.T @ slope + values[:-1] / ERROR_PRIOR**2, slope.sum())
        return float(total), slopes

    found = minimize(cost, start, jac=True, method="L-BFGS-B", options={"maxiter": 200}).x
    return float(found[-1]), found[:-1]
