"""Dang Van's criterion over the histories of many material points, theory eq. (B5).

    factor = max over time of tau(t)/(tau_f - c sigma_H(t)),

tension positive; tau is Tresca's shear of the deviator less the centre of the smallest hypersphere
about its path, sigma_H the hydrostatic stress. 1 or more: cracks begin within the cycles that tau_f
is of. Material of bearings: Morales-Espejel and Brizmer (2011), Tribology Transactions 54.
"""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from ehlwave.errors import StressError
from ehlwave.stress.criteria import hydrostatic, largest_shear
from ehlwave.stress.enclosing import enclosing_balls
from ehlwave.stress.waves import COMPONENTS

Floats = NDArray[np.float64]

PRESSURE_COEFFICIENT = 0.232
"""c of bearing steel."""

AT_ONCE = 2**22
"""Numbers of histories that are held as deviators at a time."""

LEAST_SHARE = 1e-12
"""Components smaller than this share of the largest are nothing."""


def fatigue_shear(cycles: ArrayLike) -> Floats:
    """Return tau_f of bearing steel, Pa, for N cycles: (1220 - 43 ln N) MPa over 3^(1/2).

    Raises
    ------
    StressError
        Below one cycle, or beyond the cycles at which the limit vanishes.
    """
    number = np.asarray(cycles, dtype=float)
    with np.errstate(divide="ignore", invalid="ignore"):
        strength = (1220 - 43 * np.log(number)) * 1e6 / 3**0.5
    if not np.all((number >= 1) & (strength > 0)):
        raise StressError(f"cycles = {cycles}: must be 1 to {np.exp(1220 / 43):.2g}")
    return np.asarray(strength)


def limit_text(cycles: float) -> str:
    """Return the limit that factors are relative to, and the meaning of a share at risk."""
    tau_f = float(fatigue_shear(cycles)) * 1e-6
    return (
        f"Limit        Dang Van's factor is relative to bearing steel at {cycles:.3g} load cycles: "
        f"tau_f = {tau_f:.4g} MPa,\n"
        f"             c = {PRESSURE_COEFFICIENT} (Morales-Espejel and Brizmer 2011). From 1 on "
        "cracks begin within these cycles.\n"
        "             Share of surface at risk: points of the surface with a factor of 1 or more "
        "at some depth."
    )


class Path(NamedTuple):
    """Shear stress tau and hydrostatic stress over time, arrays with time first, Pa."""

    shear: Floats
    hydrostatic: Floats


def dang_van_factor(
    history: xr.Dataset | Mapping[str, ArrayLike],
    fatigue_shear_pa: float,
    pressure_coefficient: float = PRESSURE_COEFFICIENT,
    dim: str = "time",
) -> Any:  # noqa: ANN401 - as the history
    """Return Dang Van's factor of every material point.

    Parameters
    ----------
    history : Dataset or mapping of arrays
        The six components, Pa, tension positive, of material points over ``dim`` and any other
        dimensions; of plain arrays the first axis is time.
    fatigue_shear_pa, pressure_coefficient : float
        tau_f, as of :func:`fatigue_shear`, and c.
    dim : str
        Name of the dimension of time of a Dataset.

    Returns
    -------
    DataArray or ndarray
        Over the other dimensions. Infinite where tension alone is more than the material bears.
    """
    if not fatigue_shear_pa > 0:
        raise StressError(f"fatigue_shear_pa = {fatigue_shear_pa}: must be above 0")
    arrays, template = _time_first(history, dim)
    shape = arrays["sxx"].shape
    factor = np.empty(int(np.prod(shape[1:])))
    for part, path in _paths(arrays):
        strength = fatigue_shear_pa - pressure_coefficient * path.hydrostatic
        with np.errstate(divide="ignore"):
            risk = np.where(strength > 0, path.shear / np.where(strength > 0, strength, 1), np.inf)
        factor[part] = risk.max(axis=0)
    values = factor.reshape(shape[1:])
    if template is None:
        return values
    labelled = template.copy(data=values).assign_attrs(long_name="Dang Van's factor")
    labelled.name = "dang_van"
    return labelled


def dang_van_path(history: xr.Dataset | Mapping[str, ArrayLike], dim: str = "time") -> Path:
    """Return shear and hydrostatic stress over time; arguments as of :func:`dang_van_factor`."""
    arrays, _ = _time_first(history, dim)
    shape = arrays["sxx"].shape
    shear, pressure = np.empty((2, shape[0], int(np.prod(shape[1:]))))
    for part, path in _paths(arrays):
        shear[:, part], pressure[:, part] = path
    return Path(shear.reshape(shape), pressure.reshape(shape))


def _time_first(
    history: xr.Dataset | Mapping[str, ArrayLike], dim: str
) -> tuple[dict[str, Floats], xr.DataArray | None]:
    """Return arrays with time first, and the shape of a result without time."""
    missing = [name for name in COMPONENTS if name not in history]
    if missing:
        raise StressError(f"history: has no {missing[0]}; {', '.join(COMPONENTS)} are needed")
    if not isinstance(history, xr.Dataset):
        given = np.broadcast_arrays(*(np.asarray(history[name], float) for name in COMPONENTS))
        return dict(zip(COMPONENTS, given, strict=True)), None
    if dim not in history.dims:
        raise StressError(
            f"history: has no dimension {dim}, but {', '.join(map(str, history.dims))}"
        )
    turned = history[list(COMPONENTS)].transpose(dim, ...)
    arrays = {name: np.asarray(turned[name].values, float) for name in COMPONENTS}
    return arrays, turned["sxx"].isel({dim: 0}, drop=True)


def _paths(arrays: Mapping[str, Floats]) -> Iterator[tuple[slice, Path]]:
    """Yield parts of the material points, and their paths."""
    times = arrays["sxx"].shape[0]
    flat = {name: values.reshape(times, -1) for name, values in arrays.items()}
    points = flat["sxx"].shape[1]
    step = max(1, AT_ONCE // (5 * times))
    for first in range(0, points, step):
        part = slice(first, min(first + step, points))
        yield part, _path({name: values[:, part] for name, values in flat.items()})


def _path(stress: Mapping[str, Floats]) -> Path:
    """Return the path of material points, arrays over time and points."""
    places = _orthonormal(stress)
    sizes = np.array([np.abs(place).max(initial=0) for place in places])
    present = [i for i in range(5) if sizes[i] > LEAST_SHARE * sizes.max()]
    centre = np.zeros((5, places[0].shape[1]))
    if present:
        points = np.stack([places[i].T for i in present], axis=-1)
        scale = sizes.max()
        centre[present] = scale * enclosing_balls(points / scale).centre.T
    moved = [place - middle for place, middle in zip(places, centre, strict=True)]
    return Path(largest_shear(_deviator(moved)), hydrostatic(stress))


def _orthonormal(stress: Mapping[str, Floats]) -> list[Floats]:
    """Return the deviator in five coordinates whose distances equal tensor distances."""
    sxx, syy, szz = (stress[name] for name in ("sxx", "syy", "szz"))
    normal = [(sxx - szz) / 2**0.5, (2 * syy - sxx - szz) / 6**0.5]
    return normal + [2**0.5 * stress[name] for name in ("sxy", "syz", "sxz")]


def _deviator(places: list[Floats]) -> dict[str, Floats]:
    """Return the tensor of five such coordinates."""
    first, second = places[0] / 2**0.5, places[1] / 6**0.5
    normal = (first - second, 2 * second, -first - second)
    return dict(zip(COMPONENTS, (*normal, *(p / 2**0.5 for p in places[2:])), strict=True))
