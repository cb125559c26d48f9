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

from ehlwave.atlas.coordinates import Complex, Floats, Shape
from ehlwave.atlas.kinds import ROLLING, SLIDING, Kind, kind_of
from ehlwave.atlas.process import Correlation, Process, Scales, Scattered, correlation
from ehlwave.atlas.sliding import SlidingShape, conditions_of, mean_stress, rolling_film
from ehlwave.deform.conditions import Conditions
from ehlwave.errors import RangeError, ResultsError

FORMAT_NAME = "ehlwave-atlas"

NEIGHBOURHOOD = 0.5
"""Of the length scales: how far around a wave errors of neighbours count for its own."""

PARTS = {"film": slice(0, 2), "pressure": slice(2, 4), "rise": slice(0, 1)}
"""What is interpolated by itself, and which of its numbers it is."""

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
    stress : float or None
        Friction under slip of a Ree-Eyring oil: mean shear stress over the Eyring stress; None in
        pure rolling.
    stress_error : float or None
        Relative.
    """

    central_moes: float
    minimum_moes: float
    central_error: float
    minimum_error: float
    stress: float | None = None
    stress_error: float | None = None


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
        self.kind: Kind = kind_of(data)
        self.scales = {
            name: Scales(np.array(one["contact"]), np.array(one["wave"]), one["noise"])
            for name, one in json.loads(data.attrs["length_scales"]).items()
        }
        self._shape = shape_of(data)
        self.points = responses_of(data, self._shape)
        self.near = Correlation(self.points.waves, self.scales["film"].waves * NEIGHBOURHOOD)
        self._processes: dict[str, Process] = {}
        films = np.stack([data[name].values for name in self.kind.films], axis=1)
        self._film_means = films.mean(axis=0)
        of_films = contacts_alone(self.points.contacts)
        self._films = Process(of_films, films - self._film_means, self.scales["smooth"])
        self._misfit = data["error"].values.astype(float) ** 2
        self._film_misfit = (
            np.stack([data[f"{name}_error"].values for name in self.kind.films], axis=1) ** 2
        )

    def process(self, part: str) -> Process:
        """Return the interpolation of a part of the responses; its weights are found once."""
        if part not in self._processes:
            points, values = numbers_of(self.data, part, self._shape)
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

    @property
    def film_scales(self) -> Floats:
        """Lengths over which errors of films are alike."""
        return self.scales["smooth" if self.kind is SLIDING else "film"].contacts

    def at(self, keys: Mapping[str, float]) -> "Chart":
        """Return the chart of one contact.

        Parameters
        ----------
        keys : mapping
            Those of its kind: :mod:`ehlwave.atlas.ranges`.

        Raises
        ------
        RangeError
            If one lies outside its range.
        """
        for key, (low, high) in self.kind.ranges.items():
            if not low * (1 - 1e-9) <= keys[key] <= high * (1 + 1e-9):
                name = "eyring_stress_pa reduced_modulus_pa" if "stress" in key else key
                raise RangeError(
                    f"{name} = {keys[key]:.5g} lies outside the atlas, which holds {low:g} to "
                    f"{high:g}: name a formula, or compute it (ehlwave.Case, a harmonic table)"
                )
        return Chart(self, keys)


class Chart:
    """The responses of one contact."""

    def __init__(self, atlas: Atlas, keys: Mapping[str, float]) -> None:
        """Weigh all points of the atlas by their nearness to the contact."""
        self._atlas = atlas
        self._keys = keys
        self._place = atlas.kind.coordinates(keys)[0]
        self._shape = atlas.kind.shape(keys, atlas.data.attrs)
        self._weights: dict[str, Floats] = {}
        self._near = self._nearness(atlas.contact_scales)

    def _nearness(self, scales: Floats) -> Floats:
        """Return how much the errors of each contact count for this one."""
        contacts = self._atlas.points.contacts
        return correlation(self._place[None, :], contacts, scales * NEIGHBOURHOOD)[0]

    def film_numbers(self) -> Floats:
        """Return what the films are interpolated by: those that the kind of the atlas names."""
        atlas = self._atlas
        return np.asarray(atlas._films.at_contact(self._place).sum(axis=0) + atlas._film_means)

    def film(self, moes: float) -> SmoothFilm:
        """Return the smooth films; `moes` is the central film of Moes' formula in his scale."""
        atlas, numbers = self._atlas, self.film_numbers()
        near = self._nearness(atlas.film_scales)
        squares = near @ atlas._film_misfit / near.sum()
        errors = np.sqrt(squares) * atlas.data.attrs["film_error_factor"]
        base, smallest, stress = moes, moes, None
        if atlas.kind is SLIDING:
            contact = conditions_of(self._keys)[0]
            base, smallest = rolling_film(contact)
            stress = float(np.exp(numbers[2])) * mean_stress(contact)
        central = float(np.exp(numbers[0]))
        return SmoothFilm(
            central_moes=base * central,
            minimum_moes=smallest * central * float(np.exp(numbers[1])),
            central_error=float(errors[0]),
            minimum_error=float(errors[:2].sum()),
            stress=stress,
            stress_error=None if stress is None else float(errors[2]),
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
        near = atlas.near(places.reshape(-1, places.shape[-1]))
        near *= self._near[atlas.points.of_contact]
        squares = near @ atlas._misfit / np.maximum(near.sum(axis=1), 1e-300)
        factor = atlas.data.attrs["error_factor"]
        return Responses(
            film.reshape(wave.shape),
            pressure.reshape(wave.shape),
            np.sqrt(factor**2 * squares.reshape(wave.shape) + PRECISION**2),
        )

    def film_response(self, wavelength_over_a: Floats, angle_deg: Floats) -> Complex:
        """Return film responses alone; arguments as of :meth:`responses`, arrays of one shape."""
        places = self._shape.wave_coordinates(wavelength_over_a, angle_deg)
        numbers = self._numbers("film", places)
        law, spread = self._shape.law_and_spread(wavelength_over_a, angle_deg)
        return np.asarray(law + (numbers[..., 0] + 1j * numbers[..., 1]) * spread)

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
        found = process.at_waves(self._weights[part], places.reshape(-1, places.shape[-1]))
        return found.reshape(*places.shape[:-1], -1)


def contacts_alone(contacts: Floats) -> Scattered:
    """Return contacts, by their coordinates, as points without waves."""
    return Scattered(contacts, np.arange(len(contacts)), np.empty((len(contacts), 0)))


def contact_of(data: xr.Dataset) -> NDArray[np.intp]:
    """Return the contact of each response: those of the first come first."""
    return np.repeat(np.arange(data.sizes["contact"]), data["responses"].values.astype(np.intp))


def shape_of(data: xr.Dataset) -> Shape:
    """Return what turns responses into numbers, for each of them."""
    shape = kind_of(data).shape(data, data.attrs)[contact_of(data)]
    if isinstance(shape, SlidingShape):
        known = data["rolling_real"].values + 1j * data["rolling_imaginary"].values
        return shape.with_rolling(known)
    return shape


def responses_of(data: xr.Dataset, known: Shape | None = None) -> Scattered:
    """Return where an atlas has responses; `known` is :func:`shape_of` the data."""
    waves = (known or shape_of(data)).wave_coordinates(*waves_of(data))
    return Scattered(kind_of(data).coordinates(data), contact_of(data), waves)


def waves_of(data: xr.Dataset) -> tuple[Floats, Floats]:
    """Return wavelengths over a and angles, degrees."""
    return data["wavelength_over_a"].values.astype(float), data["angle_deg"].values.astype(float)


def numbers_of(data: xr.Dataset, part: str, known: Shape | None = None) -> tuple[Scattered, Floats]:
    """Return where an atlas knows a part of the responses, and the numbers that are interpolated.

    Those of film and pressure are of :meth:`ehlwave.atlas.coordinates.Shape.reduced`; the rise of
    the mean film, which only single waves have, is itself.
    """
    shape = known or shape_of(data)
    points = responses_of(data, shape)
    if part == "rise":
        known = np.flatnonzero(np.isfinite(data["mean_rise"].values))
        return points[known], data["mean_rise"].values[known, None].astype(float)
    film = data["film_real"].values + 1j * data["film_imaginary"].values
    pressure = data["pressure_real"].values + 1j * data["pressure_imaginary"].values
    return points, shape.reduced(*waves_of(data), film, pressure)[:, PARTS[part]]


def shipped(kind: Kind) -> Path:
    """Return the file of this package."""
    return Path(__file__).with_name(f"{kind.name}.nc")


SHIPPED = shipped(ROLLING)
"""The atlas of contacts that roll."""


def atlas_for(conditions: Conditions, atlas: Atlas | None = None) -> Atlas:
    """Return the atlas that a contact is looked up in: this one if it is of the kind, else ours.

    A Ree-Eyring oil under slip has one of its own; all else rolls as far as the atlas knows.
    """
    kind = SLIDING if conditions.has_sliding_atlas else ROLLING
    return atlas if atlas is not None and atlas.kind is kind else load_atlas(shipped(kind))


@lru_cache(maxsize=4)
def load_atlas(path: str | Path = SHIPPED) -> Atlas:
    """Return the atlas of a file, by default the one of this package for contacts that roll.

    Read once a process.

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
