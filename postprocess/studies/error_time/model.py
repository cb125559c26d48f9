"""Fit what ``ehlwave-case --plan`` expects: error and cost as functions of the case.

The functions are those of src/case/accuracy_model.f90, which holds the coefficients.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from studies.error_time.errors import (
    FILMS,
    RATIO,
    by_contact,
    grid_series,
    has_defaults,
    reference,
)
from studies.error_time.table import Row

LENGTH_X = 4.0
"""Of the domain of every run, in units of a."""

SMALLEST_ERROR = 1e-3
"""Smaller errors are near those of the reference and of the iteration: not fitted to."""


@dataclass(frozen=True)
class Fit:
    """Coefficients of one function, and how far it is from what it was fitted to."""

    name: str
    coefficients: tuple[float, ...]
    points: int
    typical_factor: float
    largest_factor: float

    def row(self) -> Row:
        """Return the row of the table of models."""
        padded = (*self.coefficients, math.nan, math.nan, math.nan)[:3]
        return {
            "model": self.name,
            **{f"coefficient_{n}": value for n, value in enumerate(padded, 1)},
            "points": self.points,
            "typical_factor": self.typical_factor,
            "largest_factor": self.largest_factor,
        }


def fit_models(table: Sequence[Row]) -> list[Fit]:
    """Fit every model to the rows that the table has; those without enough rows are left out."""
    film, ratio = grid_errors(table, FILMS[0]), grid_errors(table, RATIO)
    steady = [row for row in table if not row["wavelength"] and has_defaults(row) and _is_good(row)]
    moving = [row for row in table if row["time_steps"] > 0 and has_defaults(row) and _is_good(row)]
    fits = [
        _fit("film", [0.2], film, _film_error),
        _fit("moving_ratio", [0.2], [r for r in ratio if r[0]["time_steps"] > 0], _ratio_error),
        _fit("standing_ratio", [0.1], [r for r in ratio if not r[0]["time_steps"]], _ratio_error),
        _fit("time_step", [1.0], _time_step_errors(table), _time_step_error),
        _share("step_tolerance", _tolerance_errors(table)),
        _fit("steady_cost", [300.0, 0.0, 0.2], [(r, r["work_units"]) for r in steady], _cost),
        _fit(
            "step_cost", [50.0, 0.5, 0.2],
            [(r, r["work_units"] / r["time_steps"]) for r in moving], _cost,
        ),
    ]  # fmt: skip
    return [fit for fit in fits if fit is not None]


def grid_errors(table: Sequence[Row], quantity: str) -> list[tuple[Row, float]]:
    """Return resolved default rows with their error, the grids of the reference left out."""
    found = []
    for contact, rows in by_contact(table).items():
        if quantity == RATIO and not contact.wavelength:
            continue
        series = grid_series(rows, quantity)
        if len(series) < 3:
            continue
        target, _ = reference(series)
        for row in rows:
            if has_defaults(row) and _is_good(row) and row["cells"] < max(series):
                error = abs(row[quantity] / target - 1)
                if error > SMALLEST_ERROR:
                    found.append((row, error))
    return found


def _is_good(row: Row) -> bool:
    return row["status"] == "converged"


def _mesh(row: Row) -> float:
    return LENGTH_X / row["cells"]


def _film_error(c: np.ndarray, row: Row) -> float:
    return c[0] * _mesh(row) ** 2 * row["gamma"] * row["m"]


def _ratio_error(c: np.ndarray, row: Row) -> float:
    return _film_error(c, row) * math.sqrt(1 - row["formula_ratio"])


def _time_step_error(c: np.ndarray, row: Row) -> float:
    steps = row["points_per_wave_x"] / row["time_step_over_cell"]
    return c[0] * (1 - row["time_step_over_cell"] ** -2) / steps**2


def _cost(c: np.ndarray, row: Row) -> float:
    return c[0] * (row["cells"] / 128) ** c[1] * (row["gamma"] * row["m"] / 100) ** c[2]


def _time_step_errors(table: Sequence[Row]) -> list[tuple[Row, float]]:
    """Return the change of Ad/Ai from that of dT = hX on the same grid, 8 steps a wave or more."""
    found = []
    for rows in by_contact(table).values():
        same = [row for row in rows if has_defaults(row, "time_step_over_cell")]
        base = {row["cells"]: row[RATIO] for row in same if row["time_step_over_cell"] == 1}
        for row in same:
            if row["time_step_over_cell"] > 1 and row["cells"] in base and _is_good(row):
                change = abs(row[RATIO] / base[row["cells"]] - 1)
                if change > SMALLEST_ERROR:
                    found.append((row, change))
    return found


def _tolerance_errors(table: Sequence[Row]) -> list[tuple[Row, float]]:
    """Return the change of Ad/Ai by the step tolerance, over that tolerance."""
    found = []
    for rows in by_contact(table).values():
        same = [row for row in rows if has_defaults(row, "step_tolerance") and _is_good(row)]
        for row in same:
            tightest = min(
                (other for other in same if other["cells"] == row["cells"]),
                key=lambda other: other["step_tolerance"],
            )
            if 1e-4 <= row["step_tolerance"] <= 1e-2 and tightest["step_tolerance"] <= 1e-6:
                change = abs(row[RATIO] / tightest[RATIO] - 1)
                found.append((row, change / row["step_tolerance"]))
    return found


def _share(name: str, data: Sequence[tuple[Row, float]]) -> Fit | None:
    """Return the value that four of five of the data stay below; they scatter by decades."""
    if not data:
        return None
    values = np.array([value for _, value in data])
    high = float(np.quantile(values, 0.8))
    return Fit(name, (high,), len(values), math.nan, float(values.max() / high))


def _fit(
    name: str,
    start: Sequence[float],
    data: Sequence[tuple[Row, float]],
    function: Callable[[np.ndarray, Row], float],
) -> Fit | None:
    """Fit in the logarithm; the first coefficient is a positive factor."""
    if len(data) <= len(start):
        return None

    def deviations(parameters: np.ndarray) -> list[float]:
        c = np.array([math.exp(parameters[0]), *parameters[1:]])
        return [math.log(function(c, row) / value) for row, value in data]

    first = [math.log(start[0]), *start[1:]]
    found = least_squares(deviations, first, loss="soft_l1").x
    left = np.abs(deviations(found))
    return Fit(
        name,
        (math.exp(found[0]), *map(float, found[1:])),
        len(data),
        math.exp(float(np.median(left))),
        math.exp(float(left.max())),
    )
