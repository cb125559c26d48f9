"""Spectra before and after, and the components outside the range of a transfer."""

import heapq
import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.laws.transfer import Transfer, shorter_than_contact
from ehlwave.shown import Shown, micrometres
from ehlwave.surface.removal import Bands

Floats = NDArray[np.float64]

NAMED_COMPONENTS = 5
"""How many of the largest components that cannot be judged are named one by one."""

NEGLIGIBLE_SHARE = 1e-9
"""Share of the mean square: below it a class of components is rounding, not surface."""


@dataclass(frozen=True, repr=False)
class Spectrum(Shown):
    """Mean square of the components, m^2, before and after, by their waves per metre along x or y.

    The sum is the mean square of the surface that was transformed: Parseval. The first entry holds
    the components that do not vary in that direction, the mean included.
    """

    waves: Floats
    before: Floats
    after: Floats
    _bin: NDArray[np.intp] = field(repr=False)

    def _shown_rows(self) -> dict[str, str]:
        """Return how many waves there are, and Rq before and after."""
        before, after = (float(np.sqrt(part.sum())) for part in (self.before, self.after))
        rq = f"{micrometres(before)} before, {micrometres(after)} after"
        return {"waves": str(self.waves.size), "Rq": rq}

    def add(self, part: slice, before: Floats, after: Floats) -> None:
        """Add mean squares of a part of the waves that it was made for."""
        np.add.at(self.before, self._bin[part], before)
        np.add.at(self.after, self._bin[part], after)


def empty_spectrum(q: Floats) -> Spectrum:
    """Return a spectrum to add to, for waves per metre of either sign."""
    waves, index = np.unique(np.abs(q), return_inverse=True)
    return Spectrum(waves, np.zeros_like(waves), np.zeros_like(waves), index)


@dataclass(frozen=True)
class Component:
    """A harmonic component: wavelengths, m (infinite: no variation), and amplitudes, m."""

    wavelength_x_m: float
    wavelength_y_m: float
    amplitude_before_m: float
    amplitude_after_m: float


@dataclass(frozen=True)
class Unjudged:
    """A class of components that the transfer cannot judge."""

    reason: str
    """Why."""
    components: int
    """How many; a wave, its conjugate and its images in mirrored ends are one."""
    share_before: float
    share_after: float
    """`share_before`, `share_after`: of the mean square of the surface before and after."""
    largest: tuple[Component, ...]
    """The largest of them."""


class Tally:
    """Number, mean square and largest members of a class of components."""

    def __init__(self) -> None:
        """Start without components."""
        self.components = 0
        self.before = 0.0
        self.after = 0.0
        self._largest: list[tuple[float, float, float, float]] = []

    def add(
        self, chosen: NDArray[np.bool_], qx: Floats, qy: Floats, before: Floats, after: Floats
    ) -> None:
        """Add the chosen members of a block."""
        count = int(np.count_nonzero(chosen))
        if count == 0:
            return
        squares, left = before, after
        if count < chosen.size:
            squares, left = np.where(chosen, before, 0.0), np.where(chosen, after, 0.0)
        self.components += count
        self.before += float(squares.sum())
        self.after += float(left.sum())
        least = self._largest[-1][0] if len(self._largest) == NAMED_COMPONENTS else 0.0
        rows, columns = np.nonzero((squares >= least) & chosen)
        if rows.size > NAMED_COMPONENTS:
            best = np.argpartition(squares[rows, columns], -NAMED_COMPONENTS)[-NAMED_COMPONENTS:]
            rows, columns = rows[best], columns[best]
        named = (squares[rows, columns], qx[rows, 0], qy[0, columns], after[rows, columns])
        candidates = [*self._largest, *zip(*(values.tolist() for values in named), strict=True)]
        self._largest = heapq.nlargest(NAMED_COMPONENTS, candidates)

    def largest(self) -> tuple[Component, ...]:
        """Return the largest components; an amplitude A has the mean square A^2/2."""
        return tuple(
            Component(_inverse(qx), _inverse(qy), (2 * before) ** 0.5, (2 * after) ** 0.5)
            for before, qx, qy, after in self._largest
        )


class Coverage:
    """Tallies of all components, of long ones, and of others that a transfer does not cover."""

    def __init__(self, conditions: Conditions, transfer: Transfer) -> None:
        """Start without components."""
        self._conditions = conditions
        self._transfer = transfer
        self.total = Tally()
        self.long = Tally()
        self.outside = Tally()
        self.bands = Bands()
        self._error_square = 0.0

    def add(self, qx: Floats, qy: Floats, before: Floats, after: Floats) -> None:
        """Add a block: waves per metre along x (rows) and y (columns), mean squares, m^2."""
        self.total.before += float(before.sum())
        self.total.after += float(after.sum())
        error = self._transfer.error(qx, qy)
        self._error_square += math.nan if error is None else float((before * error**2).sum())
        is_term = (before > 0) & ((qx != 0) | (qy != 0))
        fits = shorter_than_contact(self._conditions, qx, qy)
        self.long.add(is_term & ~fits, qx, qy, before, after)
        if not self._transfer.covers_all:
            covered = self._transfer.is_covered(qx, qy)
            self.outside.add(is_term & fits & ~covered, qx, qy, before, after)

    def error_m(self) -> float | None:
        """Return the rms error of the deformed heights from the transfer's error, m, if known."""
        return None if math.isnan(self._error_square) else math.sqrt(self._error_square)

    def unjudged(self) -> list[Unjudged]:
        """Return the classes that are not empty."""
        classes = (
            ("longer than the contact (lambda_x > 2a and lambda_y > 2b)", self.long),
            (self._transfer.outside_reason, self.outside),
        )
        return [
            Unjudged(
                reason,
                tally.components,
                _share(tally.before, self.total.before),
                _share(tally.after, self.total.after),
                tally.largest(),
            )
            for reason, tally in classes
            if tally.before > NEGLIGIBLE_SHARE * self.total.before
        ]


def _share(part: float, whole: float) -> float:
    return part / whole if whole > 0 else 0.0


def _inverse(wave: float) -> float:
    return abs(1 / wave) if wave != 0 else float("inf")
