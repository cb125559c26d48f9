"""Which rows of a harmonic table are of a contact."""

from collections.abc import Iterator

import numpy as np
import pandas as pd

from ehlwave.contact.conditions import Conditions
from ehlwave.errors import SurfaceError, printable
from ehlwave.inputs.effective_input import value_of
from ehlwave.laws.table_keys import CARRIED, OF_THE_INLET, STRESSES

LARGEST_DIFFERENCE = 0.01
"""Relative, between a number of a contact and of a condition that is taken to be the same."""

SAME_RESPONSE = 1e-3
"""Largest difference of two responses to one wave that are taken to be the same."""

FLOW_LAWS = {"Newtonian": "newtonian", "Ree-Eyring": "eyring", "Carreau": "carreau"}


def matching_rows(rows: pd.DataFrame, conditions: Conditions, name: str) -> pd.DataFrame:
    """Return the rows of a table whose keys match a contact.

    Numbers are the same within 1 per cent, as M, L and D; of a stress its product with the reduced
    modulus is. A key that the table does not have, or that does not apply, is not compared.

    Raises SurfaceError if there are none, naming the key and both values; if the remaining rows
    differ in a key that the contact does not set, or have two responses to a wave.
    """
    slides = not conditions.rolls and conditions.oil.stress_modulus_pa2 is not None
    if slides and "flow_law" not in rows:
        raise SurfaceError(
            f"{name}: has no column flow_law, so that it may be of another oil than this contact, "
            f"which slides in a {conditions.oil.name} oil: write it by ehlwave harmonics"
        )
    for key, wanted in _wanted(conditions):
        if key in rows and len(rows):
            same = rows[key].map(lambda found, value=wanted: _is_same(found, value))
            if not same.any():
                there = ", ".join(sorted({_text(value) for value in rows[key]})[:5])
                raise SurfaceError(
                    f"{name}: is of {key} = {there}, the contact has {_text(wanted)}: compute a "
                    "table for this contact"
                )
            rows = rows[same]
    rows = _of_same_stress(rows, conditions, name)
    rows = _of_same_inlet(rows, conditions, name)
    _refuse_varying(rows, name)
    return rows


def _wanted(conditions: Conditions) -> Iterator[tuple[str, float | str]]:
    """Yield keys of the oil and their values that a contact has."""
    oil = conditions.oil
    laws = {"viscosity_law": "roelands", "density_law": "dowson_higginson"}
    others = {key: value_of(value) for key, value in (_pair(law) for law in oil.other_laws)}
    yield from (laws | others).items()
    if "viscosity_law" not in others:
        yield "pressure_viscosity_per_pa", oil.pressure_viscosity_per_pa
        yield "roelands_index", oil.roelands_index
    yield "flow_law", FLOW_LAWS[oil.name]
    if oil.carreau_exponent is not None:
        yield "carreau_exponent", oil.carreau_exponent
    yield from oil.other_keys


def _pair(law: str) -> tuple[str, str]:
    key, _, value = law.partition("=")
    return key.strip(), value


def _of_same_stress(rows: pd.DataFrame, conditions: Conditions, name: str) -> pd.DataFrame:
    """Return the rows whose stress times modulus is the contact's."""
    wanted = conditions.oil.stress_modulus_pa2
    for key in STRESSES:
        if wanted is None or key not in rows or rows[key].isna().all():
            continue
        if "reduced_modulus_pa" not in rows:
            raise SurfaceError(f"{name}: has {key} but no column reduced_modulus_pa")
        product = rows[key] * rows["reduced_modulus_pa"]
        same = np.abs(product / wanted - 1) <= LARGEST_DIFFERENCE
        if len(rows) and not same.any():
            there = ", ".join(f"{value:g}" for value in sorted(set(rows[key].dropna()))[:5])
            modulus = float(rows["reduced_modulus_pa"].dropna().iloc[0])
            raise SurfaceError(
                f"{name}: is of {key} = {there} at reduced_modulus_pa = {modulus:g}, the contact "
                f"has {wanted / modulus:g} at this modulus: compute a table for this contact"
            )
        rows = rows[same]
    return rows


def _of_same_inlet(rows: pd.DataFrame, conditions: Conditions, name: str) -> pd.DataFrame:
    """Return the rows with as much oil: for a flooded contact the rows without such a key."""
    r = conditions.oil_over_flooded
    is_other = pd.Series(False, index=rows.index)
    for key in OF_THE_INLET:
        there = rows[key] if key in rows else pd.Series(np.nan, index=rows.index)
        if key == "oil_over_flooded" and r is not None:
            is_other |= ~((there.astype(float) / r - 1).abs() <= LARGEST_DIFFERENCE)
        else:
            is_other |= there.notna()
    if len(rows) and is_other.all():
        wanted = "a flooded contact" if r is None else f"oil_over_flooded = {r:g}"
        raise SurfaceError(
            f"{name}: has no rows of this much oil, {wanted}: compute a table for this contact"
        )
    return rows[~is_other]


def _refuse_varying(rows: pd.DataFrame, name: str) -> None:
    """Refuse rows that differ in a key that the contact does not set."""
    compared = {*STRESSES, "reduced_modulus_pa", "pressure_viscosity_per_pa", "roelands_index"}
    for key in CARRIED:
        if key not in rows or key in compared:
            continue
        there = sorted({_text(value) for value in rows[key]})
        if len(there) > 1:
            raise SurfaceError(
                f"{name}: has rows of {key} = {' and of '.join(there[:4])}: keep the "
                "rows of a single value"
            )


def refuse_two_responses(rows: pd.DataFrame, place: str) -> None:
    """Raise SurfaceError if rows with the same keys and the same wave have different responses."""
    keys = ["M", "L", "D", "slip_parameter", *(key for key in CARRIED if key in rows)]
    waves = [rows["angle"].round(6), rows["log_wave"].round(9)]
    groups = rows.groupby([*(rows[key] for key in keys), *waves], dropna=False, sort=False)
    for part in ("transfer_real", "transfer_imag"):
        spread = groups[part].transform("max") - groups[part].transform("min")
        if not (spread <= SAME_RESPONSE).all():
            worst = spread.idxmax()
            one = rows.loc[worst]
            alike = (rows[["M", "L", "D", "slip_parameter"]] == one[keys[:4]]).all(axis=1)
            alike &= (rows["angle"].round(6) == round(one["angle"], 6)) & (
                rows["log_wave"].round(9) == round(one["log_wave"], 9)
            )
            values = sorted(set(rows.loc[alike, part]))
            raise SurfaceError(
                f"{place}: has different responses to one wave, {part} = {values[0]:.6g} and "
                f"{values[-1]:.6g}, at M = {one['M']:.6g}, L = {one['L']:.6g}, D = {one['D']:.6g}, "
                f"S = {one['slip_parameter']:g}, which differ in no key of the table: keep the "
                "better one (of the finer grid)"
            )


def _is_same(found: object, wanted: float | str) -> bool:
    """Return whether a value of a table is a contact's; a missing value always does."""
    if found is None or found != found:
        return True
    if isinstance(wanted, str) or isinstance(found, str):
        return str(found).lower() == str(wanted).lower()
    return bool(abs(float(found) - wanted) <= LARGEST_DIFFERENCE * abs(wanted))  # type: ignore[arg-type]


def _text(value: object) -> str:
    if value is None or value != value:
        return "none"
    return f"{value:g}" if isinstance(value, (float, int)) else printable(str(value))
