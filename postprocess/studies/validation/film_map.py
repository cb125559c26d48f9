"""Films of smooth contacts over a map of M, L and D."""

from itertools import product
from pathlib import Path

import pandas as pd

from ehlwave.results.schema import CONVERGED
from studies.validation.sweep import swept

LOADS = (20, 50, 100, 200, 500)
LUBRICANTS = (2.5, 5, 10, 20)
RATIOS = (1, 0.35, 0.12)

GRIDS = {"coarse": {"cells_x": 128, "cells_y": 128}, "fine": {"cells_x": 256, "cells_y": 256}}
NEAR = {"x_min": -4, "x_max": 1.5, "y_max": 2}
WIDE = {"x_min": -9.5, "x_max": 1.5, "y_max": 4}
"""Twice the lengths: on the cells of the fine grid it has the mesh of the coarse one."""

LARGEST_ERROR = 0.03
"""Of a central film that is compared; where the coarse grid is too coarse it is larger."""


def films(folder: Path) -> pd.DataFrame:
    """Return the films of the map that are resolved, to mesh size 0 and as on the wide domain.

    Columns: ``m``, ``l``, ``d``; ``central`` and ``smallest`` film in the Moes scale, and
    ``central_error`` and ``smallest_error``, relative.

    Errors are what was added for mesh and domain: at small loads twice the domain once more adds as
    much again (M = 20, L = 2.5, D = 0.12: 2.2 %), elsewhere a third or less.
    """
    rows = [
        {"load_parameter_m": m, "lubricant_parameter_l": l, "radius_ratio_d": d}
        for m, l, d in product(LOADS, LUBRICANTS, RATIOS)
    ]
    coarse, fine, wide = (
        swept(folder, f"films_{name}", {"grid": {**cells, **domain}}, rows).to_dataframe()
        for name, cells, domain in (
            ("coarse", GRIDS["coarse"], NEAR),
            ("fine", GRIDS["fine"], NEAR),
            ("wide", GRIDS["fine"], WIDE),
        )
    )
    found = fine[list(rows[0])].set_axis(["m", "l", "d"], axis=1)
    for name, film in (("central", _central), ("smallest", _smallest)):
        mesh, domain = (film(fine) - film(coarse)) / 3, film(wide) / film(coarse)
        found[name] = (film(fine) + mesh) * domain
        found[f"{name}_error"] = (mesh / film(fine)).abs() + (domain - 1).abs()
    return found[(fine["status"] == CONVERGED) & (found["central_error"] <= LARGEST_ERROR)]


def _central(results: pd.DataFrame) -> pd.Series:
    return results["central_film_moes"]


def _smallest(results: pd.DataFrame) -> pd.Series:
    return results["central_film_moes"] * (results["minimum_film"] / results["central_film"])
