"""Friction over the slide-to-roll ratio by the list of laws."""

import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from ehlwave.contact.conditions_read import given_of
from ehlwave.contact.file_keys import LEFT_OUT
from ehlwave.errors import ExtrapolationWarning, RangeError
from ehlwave.inputs.slip import RATIO
from ehlwave.laws.answers import Film
from ehlwave.operating_point import contact_of


def table_by_laws(given: Mapping[str, Any], ratios: Sequence[float]) -> pd.DataFrame:
    """Return friction over the ratios by the first law that holds; nothing is computed.

    Temperatures are those at the centre of the contact.

    Parameters
    ----------
    given : mapping
        Keys of the contact without its slip.
    ratios : sequence of float
        Slide-to-roll ratios.

    Raises
    ------
    RangeError
        If no law has the friction at a ratio.
    """
    return pd.DataFrame([_row(ratio, film_at(given, ratio)) for ratio in ratios])


def film_at(given: Mapping[str, Any], ratio: float) -> Film:
    """Return the film of a contact at a slide-to-roll ratio by the list of laws."""
    keys = {key: value for key, value in given.items() if key not in LEFT_OUT}
    contact = contact_of(given_of(keys | {RATIO: ratio}, "traction"))
    with warnings.catch_warnings():  # they are in the table
        warnings.simplefilter("ignore", ExtrapolationWarning)
        film = contact.film("laws")
    if film.friction is None:
        raise RangeError(f"{RATIO} = {ratio:g}: friction is not known for this oil")
    return film


def _row(ratio: float, film: Film) -> dict[str, Any]:
    warm = film.heated
    row: dict[str, Any] = {RATIO: ratio}
    row["isothermal"] = film.friction if warm is None else warm.isothermal_friction
    if warm is not None:
        row |= {"thermal": film.friction, "rise_mid_film_k": warm.rise_mid_film_k}
        row["rise_surfaces_k"] = warm.rise_surfaces_k
    row["central_film_um"] = np.nan if film.central_m is None else film.central_m * 1e6
    row |= {"friction_error": film.friction_error, "status": "law"}
    return row | {"warning": "; ".join(film.warnings), "source": film.source}
