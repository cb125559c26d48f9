"""Fit the models of ``ehlwave-case --plan``: error and cost as functions of the case.

src/case/accuracy_model.f90 has the functions and holds the coefficients.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd
from scipy.optimize import least_squares

from studies.error_time.errors import (
    FILMS,
    RATIO,
    by_contact,
    grid_series,
    reference,
    with_defaults,
)

LENGTH_X = 4.0
"""Length of the domain of every run, in units of a."""

SMALLEST_ERROR = 1e-3
"""Smaller errors are close to the errors of the reference and of the iteration: not fitted."""


VALUE = "value"
"""Column of the fitted quantity of a model."""


def fit_models(table: pd.DataFrame) -> pd.DataFrame:
    """Fit every model to the rows that the table has; those without enough rows are left out.

    A row for each, with its coefficients and the deviation from its data.
    """
    film, ratio = grid_errors(table, FILMS[0]), grid_errors(table, RATIO)
    good = _good(with_defaults(table))
    steady = good[good["wavelength"] == 0].assign(value=good["counted_work_units"])
    moving = good[good["time_steps"] > 0]
    moving = moving.assign(value=moving["counted_work_units"] / moving["time_steps"])
    fits = [
        _fit("film", [0.2], film, _film_error),
        _fit("moving_ratio", [0.2], ratio[ratio["time_steps"] > 0], _ratio_error),
        _fit("standing_ratio", [0.1], ratio[ratio["time_steps"] == 0], _ratio_error),
        _fit("time_step", [0.01], _time_step_errors(table), _time_step_error),
        _share("step_tolerance", _tolerance_errors(table)),
        _fit("steady_cost", [300.0, 0.0, 0.2], steady, _cost),
        _fit("step_cost", [50.0, 0.5, 0.2], moving, _cost),
    ]
    return pd.DataFrame([fit for fit in fits if fit])


def grid_errors(table: pd.DataFrame, quantity: str) -> pd.DataFrame:
    """Return resolved default rows with their error, the grids of the reference left out."""
    parts = [table[:0].assign(value=0.0)]
    for contact, rows in by_contact(table):
        series = grid_series(rows, quantity)
        if len(series) >= 3 and (quantity != RATIO or contact.wavelength):
            target, _ = reference(series)
            some = _good(with_defaults(rows))
            some = some[some["cells"] < series.index.max()]
            parts.append(some.assign(value=(some[quantity] / target - 1).abs()))
    return _large(parts)


def _good(table: pd.DataFrame) -> pd.DataFrame:
    return table[table["status"] == "converged"]


def _large(parts: Sequence[pd.DataFrame]) -> pd.DataFrame:
    joined = pd.concat(parts)
    return joined[joined[VALUE] > SMALLEST_ERROR]


def _film_error(c: np.ndarray, rows: pd.DataFrame) -> pd.Series:
    return c[0] * (LENGTH_X / rows["cells"]) ** 2 * rows["gamma"] * rows["m"]


def _ratio_error(c: np.ndarray, rows: pd.DataFrame) -> pd.Series:
    return _film_error(c, rows) * np.sqrt(1 - rows["formula_ratio"])


def _time_step_error(c: np.ndarray, rows: pd.DataFrame) -> pd.Series:
    """Waves in the inlet, as on a mesh of one step; short waves add the part of the difference."""
    return _ratio_error(c, rows) * (rows["time_step_over_cell"] ** 2 - 1)


def _cost(c: np.ndarray, rows: pd.DataFrame) -> pd.Series:
    return c[0] * (rows["cells"] / 128) ** c[1] * (rows["gamma"] * rows["m"] / 100) ** c[2]


def _time_step_errors(table: pd.DataFrame) -> pd.DataFrame:
    """Return the change of Ad/Ai from dT = hX on the same grid, with 8 or more steps per wave."""
    parts = [table[:0].assign(value=0.0)]
    for _, rows in by_contact(table):
        same = with_defaults(rows, "time_step_over_cell")
        base = same[same["time_step_over_cell"] == 1].set_index("cells")[RATIO]
        longer = _good(same[same["time_step_over_cell"] > 1])
        parts.append(longer.assign(value=(longer[RATIO] / longer["cells"].map(base) - 1).abs()))
    return _large(parts)


def _tolerance_errors(table: pd.DataFrame) -> pd.Series:
    """Return the change of Ad/Ai by the step tolerance, over that tolerance."""
    parts = []
    for _, rows in by_contact(table):
        same = _good(with_defaults(rows, "step_tolerance")).sort_values("step_tolerance")
        tightest = same.groupby("cells")[["step_tolerance", RATIO]].transform("first")
        change = (same[RATIO] / tightest[RATIO] - 1).abs() / same["step_tolerance"]
        chosen = same["step_tolerance"].between(1e-4, 1e-2)
        parts.append(change[chosen & (tightest["step_tolerance"] <= 1e-6)])
    return pd.concat(parts)


def _share(name: str, values: pd.Series) -> dict[str, object] | None:
    """Return the value that four of five of the data stay below; they scatter by decades."""
    if values.empty:
        return None
    high = values.quantile(0.8)
    return _row(name, [high], len(values), math.nan, values.max() / high)


def _fit(
    name: str,
    start: Sequence[float],
    data: pd.DataFrame,
    function: Callable[[np.ndarray, pd.DataFrame], pd.Series],
) -> dict[str, object] | None:
    """Fit in the logarithm; the first coefficient is a positive factor."""
    if len(data) <= len(start):
        return None

    def deviations(parameters: np.ndarray) -> np.ndarray:
        c = np.array([math.exp(parameters[0]), *parameters[1:]])
        return np.log((function(c, data) / data[VALUE]).to_numpy(float))

    first = [math.log(start[0]), *start[1:]]
    found = least_squares(deviations, first, loss="soft_l1").x
    left = np.abs(deviations(found))
    coefficients = [math.exp(found[0]), *found[1:]]
    return _row(name, coefficients, len(data), math.exp(np.median(left)), math.exp(left.max()))


def _row(
    name: str, coefficients: Sequence[float], points: int, typical: float, largest: float
) -> dict[str, object]:
    padded = (*coefficients, math.nan, math.nan)[:3]
    return {
        "model": name,
        **{f"coefficient_{n}": value for n, value in enumerate(padded, 1)},
        "points": points,
        "typical_factor": typical,
        "largest_factor": largest,
    }
