"""Stresses below contacts that were solved: files of ``ehlwave-case --output``."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from ehlwave.choices import POISSON_RATIO
from ehlwave.errors import StressError
from ehlwave.results.case_file import (
    CONTACT_PRESSURE,
    read_contact,
    total_pressure,
    whole_domain,
)
from ehlwave.stress.field import stress_below, stress_line
from ehlwave.stress.loads import checked_depths, checked_load
from ehlwave.stress.waves import COMPONENTS

Floats = NDArray[np.float64]

OVER_TIME = {"pressure": "pressure_over_time", "shear": "mean_shear_stress_over_time_pa"}


@dataclass(frozen=True)
class SolvedContact:
    """A solved contact in the units of stresses."""

    case: xr.Dataset
    """As :func:`ehlwave.read_case` reads it."""
    steps_m: tuple[float, float]
    """Steps of the grid."""
    scales_m: tuple[float, float]
    """a and b; 1 and b/a where the case has no lengths: all lengths are in units of a then."""
    has_lengths: bool
    """Whether it has."""
    hertz_pa: float
    """Largest Hertz pressure."""
    slip: float
    """S of the first surface."""
    solid_friction: float = 0.0
    """Friction coefficient of solids that touch."""

    def loads(self, body: int, sets: Mapping[str, xr.DataArray]) -> dict[str, xr.DataArray]:
        """Return pressure and traction on a body, Pa, from fields of the file over x and y in m.

        The oil drags the faster body back: the mean shear stress, above 0 where the first surface
        is faster, acts on it with a minus. So do solids that touch, by their friction.
        """
        if body not in (1, 2):
            raise StressError(f"body = {body}: 1 (whose slip parameter is S) or 2")
        a, b = self.scales_m
        places = {"x": self.case["x"].values * a, "y": self.case["y"].values * b}
        found = {"pressure_pa": sets["pressure"] * self.hertz_pa}
        borne = None
        if "shear" in sets:
            borne = xr.where(sets["pressure"] > 0, sets["shear"], 0.0)
        if "solids" in sets:
            rubbed = np.sign(self.slip - 1) * self.solid_friction * self.hertz_pa * sets["solids"]
            borne = rubbed if borne is None else borne + rubbed
        if borne is not None:
            found["traction_x_pa"] = borne * (-1 if body == 1 else 1)
        return {kind: load.assign_coords(places) for kind, load in found.items()}

    @property
    def last(self) -> dict[str, xr.DataArray]:
        """Fields of the last solution."""
        fields = {"pressure": total_pressure(self.case)}
        if CONTACT_PRESSURE in self.case:
            fields["solids"] = self.case[CONTACT_PRESSURE]
        if "mean_shear_stress_pa" in self.case:
            fields["shear"] = self.case["mean_shear_stress_pa"]
        return fields


def solved_contact(case: xr.Dataset | str | Path) -> SolvedContact:
    """Return a solved contact from its file.

    Raises
    ------
    ResultsError
        If the file cannot be read, or has no fields.
    """
    data = whole_domain(case) if isinstance(case, xr.Dataset) else read_contact(case)
    has_lengths = "semi_axis_a_m" in data
    a = float(data["semi_axis_a_m"]) if has_lengths else 1.0
    b = float(data["semi_axis_b_m"]) if "semi_axis_b_m" in data else a * _width_over_length(data)
    steps = [
        float(data[letter][1] - data[letter][0]) * scale if data[letter].size > 1 else 1.0
        for letter, scale in (("x", a), ("y", b))
    ]
    slip = _key(data, "slip_parameter")
    return SolvedContact(
        case=data,
        steps_m=(steps[0], steps[1]),
        scales_m=(a, b),
        has_lengths=has_lengths,
        hertz_pa=_hertz_pressure(data),
        slip=1.0 if slip is None else slip,
        solid_friction=_key(data, "solid_friction") or 0.0,
    )


def _key(data: xr.Dataset, key: str) -> float | None:
    """Return a number of the input that the case was computed from."""
    text = str(data.attrs.get("effective_input", ""))
    found = re.search(rf"\b{key} = ([-+.0-9eE]+)", text)
    return None if found is None else float(found[1])


def _hertz_pressure(data: xr.Dataset) -> float:
    """Return ph, Pa; of a case without dimensions alphabar over alpha."""
    if "hertz_pressure_pa" in data:
        return float(data["hertz_pressure_pa"])
    alpha = _key(data, "pressure_viscosity_per_pa")
    if alpha is None or "alphabar" not in data or not float(data["alphabar"]) > 0:
        raise StressError(
            "the case has no pressure in Pa: give it dimensional conditions, or an oil with "
            "pressure_viscosity_per_pa"
        )
    return float(data["alphabar"]) / alpha


def _width_over_length(data: xr.Dataset) -> float:
    """Return b/a of a case without lengths; 1 of a line contact, which has no width."""
    return 1 / float(data["kappa"]) if "kappa" in data and float(data["kappa"]) > 0 else 1.0


def stress_of_case(
    case: xr.Dataset | str | Path,
    depths_m: ArrayLike,
    body: int = 1,
    poisson_ratio: float = POISSON_RATIO,
    workers: int = 1,
) -> xr.Dataset:
    """Return the stresses below the last solution of a case, friction included.

    Parameters
    ----------
    case : Dataset or path
        A file of ``ehlwave-case --output``.
    depths_m : array_like
        Depths, m; in units of a where the case was given by M, L and D alone.
    body : {1, 2}
        The first surface, whose slip parameter is S, or the second.
    poisson_ratio, workers
        As of :func:`ehlwave.stress.stress_below`.
    """
    contact = solved_contact(case)
    loads = contact.loads(body, contact.last)
    pressure = loads.pop("pressure_pa")
    found = stress_below(
        pressure, contact.steps_m, depths_m, poisson_ratio=poisson_ratio, workers=workers, **loads
    )
    return found.assign_attrs(body=body, length_unit="m" if contact.has_lengths else "a")


def line_stress_over_time(
    case: xr.Dataset | str | Path,
    depths_m: ArrayLike,
    body: int = 1,
    poisson_ratio: float = POISSON_RATIO,
) -> xr.Dataset:
    """Return the stresses in the plane y = 0 over time, of a march with ``fields_every``.

    Returns
    -------
    xarray.Dataset
        The components over (time, z, x), Pa and m, with ``time`` as the way of the mean speed, m.
        ``smooth`` components, ``sxx_smooth`` and so on, belong to the first solution.

    Raises
    ------
    StressError
        If the file has no fields over time.
    """
    contact = solved_contact(case)
    data = contact.case
    if OVER_TIME["pressure"] not in data:
        raise StressError(
            "the file has no fields over time: run ehlwave-case with &output fields_every = N /"
        )
    depths = checked_depths(depths_m)
    sets = {kind: data[name] for kind, name in OVER_TIME.items() if name in data}
    loads = contact.loads(body, sets)
    first = {kind: load.isel(field_time=0) for kind, load in loads.items()}
    row = int(np.argmin(np.abs(data["y"].values)))
    smooth = stress_below(
        first.get("pressure_pa"),
        contact.steps_m,
        depths,
        traction_x_pa=first.get("traction_x_pa"),
        poisson_ratio=poisson_ratio,
    ).isel(y=row)
    count = data["field_time"].size
    shape = (count, depths.size, data["x"].size)
    values = {name: np.empty(shape) for name in COMPONENTS}
    for index in range(count):
        # Drop changes, which bear nothing as a whole: their images are too far to matter.
        change = [
            loads[kind].isel(field_time=index) - first[kind] if kind in loads else None
            for kind in ("pressure_pa", "traction_x_pa")
        ]
        load = checked_load(*change, None, contact.steps_m, poisson_ratio)
        for name, line in stress_line(load, depths, row).items():
            values[name][index] = smooth[name].values + line
    way = data["field_time"].values * contact.scales_m[0]
    over = {name: (("time", "z", "x"), field, {"units": "Pa"}) for name, field in values.items()}
    steady = {f"{name}_smooth": (("z", "x"), smooth[name].values) for name in COMPONENTS}
    coordinates = {"time": way, "z": depths, "x": smooth["x"].values}
    return xr.Dataset(over | steady, coords=coordinates, attrs={"slip_parameter": contact.slip})


def point_histories(stress: xr.Dataset, slip: float, points_m: ArrayLike) -> xr.Dataset:
    """Return the stresses of material points over time, from those in the plane of the contact.

    Parameters
    ----------
    stress : Dataset
        From :func:`line_stress_over_time`.
    slip : float
        S of the body whose points are followed: S of the first body, 2 - S of the second.
    points_m : array_like
        X of the points at time 0, m: at time t they are at X + S t, t as the way of the mean speed.

    Returns
    -------
    xarray.Dataset
        Components over (time, z, point). Beyond the computed domain the stress is that at its end.
    """
    points = np.atleast_1d(np.asarray(points_m, dtype=float))
    x, ways = stress["x"].values, stress["time"].values
    at = np.clip(points + slip * ways[:, None], x[0], x[-1])
    found = {}
    for name in COMPONENTS:
        values = stress[name].transpose("time", "z", "x").values
        lines = [
            scipy.interpolate.CubicSpline(x, line, axis=1)(place)
            for line, place in zip(values, at, strict=True)
        ]
        found[name] = (("time", "z", "point"), np.array(lines), {"units": "Pa"})
    coordinates = {"time": ways, "z": stress["z"].values, "point": points}
    return xr.Dataset(found, coords=coordinates)
