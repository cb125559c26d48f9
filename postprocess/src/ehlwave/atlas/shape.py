"""Waves as an atlas sees them: their coordinates, and what of responses is interpolated there."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ellipk

from ehlwave.atlas.coordinates import Complex, Floats, columns, hertz_film
from ehlwave.deform.conditions import MOES_KEYS, ellipticity, pressure_factor
from ehlwave.rolling import transfer_along

SomeShape = TypeVar("SomeShape", bound="Shape")

WAVE_COORDINATES = ("ln x", "angle, rad", "ln(lambda/b)", "ln(lambda/a)")

INLET_SCALE = 0.18
"""Where loads are high, (lambda/a) H^(-2/3) is V times 1.46 (scatter 18 %): 0.263 over that."""

LEAST_SHARE = 1e-9
"""Cosine below which a wave does not move."""


@dataclass(frozen=True)
class Seen:
    """Waves in contacts.

    A film response T is taken less a law, over its spread; a pressure response P as
    W P - (T - 1), 0 for plane waves in a contact without end: the film is the pattern and the
    deflection under the pressure, T = 1 + W P, W = 2/(K (kx^2 + kappa^2 ky^2)^(1/2)).

    Attributes
    ----------
    coordinates : ndarray, shape (n, k)
        In which what is left of responses hardly changes.
    law, spread : ndarray of complex
        Film responses by a law, and what they differ from it in proportion to.
    compliance : ndarray
        W, in units of c/ph.
    """

    coordinates: Floats
    law: Complex
    spread: Complex
    compliance: Floats

    def reduced(self, film: Complex, pressure: Complex) -> Floats:
        """Return the four numbers of responses, shape (n, 4)."""
        ratio = (film - self.law) / self.spread
        left = self.compliance * pressure - (film - 1)
        return np.stack([ratio.real, ratio.imag, left.real, left.imag], axis=-1)

    def film(self, numbers: Floats) -> Complex:
        """Return film responses by the first two of their numbers."""
        return np.asarray(self.law + (numbers[..., 0] + 1j * numbers[..., 1]) * self.spread)

    def pressure(self, film: Complex, numbers: Floats) -> Complex:
        """Return pressure responses by those of the film and the last two of their numbers."""
        return np.asarray((film - 1 + numbers[..., 0] + 1j * numbers[..., 1]) / self.compliance)


class Shape:
    """What turns responses of contacts that roll into numbers that hardly change, and back.

    Law and spread are the law of pure rolling, amplitude and phase. Takes M, L and D as arrays of
    one shape.
    """

    OF_ALL: tuple[str, ...] = ()
    """Names of what is not of each contact."""

    def __init__(self, m: ArrayLike, l: ArrayLike, d: ArrayLike) -> None:  # noqa: E741
        """Find what follows from M, L and D."""
        m = np.asarray(m, dtype=float)
        self.l = np.asarray(l, dtype=float)
        self.kappa = np.vectorize(ellipticity, otypes=[float])(np.asarray(d, dtype=float))
        gamma = np.vectorize(pressure_factor, otypes=[float])(self.kappa)
        self.load = gamma * m
        self._inlet = INLET_SCALE * hertz_film(m, l, d) ** (-2 / 3)
        self._pi_k = np.pi * ellipk(1 - self.kappa**2)

    @classmethod
    def of_keys(cls, keys: Mapping[str, ArrayLike], _: Mapping[str, Any]) -> "Shape":
        """Return that of contacts given by columns named as the input keys."""
        return cls(*columns(keys, MOES_KEYS))

    def __getitem__(self: SomeShape, index: NDArray[np.intp]) -> SomeShape:
        """Return the same of a choice of contacts."""
        part = type(self).__new__(type(self))
        for name, values in vars(self).items():
            setattr(part, name, values[index] if name not in self.OF_ALL else values)
        return part

    def seen(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Seen:
        """Return waves, of each contact one or all of the only contact.

        Coordinates are ln x, x = 0.18 (lambda/a) H^(-2/3) L^(1/2 - cos^2(theta)/3), the angle and
        the wavelength over b and a. x is that of the recommended formula where loads are high; at
        low ones it is smaller.
        """
        wave, theta = np.asarray(wavelength_over_a, dtype=float), np.radians(angle_deg)
        share = np.cos(theta)
        along = np.where(share > LEAST_SHARE, share**2, 0.0)
        x = self._inlet * wave * self.l ** (0.5 - along / 3)
        parts = np.log(x), theta, np.log(wave * self.kappa), np.log(wave)
        law = transfer_along(self.load, self.l, wave, along)
        coordinates = np.empty((*np.shape(law), len(parts)))
        for place, part in enumerate(parts):
            coordinates[..., place] = part
        return Seen(coordinates, law, law, wave / self._pi_k)
