"""The law of the two waves and its corrections under slip, fitted to the points of an atlas."""

import json
from collections.abc import Iterator

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve, cholesky, solve_triangular
from scipy.optimize import least_squares, minimize

from ehlwave.atlas.expanded import seen_in
from ehlwave.atlas.process import Correlation
from ehlwave.atlas.sliding_shape import FILM_NUMBERS, INSTALLED, SlidingSeen, SlidingShape
from ehlwave.atlas.stored import computed, contact_of, waves_of
from studies.atlas.folds import FOLDS, folds

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]

CENTRES = 600
"""Points about which there are kernels."""

REACH = 5.0
"""Of the kernels, in units of the scatter of each coordinate."""

FREER = {2: 2.0}
"""Coordinates, by their places, along which the kernels reach farther: ln kappa."""

JITTER = 1e-6
"""On the diagonal of the correlations between centres."""

PRIOR = np.array([0.7, 0.7, 0.7, 0.7, 0.7, 0.04, 0.04])
"""Standard deviations of the numbers of a film response."""

NOISE = 0.01
"""Of film responses, units of Ai: those that are off by more than twice that count less."""

STEPS, SHORTEST_STEP = 5, 0.1
"""Of Gauss and Newton's method, and the share of one that is still tried."""

LARGEST_MISS = 0.2
"""Of a response, units of Ai: what is farther off counts as if it was this."""

LAW_SCATTER = 0.03
"""Of the law alone."""

PRESSURE_PRIOR, PRESSURE_NOISE = 1.0, 0.03
"""Of the numbers of a pressure response."""

ERROR_PRIOR, ERROR_FREEDOM = 0.3, 4.0
"""Of ln of the error, and degrees of freedom of Student's distribution of errors over it."""

COVERED = 0.965
"""Share of cross-validated responses that error bars hold."""

DIFFERENCE = 1e-4

WAVES = ("wavelength_over_a", "angle_deg", "rolling_real", "rolling_imaginary")
"""What the file has of the centres; other points are in it by what was fitted to them."""


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


def fitted_law(data: xr.Dataset, film: Complex) -> Floats:
    """Return the coefficients of the law of the two waves that fit the points best."""
    shape = SlidingShape.of_keys(data, data.attrs)[contact_of(data)].with_rolling(rolling_of(data))

    def left(law: Floats) -> Floats:
        miss = shape.with_law(law).seen_under_slip(*waves_of(data)).film_by_law() - film
        return np.concatenate([miss.real, miss.imag])

    found = least_squares(left, INSTALLED, loss="soft_l1", f_scale=LAW_SCATTER, x_scale="jac")
    return np.asarray(found.x)


def seen_of(data: xr.Dataset) -> SlidingSeen:
    """Return all points as the atlas sees them."""
    return seen_in(data, contact_of(data), waves_of(data), rolling_of(data))


def rolling_of(data: xr.Dataset) -> Complex:
    """Return the transfers in pure rolling of all points."""
    return np.asarray(data["rolling_real"].values + 1j * data["rolling_imaginary"].values)


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


def parted(data: xr.Dataset) -> Iterator[tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """Yield points to learn from and points of other contacts to be judged by."""
    fold = folds(data.sizes["contact"])[contact_of(data)]
    for one in range(FOLDS):
        yield np.flatnonzero(fold != one), np.flatnonzero(fold == one)


def cross_validated(data: xr.Dataset, predicted: xr.Dataset, scales: Floats) -> Floats:
    """Return |response predicted without its contact - response|, units of Ai.

    `predicted` has the states of contacts as they are predicted from others.
    """
    film = computed(data)[0]
    seen, unseen = seen_of(data), seen_of(predicted)
    misfit = np.zeros(film.size)
    for train, test in parted(data):
        places = seen.coordinates
        basis = Basis(places[train][chosen_centres(places[train], scales)], scales)
        found = fitted_film(seen, film, basis(places), train)
        value = unseen.film(basis(unseen.coordinates) @ found * PRIOR)
        misfit[test] = np.abs(value - film)[test]
    return misfit


def expanded(data: xr.Dataset, predicted: xr.Dataset) -> tuple[xr.Dataset, Floats]:
    """Return the atlas with the law, its corrections and errors, and the cross-validated misfits.

    `predicted` is the same with the states of contacts as they are predicted from others.
    """
    film, pressure = computed(data)
    law = json.dumps([float(f"{value:.5g}") for value in fitted_law(data, film)])
    data, predicted = data.assign_attrs(law=law), predicted.assign_attrs(law=law)
    seen = seen_of(data)
    scales = kernel_scales(seen.coordinates)
    misfit = cross_validated(data, predicted, scales)
    centres = chosen_centres(seen.coordinates, scales)
    of_centres = Basis(seen.coordinates[centres], scales)
    basis = of_centres(seen.coordinates)
    coefficients = fitted_film(seen, film, basis, np.arange(film.size)) * PRIOR
    value = seen.film(basis @ coefficients)
    of_pressure = fitted_pressure(seen.pressure_left(value, pressure), basis)
    error = np.hypot(misfit, data["discretisation"].values)
    usual, of_error = fitted_error(error, basis)
    ratios = np.zeros(misfit.size)
    for train, test in parted(data):
        log, part = fitted_error(error[train], basis[train])
        ratios[test] = misfit[test] / np.exp(log + basis[test] @ part)
    numbers = np.column_stack([coefficients, of_pressure, of_error])
    kept = [str(name) for name in data.variables if "point" not in data[name].dims]
    waves = data[[*WAVES]].isel(point=centres).rename(point="kernel")
    data = (
        data[kept]
        .merge(waves)
        .assign(
            centre_contact=("kernel", contact_of(data)[centres].astype(np.int16)),
            coefficient=(("kernel", "number"), of_centres.of_kernels(numbers).astype(np.float32)),
        )
    )
    data.attrs |= {
        "wave_scales": json.dumps(scales.tolist()),
        "usual_log_error": round(usual, 4),
        "error_factor": round(float(np.quantile(ratios, COVERED)), 3),
    }
    return data, misfit
