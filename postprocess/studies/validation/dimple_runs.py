"""Runs of the rolling dimple of Mourier, Mazuyer, Lubrecht and Donnet (2006)."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from ehlwave.results.case_file import read_contact
from ehlwave.surface import conditions_from_keys, map_surface
from studies.programs import Groups
from studies.sweeps import fields_file, write_surface
from studies.validation.sweep import swept

Floats = NDArray[np.float64]

CONTACT = {
    "radius_x_m": 12.5e-3,
    "radius_y_m": 12.5e-3,
    "reduced_modulus_pa": 110e9,
    "load_n": 15.0,
    "mean_speed_m_per_s": 0.09,
    "viscosity_pa_s": 0.25,
}
OIL = {"pressure_viscosity_per_pa": 22e-9, "roelands_index": 0.5206}

DEPTH_NM = 175.0
"""Of the dimple in their simulation, not of the real one, which was 7 um deep."""

RADIUS_UM = 1.2 * 15.5
"""Where the dimple of their simulation crosses the undisturbed surface."""

DOMAIN, WIDE_DOMAIN = (-4.0, 1.5, 3.0), (-10.0, 1.5, 6.0)
"""x_min and x_max, units of a, and y_max; P = 0 at the edges."""

_END = 4.5  # T: a whole number of steps on every grid, with the dimple past the contact centre
_REACH = 2.2  # radii to which the dimple is followed: 1e-4 of its depth is left
_STEP_UM = 0.4


_SHARED = {"conditions": CONTACT, "lubricant": OIL, "output": {"fields": True}}


@dataclass(frozen=True)
class Grid:
    """A mesh of square cells, so many in a, on a domain."""

    per_a: int
    domain: tuple[float, float, float] = DOMAIN

    def keys(self) -> dict[str, float]:
        """Return the keys of a case."""
        x_min, x_max, y_max = self.domain
        return {
            **{"x_min": x_min, "x_max": x_max, "y_max": y_max},
            "cells_x": round((x_max - x_min) * self.per_a),
            "cells_y": round(2 * y_max * self.per_a),
        }


@dataclass(frozen=True)
class Line:
    """Film, nm, and pressure, MPa, along the centre line against x, um, from the contact centre."""

    x_um: Floats
    film: Floats
    pressure: Floats

    def at(self, quantity: str, x_um: Floats) -> Floats:
        """Return film or pressure at places, by a cubic spline."""
        return CubicSpline(self.x_um, getattr(self, quantity))(x_um)


def semi_axis_um() -> float:
    """Return the Hertz semi-axis a, um."""
    return conditions_from_keys(CONTACT).semi_axis_a_m * 1e6


def dimple_heights(x_um: Floats, y_um: Floats) -> Floats:
    """Return heights, m, of shape (x, y): -d cos(pi q/2) exp(-2 q^2), q the radius over 18.6 um."""
    q = np.hypot(x_um[:, None], y_um[None, :]) / RADIUS_UM
    return -1e-9 * DEPTH_NM * np.cos(0.5 * np.pi * q) * np.exp(-2 * q**2)


def smooth_lines(folder: Path, grids: Sequence[Grid]) -> list[Line]:
    """Return the steady state of smooth surfaces on each grid."""
    return _lines(folder, "smooth", _SHARED, grids)


def dimple_lines(folder: Path, name: str, grids: Sequence[Grid], centre_um: float) -> list[Line]:
    """Return the lines on each grid when the dimple of the surface is at `centre_um`.

    The front of the surface starts at x_min, so its flat part ahead of the dimple is made as long
    as the dimple has to lie behind it at the end: the time is that of a whole step on every grid.
    """
    ahead = (DOMAIN[0] + _END) * semi_axis_um() - centre_um
    step = ahead / round(ahead / _STEP_UM)
    count = int(np.ceil(_REACH * RADIUS_UM / step))
    x = step * np.arange(-count, round(ahead / step) + 1)
    y = _STEP_UM * np.arange(-round(_REACH * RADIUS_UM / _STEP_UM), 1)
    y = np.concatenate([y, -y[-2::-1]])
    heights = dimple_heights(x, y)
    surface = map_surface(heights, step * 1e-6, _STEP_UM * 1e-6, "dimple")
    march = {
        "surface": {"file": str(write_surface(folder, surface).resolve())},
        "dynamics": {"end_time": _END},
        "solver": {"error_estimate": "model"},
    }
    return _lines(folder, name, {**_SHARED, **march}, grids)


def _lines(folder: Path, name: str, groups: Groups, grids: Sequence[Grid]) -> list[Line]:
    results = swept(folder, name, groups, [grid.keys() for grid in grids])
    lines = []
    for case_id in results["case_id"].values.tolist():
        fields = read_contact(fields_file(folder, name, {"case_id": case_id}))
        middle = int(np.argmin(np.abs(fields["y"].values)))
        lines.append(
            Line(
                fields["x"].values * float(fields["semi_axis_a_m"]) * 1e6,
                fields["film"].values[middle] * float(fields["hertz_approach_c_m"]) * 1e9,
                fields["pressure"].values[middle] * float(fields["hertz_pressure_pa"]) * 1e-6,
            )
        )
    return lines
