"""From points to the atlas: responses and films with their errors."""

import json
from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave.atlas.atlas import FORMAT_NAME
from ehlwave.atlas.kinds import LINE, SLIDING, kind_of
from ehlwave.atlas.process import Process, Scales, correlation
from ehlwave.atlas.stored import contacts_alone, film_numbers
from studies.atlas.expand import expanded
from studies.atlas.folds import FOLDS, folds, quantiles
from studies.atlas.interpolate import OF_D, fitted_scales, interpolated

Floats = NDArray[np.float64]

FIRST_SMOOTH = np.array([1.0, 4.0, 4.0, 2.0, 2.0])
FIRST_SLIDING = np.array([1.0, 4.0])
"""Of S and of the stress, beside those of contacts that roll."""

FIRST_NOISE = 0.02

FILMS_COVERED = 0.975
"""Share of cross-validated films that error bars hold."""

FILM_REACH = 0.5
"""Of the scatter of each coordinate: how far errors of films are alike."""


def finished(data: xr.Dataset) -> xr.Dataset:
    """Return the atlas: length scales, errors, and what responses and films are found by."""
    kind = kind_of(data)
    contacts, films = contacts_alone(kind.coordinates(data)), film_numbers(data, kind)
    more = FIRST_SLIDING if kind is SLIDING else np.empty(0)
    rolling = np.delete(FIRST_SMOOTH, OF_D) if kind is LINE else FIRST_SMOOTH
    first = Scales(np.append(rolling, more), np.empty(0), FIRST_NOISE)
    centred = films - films.mean(axis=0)
    scales = {
        name: fitted_scales(contacts, values[:, None], first)
        for name, values in zip(kind.films, centred.T, strict=True)
    }
    left = films_left_out(contacts.contacts, films, list(scales.values()))
    if kind is SLIDING:
        data, misfit = expanded(data, as_predicted(data, left))
    else:
        data, more_scales, misfit = interpolated(data)
        scales |= more_scales
    data = with_film_errors(data, contacts.contacts, left)
    data.attrs |= {
        "format": FORMAT_NAME,
        "length_scales": json.dumps({name: _rounded(one) for name, one in scales.items()}),
        "cross_validated": json.dumps(quantiles(misfit)),
        "film_cross_validated": json.dumps(quantiles(np.abs(left[:, 0]))),
        "program": "ehlwave {program_version}, revision {git_revision}".format(**data.attrs),
    }
    return data


def as_predicted(data: xr.Dataset, left: Floats) -> xr.Dataset:
    """Return the same with film and pressure at the centres of contacts as others predict them."""
    film, _, _, pressure = left.T
    return data.assign(
        central_film=data["central_film"] * np.exp(film),
        pressure_ratio=data["pressure_ratio"] + pressure,
    )


def films_left_out(contacts: Floats, films: Floats, scales: Sequence[Scales]) -> Floats:
    """Return the errors of film numbers, (contacts, films), each predicted without its contact."""
    fold, found = folds(len(contacts)), np.zeros_like(films)
    for one in range(FOLDS):
        train, test = np.flatnonzero(fold != one), np.flatnonzero(fold == one)
        mean = films[train].mean(axis=0)
        for k, lengths in enumerate(scales):
            values = films[train, k, None] - mean[k]
            process = Process(contacts_alone(contacts[train]), values, lengths)
            found[test, k] = [process.at_contact(contacts[i]).sum() + mean[k] for i in test]
    return found - films


def with_film_errors(data: xr.Dataset, contacts: Floats, left: Floats) -> xr.Dataset:
    """Return the same with the errors of films, and what those of neighbours are multiplied by.

    The error of a contact is the rms of those of others near by, for each film times what holds
    the wanted share of errors.
    """
    films = kind_of(data).films
    names = [f"{name}_discretisation" for name in films]
    errors = np.hypot(left, np.stack([data[name].values for name in names], axis=1))
    reach = np.array([float(f"{value:.4g}") for value in FILM_REACH * contacts.std(axis=0)])
    near = correlation(contacts, contacts, reach)
    np.fill_diagonal(near, 0)
    local = np.sqrt(near @ errors**2 / near.sum(axis=1, keepdims=True))
    factors = np.quantile(np.abs(left) / local, FILMS_COVERED, axis=0)
    found = {
        f"{name}_error": ("contact", errors[:, k].astype(np.float32))
        for k, name in enumerate(films)
    }
    data = data.drop_vars(names).assign(found)
    data.attrs |= {
        "film_reach": json.dumps(reach.tolist()),
        "film_error_factors": json.dumps([round(float(factor), 3) for factor in factors]),
    }
    return data


def _rounded(scales: Scales) -> dict[str, list[float] | float]:
    def four(values: Floats) -> list[float]:
        return [float(f"{value:.4g}") for value in values]

    return {
        "contact": four(scales.contacts),
        "wave": four(scales.waves),
        "noise": float(f"{scales.noise:.4g}"),
    }
