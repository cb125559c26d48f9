"""Names of cases: their varying keys, or the labels of their table."""

from collections.abc import Hashable

import numpy as np
import pandas as pd
import xarray as xr

from ehlwave.inputs.effective_input import keys_of_input
from ehlwave.inputs.keys import CaseKeys
from ehlwave.results.schema import DIMENSION

LABEL = "label"

SHORT = {
    "load_parameter_m": "M",
    "lubricant_parameter_l": "L",
    "radius_ratio_d": "D",
    "slip_parameter": "S",
    "wavelength_over_a": "lambda/a",
    "wavelength_x_over_a": "lambda_x/a",
    "wavelength_y_over_a": "lambda_y/a",
    "orientation": "",
    "edges": "",
    "response": "",
}
"""Names of keys in labels; words of other keys explain themselves."""

CHOSEN = ("cells_x", "cells_y", "deformation", "error_estimate")
"""Columns that vary by themselves: the program chooses them, or they are results of this name."""

NEARLY = 1e-9
"""Relative difference of numbers that are the same."""


def labels(results: xr.Dataset) -> list[str]:
    """Return a label for each case: the keys that vary with their values."""
    parts: list[list[str]] = [[] for _ in range(results.sizes[DIMENSION])]
    for key in (*SHORT, *sorted(set(CaseKeys.__annotations__) - set(SHORT) - set(CHOSEN))):
        if key not in results:
            continue
        texts = [_text(value) for value in results[key].values.tolist()]
        if len(set(texts)) < 2 or _follows(results, key):
            continue
        name = SHORT.get(key, key)
        for part, text in zip(parts, texts, strict=True):
            if text:
                part.append(f"{name} = {text}" if name else text)
    return [", ".join(part) for part in parts]


def with_labels_of(results: xr.Dataset, rows: pd.DataFrame) -> xr.Dataset:
    """Return results with the labels that the rows of a table of cases give, if they give any.

    Keys identify a case. Rows that lead to the same case all give it their labels.
    """
    if LABEL not in rows or "effective_input" not in results:
        return results
    given = rows.drop(columns=LABEL).to_dict("records")
    names = list(results[LABEL].values)
    for index, text in enumerate(results["effective_input"].values):
        keys = keys_of_input(str(text))
        own = [str(rows[LABEL].iloc[row]) for row, one in enumerate(given) if _is_of(one, keys)]
        if own:
            names[index] = "; ".join(own)
    return results.assign_coords({LABEL: (DIMENSION, np.array(names, dtype=np.str_))})


def _is_of(row: dict[Hashable, object], keys: dict[str, float | str]) -> bool:
    """Return whether the keys of a case equal the keys of a row, as far as both have them."""
    for key, value in row.items():
        own = keys.get(str(key))
        if own is None or value is None or value != value:
            continue
        if not (_is_word(own, value) if isinstance(own, str) else _is_number(own, value)):
            return False
    return True


def _is_word(own: str, value: object) -> bool:
    """Return whether a word, or a logical value such as .true., equals the value of a row."""
    return own.strip(".") == str(value).lower().strip(".") or own == str(value)


def _is_number(own: float, value: object) -> bool:
    is_number = isinstance(value, (int, float, np.number))
    return is_number and bool(abs(own - float(value)) <= NEARLY * abs(own))  # type: ignore[arg-type]


def _follows(results: xr.Dataset, key: str) -> bool:
    """Return whether a wavelength along an axis only repeats the wavelength along the waves."""
    if key not in ("wavelength_x_over_a", "wavelength_y_over_a"):
        return False
    whole, own = results["wavelength_over_a"].values, results[key].values
    return bool(np.all((own == whole) | (own == 0) | np.isnan(own)))


def _text(value: object) -> str:
    if isinstance(value, float):
        return "" if value != value else f"{value:.6g}"
    return str(value)
