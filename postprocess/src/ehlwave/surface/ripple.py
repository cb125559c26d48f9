"""The pressure that a rough surface makes inside a lubricated contact, wave by wave.

Film and pressure belong together: h = r + W p, r positive where it widens the gap. In pure rolling
a film T r has the pressure p = (E'/4) k (T - 1) r. Under slip the film is two waves, each with its
own wave number and so its own depth of stress:

    p = (E'/4) [k (a - 1) exp(i kx X) + kappa c exp(i psi X)] exp(-i w t),
    k^2 = kx^2 + ky^2,   kappa^2 = psi^2 + ky^2,   a + c = T at the contact centre.

a and psi are known in closed form (:mod:`ehlwave.contact.medium`), T is the atlas' or of a law.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.error_bars import bar
from ehlwave.errors import StressError
from ehlwave.laws.transfer import FormulaBasis, Transfer

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

USUAL_ERROR = bar("ripple.response")
"""Error of the response, units of the amplitude, where the transfer has none."""

LARGEST_UPSTREAM = bar("ripple.upstream")
"""Units of the amplitude: limit of the error of the complementary wave upstream of the centre.
Where the wave decays fast its error is unknown there, and limited to this.
"""


@dataclass(frozen=True)
class PressureWaves:
    """Pressure per amplitude of waves at the contact centre; arrays of equal shape."""

    number_x: Floats
    number_y: Floats
    """`number_x`, `number_y`: wave numbers of the surface, 1/m; along x 0 or more."""
    attenuated: Complex
    complementary: Complex
    """`attenuated`, `complementary`: pressure of both waves at X = 0 over the amplitude, Pa/m."""
    psi: Complex
    """Wave number of the complementary wave along x, 1/m."""
    film: tuple[Complex, Complex]
    """Film of both over the amplitude: a and c."""
    error: Floats
    """Error of their sum by the error bar of the response, Pa/m."""
    most_growth: Floats
    """By how much the complementary wave is larger upstream, at most."""

    def at(self, x_m: float) -> Complex:
        """Return the pressure over the amplitude at X = x, Pa/m, times exp(-i w t)."""
        own = self.attenuated * np.exp(1j * self.number_x * x_m)
        return np.asarray(own + self.complementary * self.carried(x_m))

    def film_at(self, x_m: float) -> Complex:
        """Return the film over the amplitude at X = x, times exp(-i w t)."""
        own = self.film[0] * np.exp(1j * self.number_x * x_m)
        return np.asarray(own + self.film[1] * self.carried(x_m))

    def carried(self, x_m: float) -> Complex:
        """Return the complementary wave at X = x over that at the centre."""
        growth = np.minimum(np.exp(-self.psi.imag * x_m), self.most_growth)
        return np.asarray(growth * np.exp(1j * self.psi.real * x_m))


def stiffness_pa(conditions: Conditions) -> float:
    """Return E'/4, Pa: the pressure of a wave over its deflection and its wave number.

    Raises StressError if the conditions have no lengths.
    """
    modulus = conditions.modulus_pa
    if modulus is None:
        raise StressError(
            "Contact: pressures need radius_x_m and semi_axis_a_m besides M, L and D, or "
            "dimensional data"
        )
    return modulus / 4


def hertz_pressure_of(conditions: Conditions) -> float:
    """Return the largest Hertz pressure ph, Pa."""
    return conditions.hertz_pa


def pressure_waves(
    conditions: Conditions, transfer: Transfer, number_x: Floats, number_y: Floats
) -> PressureWaves:
    """Return the pressure of waves of these numbers, 1/m; along x 0 or more, of equal shape."""
    modulus = stiffness_pa(conditions)
    per_x, per_y = number_x / (2 * np.pi), np.abs(number_y) / (2 * np.pi)
    response = np.asarray(transfer.ratio(per_x, per_y), dtype=complex)
    found = transfer.error(per_x, per_y)
    error = np.full(per_x.shape, USUAL_ERROR) if found is None else np.asarray(found)
    attenuated, psi = response.copy(), number_x.astype(complex)
    moves = (number_x > 0) & (not conditions.rolls and not isinstance(transfer, FormulaBasis))
    if np.any(moves):
        a_m, slip = conditions.semi_axis_a_m, conditions.slip_parameter
        medium = conditions.medium(slip)
        waves = number_x[moves] * a_m, number_y[moves] * a_m
        attenuated[moves] = medium.attenuated(*waves, slip)
        psi[moves] = medium.complementary_number(waves[0] * slip, waves[1]) / a_m
    number = np.hypot(number_x, number_y)
    carried = np.sqrt(psi**2 + number_y**2)
    is_wave = number > 0
    return PressureWaves(
        number_x,
        number_y,
        np.where(is_wave, modulus * number * (attenuated - 1), 0),
        modulus * carried * (response - attenuated),
        psi,
        (attenuated, response - attenuated),
        np.where(is_wave, modulus * np.abs(carried) * error, 0.0),
        np.maximum(1, LARGEST_UPSTREAM / np.maximum(error, 1e-6)),
    )
