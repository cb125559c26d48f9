"""The file of an atlas: its points, and the numbers of them that are interpolated."""

import hashlib

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave.atlas.coordinates import Floats
from ehlwave.atlas.kinds import kind_of
from ehlwave.atlas.process import Scattered
from ehlwave.atlas.shape import Seen, Shape
from ehlwave.atlas.sliding_shape import SlidingShape

PARTS = {"film": slice(0, 2), "pressure": slice(2, 4), "rise": slice(0, 1)}
"""What is interpolated by itself, and which of its numbers it is."""


def contact_of(data: xr.Dataset) -> NDArray[np.intp]:
    """Return the contact of each response: those of the first come first."""
    return np.repeat(np.arange(data.sizes["contact"]), data["responses"].values.astype(np.intp))


def contacts_alone(contacts: Floats) -> Scattered:
    """Return contacts, by their coordinates, as points without waves."""
    return Scattered(contacts, np.arange(len(contacts)), np.empty((len(contacts), 0)))


def shape_of(data: xr.Dataset) -> Shape:
    """Return what turns responses into numbers, for each of them."""
    shape = kind_of(data).shape(data, data.attrs)[contact_of(data)]
    if isinstance(shape, SlidingShape):
        return shape.with_rolling(
            data["rolling_real"].values + 1j * data["rolling_imaginary"].values
        )
    return shape


def waves_of(data: xr.Dataset) -> tuple[Floats, Floats]:
    """Return wavelengths over a and angles, degrees."""
    wave = data["wavelength_over_a"].values.astype(float)
    angle = data.get("angle_deg")  # line contacts have transverse waves alone
    return wave, np.zeros(wave.shape) if angle is None else angle.values.astype(float)


def seen_of(data: xr.Dataset) -> Seen:
    """Return the waves of an atlas as it sees them."""
    return shape_of(data).seen(*waves_of(data))


def responses_of(data: xr.Dataset, seen: Seen) -> Scattered:
    """Return where an atlas has responses; `seen` are its waves."""
    return Scattered(kind_of(data).coordinates(data), contact_of(data), seen.coordinates)


def numbers_of(data: xr.Dataset, part: str, seen: Seen) -> tuple[Scattered, Floats]:
    """Return where an atlas knows a part of the responses, and the numbers that are interpolated.

    Those of film and pressure are of :meth:`ehlwave.atlas.shape.Seen.reduced`; the rise of the mean
    film, which only single waves have, is itself.
    """
    points = responses_of(data, seen)
    if part == "rise":
        known = np.flatnonzero(np.isfinite(data["mean_rise"].values))
        return points[known], data["mean_rise"].values[known, None].astype(float)
    film = data["film_real"].values + 1j * data["film_imaginary"].values
    pressure = data["pressure_real"].values + 1j * data["pressure_imaginary"].values
    return points, seen.reduced(film, pressure)[:, PARTS[part]]


def film_numbers(data: xr.Dataset) -> Floats:
    """Return the logarithms of films that are interpolated, shape (contacts, films)."""
    return np.stack([data[name].values.astype(float) for name in kind_of(data).films], axis=1)


def film_errors(data: xr.Dataset) -> Floats:
    """Return their errors."""
    names = [f"{name}_error" for name in kind_of(data).films]
    return np.stack([data[name].values.astype(float) for name in names], axis=1)


def checksum(data: xr.Dataset) -> str:
    """Return the SHA-256 digest of all values, variables in alphabetical order."""
    digest = hashlib.sha256()
    for name in sorted(str(name) for name in data.variables):
        digest.update(name.encode() + np.ascontiguousarray(data[name].values).tobytes())
    return digest.hexdigest()
