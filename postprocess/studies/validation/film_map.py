"""Films of smooth contacts over a map of M, L and D."""

from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np
import xarray as xr

from ehlwave_post.schema import CONVERGED
from studies.validation.sweep import swept

LOADS = (20, 50, 100, 200, 500)
LUBRICANTS = (2.5, 5, 10, 20)
RATIOS = (1, 0.35, 0.12)

GRIDS = {
    "coarse": {"cells_x": 128, "cells_y": 128},
    "fine": {"cells_x": 256, "cells_y": 256},
}
NEAR = {"x_min": -4, "x_max": 1.5, "y_max": 2}
WIDE = {"x_min": -9.5, "x_max": 1.5, "y_max": 4}
"""Twice the lengths: on the cells of the fine grid it has the mesh of the coarse one."""

LARGEST_ERROR = 0.03
"""Of a central film that is compared; where the coarse grid is too coarse it is larger."""


@dataclass(frozen=True)
class Film:
    """Central and smallest film of one contact in the Moes scale, with their relative errors."""

    m: float
    l: float
    d: float
    central: float
    central_error: float
    smallest: float
    smallest_error: float


def films(folder: Path) -> list[Film]:
    """Return the films of the map that are resolved, to mesh size 0 and as on the wide domain.

    Errors are what was added for mesh and domain: at small loads twice the domain once more adds as
    much again (M = 20, L = 2.5, D = 0.12: 2.2 %), elsewhere a third or less.
    """
    rows = [
        {"load_parameter_m": m, "lubricant_parameter_l": l, "radius_ratio_d": d}
        for m, l, d in product(LOADS, LUBRICANTS, RATIOS)
    ]
    coarse = swept(folder, "films_coarse", {"grid": {**GRIDS["coarse"], **NEAR}}, rows)
    fine = swept(folder, "films_fine", {"grid": {**GRIDS["fine"], **NEAR}}, rows)
    wide = swept(folder, "films_wide", {"grid": {**GRIDS["fine"], **WIDE}}, rows)
    central, central_error = _extrapolated(*map(_central, (coarse, fine, wide)))
    smallest, smallest_error = _extrapolated(*map(_smallest, (coarse, fine, wide)))
    is_good = (fine["status"] == CONVERGED).values & (central_error <= LARGEST_ERROR)
    return [
        Film(
            *(float(fine[name][index]) for name in rows[0]),
            *(float(one[index]) for one in (central, central_error, smallest, smallest_error)),
        )
        for index in np.flatnonzero(is_good)
    ]


def _central(results: xr.Dataset) -> np.ndarray:
    return results["central_film_moes"].values


def _smallest(results: xr.Dataset) -> np.ndarray:
    ratio = results["minimum_film"].values / results["central_film"].values
    return results["central_film_moes"].values * ratio


def _extrapolated(
    coarse: np.ndarray, fine: np.ndarray, wide: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return films to mesh size 0 on the wide domain, and their relative errors."""
    mesh, domain = (fine - coarse) / 3, wide / coarse
    values = (fine + mesh) * domain
    return values, np.abs(mesh / fine) + np.abs(domain - 1)
