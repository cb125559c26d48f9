"""Heights as they are in a file, an array or an object of SurfaceTopography."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeGuard

import h5py
import numpy as np
from numpy.typing import NDArray

from ehlwave.errors import SurfaceError
from ehlwave.extras import install
from ehlwave.hdf5 import DATA_PER_BYTE, opened, reason
from ehlwave.inputs.surfaces import TopographyLike

MOST_POINTS = 100_000_000
"""In a file; what claims more is refused before memory is asked for."""

METRE = "m"


@dataclass
class RawSurface:
    """Heights as in a file, with what the file says about them.

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
    """Whether commas were taken as decimal ones."""


SurfaceSource = str | Path | NDArray[Any] | TopographyLike
"""What a surface is read from."""


def is_topography(source: object) -> TypeGuard[TopographyLike]:
    """Return whether this is an object of SurfaceTopography."""
    return all(hasattr(source, name) for name in ("heights", "is_uniform", "physical_sizes"))


def raw_array(heights: NDArray[Any], place: Path) -> RawSurface:
    """Return an array as it would be in a ``.npy`` file, in metres unless options say otherwise."""
    values = np.ma.asarray(heights)
    if values.dtype.kind not in "fiu":
        raise SurfaceError(f"{place}: holds {values.dtype} where real numbers are expected")
    if np.ma.is_masked(values):
        values = values.astype(np.float64)
    filled = np.ma.filled(values, np.nan) if np.ma.is_masked(values) else values.data
    return RawSurface(np.asarray(filled), length_unit=METRE, height_unit=METRE)


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


def raw_instrument(file: Path) -> RawSurface:
    """Return a file of an instrument, as SurfaceTopography reads it.

    Raises SurfaceError if it is not installed, or cannot read the file.
    """
    try:
        import SurfaceTopography  # optional, and slow to import
    except ImportError as error:
        raise SurfaceError(
            f"{file}: this format is read by SurfaceTopography, which is not installed: "
            f"{install('instruments')} (CSV, NumPy and HDF5 need nothing)"
        ) from error
    if h5py.is_hdf5(file):
        with opened(file):
            pass  # it stands for itself
    try:
        # Its readers raise whatever a damaged file makes them stumble into.
        reader = SurfaceTopography.open_topography(str(file))
        points = math.prod(reader.channels[0].nb_grid_pts)
        refuse_large(file, points)
        if points > DATA_PER_BYTE * file.stat().st_size:
            raise SurfaceError(f"{file}: claims {points} numbers that it cannot hold")
        return raw_topography(reader.topography(), file)
    except SurfaceError:
        raise
    except Exception as error:
        raise SurfaceError(
            f"{file}: SurfaceTopography cannot read it ({type(error).__name__}: {reason(error)})"
        ) from error


def refuse_large(file: Path, points: int) -> None:
    """Raise SurfaceError if a file claims more points than are read."""
    if points > MOST_POINTS:
        raise SurfaceError(f"{file}: claims {points} numbers, more than {MOST_POINTS}")


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
