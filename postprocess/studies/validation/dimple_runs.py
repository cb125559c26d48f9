"""Runs of the rolling dimple of Mourier, Mazuyer, Lubrecht and Donnet (2006)."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from ehlwave_post.deform import conditions_from_keys, map_surface, write_simulation_surface
from ehlwave_post.errors import ResultsError
from studies.programs import Groups, namelist, run

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

CELLS_PER_A = (32, 64)
DOMAIN = (-4.0, 1.5, 3.0)
"""x_min, x_max and y_max, units of a; P = 0 at its edges."""

WIDE_DOMAIN = (-10.0, 1.5, 6.0)

_END = 4.5  # T: a whole number of steps on every grid, with the dimple past the contact centre
_REACH = 2.2  # radii to which the dimple is followed: 1e-4 of its depth is left
_STEP_UM = 0.4


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
    return conditions_from_keys(CONTACT | {"pressure_viscosity_per_pa": 22e-9}).semi_axis_a_m * 1e6


def dimple_heights(x_um: Floats, y_um: Floats) -> Floats:
    """Return heights, m, of shape (x, y): -d cos(pi q/2) exp(-2 q^2), q the radius over 18.6 um."""
    q = np.hypot(x_um[:, None], y_um[None, :]) / RADIUS_UM
    return -1e-9 * DEPTH_NM * np.cos(0.5 * np.pi * q) * np.exp(-2 * q**2)


def smooth_line(folder: Path, per_a: int, domain: tuple[float, float, float] = DOMAIN) -> Line:
    """Return the steady state of smooth surfaces, on a mesh of `per_a` cells in a."""
    name = f"smooth_{per_a}" + ("" if domain == DOMAIN else "_wide")
    return _line(folder, name, _groups(per_a, domain))


def dimple_line(folder: Path, name: str, per_a: int, centre_um: float) -> Line:
    """Return the centre line when the middle of the dimple of the surface is at `centre_um`.

    The front of the surface starts at x_min, so its flat part ahead of the dimple is made as long
    as the dimple has to lie behind it at the end: the time is that of a whole step on every grid.
    """
    ahead = (DOMAIN[0] + _END) * semi_axis_um() - centre_um
    step = ahead / round(ahead / _STEP_UM)
    count = int(np.ceil(_REACH * RADIUS_UM / step))
    x = step * np.arange(-count, round(ahead / step) + 1)
    y = _STEP_UM * np.arange(-round(_REACH * RADIUS_UM / _STEP_UM), 1)
    y = np.concatenate([y, -y[-2::-1]])
    surface = map_surface(dimple_heights(x, y), step * 1e-6, _STEP_UM * 1e-6, "dimple")
    write_simulation_surface(surface, folder / f"{name}_surface.h5")
    march = {
        "surface": {"file": f"{name}_surface.h5"},
        "dynamics": {"end_time": _END},
        "solver": {"error_estimate": "model"},
    }
    # the place is in the text, so that a run with the dimple elsewhere is another one
    return _line(folder, name, {**_groups(per_a, DOMAIN), **march}, f"! {centre_um:.6f} um\n")


def _groups(per_a: int, domain: tuple[float, float, float]) -> dict[str, dict[str, Any]]:
    x_min, x_max, y_max = domain
    return {
        "conditions": CONTACT,
        "lubricant": OIL,
        "grid": {
            **{"x_min": x_min, "x_max": x_max, "y_max": y_max},
            "cells_x": round((x_max - x_min) * per_a),
            "cells_y": round(2 * y_max * per_a),
        },
    }


def _line(folder: Path, name: str, groups: Groups, remark: str = "") -> Line:
    """Return the centre line of a case, run unless there is a file of the same input."""
    text = remark + namelist(groups)
    source, target = folder / f"{name}.nml", folder / f"{name}.h5"
    if not (target.is_file() and source.is_file() and source.read_text(encoding="utf-8") == text):
        target.unlink(missing_ok=True)
        source.write_text(text, encoding="utf-8")
        outcome = run("case", source.name, "--quiet", "--output", target.name, folder=folder)
        if outcome.returncode != 0:
            raise ResultsError(f"{source}: {(outcome.stderr or outcome.stdout).strip()[-500:]}")
    with h5py.File(target) as file:
        status = file.attrs["status"].decode()
        if status != "converged":
            raise ResultsError(f"{target}: status {status}")
        middle = int(np.argmin(np.abs(file["y"][()])))
        return Line(
            file["x"][()] * float(file["length_a_m"][()]) * 1e6,
            file["film"][middle] * float(file["length_c_m"][()]) * 1e9,
            file["pressure"][middle] * float(file["hertz_pressure_pa"][()]) * 1e-6,
        )
