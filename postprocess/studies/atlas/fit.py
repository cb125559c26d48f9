"""From points to the atlas file: length scales, cross-validation, error bars, compression."""

import json
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.optimize import least_squares, minimize

from ehlwave.atlas.atlas import FORMAT_NAME
from ehlwave.atlas.chart import NEIGHBOURHOOD
from ehlwave.atlas.kinds import LINE, SLIDING, Kind, kind_of
from ehlwave.atlas.process import Process, Scales, Scattered, correlation, likelihood
from ehlwave.atlas.shape import Seen
from ehlwave.atlas.sliding_shape import INSTALLED
from ehlwave.atlas.stored import (
    PARTS,
    checksum,
    contacts_alone,
    film_numbers,
    numbers_of,
    responses_of,
    seen_of,
    shape_of,
    waves_of,
)
from ehlwave.errors import ResultsError

Floats = NDArray[np.float64]

FIRST_SCALES = np.array([0.45, 6.0, 20.0, 4.5, 1.1])
FIRST_WAVE_SCALES = np.array([2.0, 1.0, 3.0, 1.5])
FIRST_SMOOTH = np.array([1.0, 4.0, 4.0, 2.0, 2.0])
FIRST_SLIDING = np.array([1.0, 4.0])
"""Of S and of the stress, beside those of contacts that roll."""

FIRST_SLIDING_WAVES = np.array([1.0, 1.0])
"""Of |a| and of the phase in pure rolling, beside those of waves in contacts that roll."""

MOST_TRAINED = 700
"""Points of which the length scales are fitted; more change them little and cost the cube."""

STEPS = 25
"""Of the search for the length scales."""

LAW_SCATTER = 0.03
"""Of the law of the two waves, units of Ai: points that miss it by more count less."""

FOLDS = 8
COVERED = 0.965
"""Share of cross-validated responses that error bars hold."""

FILMS_COVERED = 0.99
"""The same of films, of which there are fewer."""


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


def fitted_law(data: xr.Dataset) -> Floats:
    """Return the coefficients of the law of the two waves that fit the points best."""
    shape, waves = shape_of(data), waves_of(data)
    film = data["film_real"].values + 1j * data["film_imaginary"].values

    def left(law: Floats) -> Floats:
        miss = shape.with_law(law).seen(*waves).law - film
        return np.concatenate([miss.real, miss.imag])

    found = least_squares(left, INSTALLED, loss="soft_l1", f_scale=LAW_SCATTER, x_scale="jac")
    return np.asarray(found.x)


def folds(contacts: int) -> NDArray[np.intp]:
    """Return the fold of each contact."""
    return np.random.default_rng(11).permutation(contacts) % FOLDS


def cross_validated(data: xr.Dataset, seen: Seen, scales: Scales) -> Floats:
    """Return |response predicted without its contact - response|, units of Ai."""
    left = left_out(data, "film", seen, scales)
    return np.asarray(np.hypot(left[:, 0], left[:, 1]) * np.abs(seen.spread))


def left_out(data: xr.Dataset, part: str, seen: Seen, scales: Scales) -> Floats:
    """Return the errors of the numbers of a part, each predicted without its own contact."""
    points, values = numbers_of(data, part, seen)
    fold, misfit = folds(data.sizes["contact"])[points.of_contact], np.zeros_like(values)
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


def film_errors(data: xr.Dataset, scales: Scales) -> Floats:
    """Return the cross-validated errors of film numbers, shape (contacts, films)."""
    contacts, values = kind_of(data).coordinates(data), film_numbers(data)
    fold, found = folds(len(contacts)), np.zeros_like(values)
    for one in range(FOLDS):
        train, test = np.flatnonzero(fold != one), np.flatnonzero(fold == one)
        mean = values[train].mean(axis=0)
        process = Process(contacts_alone(contacts[train]), values[train] - mean, scales)
        found[test] = [process.at_contact(contacts[index]).sum(axis=0) + mean for index in test]
    return np.abs(found - values)


