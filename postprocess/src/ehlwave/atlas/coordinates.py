"""The coordinates in which responses are smooth, and what of them is interpolated there."""

from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ellipk

from ehlwave.atlas.ranges import CONTACT_RANGES
from ehlwave.deform.conditions import (
    MOES_KEYS,
    ellipticity,
    moes_film,
    moes_per_film,
    pressure_factor,
)
from ehlwave.formula import wave_and_direction
from ehlwave.medium import log_viscosity
from ehlwave.rolling import rolling_transfer

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
SomeShape = TypeVar("SomeShape", bound="Shape")

CONTACT_COORDINATES = ("H^(1/2)", "ln L", "ln D", "ln ph", "ln B")
WAVE_COORDINATES = ("ln x", "angle, rad", "ln(lambda/b)", "ln(lambda/a)")

INLET_SCALE = 0.18
"""Where loads are high, (lambda/a) H^(-2/3) is V times 1.46 (scatter 18 %): 0.263 over that."""


def contact_coordinates(keys: Mapping[str, ArrayLike]) -> Floats:
    """Return the coordinates of contacts, shape (c, 5), by columns named as the input keys.

    H, the central film of Moes' formula over the Hertz approach c, stands for M: the inlet is as
    long as H^(2/3) a, in contacts of any load. Its root changes most where responses do, at low
    loads. Of the oil it is the viscosity under the Hertz pressure, eta0 exp(B), that counts, more
    than alpha, z and even L by themselves; the pressure stands for the compressibility.
    """
    m, l, d, alpha, z = map(np.atleast_1d, columns(keys, CONTACT_RANGES))  # noqa: E741
    gamma = np.vectorize(lambda d: pressure_factor(ellipticity(d)), otypes=[float])(d)
    pressure = l / np.pi * (1.5 * gamma * m) ** (1 / 3) / alpha
    b = log_viscosity(alpha, z, pressure)
    parts = np.sqrt(hertz_film(m, l, d)), np.log(l), np.log(d), np.log(pressure), np.log(b)
    return np.stack(parts, axis=1)


def columns(keys: Mapping[str, ArrayLike], names: Iterable[str]) -> list[Floats]:
    """Return some columns as arrays."""
    return [np.asarray(keys[name], dtype=float) for name in names]


def hertz_film(m: ArrayLike, l: ArrayLike, d: ArrayLike) -> Floats:  # noqa: E741
    """Return the central film of Moes' formula over the Hertz approach c."""

    def film(m: float, l: float, d: float) -> float:  # noqa: E741
        return moes_film(m, l, d) / moes_per_film(m, ellipticity(d))

    return np.asarray(np.vectorize(film, otypes=[float])(m, l, d))


def wave_components(wavelength: ArrayLike, angle_deg: ArrayLike) -> tuple[Floats, Floats]:
    """Return wavelengths along X and Y, 0 for infinite, of waves of this length and direction."""
    wave, theta = np.broadcast_arrays(np.asarray(wavelength, float), np.radians(angle_deg))
    parts = []
    for share in (np.abs(np.cos(theta)), np.abs(np.sin(theta))):
        with np.errstate(divide="ignore"):
            parts.append(np.where(share > 1e-9, wave / share, 0.0))
    return parts[0], parts[1]


class Shape:
    """What turns responses of contacts into numbers that hardly change, and back.

    A film response T is divided by the law of pure rolling, amplitude and phase; a pressure
    response P is taken as W P - (T - 1), 0 for plane waves in a contact without end: the film is
    the pattern and the deflection under the pressure, T = 1 + W P, W = 2/(K (kx^2 +
    kappa^2 ky^2)^(1/2)).

    Takes M, L and D as arrays of one shape.
    """

    OF_ALL: tuple[str, ...] = ()
    """Names of what is not of each contact."""

    def __init__(self, m: ArrayLike, l: ArrayLike, d: ArrayLike) -> None:  # noqa: E741
        """Find what follows from M, L and D."""
        self.m, self.l = np.asarray(m, dtype=float), np.asarray(l, dtype=float)
        self.film = hertz_film(m, l, d)
        self.kappa = np.vectorize(ellipticity, otypes=[float])(np.asarray(d, dtype=float))
        self.gamma = np.vectorize(pressure_factor, otypes=[float])(self.kappa)
        self._k = ellipk(1 - self.kappa**2)

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

    def parameter(self, wavelength: ArrayLike, angle_deg: ArrayLike) -> Floats:
        """Return x = 0.18 (lambda/a) H^(-2/3) L^(1/2 - cos^2(theta)/3).

        That of the recommended formula where loads are high; at low ones it is smaller.
        """
        wave, along = wave_and_direction(*wave_components(wavelength, angle_deg))
        return INLET_SCALE * wave * self.film ** (-2 / 3) * self.l ** (0.5 - along / 3)

    def wave_coordinates(self, wavelength: ArrayLike, angle_deg: ArrayLike) -> Floats:
        """Return the coordinates of waves, shape (n, 4)."""
        wave = np.asarray(wavelength, dtype=float)
        log_x = np.log(self.parameter(wave, angle_deg))
        parts = log_x, np.radians(angle_deg), np.log(wave * self.kappa), np.log(wave)
        return np.stack(np.broadcast_arrays(*parts), axis=-1)

    def reduced(
        self, wavelength: ArrayLike, angle_deg: ArrayLike, film: Complex, pressure: Complex
    ) -> Floats:
        """Return the four numbers of responses, shape (n, 4)."""
        law, spread = self.law_and_spread(wavelength, angle_deg)
        ratio = (film - law) / spread
        left = self.compliance(wavelength) * pressure - (film - 1)
        return np.stack([ratio.real, ratio.imag, left.real, left.imag], axis=-1)

    def responses(
        self, wavelength: ArrayLike, angle_deg: ArrayLike, numbers: Floats
    ) -> tuple[Complex, Complex]:
        """Return film and pressure responses, the inverse of :meth:`reduced`."""
        law, spread = self.law_and_spread(wavelength, angle_deg)
        film = law + (numbers[..., 0] + 1j * numbers[..., 1]) * spread
        pressure = (film - 1 + numbers[..., 2] + 1j * numbers[..., 3]) / self.compliance(wavelength)
        return film, pressure

    def law_and_spread(
        self, wavelength: ArrayLike, angle_deg: ArrayLike
    ) -> tuple[Complex, Complex]:
        """Return a law, and what film responses differ from it in proportion to: here itself."""
        law = self.formula(wavelength, angle_deg)
        return law, law

    def formula(self, wavelength: ArrayLike, angle_deg: ArrayLike) -> Complex:
        """Return the law of pure rolling."""
        waves = wave_components(wavelength, angle_deg)
        return rolling_transfer(self.m, self.l, self.gamma, *waves)

    def compliance(self, wavelength: ArrayLike) -> Floats:
        """Return W = (lambda/a)/(pi K), in units of c/ph."""
        return np.asarray(wavelength, dtype=float) / (np.pi * self._k)
