"""Stresses below loads that repeat in x and y, depth by depth: Fourier transform times factors."""

from collections.abc import Iterator, Mapping

import numpy as np
import scipy
from numpy.typing import NDArray

from ehlwave.stress.waves import COMPONENTS, LOADS, Directions

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
Loads = Mapping[str, Floats]
"""By kind, as the keys of LOADS: arrays of one shape, Pa, [x, y]."""


class RepeatedLoad:
    """Loads on a grid that repeat after ``periods`` points; the rest of a period bears nothing.

    Parameters
    ----------
    loads : mapping
        Arrays of equal shape by kind.
    steps : pair of float
        Of the grid, m.
    poisson_ratio : float
        Of the body.
    periods : pair of int
        Points of a period along x and y, at least as many as the arrays have.
    is_endless : pair of bool
        Whether the load really repeats along x, along y. Where it does not, the period only keeps
        images of it away.
    blur : float
        Standard deviation, in steps, of a Gaussian that loads are smoothed with first; 0: none.
    workers : int
        Threads.
    """

    def __init__(
        self,
        loads: Loads,
        steps: tuple[float, float],
        poisson_ratio: float,
        periods: tuple[int, int],
        is_endless: tuple[bool, bool],
        blur: float = 0.0,
        workers: int = 1,
    ) -> None:
        """Transform the loads."""
        self._shape = next(iter(loads.values())).shape
        self._periods, self._workers, self._nu = periods, workers, poisson_ratio
        a = 2 * np.pi * scipy.fft.fftfreq(periods[0], steps[0])[:, None]
        b = 2 * np.pi * scipy.fft.rfftfreq(periods[1], steps[1])[None, :]
        self._number = np.hypot(a, b)
        self._directions = _directions(a, b, periods, _mean_squares(poisson_ratio, is_endless))
        smoothing = np.exp(-0.5 * blur**2 * ((a * steps[0]) ** 2 + (b * steps[1]) ** 2))
        self._spectra = {}
        for kind, load in loads.items():
            spectrum = scipy.fft.rfft2(load, s=periods, workers=workers)
            self._spectra[kind] = spectrum if blur == 0 else spectrum * smoothing

    def at(self, depth: float) -> dict[str, Floats]:
        """Return the stresses at a depth, m, over the points of the arrays; tension positive."""
        return {name: self._plane(waves) for name, waves in self._below(depth)}

    def line_at(self, depth: float, row: int) -> dict[str, Floats]:
        """Return the stresses along x at a row of y, without the other rows."""
        last = self._periods[1] // 2
        weight = np.where(np.arange(last + 1) % (self._periods[1] / 2) == 0, 1, 2)
        turn = weight * np.exp(2j * np.pi * row * np.arange(last + 1) / self._periods[1])
        lines = {name: scipy.fft.ifft(waves @ turn).real for name, waves in self._below(depth)}
        count = self._shape[0]
        return {name: line[:count] / self._periods[1] for name, line in lines.items()}

    def _below(self, depth: float) -> Iterator[tuple[str, Complex]]:
        """Yield the transforms of the stresses at a depth, component by component."""
        s = self._number * depth
        decay = -np.exp(-s)
        falling = {kind: spectrum * decay for kind, spectrum in self._spectra.items()}
        for name in COMPONENTS:
            yield name, self._component(name, s, falling)

    def _component(self, name: str, s: Floats, falling: Mapping[str, Complex]) -> Complex:
        total = np.zeros(s.shape, dtype=complex)
        for kind, spectrum in falling.items():
            is_odd, factor = LOADS[kind][name]
            part = spectrum * factor(self._directions, s, self._nu)
            if is_odd:
                part *= -1j
            total += part
        return total

    def _plane(self, waves: Complex) -> Floats:
        # Rows and columns outside the arrays are left out as early as can be.
        along = scipy.fft.ifft(waves, axis=0, overwrite_x=True, workers=self._workers)
        part = scipy.fft.irfft(
            along[: self._shape[0]], n=self._periods[1], axis=1, workers=self._workers
        )
        return part[:, : self._shape[1]]


def _directions(
    a: Floats, b: Floats, periods: tuple[int, int], mean_squares: tuple[float, float]
) -> Directions:
    """Return the directions of all waves.

    In odd factors the shortest wave along an axis has none along it: in a real field it is its own
    conjugate. The mean has no direction: its squares are given.
    """
    number = np.hypot(a, b)
    number[0, 0] = 1
    u, v = a / number, b / number
    uu, vv = u**2, v**2
    uu[0, 0], vv[0, 0] = mean_squares
    if periods[0] % 2 == 0:
        u[periods[0] // 2] = 0
    if periods[1] % 2 == 0:
        v[:, -1] = 0
    return Directions(u, v, uu, vv)


def _mean_squares(nu: float, is_endless: tuple[bool, bool]) -> tuple[float, float]:
    """Return u^2 and v^2 of the mean of the load.

    A load that is endless along x and y is borne without lateral strain: sx = sy = nu/(1 - nu) sz.
    A load that ends is a part of long waves: along x where it is endless along y, else in all
    directions alike.
    """
    if all(is_endless):
        lateral = nu / ((1 - nu) * (1 + 2 * nu))
        return lateral, lateral
    if any(is_endless):
        return (0.0, 1.0) if is_endless[0] else (1.0, 0.0)
    return 0.5, 0.5
