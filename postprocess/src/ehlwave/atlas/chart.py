"""The responses and films of one contact, from an atlas."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ehlwave.atlas.coordinates import Complex, Floats
from ehlwave.atlas.process import correlation
from ehlwave.atlas.shape import Seen

if TYPE_CHECKING:
    from ehlwave.atlas.atlas import Atlas

NEIGHBOURHOOD = 0.5
"""Of the length scales: how far around a wave errors of neighbours count for its own."""

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


class Chart:
    """The responses of one contact."""

    def __init__(self, atlas: "Atlas", keys: Mapping[str, float]) -> None:
        """Weigh all points of the atlas by their nearness to the contact."""
        self._atlas = atlas
        self._keys = keys
        self._place = atlas.kind.coordinates(keys)[0]
        self._shape = atlas.kind.shape(keys, atlas.data.attrs)
        self._weights: dict[str, Floats] = {}
        self._near = self._nearness(atlas.contact_scales)[atlas.points.of_contact]

    @property
    def source(self) -> str:
        """Name of the atlas."""
        return self._atlas.name

    def _nearness(self, scales: Floats) -> Floats:
        """Return how much the errors of each contact count for this one."""
        contacts = self._atlas.points.contacts
        return correlation(self._place[None, :], contacts, scales * NEIGHBOURHOOD)[0]

    def film_numbers(self) -> Floats:
        """Return what the films are interpolated by: those that the kind of the atlas names."""
        atlas = self._atlas
        return np.asarray(atlas.films.at_contact(self._place).sum(axis=0) + atlas.film_means)

    def film(self) -> SmoothFilm:
        """Return the smooth films, and the shear stress where the kind of the atlas has it."""
        atlas, numbers = self._atlas, self.film_numbers()
        near = self._nearness(atlas.film_scales)
        squares = near @ atlas.film_misfit / near.sum()
        errors = np.sqrt(squares) * atlas.data.attrs["film_error_factor"]
        base, ratios = atlas.kind.references(self._keys)[0], np.exp(numbers)
        has_stress = len(numbers) > 2
        return SmoothFilm(
            central_moes=float(base[0] * ratios[0]),
            minimum_moes=float(base[1] * ratios[0] * ratios[1]),
            central_error=float(errors[0]),
            minimum_error=float(errors[:2].sum()),
            stress=float(base[2] * ratios[2]) if has_stress else None,
            stress_error=float(errors[2]) if has_stress else None,
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
        seen, shape = self._seen(wavelength_over_a, angle_deg)
        film = self.film_of(seen)
        pressure = seen.pressure(film, self._numbers("pressure", seen))
        near = self._atlas.near(seen.coordinates)
        near *= self._near
        squares = near @ self._atlas.misfit / np.maximum(near.sum(axis=1), 1e-300)
        error = np.sqrt(self._atlas.data.attrs["error_factor"] ** 2 * squares + PRECISION**2)
        return Responses(film.reshape(shape), pressure.reshape(shape), error.reshape(shape))

    def film_of(self, seen: Seen) -> Complex:
        """Return film responses alone, to waves as the contact sees them."""
        return seen.film(self._numbers("film", seen))

    def rise(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Floats | None:
        """Return what waves add to the mean film over the film, per (A/film)^2; None: not known.

        Second order in the amplitude A of a single wave; arguments as of :meth:`responses`.
        """
        if not self._atlas.has_rises:
            return None
        seen, shape = self._seen(wavelength_over_a, angle_deg)
        return self._numbers("rise", seen)[:, 0].reshape(shape)

    def film_response(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Complex:
        """Return film responses alone; arguments as of :meth:`responses`."""
        seen, shape = self._seen(wavelength_over_a, angle_deg)
        return self.film_of(seen).reshape(shape)

    def _seen(self, wavelength: ArrayLike, angle_deg: ArrayLike) -> tuple[Seen, tuple[int, ...]]:
        """Return waves, flattened, and their shape."""
        wave, angle = np.broadcast_arrays(
            np.asarray(wavelength, dtype=float), np.asarray(angle_deg, dtype=float)
        )
        return self._shape.seen(wave.ravel(), angle.ravel()), wave.shape

    def _numbers(self, part: str, seen: Seen) -> Floats:
        """Return the interpolated numbers of a part, shape (n, numbers)."""
        process = self._atlas.process(part)
        if part not in self._weights:
            self._weights[part] = process.at_contact(self._place)
        return process.at_waves(self._weights[part], seen.coordinates)
