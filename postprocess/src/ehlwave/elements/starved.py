"""Starved or not: a band of films, or an estimate from the oil layer.

R, film over flooded film, follows from r, the oil offered over the oil that the flooded contact
passes: R = r (1 + r^g)^(-1/g) (:mod:`ehlwave.contact.starvation`). Without r the film is unknown;
tables of contacts that roll have the film at r = 0.3 as lower end of a band whose upper end is the
flooded film. g comes from the law, outside its range of contacts continued: at r = 0.3, R is 0.3
within 2 % for any g above 2.5, since hardly any oil is pushed aside.
"""

from __future__ import annotations

import math
from typing import Any

from ehlwave.contact.formula import power_ratio
from ehlwave.contact.starvation import FILM_BAR, FILM_RANGES, film_sharpness
from ehlwave.elements.place import ElementContact
from ehlwave.errors import RangeError
from ehlwave.laws.replenishment import SHARPNESS_ERROR, density

LOW = 0.3
"""r of the lower end of the band."""


def starved_row(
    place: ElementContact, row: dict[str, Any], oil_layer_m: float | None
) -> dict[str, float]:
    """Return the lower end of the band, and with a layer r and the starved film with its error.

    Parameters
    ----------
    place : ElementContact
        A contact that rolls.
    row : mapping
        Its flooded film.
    oil_layer_m : float or None
        Thickness of the oil on both surfaces together.
    """
    film = row.get("central_film_m") or row.get("isothermal_central_film_m")
    if film is None or not math.isfinite(film):
        return {}
    try:
        conditions = place.contact_with({}).conditions
    except RangeError:
        return {}
    least, most = FILM_RANGES["r"]
    m, l, d = conditions.m, conditions.l, max(conditions.d, 0.01)  # noqa: E741

    def ratio(r: float, factor: float = 1.0) -> float:
        return float(power_ratio(1 / r, factor * film_sharpness(min(max(r, least), most), m, l, d)))

    found = {"film_starved_low_m": ratio(LOW) * film}
    if oil_layer_m is not None:
        r = oil_layer_m / (film * float(density(place.hertz_pressure_pa)))
        share = ratio(r)
        ends = [abs(ratio(r, 1 + sign * SHARPNESS_ERROR) / share - 1) for sign in (-1, 1)]
        flooded = row.get("central_film_error") or row.get("isothermal_central_film_error") or 0.0
        found |= {
            "oil_over_flooded": r,
            "film_starved_m": share * film,
            "film_starved_error": max(ends) + FILM_BAR / share + flooded,
        }
    return found
