"""Derivatives of a contact's results by its keys, and what errors of the keys do to the results."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from ehlwave.choices import FILM_BY, chosen_or_none
from ehlwave.contact.data_errors import DATA_ERRORS, OF_ERRORS
from ehlwave.duals import Dual, log_slopes, seeded
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.inputs.key_classes import HEAT_DATA
from ehlwave.quantities import number

if TYPE_CHECKING:
    from ehlwave.laws.answers import Film
    from ehlwave.operating_point.smooth import SmoothContact

RESULTS = ("central_film", "minimum_film", "friction")
PROGRAM_RESULTS = {
    "central_film": "central_film",
    "minimum_film": "minimum_film",
    "friction": "friction_coefficient",
}
"""Results by their names in the program."""

LAMBDA = "lambda_ratio"
DEFAULTS = {"pressure_viscosity_per_pa": 2.2e-8, "roelands_index": 0.68}
KEYS = (
    *("radius_x_m", "radius_y_m", "reduced_modulus_pa", "load_n", "load_n_per_m"),
    *("mean_speed_m_per_s", "viscosity_pa_s", "load_parameter_m", "lubricant_parameter_l"),
    *("radius_ratio_d", "semi_axis_a_m", "slip_parameter", "slide_to_roll_ratio"),
    *("pressure_viscosity_per_pa", "roelands_index", "eyring_stress_pa", "carreau_modulus_pa"),
    *("carreau_exponent", "oil_over_flooded"),
)
CELLS, LINE_CELLS = 128, 512
"""Cells of computed contacts whose input has none."""
ONLY_LAWS = "an error budget has the lambda ratio by the laws alone"
WARM = (
    "derivatives with heat are known of its laws alone, not of computed contacts, whose "
    "temperatures are marched: leave out heat, or keep to the range of the laws"
)


def sensitivities(contact: "SmoothContact", by: str | None = None) -> pd.DataFrame:
    """Return the result of :meth:`ehlwave.Contact.sensitivities`."""
    chosen_or_none(by, "by", FILM_BY)
    keys, refusal = _keys(contact), None
    if by != "computed":
        try:
            rows = _by_laws(contact, keys)
        except RangeError as error:
            if by == "laws":
                raise
            refusal = error
    if by == "computed" or refusal is not None:
        rows = _by_program(contact, keys, refusal)
    return pd.DataFrame.from_dict(rows, orient="index", columns=list(RESULTS))


def error_budget(
    contact: "SmoothContact",
    surface: Any,  # noqa: ANN401 - a surface or a source of one
    by: str | None,
    options: Mapping[str, Any],
) -> pd.DataFrame:
    """Return the result of :meth:`ehlwave.Contact.error_budget`."""
    errors = given_errors(contact)
    if not errors:
        raise SurfaceError(
            "error_budget: the contact has no errors of data: give viscosity_error, "
            "pressure_viscosity_error, load_error or others"
        )
    powers = sensitivities(contact, by).reindex(list(errors))
    if surface is not None:
        keys = {key: value for key, value in _keys(contact).items() if key in errors}
        powers[LAMBDA] = pd.Series(_lambda_powers(contact, keys, surface, **options))
    table = pd.DataFrame({"error": errors})
    for name in powers:
        if powers[name].notna().any():
            table[name] = powers[name].abs() * table["error"]
    results = [name for name in table if name != "error"]
    table = table.sort_values(results[0], ascending=False)
    table.loc["total"] = [np.nan, *(math.hypot(*table[name].dropna()) for name in results)]
    for name in results:
        table[f"{name}_share"] = (table[name] / table.loc["total", name]) ** 2
    return table


def given_errors(contact: "SmoothContact") -> dict[str, float]:
    """Return the relative standard errors of data by the keys that they belong to."""
    given, keys = dict(contact._given.given), _keys(contact)
    return {
        next(key for key in of if key in keys): float(given[error])
        for error, of in OF_ERRORS.items()
        if given.get(error) and any(key in keys for key in of)
    }


def _keys(contact: "SmoothContact") -> dict[str, float]:
    """Return the numbers that the results depend on; those of pure rolling without their slip."""
    given = {**DEFAULTS, **contact._keys}
    found = {key: number(given[key], key) for key in KEYS if key in given}
    found = {key: value for key, value in found.items() if value}
    if str(given.get("viscosity_law", "roelands")) != "roelands":
        found.pop("roelands_index", None)
    return found


def _lambda_powers(
    contact: Any,  # noqa: ANN401 - a Contact
    keys: Mapping[str, float],
    surface: Any,  # noqa: ANN401
    second: Any = None,  # noqa: ANN401
    **options: Any,  # noqa: ANN401
) -> dict[str, float]:
    """Return d ln(lambda ratio)/d ln(key) by the laws."""
    from ehlwave.surface.lambda_slopes import lambda_with_slopes

    if options.get("transfer") is not None or contact._table is not None:
        raise RangeError(f"{ONLY_LAWS}: give neither transfer nor a table, or no surface")
    contacts, surfaces = [contact], [surface]
    if second is not None:
        contacts, surfaces = [contact, contact.exchanged()], [surface, second]
    try:
        found = [
            one._deformed(own, "laws", **options)
            for one, own in zip(contacts, surfaces, strict=True)
        ]
    except RangeError as error:
        raise RangeError(f"{ONLY_LAWS}; leave the surface out. The laws: {error}") from error
    varied = contact.replace(**dict.fromkeys(DATA_ERRORS), **seeded(keys))
    both = [varied, varied.exchanged()][: len(found)]
    film = varied._filmed("laws")[0].central_film_m
    if not isinstance(film, Dual):  # given
        film = film + 0 * next(iter(seeded(keys).values()))
    ratio = lambda_with_slopes(found, film, [one._transfer(None, "laws") for one in both])
    return dict(zip(keys, log_slopes(ratio, len(keys)), strict=True))


def _by_laws(contact: "SmoothContact", keys: Mapping[str, float]) -> dict[str, dict[str, float]]:
    contact._film("laws")  # refuses with numbers
    sure = dict.fromkeys(DATA_ERRORS)
    film: Film = contact.replace(**sure, **seeded(keys))._film("laws")
    in_metres = film.central_m is not None
    central = film.central_m if in_metres else film.central_moes
    minimum = film.minimum_m if in_metres else film.minimum_moes
    found = {"central_film": central, "minimum_film": minimum, "friction": film.friction}
    powers = {name: log_slopes(value, len(keys)) for name, value in found.items()}
    return {key: {name: of[k] for name, of in powers.items()} for k, key in enumerate(keys)}


def _by_program(
    contact: "SmoothContact", keys: Mapping[str, float], refusal: RangeError | None
) -> dict[str, dict[str, float]]:
    from ehlwave.programs.case_input import case_keys

    given = case_keys(contact._given, contact.heat).items()
    found = computed({key: value for key, value in given if value is not None}, refusal)
    return {
        key: {
            name: _number(found.get(f"sensitivity_{own}_{key}"))
            for name, own in PROGRAM_RESULTS.items()
        }
        for key in keys
    }


def computed(keys: Mapping[str, Any], refusal: RangeError | None = None) -> dict[str, Any]:
    """Return the results of ``ehlwave-case`` with their derivatives, for keys of input files.

    Raises RangeError of contacts with heat, with the refusal of the laws, if they were asked.
    """
    from ehlwave.cases.case import Case

    if any(key in keys for key in HEAT_DATA):
        raise RangeError(WARM if refusal is None else f"{WARM}. The laws: {refusal}")
    is_line = "load_n_per_m" in keys or keys.get("radius_ratio_d") == 0
    cells = {"cells_x": LINE_CELLS} if is_line else {"cells_x": CELLS, "cells_y": CELLS}
    found: dict[str, Any] = Case(**{**cells, **keys, "sensitivities": True})._json()
    return found


def _number(value: float | None) -> float:
    return math.nan if value is None else float(value)
