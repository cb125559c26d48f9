"""From points to the atlas file: length scales, cross-validation, error bars, compression."""

import json
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.optimize import minimize

from ehlwave.atlas.atlas import FILM_NUMBERS, FORMAT_NAME, NEIGHBOURHOOD, checksum, reduced_of, responses_of
from ehlwave.atlas.coordinates import Shape, contact_coordinates
from ehlwave.atlas.process import Process, Scales, Scattered, correlation, likelihood
from ehlwave.atlas.ranges import CONTACT_RANGES

Floats = NDArray[np.float64]

FIRST_SCALES = Scales(np.array([4.0, 2.0, 3.0, 4.0, 2.0]), np.array([2.0, 1.5]))
FIRST_FILM_SCALES = np.array([4.0, 2.0, 3.0, 4.0, 2.0])
MOST_TRAINED = 900
"""Points of which the length scales are fitted; more change them little and cost the cube."""

FOLDS = 8
COVERED = 0.965
"""Share of cross-validated responses that error bars hold."""

SPREAD = 0.2
"""Of the numbers interpolated; noise counts relative to it."""

DIGITS = 1e-5


def with_noise(data: xr.Dataset, floor: float = 3e-3) -> xr.Dataset:
    """Return points with ``noise``: error of the numbers over their spread."""
    shape = Shape(*(data[name].values for name in list(CONTACT_RANGES)[:3]))[data["of_contact"].values.astype(int)]
    formula = shape.formula(data["wavelength_over_a"].values, data["angle_deg"].values)
    noise = np.hypot(floor, data["discretisation"].values / formula / SPREAD).astype(np.float32)
    return data.assign(noise=("point", noise))


def fitted_scales(data: xr.Dataset, start: Scales = FIRST_SCALES) -> Scales:
    """Return the length scales of greatest likelihood, from some of the points."""
    random = np.random.default_rng(5)
    chosen = np.sort(random.permutation(data.sizes["point"])[:MOST_TRAINED])
    whole, values = responses_of(data), reduced_of(data)[chosen]
    part = Scattered(whole.contacts, whole.of_contact[chosen], whole.waves[chosen], whole.noise[chosen])
    count = len(start.contacts)

    def cost(logs: Floats) -> float:
        return likelihood(part, values, Scales(np.exp(logs[:count]), np.exp(logs[count:])))

    first = np.log([*start.contacts, *start.waves])
    limits = [(value - 2.5, value + 2.5) for value in first]
    found = minimize(cost, first, method="L-BFGS-B", bounds=limits, options={"maxiter": 15, "eps": 1e-3})
    return Scales(np.exp(found.x[:count]), np.exp(found.x[count:]))


def folds(contacts: int) -> NDArray[np.intp]:
    """Return the fold of each contact."""
    return np.random.default_rng(11).permutation(contacts) % FOLDS


def cross_validated(data: xr.Dataset, scales: Scales) -> Floats:
    """Return |response predicted without its contact - response|, units of Ai."""
    points, values = responses_of(data), reduced_of(data)
    shape = Shape(*(data[name].values for name in list(CONTACT_RANGES)[:3]))
    left_out = folds(data.sizes["contact"])[points.of_contact]
    film = data["film_real"].values + 1j * data["film_imaginary"].values
    wave, angle = data["wavelength_over_a"].values, data["angle_deg"].values
    misfit = np.zeros(len(values))
    for fold in range(FOLDS):
        train, test = np.flatnonzero(left_out != fold), np.flatnonzero(left_out == fold)
        part = Scattered(points.contacts, points.of_contact[train], points.waves[train], points.noise[train])
        process = Process(part, values[train], scales)
        for contact in np.unique(points.of_contact[test]):
            own = test[points.of_contact[test] == contact]
            numbers = process.at_waves(process.at_contact(points.contacts[contact]), points.waves[own])
            found, _ = shape[points.of_contact[own]].responses(wave[own], angle[own], numbers)
            misfit[own] = np.abs(found - film[own])
    return misfit


def error_factor(data: xr.Dataset, misfit: Floats, error: Floats, scales: Scales) -> float:
    """Return what local errors are multiplied by to hold the wanted share of misfits.

    The local error of a point comes from other contacts alone, as it does for a new contact.
    """
    points = responses_of(data)
    local = local_error(points, error, scales)
    return float(np.quantile(misfit / local, COVERED))


