"""Keys that determine the response of a case: harmonic tables contain and match them.

Every key of the programs is in a group of :mod:`ehlwave.inputs.key_classes`.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from ehlwave.errors import ResultsError, SurfaceError, printable
from ehlwave.inputs.effective_input import keys_of_input
from ehlwave.inputs.key_classes import (
    IN_COLUMNS,
    OF_MARCHES,
    OF_OTHER_EFFECTS,
    OF_THE_EDGES,
    OF_THE_HEAT,
    OF_THE_INLET,
    OF_THE_OIL,
    OF_THE_SOLUTION,
    WITHOUT_EFFECT,
)
from ehlwave.inputs.key_table import GROUP_OF

CARRIED = (*OF_THE_OIL, *OF_THE_EDGES, *OF_THE_INLET, *OF_MARCHES)
"""Columns of a table, empty where a key does not apply."""

CLASSIFIED = (
    IN_COLUMNS
    | OF_THE_SOLUTION
    | WITHOUT_EFFECT
    | OF_THE_HEAT
    | OF_OTHER_EFFECTS
    | frozenset(CARRIED)
)

WORDS = ("edges", "load_balance", "viscosity_table", "oil_profile")
"""Keys whose values are text, besides the laws of the oil."""
STRESSES = ("eyring_stress_pa", "carreau_modulus_pa")
"""Stresses of shear-thinning oils."""


def carried_columns(points: xr.Dataset) -> dict[str, list[Any]]:
    """Return the columns of the keys that a response depends on, of the points of a sweep.

    Raises ResultsError if the points have heat, or differ in an unknown key.
    """
    inputs = _inputs(points)
    if any(key in OF_THE_HEAT for one in inputs for key in one):
        raise ResultsError(
            "the cases have heat (&heat): a table is for contacts of any size and speed, "
            "and their responses are not"
        )
    for key in sorted({key for one in inputs for key in one} & OF_OTHER_EFFECTS):
        raise ResultsError(f"the cases have &{GROUP_OF[key]} {key}: no table has this effect")
    unknown = sorted({key for one in inputs for key in one} - CLASSIFIED)
    for key in unknown:
        values = sorted({str(one.get(key, "none")) for one in inputs})
        if len(values) > 1:
            raise ResultsError(
                f"the cases differ in {printable(key)} ({printable(', '.join(values[:4]))}), which "
                "this version of ehlwave does not support: update it"
            )
    linear = _is_linear(points)
    columns: dict[str, list[Any]] = {}
    for key in CARRIED:
        values = [
            one.get(key) if _counts(key, one, is_linear) else None
            for one, is_linear in zip(inputs, linear, strict=True)
        ]
        if any(value is not None for value in values):
            columns[key] = values
    return columns


def _counts(key: str, keys: Mapping[str, float | str], is_linear: bool) -> bool:
    """Return whether a response depends on a key that its case has.

    Keys of marches are nothing to a response to small waves, and the modulus matters where a
    stress thins the oil, times that stress.
    """
    if key in OF_MARCHES:
        return not is_linear
    return key != "reduced_modulus_pa" or any(stress in keys for stress in STRESSES)


def _inputs(points: xr.Dataset) -> list[dict[str, float | str]]:
    """Return the keys of each point: of its effective input, or where there is none by columns."""
    if "effective_input" in points:
        texts = [str(text) for text in points["effective_input"].values]
        known = {text: keys_of_input(text) for text in set(texts)}
        return [known[text] for text in texts]
    names = [key for key in CARRIED if key in points]
    rows = zip(*(points[name].values.tolist() for name in names), strict=True)
    every = [dict(zip(names, row, strict=True)) for row in rows]
    return [
        {key: value for key, value in one.items() if value == value and value != ""}
        for one in every or [{} for _ in range(points.sizes["case"])]
    ]


def _is_linear(points: xr.Dataset) -> list[bool]:
    """Return whether each response is that to small waves."""
    if "harmonic_real" not in points or "harmonic_imaginary" not in points:
        return [False] * points.sizes["case"]
    response = points["harmonic_real"].values + 1j * points["harmonic_imaginary"].values
    return np.isfinite(response).tolist()


def table_columns(raw: pd.DataFrame, place: str) -> Mapping[str, pd.Series]:
    """Return the key columns of a table: numbers, or text of the laws.

    Raises SurfaceError if there is text where a number belongs.
    """
    found = {}
    for key in CARRIED:
        if key not in raw:
            continue
        column = raw[key].map(lambda value: value.decode() if isinstance(value, bytes) else value)
        if key.endswith("_law") or key in WORDS:
            column = column.map(lambda value: np.nan if value == "" else value)
        elif column.dtype.kind not in "fiu":
            raise SurfaceError(f"{place}: column {key} does not hold numbers")
        found[key] = column
    return found
