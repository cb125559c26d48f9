"""Pressure waves of a rough surface inside a contact, of a surface whose film was predicted."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.errors import StressError
from ehlwave.laws.transfer import Transfer
from ehlwave.shown import Shown
from ehlwave.surface.prepare import Window, extended
from ehlwave.surface.ripple import PressureWaves, pressure_waves
from ehlwave.surface.surface import Surface

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

LINES = 5
"""Lines along rolling on which a map is judged, evenly spread."""

LEAST_SHARE = 1e-6
"""Share of the mean square of amplitude times wave number: the smallest waves, left out."""


class Predicted(Protocol):
    """Interface of a predicted surface, as :class:`ehlwave.surface.Deformed`."""

    @property
    def surface(self) -> Surface:
        """Measured surface, before the contact."""

    @property
    def conditions(self) -> Conditions:
        """Unit of the contact."""

    @property
    def transfer(self) -> Transfer | None:
        """Return the transfer that it was predicted with."""

    @property
    def window(self) -> Window:
        """How its ends were treated."""


@dataclass(frozen=True, repr=False)
class Ripple(Shown):
    """The pressure waves of a surface inside a contact."""

    slip: float
    """S of the surface."""
    length_m: float
    """After which it repeats along rolling; 0: it does not vary along rolling."""
    points: int
    measured: int
    """`points`, `measured`: points of that length, and how many of them, the first, are the surface
    as it was measured."""
    amplitude: Complex
    """Amplitudes of the gap, m; waves with kx above 0 represent themselves and their conjugates;
    shape (kx, ky).
    """
    waves: PressureWaves
    """Waves, of the same shape."""
    lines_m: Floats
    """Places across rolling that are judged."""

    def _shown_rows(self) -> dict[str, str]:
        """Return its slip, points and waves."""
        waves = " x ".join(map(str, self.amplitude.shape))
        return {"S": f"{self.slip:g}", "points": str(self.points), "waves": waves}

    @property
    def moves(self) -> bool:
        """Whether it varies along rolling."""
        return self.points > 1

    def pressure(self, x_m: float = 0.0) -> Floats:
        """Return the ripple at X = x when points of the surface are there, Pa, (points, lines)."""
        turn = np.exp(-1j * self.waves.number_x * x_m)
        return self.over_points(self.waves.at(x_m) * turn * self.amplitude)

    def over_points(self, values: Complex) -> Floats:
        """Return the sum of waves over the points of the length and the lines."""
        across = np.exp(1j * np.outer(self.waves.number_y[0], self.lines_m))
        along = values @ across
        return np.asarray(np.fft.irfft(along, n=self.points, axis=-2) * self.points)


def ripple_of(deformed: Predicted, *, every_line: bool = False) -> Ripple:
    """Return the ripple of a surface, along some or all lines of a map.

    Raises StressError if the surface was not predicted with a transfer, or the contact has no
    lengths.
    """
    surface, conditions, transfer = deformed.surface, deformed.conditions, deformed.transfer
    if transfer is None:
        raise StressError(f"{surface.name}: has no transfer: predict it with deform_surface")
    gap = -extended(surface.height.astype(float), deformed.window)
    nx, ny = gap.shape
    spectrum = np.fft.fft(np.fft.rfft(gap, axis=0), axis=1) / gap.size
    number_x = 2 * np.pi * np.fft.rfftfreq(nx, surface.step_x_m or 1.0)
    number_y = 2 * np.pi * np.fft.fftfreq(ny, surface.step_y_m or 1.0)
    large = _large(spectrum, np.hypot(number_x[:, None], number_y))
    last = int(np.flatnonzero(large.any(axis=1))[-1])
    columns = np.flatnonzero(large.any(axis=0))
    kx, ky = np.meshgrid(number_x[: last + 1], number_y[columns], indexing="ij")
    lines = np.arange(surface.height.shape[1])
    if surface.height.shape[0] > 1 and lines.size > LINES and not every_line:
        lines = np.linspace(0, lines.size - 1, LINES).round().astype(int)
    return Ripple(
        slip=conditions.slip_parameter,
        length_m=nx * surface.step_x_m if nx > 1 else 0.0,
        points=nx,
        measured=surface.height.shape[0],
        amplitude=np.where(large, spectrum, 0)[: last + 1, columns],
        waves=pressure_waves(conditions, transfer, kx.copy(), ky.copy()),
        lines_m=lines * (surface.step_y_m or 1.0),
    )


def _large(spectrum: Complex, number: Floats) -> NDArray[np.bool_]:
    """Return which waves could make pressure that counts: it goes as amplitude times number."""
    squares = np.abs(spectrum * number) ** 2
    whole = squares.sum()
    if whole == 0:
        return np.asarray(number == 0)
    tails = [whole - np.cumsum(np.sort(squares.sum(axis=axis))[::-1]) for axis in (1, 0)]
    kept = [1 + int(np.sum(tail > LEAST_SHARE * whole)) for tail in tails]
    chosen = np.zeros(squares.shape, dtype=bool)
    rows, columns = (
        np.argsort(-squares.sum(axis=axis), kind="stable")[:count]
        for axis, count in zip((1, 0), kept, strict=True)
    )
    chosen[np.ix_(rows, columns)] = True
    return chosen
