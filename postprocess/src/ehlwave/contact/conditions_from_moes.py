"""Quantities that follow from M, L, D and the lengths of a contact.

Equation numbers refer to ``src/theory.md``.
"""

from collections.abc import Mapping
from dataclasses import replace

from ehlwave.contact.conditions import (
    FIT_ERROR,
    FIT_TEXT,
    GIVEN_TEXT,
    LINE_FIT_ERROR,
    LINE_FIT_TEXT,
    MOES_KEYS,
    Conditions,
)
from ehlwave.contact.data_errors import film_error_by_data
from ehlwave.contact.moes_parameters import checked_ratio
from ehlwave.contact.oil_keys import oil_of_keys
from ehlwave.contact.scales import (
    ellipticity,
    first_integral,
    moes_film,
    moes_per_film,
    pressure_factor,
    second_integral,
)
from ehlwave.contact.starvation import FILM_BAR, OIL_OVER_FLOODED, film_over_flooded
from ehlwave.duals import math, to_float
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.inputs.slip import SLIP


def conditions_from_moes(
    values: Mapping[str, float], place: str, given: tuple[tuple[str, float], ...]
) -> Conditions:
    """Return the conditions, eq. (1) to (6).

    Takes all values by their keys, M, L, D and the semi-axis (NaN: none) among them, and pairs of
    key and value as they were given.
    """
    m, l, d = (values[key] for key in MOES_KEYS)  # noqa: E741
    d = checked_ratio(d, f"{place}: radius_ratio_d = {d:g}")
    semi_axis_a_m, film_m = values["semi_axis_a_m"], values.get("central_film_m")
    slip, oil = values.get("slip_parameter", 1.0), oil_of_keys(values, place)
    oil_error = film_error_by_data(values, m, l, d)
    kappa = ellipticity(d) if d > 0 else 0.0
    ratio = _film_ratio(values, m, l, d, place)
    starved = FILM_BAR / ratio if OIL_OVER_FLOODED in values else 0.0
    approach, metres_per_moes = None, None
    source, error = GIVEN_TEXT, 0.0
    if "radius_x_m" in values and math.isfinite(semi_axis_a_m):
        k, e = first_integral(kappa), second_integral(kappa)
        approach = semi_axis_a_m**2 * (1 + d) / (2 * values["radius_x_m"]) * k / e
        metres_per_moes = approach / moes_per_film(m, kappa)
        if film_m is None and math.isfinite(ratio):
            film_m = moes_film(m, l, d) * metres_per_moes * ratio
            source, error = (FIT_TEXT, FIT_ERROR) if d > 0 else (LINE_FIT_TEXT, LINE_FIT_ERROR)
            error += oil_error + starved
            if starved:
                source += f", times R = {ratio:.3g} of the law of starved contacts"
    if film_m is None:
        source = "unknown: give central_film_m or radius_x_m"
    found = Conditions(
        m=m,
        l=l,
        d=d,
        kappa=kappa,
        gamma=pressure_factor(kappa) if d > 0 else math.sqrt(m),
        slip_parameter=slip,
        semi_axis_a_m=semi_axis_a_m,
        hertz_approach_c_m=approach,
        central_film_m=film_m,
        film_source=source,
        oil=oil,
        metres_per_moes=metres_per_moes,
        central_film_error=None if film_m is None else error,
        oil_error=oil_error,
        oil_over_flooded=values.get(OIL_OVER_FLOODED),
        film_ratio=ratio,
        given=given,
    )
    # The formulas are of oils that nothing thins.
    return _with_loss(found) if film_m is not None and not found.has_given_film else found


def _with_loss(found: Conditions) -> Conditions:
    """Return conditions with a film by formula, whose error counts thinning in the inlet, too."""
    error, loss = found.central_film_error, found.film_loss
    if error is not None and math.isfinite(loss):
        return replace(found, central_film_error=error + loss)
    source = f"{found.film_source}, which leaves out how much the oil thins"
    return replace(found, central_film_error=None, film_source=source)


def _film_ratio(values: Mapping[str, float], m: float, l: float, d: float, place: str) -> float:  # noqa: E741
    """Return R of a starved contact, 1 if flooded; NaN where its law does not hold."""
    if OIL_OVER_FLOODED not in values:
        return 1.0
    if "central_film_m" in values:
        raise SurfaceError(
            f"{place}: gives both {OIL_OVER_FLOODED} and central_film_m: a given film already "
            "includes the lack of oil: remove one"
        )
    if values.get(SLIP, 1.0) != 1 or d == 0:
        return math.nan
    try:
        return to_float(film_over_flooded(values[OIL_OVER_FLOODED], m, l, d))
    except RangeError:
        return math.nan
