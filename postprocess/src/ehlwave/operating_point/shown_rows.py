"""Rows by which notebooks show a contact."""

import math

from ehlwave.contact.conditions import Conditions
from ehlwave.laws.answers import Film
from ehlwave.shown import within


def shown_rows(c: Conditions, film: Film | None) -> dict[str, str]:
    """Return conditions, and the films that are known."""
    rows = {"M, L, D, S": f"{c.m:.5g}, {c.l:.5g}, {c.d:.5g}, {c.slip_parameter:g}"}
    rows["oil"] = c.oil.name
    if film is None:
        return rows
    if film.central_m is not None:
        rows["central film"] = within(film.central_m * 1e6, film.central_error, " um")
        if film.minimum_m is not None:
            rows["smallest film"] = within(film.minimum_m * 1e6, film.minimum_error, " um")
    else:
        rows["central film, Moes"] = within(film.central_moes, film.central_error)
        if math.isfinite(film.minimum_moes):
            rows["smallest film, Moes"] = within(film.minimum_moes, film.minimum_error)
    return rows | {"source": film.source}
