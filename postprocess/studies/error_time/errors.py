"""Errors of the table: against a finer solution, and of the iteration alone."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import fields

from studies.error_time.runs import Contact, Run
from studies.error_time.table import KEYS, Row

FILMS = ("central_film", "minimum_film")
RATIO = "amplitude_ratio_fit"
_CONTACT = Contact._fields
_DEFAULT = {
    field.name: field.default for field in fields(Run) if field.name not in (*_CONTACT, "cells")
}


def contact_of(row: Row) -> Contact:
    """Return the contact of a row."""
    return Contact(*(row[name] for name in _CONTACT))


def has_defaults(row: Row, *others: str) -> bool:
    """Whether a row is of the default method, tolerances and time step, but for `others`."""
    return all(row[name] == value for name, value in _DEFAULT.items() if name not in others)


def quantities(contact: Contact) -> tuple[str, ...]:
    """Return what is measured: films of a smooth contact, the amplitude ratio of a wavy one."""
    return (RATIO,) if contact.wavelength else FILMS


def by_contact(table: Iterable[Row]) -> dict[Contact, list[Row]]:
    """Return the rows of each contact."""
    groups: dict[Contact, list[Row]] = {}
    for row in table:
        groups.setdefault(contact_of(row), []).append(row)
    return groups


def grid_series(rows: Sequence[Row], quantity: str) -> dict[int, float]:
    """Return the values on each grid, by default method and tolerances, coarsest first."""
    series = {int(row["cells"]): row[quantity] for row in rows if has_defaults(row)}
    return {cells: series[cells] for cells in sorted(series) if math.isfinite(series[cells])}


def reference(series: dict[int, float]) -> tuple[float, str]:
    """Richardson's value from the two finest grids, order 2, and what it is made of."""
    coarse, fine = list(series)[-2:]
    factor = (fine / coarse) ** 2 - 1
    value = series[fine] + (series[fine] - series[coarse]) / factor
    return value, f"Richardson from {coarse} and {fine} cells"


def referenced(
    table: Sequence[Row],
) -> Iterator[tuple[Contact, list[Row], str, dict[int, float], tuple[float, str]]]:
    """Yield contact, its rows, quantity, values by cells, and reference with its basis.

    Left out is what was run on one grid only.
    """
    for contact, rows in by_contact(table).items():
        for quantity in quantities(contact):
            series = grid_series(rows, quantity)
            if len(series) < 2:
                continue
            yield contact, rows, quantity, series, reference(series)


def error_rows(table: Sequence[Row]) -> list[Row]:
    """Return one row for each run and quantity.

    ``error`` is the relative deviation from the reference of the contact. ``algebraic_error`` is
    that from the run on the same grid with the tightest tolerance, empty where there is none.
    """
    found: list[Row] = []
    for _, rows, quantity, _, (target, basis) in referenced(table):
        for row in rows:
            if not math.isfinite(row[quantity]):
                continue
            found.append(
                {
                    **{name: row[name] for name in KEYS},
                    "status": row["status"],
                    "quantity": quantity,
                    "value": row[quantity],
                    "reference": target,
                    "reference_basis": basis,
                    "error": abs(row[quantity] / target - 1),
                    "algebraic_error": _algebraic_error(row, rows, quantity),
                    "seconds": row["seconds"],
                    "work_units": row["work_units"],
                }
            )
    return found


def _algebraic_error(row: Row, rows: Sequence[Row], quantity: str) -> float:
    name = "step_tolerance" if row["wavelength"] else "tolerance"
    same = [
        other
        for other in rows
        if all(other[key] == row[key] for key in KEYS if key != name)
        and math.isfinite(other[quantity])
    ]
    tightest = min(same, key=lambda other: other[name])
    if tightest[name] >= row[name]:
        return math.nan
    return abs(row[quantity] / tightest[quantity] - 1)


def order_rows(table: Sequence[Row]) -> list[Row]:
    """Return the observed orders: in mesh size with dT = hX, and in dT = hX, 2 hX, 4 hX."""
    found: list[Row] = []
    for contact, rows in by_contact(table).items():
        for quantity in quantities(contact):
            series = grid_series(rows, quantity)
            for cells in series:
                names = (cells, cells // 2, cells // 4)
                if all(name in series for name in names):
                    values = [series[name] for name in names]
                    found.append(_order(contact, quantity, "mesh size", cells, values))
        steps: dict[int, dict[float, float]] = {}
        for row in rows:
            if contact.wavelength and has_defaults(row, "time_step_over_cell"):
                grid = steps.setdefault(int(row["cells"]), {})
                grid[row["time_step_over_cell"]] = row[RATIO]
        for cells, grid in steps.items():
            if {1.0, 2.0, 4.0} <= set(grid):
                values = [grid[step] for step in (1.0, 2.0, 4.0)]
                found.append(_order(contact, RATIO, "time step", cells, values))
    return found


def estimate_rows(table: Sequence[Row]) -> list[Row]:
    """Return the estimates that a run makes of its own error beside the error."""
    found: list[Row] = []
    for contact, rows, quantity, series, (target, basis) in referenced(table):
        for row in rows:
            cells = int(row["cells"])
            if not has_defaults(row) or cells not in series:
                continue
            if contact.wavelength:
                estimate = richardson([series.get(cells // n, math.nan) for n in (1, 2, 4)])
            else:
                estimate = row[f"{quantity}_error"]
            error = abs(series[cells] / target - 1)
            found.append(
                {
                    **contact._asdict(),
                    "cells": cells,
                    "status": row["status"],
                    "quantity": quantity,
                    "error": error,
                    "reference_basis": basis,
                    "estimate": estimate,
                    "estimate_over_error": estimate / error,
                }
            )
    return found


def richardson(values: Sequence[float]) -> float:
    """Return the relative error of the first of the values on h, 2h, 4h, as ehlwave-case does.

    See ``estimate_error`` in src/run/error_estimate.f90.
    """
    if not all(map(math.isfinite, values[:2])):
        return math.nan
    order = 2.0
    fine = values[0] - values[1]
    if len(values) > 2 and math.isfinite(values[2]):
        coarse = values[1] - values[2]
        order = min(max(math.log2(coarse / fine), 1.0), 2.0) if coarse * fine > 0 else 1.0
    return abs(fine) / (2**order - 1) / abs(values[0])


def _order(contact: Contact, quantity: str, what: str, cells: int, values: Sequence[float]) -> Row:
    change, before = abs(values[1] - values[0]), abs(values[2] - values[1])
    order = math.log2(before / change) if change > 0 and before > 0 else math.nan
    return {
        **contact._asdict(),
        "quantity": quantity,
        "refined": what,
        "finest_cells": cells,
        "observed_order": order,
    }
