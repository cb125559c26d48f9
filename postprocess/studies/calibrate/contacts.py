"""Random contacts of the sample: inputs over every key, in classes, on grids that resolve them."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from studies.all_keys.check import plan_of
from studies.all_keys.draw import Row, draw

SEED = 55
CLASSES = ("line", "ellipse", "oil", "slip", "starved", "heat", "pair", "march", "periodic")
"""Classes of contacts; a contact may have several. The number of a contact decides the first."""
POINT_CELLS, LINE_CELLS = (32, 48, 64), (64, 96, 128)
MARCH_POINT_CELLS, MARCH_LINE_CELLS = (32,), (48, 64)
"""Cells of the grid that is judged; truths have up to four times as many."""
UNRESOLVED = 0.15
"""Share of contacts that their grid may not resolve."""
LARGEST_WAVES = 0.05
"""Largest amplitude over the film: larger waves have an error by their amplitude."""
SLOWEST_WAVES = 0.6
"""Speed of a marched surface over the mean speed, at least: a march waits for the slowest."""
WIDE = {"x_min": -5.0, "x_max": 3.0}
"""Twice the usual domain; Y likewise."""
LEFT_OUT = (
    *("accuracy", "largest_cells", "tolerance", "step_tolerance", "response_tolerance"),
    *("largest_steps", "largest_total_steps", "error_estimate", "threads", "fields", "edges"),
    *("fields_every", "sensitivities", "end_time", "load_factor", "load_balance", "domain"),
    *("natural_frequency", "oil_change_factor", "oil_change_start", "oil_change_length"),
    *("x_min", "x_max", "y_max", "cells_x", "cells_y", "settling_periods", "mean_rise"),
    *("time_step_over_cell", "file", "file_2"),
)
"""Keys of effort, output and changes in time, and measured surfaces."""


def classes_of(row: Row) -> list[str]:
    """Return the classes of a contact."""
    starved = "oil_over_flooded" in row or "oil_layer_m" in row
    moves = row.get("response") in ("transient", "both") and row.get("orientation") is not None
    found = {
        "line": row.get("radius_ratio_d") == 0 or "load_n_per_m" in row,
        "oil": row.get("flow_law", "newtonian") != "newtonian",
        "slip": row.get("slip_parameter", 1.0) != 1 or row.get("slide_to_roll_ratio", 0) != 0,
        "starved": starved,
        "heat": "oil_conductivity_w_per_m_k" in row,
        "pair": "orientation_2" in row,
        "march": moves,
        "periodic": row.get("response") == "periodic",
    }
    found["ellipse"] = not found["line"]
    found["response"] = row.get("response") in ("harmonic", "both")
    return [name for name, is_there in found.items() if is_there]


def drawn(number: int, known: dict[str, str], folder: Path) -> Row:
    """Return the keys of a contact of the sample."""
    rng = np.random.default_rng([SEED, number])
    wish = CLASSES[number % len(CLASSES)]
    while True:
        row = _stripped(draw(rng, known, folder), rng)
        if row is None or wish not in classes_of(row):
            continue
        for on_grid in _grids(row, rng):
            plan = plan_of(on_grid, known, folder)
            if plan is None:
                break
            if plan["is_resolved"] or rng.random() < UNRESOLVED:
                return on_grid


def _stripped(row: Row, rng: np.random.Generator) -> Row | None:
    """Return a drawn input with usual settings; None with a measured surface."""
    if "file" in row or "file_2" in row:
        return None
    row = {key: value for key, value in row.items() if key not in LEFT_OUT}
    slip = row.get("slip_parameter", 1 + row.get("slide_to_roll_ratio", 0) / 2)
    marches = bool({"march", "periodic"} & set(classes_of(row)))
    if marches and not SLOWEST_WAVES <= slip <= 2 - SLOWEST_WAVES:
        return None
    for key in ("amplitude_over_film", "amplitude_over_film_2"):
        if key in row:
            row[key] = float(f"{LARGEST_WAVES * 0.1 ** rng.random():.3g}")
    if row.get("orientation") is not None and row.get("response") != "harmonic":
        row.setdefault("amplitude_over_film", 0.02)
        if "orientation_2" in row:
            row.setdefault("amplitude_over_film_2", 0.02)
    if row.get("response") == "harmonic":
        row["mean_rise"] = False
    row["scheme"] = "fitted" if rng.random() < 0.4 else "averaged"
    return row


def _grids(row: Row, rng: np.random.Generator) -> Iterator[Row]:
    """Yield the contact on grids, coarse ones first, from a random one on."""
    classes = classes_of(row)
    marches = bool({"march", "periodic"} & set(classes))
    if "line" in classes:
        sizes = MARCH_LINE_CELLS if marches else LINE_CELLS
        pairs = [{"cells_x": size} for size in sizes]
    else:
        sizes = MARCH_POINT_CELLS if marches else POINT_CELLS
        pairs = [{"cells_x": size, "cells_y": int(rng.choice(sizes))} for size in sizes]
    for pair in pairs[int(rng.integers(len(pairs))) :]:
        yield {**row, **pair, "edges": "flooded"}


def scaled(row: Row, factor: float) -> Row:
    """Return the contact on a grid with `factor` times the cells along each side."""
    cells = {key: round(factor * row[key]) for key in ("cells_x", "cells_y") if key in row}
    return {**row, **cells, **_cheap(row)}


def widened(row: Row) -> Row:
    """Return the contact on the same mesh in twice the domain."""
    across: dict[str, Any] = {"y_max": 4.0} if "cells_y" in row else {}
    return {**scaled(row, 2), **WIDE, **across}


def _cheap(row: Row) -> Row:
    """Return the key that leaves out coarse runs, where it has an effect."""
    waves = row.get("orientation") is not None and row.get("response") != "harmonic"
    return {"error_estimate": "model"} if waves else {}
