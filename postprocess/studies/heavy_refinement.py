"""What local refinement of the averaged scheme could save on heavy loads, at best.

``python -m studies.heavy_refinement`` prints it; ``scripts/study heavy --refinement`` keeps it.
"""

import itertools
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ehlwave.errors import ResultsError
from ehlwave.hdf5 import opened
from studies.programs import Groups, last_line, run_case

CONTACTS = tuple((m, d) for m in (1000, 3000, 10000) for d in (1, 0.07))  # M and D; L = 12.05
CELLS = 512  # along X and Y
ALPHA, Z, P0 = 2.2e-8, 0.68, 1.96e8  # of the default oil: 1/Pa, Roelands' index, Pa
SATURATED = 0.9  # of the reduced pressure in the contact, where the inlet ends
LOADED = 0.1  # pressure at X = 0 of rows whose film counts, over that of Hertz
LEVELS = 2.0 ** -np.arange(1, 24)  # of the error at a node, over the largest, tried for patches
COUNTS = 2.0 ** -np.arange(2, 14, 0.5)  # shares of the nodes, tried for patches of any shape


@dataclass(frozen=True)
class Bound:
    """Nodes of uniform grids over those of composite ones with cells h, h/2 and h/4, at best.

    ``centre`` is for the film at the centre alone: nodes at |Y| up to the length of the inlet.
    ``rectangles`` is for the film of all rows, ``any_shape`` for patches of those nodes alone,
    ``any_size`` for cells of any size at each node. ``share``: of the finest patch in all nodes.
    """

    load_parameter_m: float
    radius_ratio_d: float
    film_error: float
    predicted_error: float
    centre_share: float
    centre: float
    rectangles_share: float
    rectangles: float
    any_shape_share: float
    any_shape: float
    any_size: float


def fields(m: float, d: float, scheme: str) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Return the answer and the fields of a steady state."""
    groups: Groups = {
        "conditions": {"load_parameter_m": m, "lubricant_parameter_l": 12.05, "radius_ratio_d": d},
        "grid": {"edges": "flooded", "cells_x": CELLS, "cells_y": CELLS},
        "solver": {"scheme": scheme},
    }
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "fields.h5")
        outcome = run_case(groups, "--json", "--quiet", "--output", str(path))
        if outcome.returncode != 0:
            raise ResultsError(outcome.stderr[-500:])
        with opened(path) as file:
            names = "x", "y", "pressure", "film"
            return last_line(outcome), {name: np.asarray(file[name]) for name in names}


def error_shares(answer: dict[str, Any], at: dict[str, np.ndarray]) -> np.ndarray:
    """Return what the truncation error at each node adds to the film at X = 0 of its row, relative.

    That is the residual of the averaged scheme (D1) for a solution of the fitted one. A source
    of oil changes the flow into the contact by the share of the resistance, the integral of
    1/(rho H^3) over the inlet, that lies upstream of it.
    """
    p, h = at["pressure"], at["film"]
    hx, hy = np.diff(at["x"])[0], np.diff(at["y"])[0]
    pascal = p * answer["alphabar"] / ALPHA
    rho = (5.9e8 + 1.34 * pascal) / (5.9e8 + pascal)
    eta = np.exp(ALPHA * P0 / Z * ((1 + pascal / P0) ** Z - 1))
    eps = rho * h**3 / (eta * answer["lambdabar"])
    along = 0.5 * (eps[:, 1:] + eps[:, :-1]) * np.diff(p, axis=1) / hx
    across = 0.5 * (eps[1:] + eps[:-1]) * np.diff(p, axis=0) / hy * answer["kappa"] ** 2
    across = np.vstack([-across[:1], across])  # rows mirrored at Y = 0
    f = rho * h
    residual = np.zeros_like(p)
    residual[:-1, 2:-1] = (
        np.diff(along, axis=1)[:-1, 1:] / hx
        + np.diff(across, axis=0)[:, 2:-1] / hy
        - (1.5 * f[:-1, 2:-1] - 2 * f[:-1, 1:-2] + 0.5 * f[:-1, :-3]) / hx
    )
    reduced = np.cumsum(np.diff(p, axis=1, prepend=0) / eta, axis=1)
    resistance = np.cumsum(1 / (rho * h**3), axis=1)
    centre = np.argmin(abs(at["x"]))
    shares = np.zeros_like(p)
    for j in np.flatnonzero(p[:, centre] > LOADED):
        end = np.argmax(reduced[j] >= SATURATED * reduced[j, centre])
        weight = np.minimum(resistance[j] / resistance[j, end], 1)
        shares[j, :centre] = (weight * residual[j])[:centre] * hx / f[j, centre]
    return shares


def cover(shares: np.ndarray, level: float) -> tuple[float, float]:
    """Return share of the nodes and of the error of the rectangle of nodes above a level."""
    rows, columns = np.nonzero(shares > level * shares.max())
    part = shares[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1]
    return part.size / shares.size, part.sum() / shares.sum()


def best_saving(patches: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """Return share of the finer patch and saving, at equal errors of second order."""
    best = 0.0, 1.0
    for (wide, wide_error), (narrow, narrow_error) in itertools.product(patches, patches):
        if narrow <= wide:
            error = 1 - 0.75 * wide_error - 0.1875 * narrow_error
            saving = 1 / (error * (1 + 4 * wide + 16 * narrow))
            best = max(best, (narrow, saving), key=lambda one: one[1])
    return best


def bound_of(shares: np.ndarray, y: np.ndarray, inlet: float) -> tuple[float, ...]:
    """Return share and saving of each kind of `Bound`; the best size goes as share^(-1/4)."""
    every = abs(shares)
    strip = np.where(y[:, None] <= inlet, every, 0)
    ordered = np.sort(every.ravel())[::-1]
    found = np.cumsum(ordered) / ordered.sum()
    counts = np.ceil(COUNTS * ordered.size).astype(int)
    return (
        *best_saving([cover(strip, level) for level in LEVELS]),
        *best_saving([cover(every, level) for level in LEVELS]),
        *best_saving([(n / ordered.size, found[n - 1]) for n in counts]),
        every.size * every.sum() / np.sqrt(every).sum() ** 2,
    )


def measure(contacts: Sequence[tuple[float, float]] = CONTACTS) -> Iterator[Bound]:
    """Yield the bound of each contact."""
    for m, d in contacts:
        answer, at = fields(m, d, "fitted")
        off = fields(m, d, "averaged")[0]["central_film"] / answer["central_film"] - 1
        shares = error_shares(answer, at)
        inlet = answer["kappa"] * (12.05 / (answer["gamma"] * m)) ** 0.5
        found = off, shares[0].sum(), *bound_of(shares, at["y"], inlet)
        yield Bound(m, d, *map(float, found))


if __name__ == "__main__":
    for row in measure():
        print(row, flush=True)