def local_error(points: Scattered, error: Floats, scales: Scales) -> Floats:
    """Return the root mean square error of the neighbours of each point, its own contact left out."""
    between = correlation(points.contacts, points.contacts, scales.contacts * NEIGHBOURHOOD)
    np.fill_diagonal(between, 0)
    local = np.empty(len(error))
    for block in np.array_split(np.arange(len(error)), max(1, len(error) // 500)):
        near = correlation(points.waves[block], points.waves, scales.waves * NEIGHBOURHOOD)
        near *= between[np.ix_(points.of_contact[block], points.of_contact)]
        local[block] = np.sqrt(near @ error**2 / near.sum(axis=1))
    return local


def film_errors(data: xr.Dataset, scales: Floats, noise: float) -> Floats:
    """Return the cross-validated errors of both film numbers, shape (contacts, 2)."""
    contacts = contact_coordinates(data)
    values = np.stack([data[name].values.astype(float) for name in FILM_NUMBERS], axis=1)
    fold, found = folds(len(contacts)), np.zeros_like(values)
    for one in range(FOLDS):
        train, test = np.flatnonzero(fold != one), np.flatnonzero(fold == one)
        mean = values[train].mean(axis=0)
        process = Process(film_points(contacts[train], noise), values[train] - mean, Scales(scales, np.empty(0)))
        found[test] = [process.at_contact(contacts[index]).sum(axis=0) + mean for index in test]
    return np.abs(found - values)


def film_points(contacts: Floats, noise: float) -> Scattered:
    """Return contacts as points without waves."""
    count = len(contacts)
    return Scattered(contacts, np.arange(count), np.empty((count, 0)), np.full(count, noise))


def fitted_film_scales(data: xr.Dataset, noise: float) -> Floats:
    """Return the length scales of greatest likelihood of the films."""
    contacts = contact_coordinates(data)
    values = np.stack([data[name].values.astype(float) for name in FILM_NUMBERS], axis=1)
    values -= values.mean(axis=0)
    points = film_points(contacts, noise)

    def cost(logs: Floats) -> float:
        return likelihood(points, values, Scales(np.exp(logs), np.empty(0)))

    first = np.log(FIRST_FILM_SCALES)
    limits = [(value - 2.5, value + 2.5) for value in first]
    found = minimize(cost, first, method="L-BFGS-B", bounds=limits, options={"maxiter": 30, "eps": 1e-3})
    return np.exp(found.x)


def finished(data: xr.Dataset, film_noise: float = 0.02) -> xr.Dataset:
    """Return the atlas: points with their errors, length scales, factors of the error bars, checksum."""
    data = with_noise(data)
    scales = fitted_scales(data)
    misfit = cross_validated(data, scales)
    error = np.hypot(misfit, data["discretisation"].values).astype(np.float32)
    factor = error_factor(data, misfit, error.astype(float), scales)
    film_scales = fitted_film_scales(data, film_noise)
    left = film_errors(data, film_scales, film_noise)
    film_error = np.stack(
        [np.hypot(left[:, k], data[f"{name}_discretisation"].values) for k, name in enumerate(FILM_NUMBERS)], axis=1
    )
    contacts = contact_coordinates(data)
    local = local_error(film_points(contacts, film_noise), film_error[:, 0], Scales(film_scales, np.empty(0)))
    data = data.assign(
        error=("point", error),
        **{f"{name}_error": ("contact", film_error[:, k].astype(np.float32)) for k, name in enumerate(FILM_NUMBERS)},
    )
    data.attrs |= {
        "format": FORMAT_NAME,
        "length_scales": json.dumps(
            {
                "contact": [float(f"{value:.4g}") for value in scales.contacts],
                "wave": [float(f"{value:.4g}") for value in scales.waves],
                "film": [float(f"{value:.4g}") for value in film_scales],
                "film_noise": film_noise,
            }
        ),
        "error_factor": round(factor, 3),
        "film_error_factor": round(float(np.quantile(left[:, 0] / local, COVERED)), 3),
        "cross_validated": json.dumps(quantiles(misfit)),
        "film_cross_validated": json.dumps(quantiles(left[:, 0])),
        "program": f"ehlwave {data.attrs['program_version']}, revision {data.attrs['git_revision']}",
    }
    return data


def quantiles(misfit: Floats) -> dict[str, float]:
    """Return median, 95th percentile and largest of some errors."""
    return {name: float(f"{np.quantile(misfit, share):.3g}") for name, share in (("median", 0.5), ("95 %", 0.95), ("all", 1))}
