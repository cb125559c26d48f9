"""Responses of an atlas as Gaussian processes: length scales, cross-validation, error bars."""

import json

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.optimize import minimize

from ehlwave.atlas.interpolated import NEIGHBOURHOOD
from ehlwave.atlas.kinds import LINE, kind_of
from ehlwave.atlas.process import Process, Scales, Scattered, correlation, likelihood
from ehlwave.atlas.stored import PARTS, numbers_of, responses_of, seen_of
from studies.atlas.folds import FOLDS, folds, quantiles

Floats = NDArray[np.float64]

FIRST_SCALES = np.array([0.45, 6.0, 20.0, 4.5, 1.1])
FIRST_WAVE_SCALES = np.array([2.0, 1.0, 3.0, 1.5])
FIRST_NOISE = 0.04

OF_D, OF_WIDTH = 2, [1, 2]
"""Places of what line contacts have not: D; the direction of waves and their length over b."""

MOST_TRAINED = 700
"""Points of which the length scales are fitted; more change them little and cost the cube."""

STEPS = 25
"""Of the search for the length scales."""

COVERED = 0.965
"""Share of cross-validated responses that error bars hold."""


def fitted_scales(points: Scattered, values: Floats, first: Scales) -> Scales:
    """Return the length scales of greatest likelihood, from some of the points."""
    random = np.random.default_rng(5)
    chosen = np.sort(random.permutation(len(values))[:MOST_TRAINED])
    part, count = points[chosen], len(first.contacts)

    def cost(logs: Floats) -> tuple[float, Floats]:
        return likelihood(part, values[chosen], Scales.of_logs(logs, count))

    start = first.logs()
    limits = [(value - 3, value + 3) for value in start]
    found = minimize(
        cost, start, jac=True, method="L-BFGS-B", bounds=limits, options={"maxiter": STEPS}
    )
    return Scales.of_logs(found.x, count)


def interpolated(data: xr.Dataset) -> tuple[xr.Dataset, dict[str, Scales], Floats]:
    """Return the atlas with the errors of its points, length scales, and the misfits they are of.

    Misfits are |response predicted without its contact - response|, units of Ai.
    """
    kind = kind_of(data)
    seen = seen_of(data, kind)
    points = responses_of(data, kind, seen)
    parts = [part for part in PARTS if part != "rise" or "mean_rise" in data]
    first = Scales(FIRST_SCALES, FIRST_WAVE_SCALES, FIRST_NOISE)
    if kind is LINE:
        of_waves = np.delete(FIRST_WAVE_SCALES, OF_WIDTH)
        first = Scales(np.delete(FIRST_SCALES, OF_D), of_waves, FIRST_NOISE)
    scales = {part: fitted_scales(*numbers_of(data, part, points, seen), first) for part in parts}
    left = left_out(*numbers_of(data, "film", points, seen), scales["film"])
    misfit = np.hypot(left[:, 0], left[:, 1]) * np.abs(seen.spread)
    error = np.hypot(misfit, data["discretisation"].values).astype(np.float32)
    data = data.drop_vars("discretisation").assign(error=("point", error))
    factor = error_factor(points, misfit, error.astype(float), scales["film"])
    data.attrs["error_factor"] = round(factor, 3)
    if "rise" in parts:
        rises = left_out(*numbers_of(data, "rise", points, seen), scales["rise"])
        data.attrs["rise_cross_validated"] = json.dumps(quantiles(np.abs(rises[:, 0])))
    return data, scales, misfit


def left_out(points: Scattered, values: Floats, scales: Scales) -> Floats:
    """Return the errors of values, each predicted without its own contact."""
    fold, misfit = folds(len(points.contacts))[points.of_contact], np.zeros_like(values)
    for one in range(FOLDS):
        train, test = np.flatnonzero(fold != one), np.flatnonzero(fold == one)
        process = Process(points[train], values[train], scales)
        for contact in np.unique(points.of_contact[test]):
            own = test[points.of_contact[test] == contact]
            weights = process.at_contact(points.contacts[contact])
            misfit[own] = process.at_waves(weights, points.waves[own]) - values[own]
    return misfit


def error_factor(points: Scattered, misfit: Floats, error: Floats, scales: Scales) -> float:
    """Return what local errors are multiplied by to hold the wanted share of misfits.

    The local error of a point comes from other contacts alone, as it does for a new contact.
    """
    local = local_error(points, error, scales)
    return float(np.quantile(misfit / local, COVERED))


def local_error(points: Scattered, error: Floats, scales: Scales) -> Floats:
    """Return the rms error of the neighbours of each point, its own contact left out."""
    between = correlation(points.contacts, points.contacts, scales.contacts * NEIGHBOURHOOD)
    np.fill_diagonal(between, 0)
    local = np.empty(len(error))
    for block in np.array_split(np.arange(len(error)), max(1, len(error) // 500)):
        near = correlation(points.waves[block], points.waves, scales.waves * NEIGHBOURHOOD)
        near *= between[np.ix_(points.of_contact[block], points.of_contact)]
        local[block] = np.sqrt(near @ error**2 / near.sum(axis=1))
    return local
