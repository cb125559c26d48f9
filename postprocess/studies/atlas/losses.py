"""Losses of the networks of an atlas: misses of responses, films and their errors."""

from dataclasses import dataclass, fields
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ehlwave.laws.atlas.shape import Seen

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]

Record = TypeVar("Record", "Waves", "Films", "Errors", Seen)

CLOSE = 0.003
"""Misses of responses, units of Ai, below which they count by their square, above by their size."""

CLOSE_FILM = 0.002
"""Close distance of logarithms of films."""

CLOSE_RISE = 0.05
"""Close distance of rises of the mean film."""

PRESSURE_SHARE, RISE_SHARE = 0.3, 0.02
"""Shares of deflections and rises, beside film responses."""

FREEDOM = 4.0
"""Degrees of freedom of Student's distribution of errors over their bars."""


@dataclass(frozen=True)
class Waves:
    """Computed responses as an atlas sees them.

    Attributes
    ----------
    inputs : ndarray, shape (n, k)
        Coordinates of contacts and waves.
    seen : Seen
        The waves.
    film, left : ndarray of complex
        Film responses, and the result of :meth:`Seen.pressure_left`.
    rise : ndarray
        Of the mean film, NaN where it is not known.
    """

    inputs: Floats
    seen: Seen
    film: Complex
    left: Complex
    rise: Floats

    @property
    def scales(self) -> Floats:
        """Usual sizes of the numbers."""
        return np.array([0.1] * (self.seen.film_numbers + 2) + [0.3])

    def missed(self, numbers: Floats) -> Complex:
        """Return the misses of film responses."""
        return self.seen.film(numbers) - self.film

    def loss(self, numbers: Floats) -> tuple[float, Floats]:
        """Return the misses of the numbers, and their slopes."""
        count, films = numbers.shape[0], self.seen.film_numbers
        slopes = np.zeros_like(numbers)
        value, back = robust(self.missed(numbers), CLOSE)
        slopes[:, :films] = (np.conj(self.seen.slopes) * back[:, None]).real
        real, imaginary = numbers[:, films : films + 2].T
        more, back = robust(real + 1j * imaginary - self.left, CLOSE)
        slopes[:, films] = PRESSURE_SHARE * back.real
        slopes[:, films + 1] = PRESSURE_SHARE * back.imag
        value += PRESSURE_SHARE * more
        more, back = robust(np.nan_to_num(numbers[:, -1] - self.rise), CLOSE_RISE)
        slopes[:, -1] = RISE_SHARE * back
        value += RISE_SHARE * more
        return value / count, slopes / count


@dataclass(frozen=True)
class Films:
    """Films of contacts: logarithms, (contacts, films), by the coordinates of contacts."""

    inputs: Floats
    numbers: Floats

    @property
    def scales(self) -> Floats:
        """Usual sizes of the numbers."""
        return self.numbers.std(axis=0)

    def loss(self, numbers: Floats) -> tuple[float, Floats]:
        """Return the misses of the numbers, and their slopes."""
        value, slopes = robust(numbers - self.numbers, CLOSE_FILM)
        return value / len(numbers), slopes / len(numbers)


@dataclass(frozen=True)
class Errors:
    """Misses of predictions, (n, outputs): the loss is of the logarithm of their size."""

    inputs: Floats
    misses: Floats

    @property
    def scales(self) -> Floats:
        """Usual sizes of the logarithms."""
        return np.full(self.misses.shape[1], 3.0)

    def loss(self, logs: Floats) -> tuple[float, Floats]:
        """Return minus the logarithm of the likelihood of the misses, and its slopes."""
        ratio = self.misses**2 * np.exp(-2 * logs) / FREEDOM
        value = np.sum(logs + (FREEDOM + 1) / 2 * np.log1p(ratio))
        return float(value) / logs.size, (1 - (FREEDOM + 1) * ratio / (1 + ratio)) / logs.size


Task = Waves | Films | Errors
"""Data that networks learn from."""


def part(record: Record, rows: NDArray[np.bool_]) -> Record:
    """Return some of the rows of all arrays that a record holds, itself or in other records."""
    values = (getattr(record, field.name) for field in fields(record))
    chosen = (one[rows] if isinstance(one, np.ndarray) else part(one, rows) for one in values)
    return type(record)(*chosen)


def robust(miss: NDArray, close: float) -> tuple[float, NDArray]:
    """Return the sum of (close^2 + |miss|^2)^(1/2) and its derivatives, of complex both parts."""
    size = np.sqrt(close**2 + miss.real**2 + miss.imag**2)
    return float(size.sum()), miss / size
