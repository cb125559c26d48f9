"""The responses and films of one contact, from an atlas."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ehlwave.atlas.coordinates import Complex, Floats
from ehlwave.atlas.shape import Seen

if TYPE_CHECKING:
    from ehlwave.atlas.atlas import Atlas


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
        """Find its films, and what its responses are interpolated by."""
        self._atlas = atlas
        self._keys = keys
        self._place = atlas.kind.coordinates(keys)[0]
        self.film_numbers = atlas.film_numbers(self._place)
        """What the films are interpolated by: those that the kind of the atlas names."""
        kind = atlas.kind
        self._references = kind.references(keys)[0]
        numbers = dict(zip(kind.films, self.film_numbers, strict=True))
        state = kind.state(keys, self._references, numbers)
        self._waves = atlas.waves.at(self._place, kind.shape(state, atlas.data.attrs))

    @property
    def source(self) -> str:
        """Name of the atlas."""
        return self._atlas.name

    def film(self) -> SmoothFilm:
        """Return the smooth films, and the shear stress where the kind of the atlas has it."""
        base, ratios = self._references, np.exp(self.film_numbers)
        errors = self._atlas.film_errors(self._place)
        has_stress = "friction_ratio" in self._atlas.kind.films
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
        wave, angle, shape = _flattened(wavelength_over_a, angle_deg)
        found = self._waves.responses(self._waves.seen(wave, angle))
        film, pressure, error = (values.reshape(shape) for values in found)
        return Responses(film, pressure, error)

    def film_response(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Complex:
        """Return film responses alone; arguments as of :meth:`responses`."""
        wave, angle, shape = _flattened(wavelength_over_a, angle_deg)
        return self.film_of(self._waves.seen(wave, angle)).reshape(shape)

    def film_of(self, seen: Seen) -> Complex:
        """Return film responses alone, to waves as the contact sees them."""
        return self._waves.film(seen)

    def rise(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Floats | None:
        """Return what waves add to the mean film over the film, per (A/film)^2; None: not known.

        Second order in the amplitude A of a single wave; arguments as of :meth:`responses`.
        """
        wave, angle, shape = _flattened(wavelength_over_a, angle_deg)
        rise = self._waves.rise(self._waves.seen(wave, angle))
        return None if rise is None else rise.reshape(shape)


def _flattened(wave: ArrayLike, angle_deg: ArrayLike) -> tuple[Floats, Floats, tuple[int, ...]]:
    """Return waves as columns, and their shape."""
    waves, angles = np.broadcast_arrays(
        np.asarray(wave, dtype=float), np.asarray(angle_deg, dtype=float)
    )
    return waves.ravel(), angles.ravel(), waves.shape
