"""The two waves of which the film of a wavy contact under slip consists, without a simulation.

Where a pattern Ai exp(i kx (X - S T)) slides through the contact, the film near its centre is

    Ai [a exp(i (kx X - w T)) + c exp(i (psi X - w T))],    w = kx S:

the attenuated wave moves with the surface, the complementary wave is launched by the inlet and
moves with the oil (Greenwood and Morales-Espejel 1994; Hooke 2006). a and psi follow from the state
of the contact centre in closed form (:mod:`ehlwave.contact.medium`). The inlet launches its share
in pure rolling, where the film is 1 + (R - 1), less the share of the attenuated wave:

    c = (G - a) way(psi - kx) + (R - 1) G way(psi - psi_1)
    G = T S^(p (gM/200)^p1 (cos^2(theta))^p2 (1 - |a|^2) + i q (gM/200)^q1 (cos^2(theta))^q2)
    T = (1 + 100 B0)^(-r cos^2(theta) (1 - |R|^2))
    way(m) = exp(i m - i u - u^2/6),   u = Re(m) d,   d = d0 (L/(gM))^(d1/2) (10/alphabar)^d2

gM is gamma M. Launched between X = -1 and -1 + 2d, a wave arrives at the centre with the phase and
the loss of its way; a launch spread over 2d averages out u^2/6. psi_1 is psi in pure rolling, whose
loss R has in it already. Of waves that are much shorter than the inlet R is 1 and nothing arrives.
T is the effect of thinning in the inlet, B0 the B of the viscosity at ambient pressure
(:class:`ehlwave.contact.medium.Medium`). p to r and d are fitted (``studies.two_waves``); S -> 1
gives a + c = R, the pure rolling law of :mod:`ehlwave.contact.rolling`.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.formula import wave_and_direction
from ehlwave.contact.medium import INLET_VISCOSITY, Medium
from ehlwave.contact.rolling import rolling_transfer
from ehlwave.duals import np
from ehlwave.error_bars import bar
from ehlwave.errors import ArgumentError

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]

SLIP_POWERS = (0.227, 0.119, 0.674, 0.686, 0.166, 0.28, 0.067)
"""p, p1, p2, q, q1, q2 and r."""

LAUNCH_LENGTH = (0.278, 0.473, 1.048)
"""d0, d1 and d2."""

USUAL_LOAD = 200.0
"""The gamma M that p and q are of."""

MOST_REGAINED = 1.0
"""Largest -Im(psi - psi_1): R is not known so well that more of its loss could be taken back."""

SLIP_ERRORS = {
    name: bar(f"two_waves.{name.lower()}") for name in ("Ree-Eyring", "Newtonian", "Carreau")
}
"""Errors of the law of the two waves, units of Ai, by oil."""

MOST_CARREAU_SHEAR = (20.0, 50.0)
"""Largest stresses by pressure and by slip in the inlet of a Carreau oil, over its own
(:mod:`ehlwave.contact.thinning`): of drawn waves within them none is off by more than the error of
the law, beyond them half are."""

FITTED_RANGES = {"M": (20.0, 1000.0), "L": (2.5, 20.0), "D": (0.1, 1.0), "S": (0.3, 1.8)}
"""Conditions that the law was fitted to, smallest and largest."""


@dataclass(frozen=True)
class TwoWaves:
    """Amplitudes over Ai at X = 0, and wave numbers along X, 1/a; arrays of equal shape.

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


@dataclass(frozen=True)
class Launch:
    """Inlet parameters of the complementary wave: its launch and its way; arrays over waves."""

    attenuated: Complex
    """a."""
    mismatch: Complex
    mismatch_rolling: Complex
    """`mismatch`, `mismatch_rolling`: psi - kx, and the same in pure rolling, 1/a."""
    slip: Floats
    along: Floats
    load: Floats
    length: Floats
    thinning: Floats
    """`slip`, `along`, `load`, `length`, `thinning`: S, above 0; cos^2 of the angle between wave
    vector and X; gamma M; d of :func:`launch_length`; B0."""


def launched(rolling: Complex, launch: Launch, powers: Sequence[float] = SLIP_POWERS) -> Complex:
    """Return c, the complementary wave at the contact centre over Ai.

    Parameters
    ----------
    rolling : ndarray of complex
        R, the transfer of the same wave in pure rolling.
    launch : Launch
        Of the waves.
    powers : seven floats
        As :data:`SLIP_POWERS`.
    """
    p, p1, p2, q, q1, q2, r = powers
    load, along, a = launch.load / USUAL_LOAD, launch.along, launch.attenuated
    power = p * load**p1 * along**p2 * (1 - np.abs(a) ** 2) + 1j * q * load**q1 * along**q2
    thinned = -r * along * np.maximum(1 - np.abs(rolling) ** 2, 0)
    change = power * np.log(launch.slip) + thinned * np.log1p(INLET_VISCOSITY * launch.thinning)
    entering = np.exp(change)
    further = launch.mismatch - launch.mismatch_rolling
    further = further.real + 1j * np.maximum(further.imag, -MOST_REGAINED)
    own = (entering - a) * _way(launch.mismatch, launch.length)
    return np.asarray(own + (rolling - 1) * entering * _way(further, launch.length))


def _way(mismatch: Complex, length: Floats) -> Complex:
    """Return the factor of the way to the centre on a wave launched over this length."""
    u = mismatch.real * length
    return np.asarray(np.exp(1j * (mismatch - u) - u**2 / 6))


def launch_length(
    load: ArrayLike,
    lubricant_l: ArrayLike,
    alphabar: ArrayLike,
    length: Sequence[float] = LAUNCH_LENGTH,
) -> Floats:
    """Return d, in units of a: half the length of the launch. ``load`` is gamma M."""
    inlet = np.sqrt(np.asarray(lubricant_l) / np.asarray(load))
    return np.asarray(length[0] * inlet ** length[1] * (10 / np.asarray(alphabar)) ** length[2])


class SmoothContact(Protocol):
    """Interface of a contact for the law, as :class:`ehlwave.surface.Conditions`."""

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
    """Return both waves of patterns that move: attenuated and complementary wave.

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
    ArgumentError
        A ValueError: a pattern does not move: slip or wavelength_x is not above 0.
    """
    wave_x, wave_y = np.broadcast_arrays(
        np.asarray(wavelength_x, dtype=float), np.asarray(wavelength_y, dtype=float)
    )
    if not slip > 0 or not np.all(wave_x > 0):
        raise ArgumentError("waves that do not move: slip and wavelength_x have to be above 0")
    kx = 2 * np.pi / wave_x
    with np.errstate(divide="ignore"):
        ky = np.where(wave_y > 0, 2 * np.pi / wave_y, 0.0)
    medium = contact.medium(slip)
    attenuated = medium.attenuated(kx, ky, slip)
    psi = medium.complementary_number(kx * slip, ky)
    psi_rolling = contact.medium(1.0).complementary_number(kx, ky)
    launch = Launch(
        attenuated,
        psi - kx,
        psi_rolling - kx,
        np.asarray(slip),
        wave_and_direction(wave_x, wave_y)[1],
        np.asarray(contact.gamma * contact.m),
        launch_length(contact.gamma * contact.m, contact.l, contact.alphabar),
        np.asarray(medium.thinning),
    )
    rolling = rolling_transfer(contact.m, contact.l, contact.gamma, wave_x, wave_y)
    complementary = launched(rolling, launch)
    return TwoWaves(attenuated, complementary, kx, psi)