def finished(data: xr.Dataset) -> xr.Dataset:
    """Return the atlas: points with their errors, length scales, factors of the error bars."""
    if kind_of(data) is SLIDING:
        data.attrs["law"] = json.dumps([float(f"{value:.5g}") for value in fitted_law(data)])
    seen = seen_of(data)
    parts = [part for part in PARTS if part != "rise" or "mean_rise" in data]
    kind = kind_of(data)
    first, smooth = first_scales(kind)
    scales = {part: fitted_scales(*numbers_of(data, part, seen), first) for part in parts}
    contacts, films = contacts_alone(kind.coordinates(data)), film_numbers(data)
    scales["smooth"] = fitted_scales(contacts, films - films.mean(axis=0), smooth)
    misfit = cross_validated(data, seen, scales["film"])
    error = np.hypot(misfit, data["discretisation"].values).astype(np.float32)
    left = film_errors(data, scales["smooth"])
    missing = np.stack([data[f"{name}_discretisation"].values for name in kind.films], axis=1)
    film_error = np.hypot(left, missing)
    near = Scales(scales["smooth" if kind is SLIDING else "film"].contacts, np.empty(0))
    local = local_error(contacts, film_error[:, 0], near)
    known = ["discretisation", *(f"{name}_discretisation" for name in kind.films)]
    data = data.drop_vars(known).assign(
        error=("point", error),
        **{
            f"{name}_error": ("contact", film_error[:, k].astype(np.float32))
            for k, name in enumerate(kind.films)
        },
    )
    points = responses_of(data, seen)
    factor = error_factor(points, misfit, error.astype(float), scales["film"])
    data.attrs |= {
        "format": FORMAT_NAME,
        "length_scales": json.dumps({name: _rounded(one) for name, one in scales.items()}),
        "error_factor": round(factor, 3),
        "film_error_factor": round(float(np.quantile(left[:, 0] / local, FILMS_COVERED)), 3),
        "cross_validated": json.dumps(quantiles(misfit)),
        "film_cross_validated": json.dumps(quantiles(left[:, 0])),
        "program": "ehlwave {program_version}, revision {git_revision}".format(**data.attrs),
    }
    if "rise" in parts:
        rise_left = np.abs(left_out(data, "rise", seen, scales["rise"])[:, 0])
        data.attrs["rise_cross_validated"] = json.dumps(quantiles(rise_left))
    return data


def first_scales(kind: Kind) -> tuple[Scales, Scales]:
    """Return where the search for length scales begins, of responses and of films."""
    parts = FIRST_SCALES, FIRST_WAVE_SCALES, FIRST_SMOOTH
    if kind is SLIDING:
        more = FIRST_SLIDING, FIRST_SLIDING_WAVES, FIRST_SLIDING
        parts = tuple(map(np.append, parts, more))
    elif kind is LINE:  # no D, no direction, no width
        parts = tuple(map(np.delete, parts, (2, [1, 2], 2)))
    return Scales(*parts[:2], 0.04), Scales(parts[2], np.empty(0), 0.02)


def _rounded(scales: Scales) -> dict[str, list[float] | float]:
    def four(values: Floats) -> list[float]:
        return [float(f"{value:.4g}") for value in values]

    return {
        "contact": four(scales.contacts),
        "wave": four(scales.waves),
        "noise": float(f"{scales.noise:.4g}"),
    }


def quantiles(misfit: Floats) -> dict[str, float]:
    """Return median, 95th percentile and largest of some errors."""
    return {
        name: float(f"{np.quantile(misfit, share):.3g}")
        for name, share in (("median", 0.5), ("95 %", 0.95), ("all", 1))
    }


