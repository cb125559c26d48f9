"""Criteria of a stress: von Mises, largest shear, orthogonal shear, hydrostatic stress.

Stresses are datasets as from :func:`ehlwave.stress.stress_below`, or any mapping of the six
components to arrays of equal shape; tension positive.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

Stress = Mapping[Any, Any]


def hydrostatic(stress: Stress) -> Any:  # noqa: ANN401 - as the stresses
    """Return the mean normal stress, below 0 in compression."""
    return (stress["sxx"] + stress["syy"] + stress["szz"]) / 3


def von_mises(stress: Stress) -> Any:  # noqa: ANN401
    """Return the equivalent stress of von Mises, (3 J2)^(1/2), theory eq. (B4)."""
    return np.sqrt(3 * _second_invariant(_deviator(stress)))


def largest_shear(stress: Stress) -> Any:  # noqa: ANN401
    """Return half the difference of the largest and the smallest principal stress (Tresca).

    s1 - s3 = 2 J2^(1/2) sin(theta + pi/3) with cos(3 theta) = (27/4)^(1/2) J3/J2^(3/2).
    """
    deviator = _deviator(stress)
    square = _second_invariant(deviator)
    tiny = np.finfo(float).tiny ** 0.5
    cosine = 27**0.5 / 2 * _third_invariant(deviator) / np.maximum(square, tiny) ** 1.5
    theta = np.arccos(np.clip(cosine, -1, 1)) / 3
    return np.sqrt(square) * np.sin(theta + np.pi / 3)


def orthogonal_shear(stress: Stress) -> Any:  # noqa: ANN401
    """Return the size of the shear stress in the plane of rolling and depth, sxz."""
    return abs(stress["sxz"])


CRITERIA = {
    "von_mises": von_mises,
    "largest_shear": largest_shear,
    "orthogonal_shear": orthogonal_shear,
}
"""By name, as in tables and files."""


@dataclass(frozen=True)
class Largest:
    """The largest value of a field, and where it is.

    Attributes
    ----------
    value : float
        In the unit of the field.
    depth_m, x_m, y_m : float
        Its place; 0 where the field has no such coordinate.
    """

    value: float
    depth_m: float = 0.0
    x_m: float = 0.0
    y_m: float = 0.0


def largest(field: xr.DataArray) -> Largest:
    """Return the largest value of a field over z, x and y, between the points of the grid.

    A parabola through the largest value on the grid and its neighbours gives the place along each
    coordinate, and the excess of the largest value over the grid value.
    """
    index = np.unravel_index(int(np.argmax(field.values)), field.shape)
    value, places = float(field.values[index]), {}
    for axis, name in enumerate(field.dims):
        at = np.asarray(field[name].values, dtype=float)
        i = int(index[axis])
        places[str(name)] = float(at[i])
        if 0 < i < at.size - 1:
            near = field.values[(*index[:axis], slice(i - 1, i + 2), *index[axis + 1 :])]
            line = [float(one) for one in near]
            shift, rise = _parabola(at[i - 1 : i + 2] - at[i], line)
            places[str(name)] += shift
            value += rise
    named = {"z": "depth_m", "x": "x_m", "y": "y_m"}
    return Largest(value, **{named[k]: place for k, place in places.items() if k in named})


def _parabola(at: np.ndarray, values: list[float]) -> tuple[float, float]:
    """Return where the parabola of three points, the middle at 0, is largest, and its excess."""
    left, right = values[0] - values[1], values[2] - values[1]
    bend = (left / at[0] - right / at[2]) / (at[0] - at[2])
    slope = left / at[0] - bend * at[0]
    if bend >= 0:
        return 0.0, 0.0
    shift = -slope / (2 * bend)
    return float(shift), float(-bend * shift**2)


def _deviator(stress: Stress) -> tuple[Any, ...]:
    """Return the components less the hydrostatic stress."""
    mean = hydrostatic(stress)
    normal = tuple(stress[name] - mean for name in ("sxx", "syy", "szz"))
    return *normal, stress["sxy"], stress["syz"], stress["sxz"]


def _second_invariant(deviator: tuple[Any, ...]) -> Any:  # noqa: ANN401
    sx, sy, sz, xy, yz, xz = deviator
    return (sx**2 + sy**2 + sz**2) / 2 + xy**2 + yz**2 + xz**2


def _third_invariant(deviator: tuple[Any, ...]) -> Any:  # noqa: ANN401
    sx, sy, sz, xy, yz, xz = deviator
    return sx * (sy * sz - yz**2) - xy * (xy * sz - yz * xz) + xz * (xy * yz - sy * xz)
