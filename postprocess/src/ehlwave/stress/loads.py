"""Loads on the surface of a body: arrays, checked, in a fixed order of axes."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from ehlwave.choices import POISSON_RATIO
from ehlwave.errors import StressError, SurfaceError
from ehlwave.quantities import number, plain

Floats = NDArray[np.float64]

SAME_STEP = 1e-6
"""Relative: coordinates of a DataArray are kept where their steps are those that are given."""


PoissonRatio = float | tuple[float, float]
"""Value for both bodies, or for the first and the second."""

DEEPEST = 100.0
"""Semi-axes a: stresses of the contact are below a thousandth there, of lines below a hundredth."""


@dataclass(frozen=True)
class Load:
    """Pressure and traction on a grid."""

    fields: dict[str, Floats]
    """By kind, as the keys of :data:`ehlwave.stress.waves.LOADS`, Pa; shape shape (nx, ny)."""
    steps_m: tuple[float, float]
    """Steps of the grid."""
    poisson_ratio: float
    """Poisson's ratio of the body."""
    periodic: tuple[bool, bool]
    """Whether the load repeats along x, along y."""
    x_m: Floats
    y_m: Floats
    """`x_m`, `y_m`: places."""

    @property
    def shape(self) -> tuple[int, int]:
        """Points along x and y."""
        return self.x_m.size, self.y_m.size

    @property
    def directions(self) -> list[tuple[bool, int]]:
        """Whether it repeats, and the points, along x and along y."""
        return list(zip(self.periodic, self.shape, strict=True))


def checked_load(
    pressure_pa: ArrayLike | xr.DataArray | None,
    traction_x_pa: ArrayLike | xr.DataArray | None,
    traction_y_pa: ArrayLike | xr.DataArray | None,
    steps_m: tuple[float, float] | float,
    poisson_ratio: float = POISSON_RATIO,
    periodic: bool | tuple[bool, bool] = False,
) -> Load:
    """Return loads that can be computed with; arguments as of :func:`ehlwave.stress.stress_below`.

    Raises StressError if there is none, shapes differ, a value is not finite, or a number makes no
    sense.
    """
    given = {
        "pressure_pa": pressure_pa,
        "traction_x_pa": traction_x_pa,
        "traction_y_pa": traction_y_pa,
    }
    given = {name: field for name, field in given.items() if field is not None}
    if not given:
        raise StressError("pressure_pa: give a pressure or a traction")
    fields = {name: _field(field, name) for name, field in given.items()}
    shapes = {name: field.shape for name, field in fields.items()}
    if len(set(shapes.values())) > 1:
        raise StressError(f"shapes differ, [x, y]: {shapes}")
    poisson_ratio = checked_poisson_ratio(poisson_ratio)
    shape = next(iter(shapes.values()))
    steps = _steps(steps_m, shape)
    places = [
        _places(given.values(), letter, n, step)
        for letter, n, step in zip("xy", shape, steps, strict=True)
    ]
    both = (periodic, periodic) if isinstance(periodic, bool | np.bool_) else tuple(periodic)
    if len(both) != 2:
        raise StressError(f"periodic = {periodic}: one truth value, or one for x and one for y")
    return Load(fields, steps, poisson_ratio, (bool(both[0]), bool(both[1])), *places)


def checked_number(value: Any, name: str) -> float:  # noqa: ANN401 - user input
    """Return a number as :func:`ehlwave.quantities.number` does; its doubts are a StressError."""
    try:
        return number(value, name)
    except SurfaceError as error:
        raise StressError(str(error)) from None


def checked_poisson_ratio(poisson_ratio: Any) -> float:  # noqa: ANN401 - user input
    """Return Poisson's ratio of an isotropic body; StressError outside -1 to 0.5."""
    found = checked_number(poisson_ratio, "poisson_ratio")
    if not -1 < found <= 0.5:
        raise StressError(f"poisson_ratio = {found:g}: must be above -1 and at most 0.5")
    return found


