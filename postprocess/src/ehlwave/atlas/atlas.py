"""The atlas file, and its answers for a contact."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from ehlwave.atlas.coordinates import Complex, Floats, Shape, contact_coordinates
from ehlwave.atlas.process import Correlation, Process, Scales, Scattered, correlation
from ehlwave.atlas.ranges import CONTACT_RANGES
from ehlwave.errors import RangeError, ResultsError

FORMAT_NAME = "ehlwave-atlas"
SHIPPED = Path(__file__).with_name("rolling.nc")

NEIGHBOURHOOD = 0.5
"""Of the length scales: how far around a wave errors of neighbours count for its own."""

PARTS = {"film": slice(0, 2), "pressure": slice(2, 4), "rise": slice(0, 1)}
"""What is interpolated by itself, and which of its numbers it is."""

FILM_NUMBERS = ("film_ratio", "minimum_ratio")
"""Of contacts: ln of central over Moes' film, ln of smallest over central film."""

PRECISION = 1e-4
"""Of the responses in the file and of the arithmetic, in units of Ai."""


@dataclass(frozen=True)
class SmoothFilm:
    """Films of a smooth contact and their relative errors, two standard deviations.

    Attributes
    ----------
    central_moes, minimum_moes : float
        In the Moes scale, (h/Rx)(2U)^(-1/2) for elliptical contacts.
    central_error, minimum_error : float
        Relative; what 95 % of films computed anew keep to.
    """

    central_moes: float
    minimum_moes: float
    central_error: float
    minimum_error: float


@dataclass(frozen=True)
class Responses:
    """Responses at the contact centre to waves, arrays of one shape.

    Attributes
    ----------
    film : ndarray of complex
        Film over Ai; the surface is exp(i(kx X - w T)), positive where it widens the gap.
    pressure : ndarray of complex
        Amplitude of P over Ai, in units of ph/c.
    error : ndarray
        Of ``film``, absolute, in units of Ai; what 95 % of responses computed anew keep to.
    """

    film: Complex
    pressure: Complex
    error: Floats


class Atlas:
    """Computed responses and films, interpolated between contacts and waves.

    Parameters
    ----------
    data : xarray.Dataset
        As :func:`load_atlas` reads it; ``scripts/atlas`` makes it.
    """

    def __init__(self, data: xr.Dataset) -> None:
        """Solve for the weights of all points: a second for 4000 of them."""
        if data.attrs.get("format") != FORMAT_NAME:
            raise ResultsError(f"not a file of scripts/atlas (format {data.attrs.get('format')!r})")
        self.data = data
        self.scales = {
            name: Scales(np.array(one["contact"]), np.array(one["wave"]), one["noise"])
            for name, one in json.loads(data.attrs["length_scales"]).items()
        }
        self.points = responses_of(data)
        self.near = Correlation(self.points.waves, self.scales["film"].waves * NEIGHBOURHOOD)
        self._processes: dict[str, Process] = {}
        films = np.stack([data[name].values for name in FILM_NUMBERS], axis=1)
        self._film_means = films.mean(axis=0)
        of_films = contacts_alone(contact_coordinates(data))
        self._films = Process(of_films, films - self._film_means, self.scales["smooth"])
        self._misfit = data["error"].values.astype(float) ** 2
        self._film_misfit = (
            np.stack([data[f"{name}_error"].values for name in FILM_NUMBERS], axis=1) ** 2
        )

    def process(self, part: str) -> Process:
        """Return the interpolation of a part of the responses; its weights are found once."""
        if part not in self._processes:
            points, values = numbers_of(self.data, part)
            self._processes[part] = Process(points, values, self.scales[part])
        return self._processes[part]

    @property
    def has_rises(self) -> bool:
        """Whether it knows what waves add to the mean film."""
        return "mean_rise" in self.data

    @property
    def name(self) -> str:
        """What it is and where it comes from."""
        data = self.data
        return (
            f"atlas of {data.sizes['point']} responses of {data.sizes['contact']} contacts "
            f"({data.attrs['program']}, {data.attrs['checksum'][:8]})"
        )

    @property
    def contact_scales(self) -> Floats:
        """Lengths over which responses change with the coordinates of the contact."""
        return self.scales["film"].contacts

    def at(self, keys: Mapping[str, float]) -> "Chart":
        """Return the chart of one contact.

        Parameters
        ----------
        keys : mapping
            Those of :data:`ehlwave.atlas.ranges.CONTACT_RANGES`.

        Raises
        ------
        RangeError
            If one lies outside its range.
        """
        for key, (low, high) in CONTACT_RANGES.items():
            if not low * (1 - 1e-9) <= keys[key] <= high * (1 + 1e-9):
                raise RangeError(
                    f"{key} = {keys[key]:.5g} lies outside the atlas, which holds {low:g} to "
                    f"{high:g}: name a formula, or compute it (ehlwave.Case, a harmonic table)"
                )
        return Chart(self, keys)


