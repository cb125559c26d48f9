"""The table of an element: a dataset over its places, with the worst places named."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from ehlwave.elements.answers import Questions, Row, row_of
from ehlwave.elements.columns import COLUMNS, TEXTS
from ehlwave.elements.formulas import FORMULAS, written
from ehlwave.elements.place import ASSUMED_EYRING_ERROR, ASSUMED_EYRING_PA, ElementContact
from ehlwave.shown import spread_of

WORST = {
    "minimum_film_m": ("thinnest film", min, 1e6, "um"),
    "isothermal_central_film_m": ("thinnest central film without heat", min, 1e6, "um"),
    "lambda_ratio": ("smallest lambda ratio", min, 1.0, ""),
    "isothermal_lambda_ratio": ("smallest lambda ratio without heat", min, 1.0, ""),
    "hertz_pressure_pa": ("highest Hertz pressure", max, 1e-9, "GPa"),
    "friction": ("largest friction", max, 1.0, ""),
    "rise_mid_film_k": ("largest temperature rise mid-film", max, 1.0, "K"),
    "dang_van": ("largest factor of Dang Van", max, 1.0, ""),
}
"""Worst value of a column: words, how it is found, factor and unit of the text."""


ERRORS = {
    "minimum_film_m": "minimum_film_error",
    "central_film_m": "central_film_error",
    "isothermal_central_film_m": "isothermal_central_film_error",
    "lambda_ratio": "lambda_error",
    "isothermal_lambda_ratio": "isothermal_lambda_error",
    "friction": "friction_error",
}
"""Columns of relative errors by the column that they are of."""

ALWAYS = ("central_film_m", "central_film_error", "minimum_film_m", "minimum_film_error")
"""Columns that tables have even where no place is answered."""


def table_of(
    places: Sequence[ElementContact],
    asked: Questions,
    coordinate: str,
    coordinates: Mapping[str, Sequence[Any]],
) -> xr.Dataset:
    """Return the answers of contacts over a coordinate.

    Places that are alike are answered once.

    Parameters
    ----------
    places : sequence of ElementContact
        In order.
    asked : Questions
        As of :func:`row_of`.
    coordinate : str
        Name of the dimension.
    coordinates : mapping
        Coordinates over it, by name.
    """
    known: dict[tuple[Any, ...], Row] = {}
    rows = []
    for place in places:
        key = _key(place)
        if key not in known:
            known[key] = row_of(place, asked)
        rows.append(known[key])
    names = [name for name in COLUMNS if name in ALWAYS or any(name in row for row in rows)]
    data: dict[str, Any] = {
        name: (coordinate, [_number(row.get(name)) for row in rows]) for name in names
    }
    data |= {name: (coordinate, [str(row.get(name, "")) for row in rows]) for name in TEXTS}
    found = xr.Dataset(data, coords={name: (coordinate, v) for name, v in coordinates.items()})
    for name in found.variables:
        if name in COLUMNS:
            unit, meaning = COLUMNS[str(name)]
            found[name].attrs |= (
                {"units": unit, "long_name": meaning} if unit else {"long_name": meaning}
            )
        elif name in TEXTS:
            found[name].attrs["long_name"] = TEXTS[str(name)]
    if asked.heat and any(place.assumes_eyring for place in places):
        found.attrs["assumed_eyring_stress_pa"] = ASSUMED_EYRING_PA
        found.attrs["assumed_eyring_stress_pa_error"] = ASSUMED_EYRING_ERROR
    return found


def worst_places(table: xr.Dataset) -> dict[str, str]:
    """Return the worst places of a table in words, by column.

    Parameters
    ----------
    table : Dataset
        Of an element.
    """
    said = {}
    for name, (words, choose, factor, unit) in WORST.items():
        if name not in table or not np.isfinite(table[name].values).any():
            continue
        values = table[name]
        index = values.argmin(...) if choose is min else values.argmax(...)
        at = values.isel(index)
        if choose is max and float(at) == 0:
            continue
        where = ", ".join(_place(str(key), value.item()) for key, value in at.coords.items())
        value = f"{words} {float(at) * factor:.4g} {unit}".rstrip()
        said[name] = f"{value}{_within(table, name, index)} at {where}"
    return said


def _within(table: xr.Dataset, name: str, index: Any) -> str:  # noqa: ANN401
    """Return the relative error of a value in words, where it is known."""
    found = table.get(ERRORS.get(name, ""))
    share = float("nan") if found is None else float(found.isel(index))
    if not np.isfinite(share):
        return ""
    _, _, factor, unit = WORST[name]
    value = float(table[name].isel(index)) * factor
    return f" {spread_of(value, share, f' {unit}'.rstrip())}"


def unanswered(table: xr.Dataset) -> int:
    """Return how many places have no central film."""
    if "central_film_m" not in table:
        return int(table["load_n"].size)
    return int(np.isnan(table["central_film_m"].values).sum())


def sliding_error(table: xr.Dataset) -> float:
    """Return the relative error of the mean sliding power of a table; NaN where not known."""
    if "sliding_power_w" not in table:
        return float("nan")
    power = table["sliding_power_w"]
    return float((power * table["friction_error"]).sum(skipna=False) / power.sum(skipna=False))


def _key(place: ElementContact) -> tuple[Any, ...]:
    bodies = tuple((b.radius_x_m, b.radius_y_m) for b in place.bodies)
    others = tuple(round(value, 9) for value in place.others.values())
    speeds = tuple(round(speed, 12) for speed in place.speeds_m_per_s)
    return (bodies, speeds, round(place.load_n, 9), place.length_m, others)


def _number(value: Any) -> float:  # noqa: ANN401
    return float("nan") if value is None else float(value)


def _place(name: str, value: Any) -> str:  # noqa: ANN401
    """Return a coordinate in words."""
    if name == "ring":
        return f"{value} ring"
    entry = FORMULAS[name]
    return f"{entry.label} {written(name, value)} {entry.unit}".rstrip()