LONG_NAMES = {
    "responses": ("", "of each contact: those of the first come first"),
    "wavelength_over_a": ("1", "wavelength along the wave vector over the Hertz semi-axis a"),
    "angle_deg": ("degree", "angle between wave vector and rolling direction, in metres"),
    "film_real": ("1", "film response at the centre over Ai, real part"),
    "film_imaginary": (
        "1",
        "film response at the centre over Ai, imaginary part; above 0: film lags",
    ),
    "pressure_real": ("ph/c", "pressure response at the centre over Ai, real part"),
    "pressure_imaginary": ("ph/c", "pressure response at the centre over Ai, imaginary part"),
    "mean_rise": ("1", "mean film less smooth film, over the film, per (A/film)^2; one wave"),
    "error": ("1", "error of the film response, predicted from other contacts, with its own"),
    "load_parameter_m": ("1", "Moes load parameter M"),
    "lubricant_parameter_l": ("1", "Moes lubricant parameter L"),
    "radius_ratio_d": ("1", "D = Rx/Ry"),
    "pressure_viscosity_per_pa": ("1/Pa", "pressure-viscosity coefficient alpha"),
    "roelands_index": ("1", "index z of Roelands' viscosity"),
    "film_ratio": ("1", "ln of central film over Moes' formula, under slip over pure rolling"),
    "minimum_ratio": ("1", "ln of smallest over central film"),
    "rolling_real": ("1", "film response of the same wave in pure rolling, real part"),
    "rolling_imaginary": ("1", "film response of the same wave in pure rolling, imaginary part"),
    "slip_parameter": ("1", "S of the surface that is rough"),
    "stress_modulus_pa2": ("Pa2", "E' tau0, reduced modulus times Eyring stress"),
    "friction_ratio": ("1", "ln of mean shear stress over that at the centre without waves"),
}
"""Units and descriptions of what the file holds."""


PACKED = {
    "wavelength_over_a": 1.5e-4,
    "angle_deg": 90 / 32767,
    "film_real": 4e-5,
    "film_imaginary": 4e-5,
    "pressure_real": 2e-3,
    "pressure_imaginary": 2e-3,
    "rolling_real": 4e-5,
    "rolling_imaginary": 4e-5,
    "mean_rise": 1e-4,
    "error": 2e-5,
    "lubricant_parameter_l": 1e-3,
    "pressure_viscosity_per_pa": 1e-12,
    "roelands_index": 2.5e-5,
    "slip_parameter": 5e-5,
    "film_ratio": 4e-5,
    "minimum_ratio": 4e-5,
    "friction_ratio": 1e-4,
    "film_ratio_error": 1e-5,
    "minimum_ratio_error": 1e-5,
    "friction_ratio_error": 5e-5,
}
"""What is kept in two bytes, and its steps."""

MOST_STEPS = 32767

NOT_KNOWN = {"mean_rise": -32768}
"""What stands for NaN."""


def write_atlas(data: xr.Dataset, path: Path) -> None:
    """Write an atlas as classic NetCDF, a third as large as HDF5, with units and its checksum."""
    kept = {}
    for name, variable in data.variables.items():
        units, long_name = LONG_NAMES.get(str(name).removesuffix("_error"), ("1", ""))
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
    for name in PACKED.keys() & kept.keys():
        if np.nanmax(np.abs(written[name].values)) > MOST_STEPS * PACKED[name]:
            raise ResultsError(f"{path}: {name} does not fit into two bytes: change PACKED")
    packing = {
        name: {"dtype": "i2", "scale_factor": step, "_FillValue": NOT_KNOWN.get(name)}
        for name, step in PACKED.items()
        if name in written.variables
    }
    packing |= {name: {"_FillValue": None} for name in written.variables if name not in PACKED}
    for _ in range(2):  # the checksum is that of the values as they are read
        written.to_netcdf(path, engine="scipy", format="NETCDF3_CLASSIC", encoding=packing)
        with xr.open_dataset(path) as opened:
            written.attrs["checksum"] = checksum(opened.load())
