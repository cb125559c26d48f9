"""The two waves of which the film of a wavy contact under slip consists, without a simulation.

Where a pattern Ai exp(i kx (X - S T)) slides through the contact, the film near its centre is

    Ai [a exp(i (kx X - w T)) + c exp(i (psi X - w T))],    w = kx S:

the attenuated wave moves with the surface, the complementary one is launched by the inlet and moves
with the oil (Greenwood and Morales-Espejel 1994; Hooke 2006). a and psi follow from the state of
the contact centre in closed form (:mod:`ehlwave.medium`). What the inlet launches is what it lets
through in pure rolling, R, less what the attenuated wave takes of it:

    c = (R T S^(p cos^2(theta) (1 - |a|^2) + i q) - a) exp(i m - i u - u^2/6)
    T = (1 + 100 B0)^(-r cos^2(theta) (1 - |R|^2))
    m = psi - kx - |a|^4 (psi_1 - kx)
    u = Re(m) d,    d = d0 (L/(gamma M))^(d1/2) (10/alphabar)^d2

Launched between X = -1 and -1 + 2d, it arrives at the centre with the phase and the loss of its
way; u^2/6 is what a launch spread over 2d averages out. psi_1 is psi in pure rolling, whose loss R
has in it already. T is what thinning in the inlet costs, B0 the B of the viscosity at ambient
pressure (:class:`ehlwave.medium.Medium`). p, q, r and d are fitted (``studies.two_waves``); S -> 1
gives a + c = R, the pure rolling law of :mod:`ehlwave.rolling`.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ehlwave.formula import wave_and_direction
from ehlwave.medium import INLET_VISCOSITY, Medium
from ehlwave.rolling import rolling_transfer

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]

SLIP_POWERS = (0.223, 0.492, 0.075)
"""p, q and r."""

LAUNCH_LENGTH = (0.296, 0.55, 1.16)
"""d0, d1 and d2."""

FITTED_RANGES = {"M": (20.0, 1000.0), "L": (2.5, 20.0), "D": (0.1, 1.0), "S": (0.3, 1.8)}
"""Conditions that the law was fitted to, smallest and largest."""


@dataclass(frozen=True)
class TwoWaves:
    """Amplitudes over Ai at X = 0, and wave numbers along X, 1/a; arrays of one shape.

    The waves go as exp(i (wave_number X - w T)) and exp(i (psi X - w T)).
    """

    attenuated: Complex
    complementary: Complex
    wave_number: Floats
    psi: Complex

    def at(self, x: ArrayLike) -> Complex:
        """Return the film over Ai exp(-i w T) at X = x (broadcast against the waves)."""
        place = np.asarray(x)
        own = self.attenuated * np.exp(1j * self.wave_number * place)
        return np.asarray(own + self.complementary * np.exp(1j * self.psi * place))


def launched(
    rolling: Complex,
    attenuated: Complex,
    mismatch: Complex,
    slip: ArrayLike,
    along: ArrayLike,
    length: ArrayLike,
    thinning: ArrayLike,
    powers: tuple[float, float, float] = SLIP_POWERS,
) -> Complex:
    """Return c, the complementary wave at the contact centre over Ai.

    Parameters
    ----------
    rolling : ndarray of complex
        R, the transfer of the same wave in pure rolling.
    attenuated : ndarray of complex
        a.
    mismatch : ndarray of complex
        m of :func:`mismatch`, 1/a.
    slip, along, length, thinning : array_like
        S, above 0; cos^2 of the angle between wave vector and X; d of :func:`launch_length`; B0.
    powers : three floats
        p, q and r.
    """
    cosine2 = np.asarray(along)
    power = powers[0] * cosine2 * (1 - np.abs(attenuated) ** 2) + 1j * powers[1]
    thinned = -powers[2] * cosine2 * np.maximum(1 - np.abs(rolling) ** 2, 0)
    change = power * np.log(slip) + thinned * np.log1p(INLET_VISCOSITY * np.asarray(thinning))
    entering = rolling * np.exp(change) - attenuated
    u = mismatch.real * np.asarray(length)
    return np.asarray(entering * np.exp(1j * (mismatch - u) - u**2 / 6))


def mismatch(
    psi: Complex, psi_rolling: Complex, wave_number: Floats, attenuated: Complex
) -> Complex:
    """Return m = psi - kx - |a|^4 (psi_1 - kx), 1/a; psi_1 that of pure rolling."""
    own = np.abs(attenuated) ** 4 * (psi_rolling - wave_number)
    return np.asarray(psi - wave_number - own)


def launch_length(
    load: ArrayLike,
    lubricant_l: ArrayLike,
    alphabar: ArrayLike,
    length: tuple[float, float, float] = LAUNCH_LENGTH,
) -> Floats:
    """Return d, in units of a: half the length of the launch. ``load`` is gamma M."""
    inlet = np.sqrt(np.asarray(lubricant_l) / np.asarray(load))
    return np.asarray(length[0] * inlet ** length[1] * (10 / np.asarray(alphabar)) ** length[2])


class SmoothContact(Protocol):
    """What the law has to know of a contact; :class:`ehlwave.deform.Conditions` is one."""

    @property
    def m(self) -> float:
        """Load parameter M."""

    @property
    def l(self) -> float:  # noqa: E743 - the paper's letter
        """Lubricant parameter L."""

    @property
    def gamma(self) -> float:
        """Pressure factor of the ellipticity, eq. (3)."""

    @property
    def alphabar(self) -> float:
        """Product alpha ph, eq. (3)."""

    def medium(self, slip: float) -> Medium:
        """Return the state of the contact centre where the wavy surface has this S."""


def two_waves(
    contact: SmoothContact, slip: float, wavelength_x: ArrayLike, wavelength_y: ArrayLike = 0.0
) -> TwoWaves:
    """Return both waves of patterns that move: the attenuated and the complementary one.

    Parameters
    ----------
    contact : SmoothContact
        Operating conditions.
    slip : float
        S of the surface that carries the pattern, above 0. In pure rolling, S = 1, a is 1.
    wavelength_x, wavelength_y : array_like
        In units of a. wavelength_x above 0; wavelength_y 0 is infinite. For a product of cosines
        the answer is the same at Y = 0.

    Raises
    ------
    ValueError
        If a pattern does not move: slip or wavelength_x is not above 0.
    """
    wave_x, wave_y = np.broadcast_arrays(
        np.asarray(wavelength_x, dtype=float), np.asarray(wavelength_y, dtype=float)
    )
    if not slip > 0 or not np.all(wave_x > 0):
        raise ValueError("waves that do not move: slip and wavelength_x have to be above 0")
    kx = 2 * np.pi / wave_x
    with np.errstate(divide="ignore"):
        ky = np.where(wave_y > 0, 2 * np.pi / wave_y, 0.0)
    medium = contact.medium(slip)
    attenuated = medium.attenuated(kx, ky, slip)
    psi = medium.complementary_number(kx * slip, ky)
    psi_rolling = contact.medium(1.0).complementary_number(kx, ky)
    complementary = launched(
        rolling_transfer(contact.m, contact.l, contact.gamma, wave_x, wave_y),
        attenuated,
        mismatch(psi, psi_rolling, kx, attenuated),
        slip,
        wave_and_direction(wave_x, wave_y)[1],
        launch_length(contact.gamma * contact.m, contact.l, contact.alphabar),
        medium.thinning,
    )
    return TwoWaves(attenuated, complementary, kx, psi)
