"""From points to the atlas file: length scales, cross-validation, error bars, compression."""

import json
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.optimize import minimize

from ehlwave.atlas.atlas import (
    FILM_NUMBERS,
    FORMAT_NAME,
    NEIGHBOURHOOD,
    checksum,
    reduced_of,
    responses_of,
)
from ehlwave.atlas.coordinates import Shape, contact_coordinates
from ehlwave.atlas.process import Process, Scales, Scattered, correlation, likelihood
from ehlwave.atlas.ranges import CONTACT_RANGES

Floats = NDArray[np.float64]

FIRST_SCALES = Scales(np.array([1.4, 1.8, 4.0, 8.0, 3.0]), np.array([1.8, 1.0, 3.5, 1.4]))
FIRST_FILM_SCALES = np.array([3.0, 4.0, 4.0, 4.0, 5.0])
MOST_TRAINED = 400
"""Points of which the length scales are fitted; more change them little and cost the cube."""

FOLDS = 8
COVERED = 0.965
"""Share of cross-validated responses that error bars hold."""


def fitted_scales(data: xr.Dataset, start: Scales = FIRST_SCALES) -> Scales:
    """Return the length scales of greatest likelihood, from some of the points."""
    random = np.random.default_rng(5)
    chosen = np.sort(random.permutation(data.sizes["point"])[:MOST_TRAINED])
    whole, values = responses_of(data), reduced_of(data)[chosen]
    part = Scattered(
        whole.contacts, whole.of_contact[chosen], whole.waves[chosen], whole.noise[chosen]
    )
    count = len(start.contacts)

    def cost(logs: Floats) -> float:
        return likelihood(part, values, Scales(np.exp(logs[:count]), np.exp(logs[count:])))

    first = np.log([*start.contacts, *start.waves])
    limits = [(value - 2.5, value + 2.5) for value in first]
    found = minimize(
        cost, first, method="L-BFGS-B", bounds=limits, options={"maxiter": 8, "eps": 1e-2}
    )
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
        part = Scattered(
            points.contacts, points.of_contact[train], points.waves[train], points.noise[train]
        )
        process = Process(part, values[train], scales)
        for contact in np.unique(points.of_contact[test]):
            own = test[points.of_contact[test] == contact]
            numbers = process.at_waves(
                process.at_contact(points.contacts[contact]), points.waves[own]
            )
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
    """Return the rms error of the neighbours of each point, its own contact left out."""
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
        process = Process(
            film_points(contacts[train], noise), values[train] - mean, Scales(scales, np.empty(0))
        )
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
    found = minimize(
        cost, first, method="L-BFGS-B", bounds=limits, options={"maxiter": 12, "eps": 1e-2}
    )
    return np.exp(found.x)


def finished(data: xr.Dataset, film_noise: float = 0.02) -> xr.Dataset:
    """Return the atlas: points with their errors, length scales, factors of the error bars."""
    scales = fitted_scales(data)
    misfit = cross_validated(data, scales)
    error = np.hypot(misfit, data["discretisation"].values).astype(np.float32)
    factor = error_factor(data, misfit, error.astype(float), scales)
    film_scales = fitted_film_scales(data, film_noise)
    left = film_errors(data, film_scales, film_noise)
    film_error = np.stack(
        [
            np.hypot(left[:, k], data[f"{name}_discretisation"].values)
            for k, name in enumerate(FILM_NUMBERS)
        ],
        axis=1,
    )
    contacts = contact_coordinates(data)
    local = local_error(
        film_points(contacts, film_noise), film_error[:, 0], Scales(film_scales, np.empty(0))
    )
    data = data.assign(
        error=("point", error),
        **{
            f"{name}_error": ("contact", film_error[:, k].astype(np.float32))
            for k, name in enumerate(FILM_NUMBERS)
        },
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
        "program": "ehlwave {program_version}, revision {git_revision}".format(**data.attrs),
    }
    return data


def quantiles(misfit: Floats) -> dict[str, float]:
    """Return median, 95th percentile and largest of some errors."""
    return {
        name: float(f"{np.quantile(misfit, share):.3g}")
        for name, share in (("median", 0.5), ("95 %", 0.95), ("all", 1))
    }


LONG_NAMES = {
    "of_contact": ("", "contact of the response, counted from 0"),
    "wavelength_over_a": ("1", "wavelength along the wave vector over the Hertz semi-axis a"),
    "angle_deg": ("degree", "angle between wave vector and rolling direction, in metres"),
    "film_real": ("1", "film response at the centre over Ai, real part"),
    "film_imaginary": (
        "1",
        "film response at the centre over Ai, imaginary part; above 0: film lags",
    ),
    "pressure_real": ("ph/c", "pressure response at the centre over Ai, real part"),
    "pressure_imaginary": ("ph/c", "pressure response at the centre over Ai, imaginary part"),
    "discretisation": ("1", "estimated error of the film response at mesh size 0"),
    "noise": ("1", "standard error of what is interpolated, over its spread"),
    "error": ("1", "error of the film response, predicted from other contacts, with its own"),
    "load_parameter_m": ("1", "Moes load parameter M"),
    "lubricant_parameter_l": ("1", "Moes lubricant parameter L"),
    "radius_ratio_d": ("1", "D = Rx/Ry"),
    "pressure_viscosity_per_pa": ("1/Pa", "pressure-viscosity coefficient alpha"),
    "roelands_index": ("1", "index z of Roelands' viscosity"),
    "film_ratio": ("1", "ln of central film over that of Nijenbanning, Venner and Moes (1994)"),
    "minimum_ratio": ("1", "ln of smallest over central film"),
}
"""Units and descriptions of what the file holds."""


PACKED = {
    "angle_deg": 90 / 32767,
    "film_real": 4e-5,
    "film_imaginary": 4e-5,
    "pressure_real": 2e-3,
    "pressure_imaginary": 2e-3,
    "discretisation": 1e-6,
    "error": 1e-5,
}
"""What is kept in two bytes, and its steps."""

LEFT_OUT = ("noise",)
"""What follows from the others."""


def write_atlas(data: xr.Dataset, path: Path) -> None:
    """Write an atlas as classic NetCDF, a third as large as HDF5, with units and its checksum."""
    kept = {}
    for name, variable in data.drop_vars(LEFT_OUT, errors="ignore").variables.items():
        units, long_name = LONG_NAMES.get(
            str(name).removesuffix("_error").removesuffix("_discretisation"), ("1", "")
        )
        if str(name) not in LONG_NAMES:
            long_name = f"error of {name}: {long_name}"
        attributes = {"long_name": long_name} | ({"units": units} if units else {})
        values = variable.values
        kept[name] = (
            variable.dims,
            values.astype(np.int16 if values.dtype.kind in "ui" else np.float32),
            attributes,
        )
    written = xr.Dataset(kept, attrs=data.attrs)
    packing = {
        name: {"dtype": "i2", "scale_factor": step, "_FillValue": None}
        for name, step in PACKED.items()
    }
    packing |= {name: {"_FillValue": None} for name in written.variables if name not in PACKED}
    for _ in range(2):  # the checksum is that of the values as they are read
        written.to_netcdf(path, engine="scipy", format="NETCDF3_CLASSIC", encoding=packing)
        with xr.open_dataset(path) as opened:
            written.attrs["checksum"] = checksum(opened.load())
