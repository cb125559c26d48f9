"""The unit that the programs count their work in."""

import numpy as np
from numpy.typing import ArrayLike, NDArray


def convolutions(cells: ArrayLike) -> NDArray[np.float64]:
    """Return the work unit of grids of as many cells along each side in units of 256 by 256 cells.

    A unit is a zero-padded convolution by FFT, counted as n log n (src/elastic/work_unit.f90).
    """
    points, usual = (2.0 * np.asarray(cells)) ** 2, 512.0**2
    return np.asarray(points * np.log2(points) / (usual * np.log2(usual)))
