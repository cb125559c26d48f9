"""A measured surface on a uniform grid, in metres."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlwave.choices import AXES, Axis, chosen
from ehlwave.errors import SurfaceError
from ehlwave.quantities import number, plain
from ehlwave.shown import Shown, micrometres
from ehlwave.surface.outliers import outliers_text
from ehlwave.surface.raw_surface import topography_of

Heights = NDArray[np.floating]

LARGEST_STEP_DEVIATION = 0.05
"""How far a position may lie from a uniform grid, in steps: rounded numbers in text files do."""

STEEPEST_SLOPE = 1.0
"""Root mean square slope above which the units are taken to be wrong; 1 is 45 degrees."""


@dataclass(frozen=True, repr=False)
class Surface(Shown):
    """Heights of a trace or a map, m, positive out of the material (a peak is positive).

    Attributes
    ----------
    height : ndarray, shape (nx, ny)
        Along the rolling direction first. A trace along rolling has ny = 1, a trace across it
        nx = 1; along the other direction it is taken not to vary.
    step_x_m, step_y_m : float
        Sampling steps; 0 in the direction a trace does not have.
    name : str
        For messages and titles.
    notes : tuple of str
        How it was read: format, channel, columns, and heights that were filled.
    """

    height: Heights
    step_x_m: float
    step_y_m: float
    name: str = "surface"
    notes: tuple[str, ...] = ()

    @property
    def is_trace(self) -> bool:
        """Whether heights are known along a single direction."""
        return 1 in self.height.shape

    def _shown_rows(self) -> dict[str, str]:
        """Return name, points, length and Rq."""
        lengths = [
            f"{count} x {step * 1e6:.4g} um"
            for count, step in zip(self.height.shape, (self.step_x_m, self.step_y_m), strict=True)
            if count > 1
        ]
        kind = f"trace along {self.trace_axis}" if self.is_trace else "map"
        rq = micrometres(float(np.std(self.height, dtype=np.float64)))
        return {"name": self.name, kind: ", ".join(lengths), "Rq": rq}

    def to_topography(self) -> Any:  # noqa: ANN401 - of a package that need not be there
        """Return it as an object of SurfaceTopography, in metres: a line scan or a map.

        Raises
        ------
        SurfaceError
            If SurfaceTopography is not installed.
        """
        steps = self.step_x_m, self.step_y_m
        return topography_of(self.height, steps, self.name)

    @property
    def trace_axis(self) -> Axis:
        """The direction a trace runs along."""
        return "y" if self.height.shape[0] == 1 else "x"


def trace_surface(height: Heights, step_m: float, axis: Axis = "x", name: str = "trace") -> Surface:
    """Return a trace along (``axis`` x) or across (y) the rolling direction.

    A trace along rolling means transverse roughness, a trace across it longitudinal roughness:
    ridges at right angles to the trace.

    Raises
    ------
    SurfaceError
        As :func:`checked_surface`.
    """
    chosen(axis, "axis", AXES, name)
    values, step_m = np.asarray(plain(height, "height_m")), number(step_m, "step_m", name)
    if values.ndim != 1:
        raise SurfaceError(f"{name}: a trace has one dimension, got shape {values.shape}")
    if axis == "x":
        return checked_surface(Surface(values[:, None], step_m, 0.0, name))
    return checked_surface(Surface(values[None, :], 0.0, step_m, name))


def map_surface(height: Heights, step_x_m: float, step_y_m: float, name: str = "map") -> Surface:
    """Return a map, heights of shape (nx, ny), x being the rolling direction.

    Raises
    ------
    SurfaceError
        As :func:`checked_surface`.
    """
    values = np.asarray(plain(height, "height_m"))
    step_x_m, step_y_m = number(step_x_m, "step_x_m", name), number(step_y_m, "step_y_m", name)
    if values.ndim != 2 or 1 in values.shape:
        raise SurfaceError(f"{name}: a map has two dimensions, got shape {values.shape}")
    return checked_surface(Surface(values, step_x_m, step_y_m, name))


def checked_surface(surface: Surface) -> Surface:
    """Return the surface if it can be used.

    Raises SurfaceError if it has fewer than 8 points along a direction, a step that is not
    positive, missing or infinite heights, or slopes that only a wrong unit explains.
    """
    name, height = surface.name, surface.height
    if not (isinstance(height, np.ndarray) and height.ndim == 2):
        raise SurfaceError(f"{name}: heights must be an array of shape (nx, ny)")
    steps = {"x": (0, surface.step_x_m), "y": (1, surface.step_y_m)}
    for letter, (axis, step) in steps.items():
        if surface.is_trace and surface.trace_axis != letter:
            continue
        if not _is_length(step):
            raise SurfaceError(f"{name}: step along {letter} is {step}: give a positive length")
        if height.shape[axis] < 8:
            raise SurfaceError(
                f"{name}: {height.shape[axis]} points along {letter}; at least 8 are needed"
            )
    if height.dtype.kind != "f":
        raise SurfaceError(f"{name}: heights are of type {height.dtype}, not real numbers")
    # A sum is not finite when any term is not, and needs no array of its own.
    if not np.isfinite(height.sum(dtype=np.float64)):
        missing = ~np.isfinite(height)
        first = tuple(int(index) for index in np.argwhere(missing)[0])
        count = int(missing.sum())
        raise SurfaceError(
            f"{name}: {count} of {height.size} heights are missing (NaN or infinite), the first "
            f"at index {first[0] if surface.is_trace and first[1] == 0 else first}; fill them "
            "with fill_missing=True or in the instrument's software, or cut the surface to a "
            "measured part"
        )
    if (text := outliers_text(height)) is not None:
        raise SurfaceError(f"{name}: {text}")
    slope = rms_slope(surface)
    if slope > STEEPEST_SLOPE:
        raise SurfaceError(
            f"{name}: the root mean square slope is {slope:.3g} ({np.degrees(np.arctan(slope)):.0f}"
            " degrees): the unit of the heights or of the lengths is wrong; set height_unit= "
            "and length_unit="
        )
    return surface


def _is_length(step: Any) -> bool:  # noqa: ANN401 - user input
    try:
        return not isinstance(step, str) and number(step, "step_m") > 0
    except SurfaceError:
        return False


def rms_slope(surface: Surface) -> float:
    """Return the root mean square slope, from differences of neighbours; the larger direction."""
    height, steps = surface.height, (surface.step_x_m, surface.step_y_m)
    if height.flags.f_contiguous:
        height, steps = height.T, steps[::-1]
    totals = np.zeros(2)
    # Blocks of rows stay in the cache.
    rows = max(1, 2**16 // height.shape[1])
    for first in range(0, len(height), rows):
        block = height[first : first + rows + 1]
        for axis, part in enumerate((block, block[:rows])):
            totals[axis] += np.square(np.diff(part, axis=axis), dtype=np.float64).sum()
    return max(
        float(np.sqrt(total / height.size)) / step if step > 0 else 0.0
        for total, step in zip(totals, steps, strict=True)
    )


def is_uniform(positions: NDArray[np.float64]) -> bool:
    """Return whether numbers can be the positions of a trace."""
    try:
        uniform_step(positions, "positions")
    except SurfaceError:
        return False
    return True


def uniform_step(positions: NDArray[np.float64], name: str) -> float:
    """Return the step of equidistant positions, in their unit.

    Raises SurfaceError if they are not increasing, or more than 0.05 steps from a uniform grid.
    """
    if not np.all(np.isfinite(positions)):
        raise SurfaceError(f"{name}: positions hold missing or infinite numbers")
    count = positions.size
    if count < 2:
        raise SurfaceError(f"{name}: {count} position; at least 8 are needed")
    if positions[-1] < positions[0]:
        raise SurfaceError(f"{name}: positions decrease; sort the file by position")
    step = (positions[-1] - positions[0]) / (count - 1)
    ideal = positions[0] + step * np.arange(count)
    worst = int(np.argmax(np.abs(positions - ideal)))
    if step <= 0 or abs(positions[worst] - ideal[worst]) > LARGEST_STEP_DEVIATION * step:
        raise SurfaceError(
            f"{name}: positions are not equidistant: number {worst + 1} is {positions[worst]:.8g}, "
            f"{ideal[worst]:.8g} would be; the mean step is {step:.6g}. Resample the surface to "
            "equal steps"
        )
    return float(step)
