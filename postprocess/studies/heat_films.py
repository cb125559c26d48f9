"""Fit of the smallest films of warm contacts, and errors of both films that hold."""

import json
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from ehlwave.laws.warm_films import smallest_factor
from ehlwave.writing import Writer
from studies.folds import held_out
from studies.sweeps import Row

Floats = NDArray[np.float64]

ROBUST = {"loss": "soft_l1", "f_scale": 0.015}
SMALLEST_START = (0.4, 0.0, 1.0, 0.0, 0.15, -0.5, 1.0)
PACKAGE = Path(__file__).resolve().parents[1] / "src/ehlwave/laws/warm_films.json"
STEPS = np.array([0.004, 0.006, 0.008, 0.012, 0.016, 0.02, 0.03]), np.linspace(0.0, 0.5, 51)
MOST_WARM_STEPS = np.linspace(0, 0.2, 21)
LEAST_BY_LOSS = 0.2
"""Least weight of e1 of smallest films: heavy lines are fewer in the sample than their error
requires.
"""
WITHIN, FAR, MOST_FAR = 0.955, 1.5, 0.01
"""Share of each kind of contact within the error, and at most so many beyond so many times."""


def fit(table: pd.DataFrame, fold: NDArray[np.intp]) -> tuple[list[Row], dict[str, list[float]]]:
    """Return a row for each law, with errors of contacts held out, and all coefficients."""
    w, h, law = (table[name].to_numpy() for name in ("warmth", "film_over_approach", "law"))
    is_line = table["is_line"].to_numpy(dtype=float)
    central = law / table["inlet"].to_numpy() - 1
    known = table["smallest"].notna().to_numpy()
    nearer = np.log((table["smallest"] / table["film"]).to_numpy()[known])
    smallest_best, smallest_off = held_out(
        lambda p: np.log(smallest_factor(law[known], w[known], h[known], is_line[known], p)),
        nearer,
        np.array(SMALLEST_START),
        fold[known],
        **ROBUST,
    )
    kinds = pd.factorize(table["group"] + (table["ratio"] > 0).astype(str))[0]
    loss = 1 / law - 1
    smallest = (1 + central[known]) * np.exp(smallest_off) - 1
    found = {
        "smallest": smallest_best,
        "central_error": error_of(central, loss, w, kinds),
        "smallest_error": error_of(smallest, loss[known], w[known], kinds[known], LEAST_BY_LOSS),
    }
    rows = []
    for name, off in (("central", central), ("smallest", smallest)):
        here = slice(None) if name == "central" else known
        error = found[f"{name}_error"] @ np.stack([np.ones_like(loss), loss, w])[:, here]
        rows.append(_row(f"film, {name}", off, error, found[f"{name}_error"]))
    digits = {name: [float(f"{c:.5g}") for c in values] for name, values in found.items()}
    return rows, digits


def error_of(
    off: Floats, loss: Floats, warmth: Floats, kinds: Floats, least_by_loss: float = 0.0
) -> Floats:
    """Return e0, e1 and e2 of the smallest mean error that holds for each kind of contact."""
    best, least = np.array([np.nan] * 3), np.inf
    for e in product(STEPS[0], STEPS[1][STEPS[1] >= least_by_loss], MOST_WARM_STEPS):
        error = e[0] + e[1] * loss + e[2] * warmth
        if error.mean() >= least:
            continue
        times = np.abs(off) / error
        holds = all(
            np.mean(times[kinds == kind] <= 1) >= WITHIN
            and np.mean(times[kinds == kind] > FAR) <= MOST_FAR
            for kind in np.unique(kinds)
        )
        warm = loss > 0.1
        if holds and np.mean(times[warm] <= 1) >= WITHIN - 0.02:
            best, least = np.array(e), float(error.mean())
    return best


def write(coefficients: dict[str, list[float]], path: Path = PACKAGE) -> None:
    """Write the coefficients where the package reads them."""
    Writer(overwrite=True).text(path, json.dumps(coefficients, indent=1) + "\n")


def _row(law: str, off: Floats, error: Floats, coefficients: Floats) -> Row:
    times = np.abs(off) / error
    row: Row = {"law": law, "contacts": len(off)}
    row |= {"rms": float(np.sqrt(np.mean(off**2))), "mean_error": float(error.mean())}
    row |= {"within": float(np.mean(times <= 1)), "beyond_1.5": float(np.mean(times > FAR))}
    return row | {f"e{i}": float(c) for i, c in enumerate(coefficients)}
