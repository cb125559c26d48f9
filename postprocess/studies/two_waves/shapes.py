"""Ridges and dimples that slide through a contact: their shapes, and the sweeps that compute them.

The surface is low, 5 per cent of the film, so that a march in time is linear.
"""

import itertools
import sys
from pathlib import Path

import numpy as np

from ehlwave.surface import Conditions, Surface, conditions_from_keys, map_surface, trace_surface
from studies import sweeps

CONTACT = {
    "radius_x_m": 12.5e-3,
    "radius_y_m": 12.5e-3,
    "reduced_modulus_pa": 226e9,
    "load_n": 20.0,
    "mean_speed_m_per_s": 0.5,
    "viscosity_pa_s": 0.1,
}
"""A ball on a disc, M = 39 and L = 12."""

STRESS_PA = 5e6
SLIPS = (1.3, 0.7)
SIGNS = {"ridge": 1, "groove": -1, "bump": 1, "dimple": -1}
"""Signs of the heights. Ridge and groove lie across rolling, bump and dimple are round."""

SHARE = 0.05
"""Height over film."""

WAVELENGTHS = tuple(float(x) for x in np.geomspace(0.3, 6.2, 10).round(4))
WAVELENGTHS_ACROSS = tuple(float(x) for x in np.geomspace(0.3, 6.2, 8).round(4))
"""Over a, along X and along Y, of the responses from which shapes are predicted."""

WAVES, MARCHES, SMOOTH = "sliding_responses", "sliding_shapes", "sliding_smooth"
ALONG = "sliding_along"
"""Names of the sweeps."""

HALF_WIDTH = 0.25
"""Half width of a shape, in units of a: height exp(-(x/0.25 a)^2), for round shapes with the radius
for x.
"""

LENGTH = 6.0
"""Length of the surface, in units of a, the shape in its middle."""

POINTS_PER_A = {"ridge": 64, "groove": 64, "bump": 48, "dimple": 48}
"""Points of the surface, as its smoothness requires."""

X_MIN, PLACE = -2.5, 0.1
"""Where the leading end of the surface starts, and where its middle is at the end, X."""


def conditions_at(slip: float, film_m: float | None = None) -> Conditions:
    """Return the contact at this slip, with the computed film where it is known."""
    known = {} if film_m is None else {"central_film_m": film_m}
    keys = {"pressure_viscosity_per_pa": 2.2e-8, "eyring_stress_pa": STRESS_PA}
    return conditions_from_keys({**CONTACT, **keys, **known, "slip_parameter": slip})


def shape(name: str, film_m: float) -> Surface:
    """Return a shape of ``SIGNS``, ridges as traces; heights 5 per cent of the film."""
    a_m = conditions_at(1.0).semi_axis_a_m
    count = round(LENGTH * POINTS_PER_A[name])
    step = LENGTH / count
    hill = np.exp(-(((np.arange(count + 1) - count / 2) * step / HALF_WIDTH) ** 2))
    height = SIGNS[name] * SHARE * film_m
    if name in ("ridge", "groove"):
        return trace_surface(height * hill, step * a_m, name=name)
    return map_surface(height * np.outer(hill, hill), step * a_m, step * a_m, name)


def write_cases(folder: Path, cells: int = 128) -> list[str]:
    """Write the sweeps of linear responses, of marches, and of the rest; return their names."""
    shared = {
        "conditions": CONTACT,
        "lubricant": {"flow_law": "eyring", "eyring_stress_pa": STRESS_PA},
        "grid": {"cells_x": cells, "cells_y": cells, "edges": "flooded"},
    }
    waviness = {"orientation": "custom", "response": "harmonic"}
    rows: list[sweeps.Row] = [
        {"slip_parameter": slip, "wavelength_x_over_a": along, "wavelength_y_over_a": across}
        for slip in SLIPS
        for along, across in itertools.product((*WAVELENGTHS, 0.0), (*WAVELENGTHS_ACROSS, 0.0))
        if along or across
    ]
    sweeps.write_sweep(folder, WAVES, rows, {**shared, "waviness": waviness})
    film_m = float(conditions_at(1.0).central_film_m or np.nan)
    rows = []
    for slip, name in itertools.product(SLIPS, SIGNS):
        path = sweeps.write_surface(folder, shape(name, film_m))
        place = {"file": str(path.resolve()), "end_time": end_time(slip)}
        rows.append({"slip_parameter": slip, **place})
    march = {**shared, "solver": {"error_estimate": "model"}, "output": {"fields": True}}
    sweeps.write_sweep(folder, MARCHES, rows, march)
    sweeps.write_sweep(folder, SMOOTH, [{"slip_parameter": slip} for slip in SLIPS], march)
    _write_along(folder, cells)
    return [WAVES, MARCHES, SMOOTH, ALONG]


def _write_along(folder: Path, cells: int) -> None:
    """Write the two cases of which the film along the contact is drawn: both oils."""
    groups = {
        "conditions": {**CONTACT, "slip_parameter": SLIPS[0]},
        "waviness": {"orientation": "transverse", "response": "harmonic"},
        "grid": {"cells_x": cells, "cells_y": cells, "edges": "flooded"},
        "output": {"fields": True},
    }
    oils: list[sweeps.Row] = [
        {"flow_law": "newtonian"},
        {"flow_law": "eyring", "eyring_stress_pa": STRESS_PA},
    ]
    rows = [{"wavelength_over_a": 0.7, **oil} for oil in oils]
    sweeps.write_sweep(folder, ALONG, rows, groups)


def end_time(slip: float) -> float:
    """Return the T at which the middle of the surface is at X = ``PLACE``."""
    return (PLACE - X_MIN + LENGTH / 2) / slip


if __name__ == "__main__":
    print(" ".join(write_cases(Path(sys.argv[1]))))
