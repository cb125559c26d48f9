"""Waves as an atlas sees them: their coordinates, and the numbers that make responses of a law."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.conditions import MOES_KEYS
from ehlwave.contact.rolling import transfer_along
from ehlwave.contact.scales import ellipticity, integral_combinations, pressure_factor
from ehlwave.duals import np
from ehlwave.laws.atlas.coordinates import Complex, Floats, columns, hertz_film

SomeShape = TypeVar("SomeShape", bound="Shape")

INLET_SCALE = 0.18
"""Where loads are high, (lambda/a) H^(-2/3) is V times 1.46 (scatter 18 %): 0.263 over that."""

LEAST_SHARE = 1e-9
"""Cosine below which a wave does not move."""


@dataclass(frozen=True)
class Seen:
    """Waves in contacts.

    A film response is a law plus numbers times their slopes: T = law + sum of numbers times slopes.
    The pressure P that belongs to it is the plane-wave pressure with two more numbers, p: W P =
    offset + gain T + p, W = 2/(K (kx^2 + kappa^2 ky^2)^(1/2)). In pure rolling gain is 1 and offset
    -1: the film is the pattern and the deflection under the pressure.

    Attributes
    ----------
    coordinates : ndarray, shape (n, k)
        Coordinates in which, with the contact's, the numbers are smooth.
    law : ndarray of complex, shape (n,)
        Film responses where all numbers are 0.
    slopes : ndarray of complex, shape (n, numbers)
        Slopes by the numbers.
    gain, offset : ndarray of complex, shape (n,)
        Of the deflection.
    compliance : ndarray, shape (n,)
        W, in units of c/ph.
    """

    coordinates: Floats
    law: Complex
    slopes: Complex
    gain: Complex
    offset: Complex
    compliance: Floats

    @property
    def film_numbers(self) -> int:
        """How many numbers are of film responses."""
        return self.slopes.shape[1]

    def film(self, numbers: Floats) -> Complex:
        """Return film responses by the first of their numbers, shape (n, any)."""
        own = numbers[:, : self.film_numbers]
        return np.asarray(self.law + np.sum(own * self.slopes, axis=1))

    def pressure(self, film: Complex, numbers: Floats) -> Complex:
        """Return pressure responses from film responses and the two numbers after its own."""
        real, imaginary = numbers[:, self.film_numbers : self.film_numbers + 2].T
        deflection = self.offset + self.gain * film + real + 1j * imaginary
        return np.asarray(deflection / self.compliance)

    def pressure_left(self, film: Complex, pressure: Complex) -> Complex:
        """Return the two numbers of pressure responses, as complex numbers."""
        return np.asarray(self.compliance * pressure - self.offset - self.gain * film)


class Shape:
    """Turns responses of contacts that roll into numbers that hardly change, and back.

    The law holds for pure rolling, amplitude and phase; two numbers change its ratio. Takes M, L
    and Das arrays of equal shape.
    """

    OF_ALL: tuple[str, ...] = ()
    """Names of variables that are not per contact."""

    def __init__(self, m: ArrayLike, l: ArrayLike, d: ArrayLike) -> None:  # noqa: E741
        """Compute the values that follow from M, L and D."""
        m = np.asarray(m, dtype=float)
        self.l = np.asarray(l, dtype=float)
        self.kappa = np.vectorize(ellipticity, otypes=[float])(np.asarray(d, dtype=float))
        gamma = np.vectorize(pressure_factor, otypes=[float])(self.kappa)
        self.load = gamma * m
        film = hertz_film(m, l, d)
        self._log_film, self._inlet = np.log(film), INLET_SCALE * film ** (-2 / 3)
        self._pi_k = np.pi * sum(integral_combinations(self.kappa))

    @classmethod
    def of_keys(cls, keys: Mapping[str, ArrayLike]) -> "Shape":
        """Return the shape of contacts given by columns named as the input keys."""
        return cls(*columns(keys, MOES_KEYS))

    def __getitem__(self: SomeShape, index: NDArray[np.intp]) -> SomeShape:
        """Return the shape of a choice of contacts."""
        part = type(self).__new__(type(self))
        for name, values in vars(self).items():
            setattr(part, name, values[index] if name not in self.OF_ALL else values)
        return part

    def seen(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Seen:
        """Return waves, one of each contact or all of the only contact.

        Coordinates are ln x, x = 0.18 (lambda/a) H^(-2/3) L^(1/2 - cos^2(theta)/3), the angle, its
        cos^2, the wavelength over b and a, and ln H. At high loads x equals the recommended
        formula's; at low loads it is smaller.
        """
        wave, theta = np.asarray(wavelength_over_a, dtype=float), np.radians(angle_deg)
        share = np.cos(theta)
        along = np.where(share > LEAST_SHARE, share**2, 0.0)
        x = self._inlet * wave * self.l ** (0.5 - along / 3)
        law = transfer_along(self.load, self.l, wave, along)
        logs = np.log(x), np.log(wave * self.kappa), np.log(wave), self._log_film
        return rolling_seen((*logs, theta, along), law, wave / self._pi_k)


def rolling_seen(coordinates: Sequence[ArrayLike], law: Complex, compliance: Floats) -> Seen:
    """Return waves that roll, whose numbers change the ratio to a law."""
    columns, one = np.broadcast_arrays(law, *coordinates)[1:], np.ones(law.shape)
    slopes = np.stack([law, 1j * law], axis=-1)
    return Seen(np.stack(columns, axis=-1), law, slopes, one, -one, compliance)
