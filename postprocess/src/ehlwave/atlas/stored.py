"""The file of an atlas: its points, and the numbers of them that are interpolated."""

import hashlib
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave.atlas.coordinates import Complex, Floats
from ehlwave.atlas.process import Scattered
from ehlwave.atlas.shape import Seen

if TYPE_CHECKING:
    from ehlwave.atlas.kinds import Kind

PARTS = {"film": slice(0, 2), "pressure": slice(2, 4), "rise": slice(0, 1)}
"""What is interpolated by itself, and which of its numbers it is."""


def contact_of(data: xr.Dataset) -> NDArray[np.intp]:
    """Return the contact of each response: those of the first come first."""
    return np.repeat(np.arange(data.sizes["contact"]), data["responses"].values.astype(np.intp))


def contacts_alone(contacts: Floats) -> Scattered:
    """Return contacts, by their coordinates, as points without waves."""
    return Scattered(contacts, np.arange(len(contacts)), np.empty((len(contacts), 0)))


def waves_of(data: xr.Dataset) -> tuple[Floats, Floats]:
    """Return wavelengths over a and angles, degrees."""
    wave = data["wavelength_over_a"].values.astype(float)
    angle = data.get("angle_deg")  # line contacts have transverse waves alone
    return wave, np.zeros(wave.shape) if angle is None else angle.values.astype(float)


def seen_of(data: xr.Dataset, kind: "Kind") -> Seen:
    """Return the waves of an atlas as it sees them."""
    return kind.shape(data, data.attrs)[contact_of(data)].seen(*waves_of(data))


def responses_of(data: xr.Dataset, kind: "Kind", seen: Seen) -> Scattered:
    """Return where an atlas has responses; `seen` are its waves."""
    return Scattered(kind.coordinates(data), contact_of(data), seen.coordinates)


def numbers_of(
    data: xr.Dataset, part: str, points: Scattered, seen: Seen
) -> tuple[Scattered, Floats]:
    """Return where an atlas knows a part of the responses, and the numbers that are interpolated.

    Those of film and pressure are of :meth:`ehlwave.atlas.shape.Seen.reduced`; the rise of the mean
    film, which only single waves have, is itself.
    """
    if part == "rise":
        known = np.flatnonzero(np.isfinite(data["mean_rise"].values))
        return points[known], data["mean_rise"].values[known, None].astype(float)
    return points, seen.reduced(*computed(data))[:, PARTS[part]]


def computed(data: xr.Dataset) -> tuple[Complex, Complex]:
    """Return the responses of film and pressure."""
    film = data["film_real"].values + 1j * data["film_imaginary"].values
    return film, data["pressure_real"].values + 1j * data["pressure_imaginary"].values


def film_numbers(data: xr.Dataset, kind: "Kind") -> Floats:
    """Return the logarithms of films that are interpolated, shape (contacts, films)."""
    return np.stack([data[name].values.astype(float) for name in kind.films], axis=1)


def film_errors(data: xr.Dataset, kind: "Kind") -> Floats:
    """Return their errors."""
    return np.stack([data[f"{name}_error"].values.astype(float) for name in kind.films], axis=1)


def checksum(data: xr.Dataset) -> str:
    """Return the SHA-256 digest of all values, variables in alphabetical order."""
    digest = hashlib.sha256()
    for name in sorted(str(name) for name in data.variables):
        digest.update(name.encode() + np.ascontiguousarray(data[name].values).tobytes())
    return digest.hexdigest()
