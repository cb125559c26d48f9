"""Heights as they are in a file, an array or an object of SurfaceTopography."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import NDArray

from ehlwave.errors import SurfaceError
from ehlwave.extras import install
from ehlwave.inputs.surfaces import TopographyLike

MOST_POINTS = 100_000_000
"""In a file; a larger claim is refused before memory is allocated."""

METRE = "m"


@dataclass
class RawSurface:
    """Heights as in a file, with the metadata of the file.

    ``height`` has one dimension (a trace), or two (rows of constant y).
    """

    height: np.ndarray
    x: np.ndarray | None = None
    y: np.ndarray | None = None
    length_unit: str | None = None
    height_unit: str | None = None
    step: float | None = None
    step_across: float | None = None
    is_across: bool = False
    """Whether a trace is known to run along y of its file."""
    has_decimal_commas: bool = False
    """Whether commas were read as decimal commas."""
    notes: list[str] = field(default_factory=list)
    """How the file was read: its format, channel, columns, parts left out."""


SurfaceSource = str | Path | NDArray[Any] | TopographyLike
"""Sources of a surface."""


def is_topography(source: object) -> TypeGuard[TopographyLike]:
    """Return whether this is an object of SurfaceTopography."""
    return all(hasattr(source, name) for name in ("heights", "is_uniform", "physical_sizes"))


def raw_array(heights: NDArray[Any], place: Path) -> RawSurface:
    """Return an array as it would be in a ``.npy`` file; options give its units."""
    values = np.ma.asarray(heights)
    numbers_of(place, values)
    if np.ma.is_masked(values):
        values = values.astype(np.float64)
    filled = np.ma.filled(values, np.nan) if np.ma.is_masked(values) else values.data
    return RawSurface(np.asarray(filled))


def raw_topography(topography: TopographyLike, place: Path) -> RawSurface:
    """Return the heights, steps and unit of an object of SurfaceTopography.

    Raises SurfaceError if its points are not equidistant.
    """
    if not topography.is_uniform:
        raise SurfaceError(f"{place}: points are not equidistant: resample to equal steps")
    height = np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), np.nan)
    steps = topography.pixel_size
    across = float(steps[1]) if len(steps) > 1 else None
    # It holds heights as (x, y); files here are rows of constant y.
    return RawSurface(
        height.T,
        length_unit=topography.unit,
        height_unit=topography.unit,
        step=float(steps[0]),
        step_across=across,
    )


def refuse_large(file: Path, points: int) -> None:
    """Raise SurfaceError if a file claims more points than are read."""
    if points > MOST_POINTS:
        raise SurfaceError(f"{file}: claims {points} numbers, more than {MOST_POINTS}")


def numbers_of(file: Path, values: Any) -> np.ndarray:  # noqa: ANN401
    """Return an array of real numbers, SurfaceError if it is none."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise SurfaceError(f"{file}: holds {array.dtype} where real numbers are expected")
    return array


def topography_of(height: NDArray[Any], steps: tuple[float, float], name: str) -> Any:  # noqa: ANN401
    """Return heights, m, as an object of SurfaceTopography: a line scan of a trace, else a map.

    Raises SurfaceError if it is not installed.
    """
    try:
        from SurfaceTopography import Topography, UniformLineScan
    except ImportError as error:
        raise SurfaceError(
            f"{name}: SurfaceTopography is not installed: {install('instruments')}"
        ) from error
    sizes = [count * step for count, step in zip(height.shape, steps, strict=True) if count > 1]
    values, info = np.asarray(height, dtype=np.float64), {"name": name}
    if 1 in height.shape:
        return UniformLineScan(values.ravel(), sizes[0], unit=METRE, info=info)
    return Topography(values, tuple(sizes), unit=METRE, info=info)
