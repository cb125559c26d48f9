"""Stresses below any pressure and traction: :func:`stress_below`."""

from collections.abc import Iterator

import numpy as np
import scipy
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from ehlwave.choices import POISSON_RATIO
from ehlwave.stress.images import ImageCorrection, coarse_factor
from ehlwave.stress.loads import Load, checked_depths, checked_load
from ehlwave.stress.spectral import RepeatedLoad
from ehlwave.stress.waves import COMPONENTS

Floats = NDArray[np.float64]

SINGLE_PRECISION_VALUES = 2**27
"""Results of more values than this are kept in single precision: a gigabyte instead of two."""

LONG_NAMES = {
    "sxx": "normal stress along x",
    "syy": "normal stress along y",
    "szz": "normal stress along z",
    "sxy": "shear stress in the xy plane",
    "syz": "shear stress in the yz plane",
    "sxz": "shear stress in the xz plane",
}


def stress_below(
    pressure_pa: ArrayLike | xr.DataArray | None,
    steps_m: tuple[float, float] | float,
    depths_m: ArrayLike,
    *,
    traction_x_pa: ArrayLike | xr.DataArray | None = None,
    traction_y_pa: ArrayLike | xr.DataArray | None = None,
    poisson_ratio: float = POISSON_RATIO,
    periodic: bool | tuple[bool, bool] = False,
    workers: int = 1,
) -> xr.Dataset:
    """Return the stresses below a pressure and a traction on an elastic half-space.

    Parameters
    ----------
    pressure_pa : array_like or DataArray, or None
        Compression positive, Pa. Plain arrays are [x, y]; a DataArray goes by the names of its
        dimensions, ``x`` and ``y`` in any order. A single point along y (or a one-dimensional
        array): nothing varies along y, plane strain. None: no pressure.
    steps_m : (float, float)
        Steps of the grid along x and y, m. The step in a direction with a single point does not
        matter.
    depths_m : array_like
        Depths below the surface, m, 0 or more.
    traction_x_pa, traction_y_pa : array_like or DataArray, optional
        Traction on the body along +x and +y, Pa; as the pressure.
    poisson_ratio : float
        Of the body.
    periodic : bool, or a pair for x and y
        Whether the load repeats beyond its ends, or ends there. A mean pressure that repeats along
        both axes is borne without lateral strain: sxx = syy = nu/(1 - nu) szz.
    workers : int
        Threads of the transforms.

    Returns
    -------
    xarray.Dataset
        ``sxx``, ``syy``, ``szz``, ``sxy``, ``syz``, ``sxz`` in Pa, tension positive, over (z, x, y)
        in m; z points into the body.

    Raises
    ------
    StressError
        A ValueError: an argument makes no sense; the message names it.
    """
    load = checked_load(pressure_pa, traction_x_pa, traction_y_pa, steps_m, poisson_ratio, periodic)
    depths = checked_depths(depths_m)
    shape = (depths.size, *load.shape)
    is_large = len(COMPONENTS) * np.prod(shape, dtype=float) > SINGLE_PRECISION_VALUES
    values = {name: np.empty(shape, np.float32 if is_large else float) for name in COMPONENTS}
    for index, plane in enumerate(stress_planes(load, depths, workers)):
        for name, field in plane.items():
            values[name][index] = field
    return xr.Dataset(
        {
            name: (("z", "x", "y"), field, {"units": "Pa", "long_name": LONG_NAMES[name]})
            for name, field in values.items()
        },
        coords={
            "z": ("z", depths, {"units": "m", "long_name": "depth"}),
            "x": ("x", load.x_m, {"units": "m"}),
            "y": ("y", load.y_m, {"units": "m"}),
        },
        attrs={"poisson_ratio": load.poisson_ratio, "sign": "tension positive, z into the body"},
    )


def stress_planes(load: Load, depths_m: Floats, workers: int = 1) -> Iterator[dict[str, Floats]]:
    """Yield the stresses at each depth, [x, y]; a single plane is held at a time."""
    ends = tuple(not endless and count > 1 for endless, count in load.directions)
    is_endless = not ends[0], not ends[1]
    factor = tuple(coarse_factor(n) if end else 1 for n, end in zip(load.shape, ends, strict=True))
    periods = tuple(
        m * scipy.fft.next_fast_len(2 * -(-n // m), real=True) if end else n
        for n, m, end in zip(load.shape, factor, ends, strict=True)
    )
    scales = load.steps_m, load.poisson_ratio
    near = RepeatedLoad(load.fields, *scales, periods, is_endless, workers=workers)
    images = ImageCorrection(load.fields, *scales, periods, factor, ends) if any(ends) else None
    for depth in depths_m:
        plane = near.at(float(depth))
        if images is not None:
            for name, correction in images.at(float(depth)).items():
                plane[name] += correction
        yield plane


def stress_line(load: Load, depths_m: Floats, row: int) -> dict[str, Floats]:
    """Return the stresses along x at a row of y, (z, x), of loads with zero sum.

    The effect of images of such loads is too small to be subtracted.
    """
    periods = tuple(n if n == 1 else scipy.fft.next_fast_len(2 * n, real=True) for n in load.shape)
    is_endless = load.shape[0] == 1, load.shape[1] == 1
    waves = RepeatedLoad(load.fields, load.steps_m, load.poisson_ratio, periods, is_endless)
    lines = [waves.line_at(float(depth), row) for depth in depths_m]
    return {name: np.array([line[name] for line in lines]) for name in COMPONENTS}