class Chart:
    """The responses of one contact."""

    def __init__(self, atlas: Atlas, keys: Mapping[str, float]) -> None:
        """Weigh all points of the atlas by their nearness to the contact."""
        self._atlas = atlas
        self._place = contact_coordinates(keys)[0]
        self._shape = Shape(*(keys[name] for name in list(CONTACT_RANGES)[:3]))
        self._weights: dict[str, Floats] = {}
        wide = atlas.contact_scales * NEIGHBOURHOOD
        self._near = correlation(self._place[None, :], atlas.points.contacts, wide)[0]

    def film(self, moes: float) -> SmoothFilm:
        """Return the smooth films; `moes` is the central film of Moes' formula in his scale."""
        films, atlas = self._atlas._films, self._atlas
        numbers = films.at_contact(self._place).sum(axis=0) + atlas._film_means
        squares = self._near @ atlas._film_misfit / self._near.sum()
        central = moes * float(np.exp(numbers[0]))
        errors = np.sqrt(squares) * atlas.data.attrs["film_error_factor"]
        return SmoothFilm(
            central, central * float(np.exp(numbers[1])), float(errors[0]), float(errors.sum())
        )

    def responses(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Responses:
        """Return responses to waves of these lengths along their wave vectors and directions.

        Parameters
        ----------
        wavelength_over_a : array_like
            0.1 to 4; nothing is checked here.
        angle_deg : array_like
            Between wave vector and rolling direction, in metres, 0 to 90; shape of the wavelengths.
        """
        atlas = self._atlas
        wave, angle = np.broadcast_arrays(
            np.asarray(wavelength_over_a, float), np.asarray(angle_deg, float)
        )
        places = self._shape.wave_coordinates(wave, angle)
        numbers = [self._numbers(part, places) for part in ("film", "pressure")]
        film, pressure = self._shape.responses(wave, angle, np.concatenate(numbers, axis=-1))
        near = atlas.near(places.reshape(-1, 4))
        near *= self._near[atlas.points.of_contact]
        squares = near @ atlas._misfit / np.maximum(near.sum(axis=1), 1e-300)
        factor = atlas.data.attrs["error_factor"]
        return Responses(
            film, pressure, np.sqrt(factor**2 * squares.reshape(wave.shape) + PRECISION**2)
        )

    def rise(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Floats | None:
        """Return what waves add to the mean film over the film, per (A/film)^2; None: not known.

        Second order in the amplitude A of a single wave; arguments as of :meth:`responses`.
        """
        if not self._atlas.has_rises:
            return None
        wave, angle = np.broadcast_arrays(
            np.asarray(wavelength_over_a, float), np.asarray(angle_deg, float)
        )
        return self._numbers("rise", self._shape.wave_coordinates(wave, angle))[..., 0]

    def _numbers(self, part: str, places: Floats) -> Floats:
        """Return the interpolated numbers of a part for coordinates of waves, each in the last."""
        process = self._atlas.process(part)
        if part not in self._weights:
            self._weights[part] = process.at_contact(self._place)
        found = process.at_waves(self._weights[part], places.reshape(-1, 4))
        return found.reshape(*places.shape[:-1], -1)


def contacts_alone(contacts: Floats) -> Scattered:
    """Return contacts, by their coordinates, as points without waves."""
    return Scattered(contacts, np.arange(len(contacts)), np.empty((len(contacts), 0)))


def contact_of(data: xr.Dataset) -> NDArray[np.intp]:
    """Return the contact of each response: those of the first come first."""
    return np.repeat(np.arange(data.sizes["contact"]), data["responses"].values.astype(np.intp))


def shape_of(data: xr.Dataset) -> Shape:
    """Return what turns responses into numbers, for each of them."""
    return Shape(*(data[name].values for name in list(CONTACT_RANGES)[:3]))[contact_of(data)]


def responses_of(data: xr.Dataset) -> Scattered:
    """Return where an atlas has responses."""
    waves = shape_of(data).wave_coordinates(*waves_of(data))
    return Scattered(contact_coordinates(data), contact_of(data), waves)


def waves_of(data: xr.Dataset) -> tuple[Floats, Floats]:
    """Return wavelengths over a and angles, degrees."""
    return data["wavelength_over_a"].values.astype(float), data["angle_deg"].values.astype(float)


def numbers_of(data: xr.Dataset, part: str) -> tuple[Scattered, Floats]:
    """Return where an atlas knows a part of the responses, and the numbers that are interpolated.

    Those of film and pressure are of :meth:`ehlwave.atlas.coordinates.Shape.reduced`; the rise of
    the mean film, which only single waves have, is itself.
    """
    points = responses_of(data)
    if part == "rise":
        known = np.flatnonzero(np.isfinite(data["mean_rise"].values))
        return points[known], data["mean_rise"].values[known, None].astype(float)
    film = data["film_real"].values + 1j * data["film_imaginary"].values
    pressure = data["pressure_real"].values + 1j * data["pressure_imaginary"].values
    return points, shape_of(data).reduced(*waves_of(data), film, pressure)[:, PARTS[part]]


@lru_cache(maxsize=4)
def load_atlas(path: str | Path = SHIPPED) -> Atlas:
    """Return the atlas of a file, by default the one of this package; read once a process.

    Raises
    ------
    ResultsError
        If it cannot be read, is none, or its checksum is not that of its data.
    """
    try:
        with xr.open_dataset(path) as opened:
            data = opened.load()
    except (OSError, ValueError) as error:
        raise ResultsError(f"{path}: cannot be read as an atlas ({error})") from error
    if checksum(data) != data.attrs.get("checksum"):
        raise ResultsError(f"{path}: its checksum is not that of its data: the file is damaged")
    return Atlas(data)


def checksum(data: xr.Dataset) -> str:
    """Return the SHA-256 digest of all values, variables in alphabetical order."""
    digest = hashlib.sha256()
    for name in sorted(str(name) for name in data.variables):
        digest.update(name.encode() + np.ascontiguousarray(data[name].values).tobytes())
    return digest.hexdigest()