def checked_poisson_ratios(poisson_ratio: Any) -> tuple[float, float]:  # noqa: ANN401
    """Return the values of both bodies, given as one number or two; StressError as for one."""
    is_pair = isinstance(poisson_ratio, list | tuple) and len(poisson_ratio) == 2
    first, second = poisson_ratio if is_pair else (poisson_ratio, poisson_ratio)
    return checked_poisson_ratio(first), checked_poisson_ratio(second)


def checked_depths(depths_m: Any, largest_m: float = np.inf) -> Floats:  # noqa: ANN401
    """Return depths as a list, m.

    Raises StressError if a value is no number, negative or too large, or missing.
    """
    try:
        depths = np.atleast_1d(np.asarray(plain(depths_m, "depths_m"), dtype=float)).ravel()
    except SurfaceError as error:
        raise StressError(str(error)) from None
    except (TypeError, ValueError):
        raise StressError(f"depths_m = {depths_m!r}: give numbers, m") from None
    if depths.size == 0 or not np.all(np.isfinite(depths)) or np.any(depths < 0):
        raise StressError(f"depths_m = {depths_m}: give depths below the surface, 0 m or more")
    if depths.max() > largest_m:
        raise StressError(
            f"depths_m: {depths.max():g} m is deeper than {largest_m:.3g} m, where nothing of the "
            f"contact is left: plain numbers are in m; did you mean {depths.max():g}e-6?"
        )
    return depths


def _field(field: ArrayLike | xr.DataArray, name: str) -> Floats:
    """Return a load over [x, y]."""
    if isinstance(field, xr.DataArray):
        others = [str(dim) for dim in field.dims if dim not in ("x", "y")]
        if others:
            raise StressError(
                f"{name}: has the dimension {others[0]} besides x and y: select one of it first"
            )
        missing = [dim for dim in ("x", "y") if dim not in field.dims]
        values = field.expand_dims(missing).transpose("x", "y").values
    else:
        values = np.asarray(field)
    if values.dtype.kind not in "fiu":
        raise StressError(f"{name}: holds {values.dtype}, not real numbers")
    values = values.astype(float, copy=False)
    if values.ndim == 1:
        values = values[:, None]
    if values.ndim != 2 or values.size == 0:
        raise StressError(f"{name}: has the shape {values.shape}; [x, y] is needed")
    if not np.all(np.isfinite(values)):
        missing_values = int(np.sum(~np.isfinite(values)))
        raise StressError(f"{name}: {missing_values} of {values.size} values are not finite")
    return values


def _steps(steps_m: tuple[float, float] | float, shape: tuple[int, ...]) -> tuple[float, float]:
    """Return steps along x and y; 1 for a single point."""
    both = np.atleast_1d(np.asarray(steps_m, dtype=float)).ravel()
    if both.size not in (1, 2):
        raise StressError(f"steps_m = {steps_m}: give the steps along x and y, m")
    steps = [float(step) for step in np.broadcast_to(both, 2)]
    for letter, count, step in zip("xy", shape, steps, strict=True):
        if count > 1 and not (np.isfinite(step) and step > 0):
            raise StressError(f"steps_m: the step along {letter} is {step}: give a length above 0")
    return tuple(step if n > 1 else 1.0 for step, n in zip(steps, shape, strict=True))  # type: ignore[return-value]


def _places(fields: object, letter: str, count: int, step: float) -> Floats:
    """Return places along an axis: from a DataArray in metres, else from 0 on."""
    for field in fields:  # type: ignore[attr-defined]
        if isinstance(field, xr.DataArray) and letter in field.coords and field[letter].ndim == 1:
            places = np.asarray(field[letter].values, dtype=float)
            if count == 1 or np.allclose(np.diff(places), step, rtol=SAME_STEP, atol=0):
                return places
    return step * np.arange(count) if count > 1 else np.zeros(1)
