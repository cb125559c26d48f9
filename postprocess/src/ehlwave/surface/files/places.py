"""Heights over columns of x and y: a map, a trace along an axis, or an oblique trace."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ehlwave.errors import SurfaceError
from ehlwave.surface.surface import LARGEST_STEP_DEVIATION

Numbers = NDArray[np.float64]

LEAST_FILLED = 0.5
"""Share of the points of a grid that a file must hold."""


@dataclass(frozen=True)
class Places:
    """Heights in order of their positions: a trace (``y`` is None), or rows of constant y."""

    height: Numbers
    x: Numbers
    y: Numbers | None
    note: str = ""


def placed(file: Path, x: Numbers, y: Numbers, z: Numbers) -> Places:
    """Return heights over x and y, which share a unit.

    Raises SurfaceError if the points are neither a grid nor equidistant on a straight line.
    """
    found = straight(x, y, z) or grid(x, y, z)
    if found is None:
        raise SurfaceError(
            f"{file}: its columns of x and y are neither a grid nor equidistant on a line: "
            "resample the surface to a grid, or keep one column of positions"
        )
    return found


def straight(x: Numbers, y: Numbers, z: Numbers, is_oblique: bool = True) -> Places | None:
    """Return a trace: along x or y where the other is constant, or oblique; None if it is none."""
    if not np.all(np.isfinite(x)) or not np.all(np.isfinite(y)):
        return None
    for p, other, names in ((x, y, "yx"), (y, x, "xy")):
        if np.ptp(other) == 0 and not (is_oblique and p[-1] < p[0]):
            return Places(z, p, None, "{} is constant: positions along {}".format(*names))
    along = np.hypot(x - x[0], y - y[0])
    ideal = [np.linspace(p[0], p[-1], p.size) for p in (x, y)]
    farthest = np.hypot(x - ideal[0], y - ideal[1]).max()
    if not is_oblique or not farthest <= LARGEST_STEP_DEVIATION * along[-1] / (along.size - 1):
        return None
    return Places(z, along, None, "oblique profile: positions along it, from x and y")


def grid(x: Numbers, y: Numbers, z: Numbers) -> Places | None:
    """Return a map of points that are a grid, in any order; None if they are none."""
    axes = _axis(x), _axis(y)
    if axes[0] is None or axes[1] is None:
        return None
    (i, first, step, nx), (j, first_y, step_y, ny) = axes
    if min(nx, ny) < 2 or not LEAST_FILLED * nx * ny <= z.size <= nx * ny:
        return None
    place = j * nx + i
    if np.unique(place).size != z.size:
        return None
    height = np.full(nx * ny, np.nan)
    height[place] = z
    missing = nx * ny - z.size
    note = f"grid of {nx} x {ny} points" + (
        f", {missing} of them not in the file" if missing else ""
    )
    return Places(
        height.reshape(ny, nx), first + step * np.arange(nx), first_y + step_y * np.arange(ny), note
    )


def _axis(values: Numbers) -> tuple[NDArray[np.intp], float, float, int] | None:
    """Return the indices of values on equidistant positions, the first, the step and the count."""
    if not np.all(np.isfinite(values)):
        return None
    single = np.unique(values)
    if single.size < 2:
        return None
    gaps = np.diff(single)
    step = float(np.median(gaps[gaps > 1e-6 * gaps.max()]))
    count = round((single[-1] - single[0]) / step) + 1
    if count > values.size or count < 2:
        return None
    step = float(single[-1] - single[0]) / (count - 1)
    index = np.rint((values - single[0]) / step).astype(np.intp)
    if np.max(np.abs(values - single[0] - step * index)) > 0.05 * step:
        return None
    return index, float(single[0]), step, count
