"""Coefficients of formula (18) from the files that ``ehlwave refit`` writes."""

import json
from pathlib import Path

import numpy as np
import pandas as pd

from ehlwave.errors import SurfaceError
from ehlwave.hdf5 import reason


def read_coefficients(path: str | Path, group: str = "all") -> tuple[float, float]:
    """Return c1 and c2 of a group of points, fitted on f(r) V.

    Parameters
    ----------
    path : path
        ``refit.csv`` or ``refit.json``.
    group : str
        ``all`` points, or an orientation.

    Raises
    ------
    SurfaceError
        If the file cannot be read, or has no such row or no coefficients in it.
    """
    file = Path(path)
    if not file.is_file():
        raise SurfaceError(f"{file}: no such file; ehlwave refit writes refit.csv")
    try:
        if file.suffix.lower() == ".json":
            rows = pd.DataFrame(json.loads(file.read_text(encoding="utf-8"))["rows"])
        else:
            rows = pd.read_csv(file)
        chosen = rows[(rows["group"] == group) & (rows["variable"] == "f_v")]
        if chosen.empty:
            there = ", ".join(sorted(set(rows["group"].astype(str))))
            raise SurfaceError(f"{file}: has no group {group!r} on f_v; there is: {there}")
        pair = chosen[["c1", "c2"]].astype(float).iloc[0]
    except SurfaceError:
        raise
    except Exception as error:
        # The readers raise whatever a damaged file makes them stumble into.
        raise SurfaceError(f"{file}: not a file of ehlwave refit ({reason(error)})") from error
    if not np.isfinite(pair).all():
        raise SurfaceError(f"{file}: group {group!r} was not fitted (too few points)")
    return float(pair["c1"]), float(pair["c2"])
