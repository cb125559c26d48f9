"""Error of films by estimated inner dimensions, from a formula that serves sensitivities alone."""

from __future__ import annotations

import math
from collections.abc import Sequence

import xarray as xr

from ehlwave.contact.scales import moes_film
from ehlwave.elements.columns import COLUMNS
from ehlwave.elements.hertz import reduced_modulus
from ehlwave.elements.place import ElementContact


def inside_error(own: ElementContact, varied: Sequence[ElementContact]) -> float:
    """Return the root of the sum of squares of the changes of the film.

    Parameters
    ----------
    own : ElementContact
        Most loaded contact of the estimated dimensions.
    varied : sequence of ElementContact
        Evaluate with each dimension in turn at its error.
    """
    film = film_by_formula(own)
    return math.hypot(*(film_by_formula(one) / film - 1 for one in varied))


def film_by_formula(place: ElementContact) -> float:
    """Return the central film of a formula, m, for sensitivities alone.

    Parameters
    ----------
    place : ElementContact
        The contact.
    """
    modulus, radius = reduced_modulus(*place.bodies), place.radius_x_m
    oil = place.oil
    speed = 2 * oil.viscosity_pa_s * abs(place.mean_speed_m_per_s) / (modulus * radius)
    viscous = oil.pressure_viscosity_per_pa * modulus * speed**0.25
    if place.length_m is None:
        load, ratio = place.load_n / (modulus * radius**2) / speed**0.75, radius / place.radius_y_m
    else:
        load, ratio = place.load_n_per_m / (modulus * radius) / speed**0.5, 0.0
    return moes_film(load, viscous, ratio) * radius * speed**0.5


def widen(found: xr.Dataset, inside: float) -> None:
    """Add the error by inner dimensions to the errors of films and lambda ratios.

    Parameters
    ----------
    found : xarray.Dataset
        Table of a bearing.
    inside : float
        The error.
    """
    found["inside_error"] = xr.full_like(found["load_n"], inside)
    found["inside_error"].attrs = {"long_name": COLUMNS["inside_error"].meaning}
    for name in list(found.data_vars):
        if str(name).endswith(("film_error", "lambda_error")):
            found[name] = (found[name] + inside).assign_attrs(found[name].attrs)
