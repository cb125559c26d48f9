"""The atlas of contacts that slide: the law of the two waves and its corrections, fitted."""

import json
from collections.abc import Iterator

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.optimize import least_squares

from ehlwave.atlas.expanded import seen_in
from ehlwave.atlas.sliding_shape import INSTALLED, SlidingSeen, SlidingShape
from ehlwave.atlas.stored import computed, contact_of, waves_of
from studies.atlas.correct import PRIOR, fitted_error, fitted_film, fitted_pressure
from studies.atlas.folds import FOLDS, folds
from studies.atlas.kernels import Basis, chosen_centres, kernel_scales

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]

LAW_SCATTER = 0.03
"""Of film responses about the law alone, units of Ai: those that miss it by more count less."""

COVERED = 0.965
"""Share of cross-validated responses that error bars hold."""

WAVES = ("wavelength_over_a", "angle_deg", "rolling_real", "rolling_imaginary")
"""What the file has of the centres; other points are in it by what was fitted to them."""


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
