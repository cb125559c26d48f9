"""The coordinates in which responses are smooth, and what of them is interpolated there."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ellipk

from ehlwave.atlas.ranges import CONTACT_RANGES
from ehlwave.deform.conditions import ellipticity, pressure_factor
from ehlwave.formula import recommended_parameter, recommended_ratio

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

LINEAR = ("roelands_index",)
"""Coordinates of a contact that are not logarithms."""


def contact_coordinates(keys: Mapping[str, ArrayLike], names: tuple[str, ...] = tuple(CONTACT_RANGES)) -> Floats:
    """Return the coordinates of contacts, shape (c, k), by columns named as the input keys."""
    columns = [np.atleast_1d(np.asarray(keys[name], dtype=float)) for name in names]
    return np.stack(
        [column if name in LINEAR else np.log(column) for name, column in zip(names, columns, strict=True)], axis=1
    )


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

    A film response T is divided by the recommended formula F(x) for its modulus; a pressure response
    P is taken as W P - (T - 1), 0 for plane waves in a contact without end: the film is the pattern
    and the deflection under the pressure, T = 1 + W P, W = 2/(K (kx^2 + kappa^2 ky^2)^(1/2)).

    Takes M, L and D as arrays of one shape.
    """

    def __init__(self, m: ArrayLike, l: ArrayLike, d: ArrayLike) -> None:  # noqa: E741
        """Find what follows from M, L and D."""
        self.m, self.l, d = (np.asarray(value, dtype=float) for value in (m, l, d))
        kappa = np.vectorize(ellipticity, otypes=[float])(d)
        self.gamma = np.vectorize(pressure_factor, otypes=[float])(kappa)
        self._k = ellipk(1 - kappa**2)

    def __getitem__(self, index: NDArray[np.intp]) -> "Shape":
        """Return the same of a choice of contacts."""
        part = Shape.__new__(Shape)
        part.m, part.l, part.gamma, part._k = (values[index] for values in (self.m, self.l, self.gamma, self._k))
        return part

    def wave_coordinates(self, wavelength: ArrayLike, angle_deg: ArrayLike) -> Floats:
        """Return ln x of the recommended formula and the angle, radian: shape (n, 2)."""
        waves = wave_components(wavelength, angle_deg)
        log_x = np.log(recommended_parameter(self.m, self.l, self.gamma, *waves))
        return np.stack(np.broadcast_arrays(log_x, np.radians(angle_deg)), axis=-1)

    def reduced(self, wavelength: ArrayLike, angle_deg: ArrayLike, film: Complex, pressure: Complex) -> Floats:
        """Return the four numbers of responses, shape (n, 4)."""
        ratio = film / self.formula(wavelength, angle_deg) - 1
        left = self.compliance(wavelength) * pressure - (film - 1)
        return np.stack([ratio.real, ratio.imag, left.real, left.imag], axis=-1)

    def responses(self, wavelength: ArrayLike, angle_deg: ArrayLike, numbers: Floats) -> tuple[Complex, Complex]:
        """Return film and pressure responses, the inverse of :meth:`reduced`."""
        film = (1 + numbers[..., 0] + 1j * numbers[..., 1]) * self.formula(wavelength, angle_deg)
        pressure = (film - 1 + numbers[..., 2] + 1j * numbers[..., 3]) / self.compliance(wavelength)
        return film, pressure

    def formula(self, wavelength: ArrayLike, angle_deg: ArrayLike) -> Floats:
        """Return Ad/Ai of the recommended formula."""
        return recommended_ratio(self.m, self.l, self.gamma, *wave_components(wavelength, angle_deg))

    def compliance(self, wavelength: ArrayLike) -> Floats:
        """Return W = (lambda/a)/(pi K), in units of c/ph."""
        return np.asarray(wavelength, dtype=float) / (np.pi * self._k)
