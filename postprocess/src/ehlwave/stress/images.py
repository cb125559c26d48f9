"""Stresses by periodic images of a load: found on a coarse grid, and subtracted.

A transform makes the load repeat. A period of twice the grid keeps the images away, but their
stress falls no faster than the third power of the distance. It is smooth, and depends only on the
total load. Two periods on a grid of blocks, the original and a much longer one, differ by the
stress of the images, except the images of the long period.
"""

import numpy as np
import scipy
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from ehlwave.stress.spectral import Loads, RepeatedLoad

Floats = NDArray[np.float64]

BLOCKS = 24
"""Most blocks along an axis."""

LONGER = {1: 64, 2: 8}
"""How many times as long the other period is, by the number of axes along which the load ends."""

FALL = {1: 2, 2: 3}
"""Power of the period with which all images together fall, likewise."""

BLUR = 1.5
"""Blur of the loads of blocks, in blocks: so that they act as patches, not as waves to all sides.
"""

DEGREE = 8
"""Degree of the polynomials between blocks: the nearest image is as far as the grid is long."""


def coarse_factor(count: int) -> int:
    """Return how many points along an axis make a block."""
    return -(-count // BLOCKS)


class ImageCorrection:
    """Stresses of the load alone less the stresses of the repeated load."""

    def __init__(
        self,
        loads: Loads,
        steps: tuple[float, float],
        poisson_ratio: float,
        periods: tuple[int, int],
        factor: tuple[int, int],
        ends: tuple[bool, bool],
    ) -> None:
        """Take the loads of blocks.

        Parameters
        ----------
        loads, steps, poisson_ratio
            As of :class:`RepeatedLoad`.
        periods : pair of int
            Points of the period whose images are taken away.
        factor : pair of int
            Points of a block; they divide the periods.
        ends : pair of bool
            Whether the load ends along an axis. Along the other its mean counts.
        """
        shape = next(iter(loads.values())).shape
        blocks = {kind: _blocks(load, factor, ends) for kind, load in loads.items()}
        coarse = tuple(
            step * m if end else 1.0 for step, m, end in zip(steps, factor, ends, strict=True)
        )
        short = tuple(n // m if e else 1 for n, m, e in zip(periods, factor, ends, strict=True))
        times = LONGER[sum(ends)]
        long = tuple(
            scipy.fft.next_fast_len(times * n) if e else 1 for n, e in zip(short, ends, strict=True)
        )
        is_endless = not ends[0], not ends[1]
        # Images of the long period add a remainder that follows from their decay.
        self._share = 1 / (1 - times ** -FALL[sum(ends)])
        self._short, self._long = (
            RepeatedLoad(blocks, coarse, poisson_ratio, n, is_endless, BLUR) for n in (short, long)
        )
        size = next(iter(blocks.values())).shape
        self._to_points = [_between(n, m, k) for n, m, k in zip(size, factor, shape, strict=True)]

    def at(self, depth: float) -> dict[str, Floats]:
        """Return the correction at a depth, m, over the points of the loads."""
        along, across = self._to_points
        short, long = self._short.at(depth), self._long.at(depth)
        return {
            name: self._share * (along @ (long[name] - short[name]) @ across.T) for name in long
        }


def _blocks(load: Floats, factor: tuple[int, int], ends: tuple[bool, bool]) -> Floats:
    """Return the means of blocks, the last filled up with 0; along an endless axis the mean."""
    for axis in (0, 1):
        if not ends[axis]:
            load = load.mean(axis=axis, keepdims=True)
            continue
        starts = np.arange(0, load.shape[axis], factor[axis])
        load = np.add.reduceat(load, starts, axis=axis) / factor[axis]
    return load


def _between(blocks: int, factor: int, points: int) -> Floats:
    """Return the matrix that takes values at the middles of blocks to points, by polynomials."""
    if blocks == 1:
        return np.ones((points, 1))
    middles = np.arange(blocks) * factor + (factor - 1) / 2
    half = max(middles[-1], points - 1) / 2
    degree = min(DEGREE, blocks - 1)
    at_blocks, at_points = (
        chebyshev.chebvander(place / half - 1, degree) for place in (middles, np.arange(points))
    )
    return np.asarray(at_points @ np.linalg.pinv(at_blocks))
