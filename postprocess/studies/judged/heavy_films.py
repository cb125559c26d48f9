"""Smallest over central films of heavy and slender contacts that roll, on fine grids."""

import json
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

import ehlwave
from ehlwave.errors import EhlwaveError
from ehlwave.laws.atlas.constriction import LARGEST_M, terms
from ehlwave.writing import Writer
from studies.judged.runs import groups_of, kept, log_uniform, solved
from studies.sweeps import Row

Floats = NDArray[np.float64]

RIDGE = 0.1
"""How much coefficients are held to zero, in units of terms."""
RANGES = {
    "load_parameter_m": (5.0, 100000.0),
    "lubricant_parameter_l": (2.0, 42.0),
    "radius_ratio_d": (0.01, 1.0),
    "pressure_viscosity_per_pa": (1e-8, 3e-8),
    "roelands_index": (0.4, 0.8),
}
HEAVY_RANGE, ALL = (300.0, 20000.0), 300
"""M of contacts after so many that have all the range."""
CELLS = ((6000.0, 512), (12000.0, 768), (math.inf, 1024))
"""Cells along X and Y up to a load M, of the fitted scheme: within 1 % of twice the cells."""
LARGEST_ERROR = 0.25
"""Declared error of a computed smallest film, several times the true one; others are left out."""


def drawn(number: int) -> dict[str, float]:
    """Return keys of a contact that rolls, within the wide atlas and outside the usual atlas."""
    random = np.random.default_rng([52, number])
    while True:
        ranges = RANGES | ({} if number < ALL else {"load_parameter_m": HEAVY_RANGE})
        keys = {name: log_uniform(random, *ends) for name, ends in ranges.items()}
        try:
            film = ehlwave.Contact(**keys).film()
        except EhlwaveError:
            continue
        if "6912" not in film.source:  # ranges of the usual atlas
            return keys


def study(number: int, folder: Path) -> Row:
    """Return films of the package and of the program, Moes scale."""
    keys = drawn(number)
    contact = ehlwave.Contact(**keys)
    film = contact.film()
    chart = contact.atlas().at(contact.conditions.atlas_keys())
    cells = next(cells for most, cells in CELLS if keys["load_parameter_m"] <= most)
    grid = {"cells_x": cells, "cells_y": cells}
    found = solved(groups_of(keys, grid=grid, solver={"scheme": "fitted"}), folder)
    row: Row = keys | {
        "minimum_law": film.minimum_moes,
        "minimum_law_error": film.minimum_error,
        "central_law_error": film.central_error,
        "networks": chart.ratio_of_networks(),
    }
    if found is None:
        return row
    scale = found["central_film_moes"] / found["central_film"]
    return row | {
        "central": found["central_film_moes"],
        "minimum": found["minimum_film"] * scale,
        "central_error": found["central_film_error"],
        "minimum_error": found["minimum_film_error"],
    }


def computed(path: Path, count: int, at_once: int) -> list[Row]:
    """Return rows of so many contacts."""
    return kept(path, range(count), study, at_once)


PACKAGE = Path(__file__).resolve().parents[2] / "src/ehlwave/laws/atlas/constriction.json"
FOLDS, WITHIN, MOST_TIMES = 12, 0.97, 2.0
"""Parts held out in turn; share of the contacts within the error; largest deviation over it."""


def usable(rows: Sequence[Row]) -> pd.DataFrame:
    """Return the contacts whose smallest film the grid resolves."""
    table = pd.DataFrame(rows)
    return table[
        (table["load_parameter_m"] <= LARGEST_M) & (table["minimum_error"] < LARGEST_ERROR)
    ]


def fit(table: pd.DataFrame) -> tuple[dict[str, list[float]], list[Row]]:
    """Return the data of the package, and rows of its present answers and of the fit, held out."""
    names = ("load_parameter_m", "lubricant_parameter_l", "radius_ratio_d")
    log_networks = np.log(table["networks"].to_numpy())
    a = terms(*(table[name].to_numpy() for name in names), log_networks)
    y = np.log((table["minimum"] / table["central"]).to_numpy())
    fold = np.arange(len(y)) % FOLDS
    off = np.zeros_like(y)
    for one in range(FOLDS):
        left = fold != one
        off[~left] = np.abs(np.expm1(a[~left] @ _solved(a[left], y[left]) - y[~left]))
    error = max(float(np.quantile(off, WITHIN)), float(off.max() / MOST_TIMES))
    known = table[table["minimum_law"].notna()]
    before = np.abs((known["minimum_law"] / known["minimum"] - 1).to_numpy())
    central = table["central_law_error"].to_numpy()
    table_rows = [
        _row("before", before, known["minimum_law_error"].to_numpy()),
        _row("corrected", off, central + error),
    ]
    found = {
        "coefficients": _solved(a, y),
        "error": [error],
        "low": [y.min()],
        "high": [y.max()],
    }
    return {name: [float(f"{c:.5g}") for c in values] for name, values in found.items()}, table_rows


def _solved(a: Floats, y: Floats) -> Floats:
    """Return least squares coefficients, held a little to zero."""
    damped = np.concatenate([a, RIDGE * np.eye(a.shape[1])])
    found: Floats = np.linalg.lstsq(damped, np.concatenate([y, np.zeros(a.shape[1])]), rcond=None)[
        0
    ]
    return found


def _row(law: str, off: Floats, error: Floats) -> Row:
    times = off / error
    return {
        "law": law,
        "contacts": len(off),
        "rms": float(np.sqrt(np.mean(off**2))),
        "mean_error": float(error.mean()),
        "within": float(np.mean(times <= 1)),
        "beyond_1.5": float(np.mean(times > 1.5)),
        "largest": float(off.max()),
    }


def write(found: dict[str, list[float]], path: Path = PACKAGE) -> None:
    """Write the data of the package."""
    Writer(overwrite=True).text(path, json.dumps(found, indent=1) + "\n")
