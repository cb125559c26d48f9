"""The rolling dimple of Mourier, Mazuyer, Lubrecht and Donnet (2006), where they have it."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from ehlwave.results.case_file import read_contact
from ehlwave.results.schema import SETTLED
from ehlwave.surface import conditions_from_keys, map_surface
from studies.programs import Groups, run
from studies.published.values import centre_line
from studies.sweeps import fields_file, read_sweep, write_surface, write_sweep

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
"""Depth of the dimple in their simulation; the real one was 7 um deep."""

RADIUS_UM = 1.2 * 15.5
"""Radius at which the dimple of their simulation crosses the undisturbed surface."""

X_MIN, X_MAX, Y_MAX = -4.0, 1.5, 3.0
"""Edges of the domain, units of a; P = 0 there."""

_END = 4.5  # T: a whole number of steps on every grid, with the dimple past the contact centre
_REACH = 2.2  # radii to which the dimple is followed: 1e-4 of its depth is left
_STEP_UM = 0.4

_SHARED = {"conditions": CONTACT, "lubricant": OIL, "output": {"fields": True}}


@dataclass(frozen=True)
class Line:
    """Film (nm) along the centre line against x (um) from the contact centre."""

    x_um: Floats
    film: Floats

    def deviations(self, instant: int) -> tuple[Floats, Floats]:
        """Return the published places, um, and the film over the published film, less 1."""
        x, published = (np.array(one) for one in centre_line("simulated", instant, "film"))
        return x, CubicSpline(self.x_um, self.film)(x) / published - 1


def dimple_heights(x_um: Floats, y_um: Floats) -> Floats:
    """Return heights, m, of shape (x, y): -d cos(pi q/2) exp(-2 q^2), q the radius over 18.6 um."""
    q = np.hypot(x_um[:, None], y_um[None, :]) / RADIUS_UM
    return -1e-9 * DEPTH_NM * np.cos(0.5 * np.pi * q) * np.exp(-2 * q**2)


def smooth_line(folder: Path, cells_per_a: int) -> Line:
    """Return the film of smooth surfaces."""
    return _line(folder, "smooth", _SHARED, cells_per_a)


def dimple_line(folder: Path, cells_per_a: int, centre_um: float) -> Line:
    """Return the film when the dimple of the surface is at `centre_um`.

    The front of the surface starts at x_min. Its flat part ahead of the dimple has the length that
    puts the dimple there at the end time, a whole number of steps on every grid.
    """
    semi_axis_um = conditions_from_keys(CONTACT).semi_axis_a_m * 1e6
    ahead = (X_MIN + _END) * semi_axis_um - centre_um
    step = ahead / round(ahead / _STEP_UM)
    count = int(np.ceil(_REACH * RADIUS_UM / step))
    x = step * np.arange(-count, round(ahead / step) + 1)
    y = _STEP_UM * np.arange(-round(_REACH * RADIUS_UM / _STEP_UM), 1)
    y = np.concatenate([y, -y[-2::-1]])
    surface = map_surface(dimple_heights(x, y), step * 1e-6, _STEP_UM * 1e-6, "dimple")
    march = {
        "surface": {"file": str(write_surface(folder, surface).resolve())},
        "dynamics": {"end_time": _END},
        "solver": {"error_estimate": "model"},
    }
    return _line(folder, "dimple", {**_SHARED, **march}, cells_per_a)


def _line(folder: Path, name: str, groups: Groups, cells_per_a: int) -> Line:
    grid = {
        **{"x_min": X_MIN, "x_max": X_MAX, "y_max": Y_MAX},
        "cells_x": round((X_MAX - X_MIN) * cells_per_a),
        "cells_y": round(2 * Y_MAX * cells_per_a),
    }
    outcome = run("sweep", write_sweep(folder, name, [grid], groups))
    if outcome.returncode not in (0, 1):
        raise AssertionError(outcome.stdout + outcome.stderr)
    (row,) = read_sweep(folder, name, 1)
    if row["status"] not in SETTLED:
        raise AssertionError(f"{name}: status {row['status']}")
    fields = read_contact(fields_file(folder, name, row))
    middle = int(np.argmin(np.abs(fields["y"].values)))
    return Line(
        fields["x"].values * float(fields["semi_axis_a_m"]) * 1e6,
        fields["film"].values[middle] * float(fields["hertz_approach_c_m"]) * 1e9,
    )
