"""Speeds, friction and areas of touching line contacts beside values of an independent solver.

The contacts and values are those of ``tests/verification/reference/touching_line.csv``.
"""

import argparse
import math
import sys
import tempfile
from pathlib import Path
from typing import Any

import pandas as pd

from ehlwave.writing import Writer
from studies import programs, touching

_REFERENCE = programs.ROOT / "tests" / "verification" / "reference" / "touching_line.csv"
_CELLS = 1536
_HALVED = 0.5
"""Share whose speed is also computed on half the mesh."""
_HERTZ_PA = 0.6e9
_WAVE = {"orientation": "transverse", "wavelength_over_a": 0.5, "amplitude_m": 50e-9}
_SPEED, _FRICTION, _AREA, _MOVED = 0.015, 0.02, 0.02, 0.01
"""Bounds: of relative deviations of speed and friction of the oil, of the deviation of the area,
and of the relative change of the speed on half the mesh."""
_DIGIT = 5e-6
"""Rounding of the reference friction."""


def groups_of(case: str, share: float, cells: int) -> touching.Groups:
    """Return the groups of a contact of the table."""
    width = 4 * _HERTZ_PA * touching.RADIUS_M / touching.MODULUS_PA
    groups: touching.Groups = {
        "conditions": {
            **{"radius_x_m": touching.RADIUS_M, "reduced_modulus_pa": touching.MODULUS_PA},
            **{"load_n_per_m": math.pi * _HERTZ_PA * width / 2, "viscosity_pa_s": 0.04},
            **{"mean_speed_m_per_s": 0.05, "slip_parameter": 0},
        },
        "lubricant": {
            **{"pressure_viscosity_per_pa": touching.ALPHA, "roelands_index": 0.68},
            **{"flow_law": "eyring", "eyring_stress_pa": 1e7},
        },
        "touching": {"film_m": touching.BOUNDARY_M, "share": share},
        "grid": {"x_min": -4, "x_max": 2, "cells_x": cells, "edges": "truncated"},
    }
    return groups | ({"waviness": _WAVE} if case == "wavyC" else {})


def compare(expected: dict[str, Any], cells: int) -> dict[str, Any]:
    """Return a contact on a mesh beside the table; deviations are NaN where it has no solution."""
    with tempfile.TemporaryDirectory() as name:
        groups = groups_of(expected["case"], expected["share"], cells)
        found = touching.solve(groups, Path(name))
    values = {key: found.get(key) or math.nan for key in _VALUES}
    friction = -values["oil_friction_coefficient"]
    return {
        **{"case": expected["case"], "share": expected["share"], "cells": cells},
        **{"status": found.get("status")} | values,
        "speed_off": values["mean_speed_m_per_s"] / expected["u_m_s"] - 1,
        "friction_off": friction / expected["mu_oil"] - 1,
        "friction_rounding": _DIGIT / expected["mu_oil"],
        "area_off": values["touching_area"] - expected["area_over_2b"],
    }


_VALUES = (
    *("mean_speed_m_per_s", "mean_speed_error", "oil_friction_coefficient", "touching_area"),
    *("mean_film_um", "residual", "nonlinear_steps"),
)


def failures(table: pd.DataFrame) -> list[str]:
    """Return the rows that are outside a bound."""
    judged = table[table.cells == _CELLS].set_index(["case", "share"])
    half = table[table.cells > _CELLS].set_index(["case", "share"]).mean_speed_m_per_s
    moved = (half / judged.mean_speed_m_per_s[half.index] - 1).abs()
    within = {
        "speed": judged.speed_off.abs() <= _SPEED,
        "friction": judged.friction_off.abs() <= _FRICTION + judged.friction_rounding,
        "area": judged.area_off.abs() <= _AREA,
        "speed on half the mesh": moved <= _MOVED,
    }
    return [
        f"{case}, share {share}: {name}"
        for name, good in within.items()
        for case, share in good[~good].index
    ]


def main() -> int:
    """Compute all contacts of the table on both meshes and compare."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--record", type=Path, required=True, help="table to write, CSV")
    options = parser.parse_args()
    rows = pd.read_csv(_REFERENCE).to_dict("records")
    runs = [(row, _CELLS) for row in rows]
    runs += [(row, 2 * _CELLS) for row in rows if row["share"] == _HALVED]
    table = pd.DataFrame([compare(*run) for run in runs])
    Writer(overwrite=True).text(options.record, table.to_csv(index=False, float_format="%.6g"))
    off = failures(table)
    judged = table[table.cells == _CELLS]
    largest = judged[["speed_off", "friction_off", "area_off"]].abs().max()
    sys.stdout.write(
        f"{len(judged)} steady states on {_CELLS} cells: speed off by at most "
        f"{largest.speed_off:.2%}, friction of the oil {largest.friction_off:.2%}, area "
        f"{largest.area_off:.4f}; outside: {off or 'none'}\n"
    )
    return int(bool(off))


if __name__ == "__main__":
    sys.exit(main())
