"""Ridges along rolling under slip: they are stationary, but slip thins the oil between them.

A ridge that the inlet has flattened to R regains height on its way to the centre, as its pressure
drives oil across it: with the flow along Y of :class:`ehlwave.contact.medium.Medium`,

    d(h - 1)/dX = -r (h - 1),    r = eps_y ky^2/(rho W + rho' H),

R is the response in pure rolling, which has the flow of the same oil without slip. Slip adds the
integral I of the difference of both rates under the Hertz pressure, from X = -0.9 to the centre:

    h = 1 - (1 - R) exp(-c1 I^c2)

In a Newtonian oil slip changes no rate, so that h = R. c1, c2 and the error come from
``scripts/study judged``, which writes ``sheared_ridges.json``.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.medium import Medium, hertz_medium
from ehlwave.duals import np, to_float
from ehlwave.laws.transfer import OfTwo, Transfer, Waves

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]

START, PLACES = -0.9, 24
"""First place of the integral, units of a, and how many places it takes."""
FULL = 0.01
"""Change by slip from which on the constant part of the error is whole."""


@cache
def fitted() -> Mapping[str, Sequence[float]]:
    """Return the coefficients of the study: ``regained`` and its ``error``."""
    text = (files("ehlwave.laws") / "sheared_ridges.json").read_text(encoding="utf-8")
    found: Mapping[str, Sequence[float]] = json.loads(text)
    return found


def gained(conditions: Conditions, film: float, wavelength_over_a: ArrayLike) -> Floats:
    """Return I of ridges of these wavelengths; 0 in pure rolling and of a Newtonian oil.

    Parameters
    ----------
    conditions : Conditions
        Of the contact, with its slip.
    film : float
        H at the centre.
    wavelength_over_a : array_like
        Across rolling.
    """
    ky = 2 * np.pi / np.asarray(wavelength_over_a, dtype=np.float64)
    nodes, weights = np.polynomial.legendre.leggauss(PLACES)
    share = (nodes + 1) / 2
    found = 0.0 * ky
    for place, weight in zip(START * (1 - share), weights / 2 * -START, strict=True):
        pressure = to_float(np.sqrt(1 - place**2))
        sliding, rolling = (
            _rate(_medium(conditions, film, slip, pressure), ky)
            for slip in (conditions.slip_parameter, 1.0)
        )
        found = found + weight * (sliding - rolling)
    return np.maximum(found, 0.0)


def regained(
    rolling: ArrayLike, gain: ArrayLike, coefficients: Sequence[float] | Floats | None = None
) -> Complex:
    """Return the response under slip by that in pure rolling and I.

    Examples
    --------
    >>> from ehlwave.laws.sheared_ridges import regained
    >>> complex(regained(0.7, 0.0)).real
    0.7
    """
    c = fitted()["regained"] if coefficients is None else coefficients
    lost = 1 - np.asarray(rolling, dtype=np.complex128)
    return np.asarray(1 - lost * np.exp(-c[0] * np.asarray(gain) ** c[1]))


def ridges_under_slip(
    conditions: Conditions,
    film: float,
    wavelength_over_a: ArrayLike,
    rolling: ArrayLike,
    rolling_error: ArrayLike = 0.0,
) -> tuple[Complex, Floats]:
    """Return responses of ridges along rolling and their errors.

    Parameters
    ----------
    conditions, film, wavelength_over_a
        As of `gained`.
    rolling, rolling_error : array_like
        Responses in pure rolling, and their errors.
    """
    gain = gained(conditions, film, wavelength_over_a)
    found = regained(rolling, gain)
    before, error = np.asarray(rolling, complex), np.asarray(rolling_error, float)
    return found, np.asarray(error + error_of(np.abs(found - before)))


def error_of(change: ArrayLike, coefficients: Sequence[float] | Floats | None = None) -> Floats:
    """Return the absolute error of the change by slip, units of Ai; 0 where there is none."""
    c = fitted()["error"] if coefficients is None else coefficients
    amount = np.asarray(change, dtype=np.float64)
    return np.asarray(c[0] * np.minimum(amount / FULL, 1) + c[1] * amount)


def _medium(conditions: Conditions, film: float, slip: float, pressure: float) -> Medium:
    c = conditions
    return hertz_medium(c.oil, c.kappa, c.alphabar, c.lambdabar, film, slip, pressure)


def _rate(medium: Medium, ky: Floats) -> Floats:
    """Return r, 1/a."""
    stiffness = medium.rho * medium.deflection(0.0, ky) + medium.drho * medium.h
    return np.asarray(medium.eps_y * ky**2 / stiffness)


@dataclass(frozen=True)
class ShearedRidges(OfTwo):
    """Transfer of ridges along rolling under slip, in an oil that thins.

    Attributes
    ----------
    conditions : Conditions
        Contact with its slip.
    rolling : Transfer
        Transfer of the same contact in pure rolling.
    law : LawBasis
        Law of the two waves: it holds for the same contacts.
    """

    conditions: Conditions
    rolling: Transfer
    law: Transfer

    @property
    def name(self) -> str:
        """Return its description."""
        return f"{self.rolling.name}, with the law of ridges under slip"

    @property
    def parts(self) -> tuple[Transfer, Transfer]:
        """Return both transfers."""
        return self.rolling, self.law

    def ratio(self, per_length_x: Waves, per_length_y: Waves) -> Complex:
        """Return the transfer for waves per metre along y; those along x are 0."""
        return self._found(per_length_x, per_length_y)[0]

    def error(self, per_length_x: Waves, per_length_y: Waves) -> Waves | None:
        """Return the absolute error of the transfer."""
        return self._found(per_length_x, per_length_y)[1]

    def _found(self, per_length_x: Waves, per_length_y: Waves) -> tuple[Complex, Floats]:
        c = self.conditions
        wave = 1 / (np.asarray(per_length_y) * c.semi_axis_a_m)
        rolling = self.rolling.ratio(per_length_x, per_length_y)
        error = self.rolling.error(per_length_x, per_length_y)
        return ridges_under_slip(c, c.medium(1.0).h, wave, rolling, 0.0 if error is None else error)
