"""Errors of the table: against a finer solution, and of the iteration alone."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import fields

import pandas as pd

from studies.error_time.runs import Contact, Run
from studies.error_time.table import KEYS
from studies.work_unit import convolutions

FILMS = ("central_film", "minimum_film")
RATIO = "amplitude_ratio_fit"
_CONTACT = list(Contact._fields)
_DEFAULT = {
    field.name: field.default for field in fields(Run) if field.name not in (*_CONTACT, "cells")
}


def with_defaults(table: pd.DataFrame, *others: str) -> pd.DataFrame:
    """Return the rows of the default method, tolerances and time step, but for `others`."""
    chosen = pd.Series(True, table.index)
    for name, value in _DEFAULT.items():
        if name not in others:
            chosen &= table[name] == value
    return table[chosen]


def by_contact(table: pd.DataFrame) -> Iterator[tuple[Contact, pd.DataFrame]]:
    """Yield each contact and its rows."""
    for key, rows in table.groupby(_CONTACT, sort=False):
        yield Contact(*key), rows


def grid_series(rows: pd.DataFrame, quantity: str) -> pd.Series:
    """Return the values by cells, by default method and tolerances, coarsest grid first."""
    return with_defaults(rows).set_index("cells")[quantity].dropna().sort_index()


def reference(series: pd.Series) -> tuple[float, int]:
    """Richardson's value from the two finest grids, order 2, and the cells of the finest."""
    coarse, fine = series.index[-2:]
    factor = (fine / coarse) ** 2 - 1
    value = series[fine] + (series[fine] - series[coarse]) / factor
    return value, int(fine)


def measured(table: pd.DataFrame) -> Iterator[tuple[Contact, pd.DataFrame, str, pd.Series]]:
    """Yield contact, its rows, quantity, and its values by cells.

    Measured are films of a smooth contact, the amplitude ratio of a wavy one.
    """
    for contact, rows in by_contact(table):
        for quantity in (RATIO,) if contact.wavelength else FILMS:
            yield contact, rows, quantity, grid_series(rows, quantity)


def error_rows(table: pd.DataFrame) -> pd.DataFrame:
    """Return a row for each run and quantity; runs on a single grid are left out.

    ``error`` is the relative deviation from the reference of the contact. ``algebraic_error`` is
    that from the run on the same grid with the tightest tolerance, empty where there is none.
    """
    parts = []
    for _, rows, quantity, series in measured(table):
        if len(series) < 2:
            continue
        target, finest = reference(series)
        some = rows[rows[quantity].notna()]
        columns = {
            "quantity": quantity,
            "value": some[quantity],
            "reference": target,
            "reference_cells": finest,
            "error": (some[quantity] / target - 1).abs(),
            "algebraic_error": _algebraic_error(some, quantity),
            "seconds": some["seconds"],
            "work": some["counted_work_units"] * convolutions(some["cells"]),
        }
        parts.append(some[[*KEYS, "status"]].assign(**columns))
    return pd.concat(parts)


def _algebraic_error(rows: pd.DataFrame, quantity: str) -> pd.Series:
    name = "tolerance" if quantity in FILMS else "step_tolerance"
    same = rows.groupby([key for key in KEYS if key != name])[name]
    tightest = rows.loc[same.transform("idxmin")].set_index(rows.index)
    error = (rows[quantity] / tightest[quantity] - 1).abs()
    return error.where(tightest[name] < rows[name])


def order_rows(table: pd.DataFrame) -> pd.DataFrame:
    """Return the observed orders: in mesh size with dT = hX, and in dT = hX, 2 hX, 4 hX."""
    found = []
    for contact, rows, quantity, series in measured(table):
        for cells in series.index:
            grids = [cells, cells // 2, cells // 4]
            if set(grids) <= set(series.index):
                found.append(_order(contact, quantity, "mesh size", cells, series[grids]))
        if not contact.wavelength:
            continue
        for cells, grid in with_defaults(rows, "time_step_over_cell").groupby("cells", sort=False):
            by_step = grid.set_index("time_step_over_cell")[RATIO]
            steps = [1.0, 2.0, 4.0]
            if set(steps) <= set(by_step.index):
                found.append(_order(contact, RATIO, "time step", cells, by_step[steps]))
    return pd.DataFrame(found)


def estimate_rows(table: pd.DataFrame) -> pd.DataFrame:
    """Return the estimates that a run makes of its own error beside the error."""
    found = []
    for contact, rows, quantity, series in measured(table):
        if len(series) < 2:
            continue
        target, finest = reference(series)
        some = with_defaults(rows)
        for row in some[some["cells"].isin(series.index)].to_dict("records"):
            cells = row["cells"]
            if contact.wavelength:
                estimate = richardson([series.get(cells // n, math.nan) for n in (1, 2, 4)])
            else:
                estimate = row[f"{quantity}_error"]
            error = abs(series[cells] / target - 1)
            line = {
                **contact._asdict(),
                "cells": cells,
                "status": row["status"],
                "quantity": quantity,
                "error": error,
                "reference": target,
                "reference_cells": finest,
                "estimate": estimate,
                "estimate_over_error": estimate / error,
            }
            found.append(line)
    return pd.DataFrame(found)


def richardson(values: Sequence[float]) -> float:
    """Return the relative error of the first of the values on h, 2h, 4h by Richardson."""
    if not all(map(math.isfinite, values[:2])):
        return math.nan
    order = 2.0
    fine = values[0] - values[1]
    if len(values) > 2 and math.isfinite(values[2]):
        coarse = values[1] - values[2]
        order = min(max(math.log2(coarse / fine), 1.0), 2.0) if coarse * fine > 0 else 1.0
    return abs(fine) / (2**order - 1) / abs(values[0])


def _order(
    contact: Contact, quantity: str, what: str, cells: int, values: pd.Series
) -> dict[str, object]:
    change, before = values.diff().abs().iloc[1:]
    order = math.log2(before / change) if change > 0 and before > 0 else math.nan
    return {
        **contact._asdict(),
        "quantity": quantity,
        "refined": what,
        "finest_cells": cells,
        "observed_order": order,
    }
