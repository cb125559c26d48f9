"""Answers of a contact of an element, as a row of a table; missing numbers have a reason."""

from __future__ import annotations

import contextlib
import math
import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np

from ehlwave.contact.heat_data import Heat
from ehlwave.elements.given import above, check_names
from ehlwave.elements.hertz import reduced_modulus
from ehlwave.elements.place import ASSUMED, STATIC_PA, ElementContact
from ehlwave.elements.practice import iso_gear_film_m
from ehlwave.elements.rolling_resistance import force_of
from ehlwave.elements.starved import starved_row
from ehlwave.errors import ExtrapolationWarning, ProgramError, RangeError, StressError
from ehlwave.laws.answers import Film
from ehlwave.operating_point import Contact
from ehlwave.surface.pair import DeformedPair
from ehlwave.surface.predict import Deformed
from ehlwave.surface.read import ReadOptions, read_surface
from ehlwave.surface.surface import Surface

Row = dict[str, Any]
LONGEST = 300
"""Characters of a reason: programs print their whole plan."""
REFUSALS = (RangeError, StressError, ProgramError)
"""Errors that leave a number out, with their message as the reason; others are the user's."""


@dataclass(frozen=True)
class Questions:
    """Questions for every contact of an element.

    Parameters
    ----------
    trace, second : surface, optional
        Roughness of the first body and of the second body, as :func:`ehlwave.read_surface` reads
        it.
    heat : bool or Heat, optional
        True: films and friction with heat, by the own data of oil and bodies.
    stress : bool
        With a trace: also stresses, Dang Van's factor and life, which take most of the time.
    oil_over_flooded : float, optional
        r of starved contacts that roll.
    oil_layer_m : float, optional
        Thickness of the oil on both surfaces together before a contact that rolls, from which r and
        the film are estimated.
    by : str, optional
        Which law answers, as of :meth:`ehlwave.Contact.film`; "laws": nothing is computed.
    reading : mapping
        Options of :class:`ehlwave.surface.ReadOptions` for the traces.
    """

    trace: Any = None
    second: Any = None
    heat: Heat | bool | None = None
    stress: bool = True
    oil_over_flooded: float | None = None
    oil_layer_m: float | None = None
    by: str | None = None
    reading: dict[str, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, asked: Mapping[str, Any], place: str, others: Iterable[str] = ()) -> Questions:
        """Return the questions of a call, and refuse arguments that it does not take.

        Parameters
        ----------
        asked : mapping
            Arguments.
        place : str
            Name of the element, for messages.
        others : iterable of str
            Names of other arguments of the call, which messages may suggest.
        """
        check_names(asked, [one.name for one in fields(cls)] + list(others), place)
        return cls(**asked)

    def __post_init__(self) -> None:
        """Check the oil layer, and read the traces once."""
        if self.oil_layer_m is not None:
            above(self.oil_layer_m, "oil_layer_m", "oil", example="1e-6")
        for name in ("trace", "second"):
            given = getattr(self, name)
            if given is not None and not isinstance(given, Surface):
                surface = read_surface(given, ReadOptions(**self.reading))
                object.__setattr__(self, name, surface)

    @property
    def options(self) -> dict[str, Any]:
        """Return the options of every contact."""
        return {"heat": self.heat or None, "oil_over_flooded": self.oil_over_flooded}

    @property
    def chosen(self) -> dict[str, Any]:
        """Return the law that answers as an argument; nothing where the contact chooses."""
        return {} if self.by is None else {"by": self.by}

    @property
    def mean_ra_m(self) -> float:
        """Return the mean of Ra of both surfaces; a smooth surface has 0."""
        heights = [one.height for one in (self.trace, self.second) if one is not None]
        return sum(float(np.mean(np.abs(h - h.mean()))) for h in heights) / 2 or math.nan


def row_of(place: ElementContact, asked: Questions) -> Row:
    """Return the numbers of a contact by their columns.

    Parameters
    ----------
    place : ElementContact
        The contact.
    asked : Questions
        Options besides the film.
    """
    row: Row = {
        "radius_m": place.radius_x_m,
        "radius_y_m": place.radius_y_m,
        "speed_1_m_per_s": place.speeds_m_per_s[0],
        "speed_2_m_per_s": place.speeds_m_per_s[1],
        "mean_speed_m_per_s": place.mean_speed_m_per_s,
        "slide_to_roll_ratio": place.slide_to_roll_ratio,
        "load_n": place.load_n,
        "load_n_per_m": place.load_n_per_m,
        "semi_axis_a_m": place.semi_axis_a_m,
        "hertz_pressure_pa": place.hertz_pressure_pa,
        **place.others,
    }
    reasons: list[str] = []
    if asked.heat:
        _film_without_heat(place, asked, row, reasons)
    with warnings.catch_warnings(record=True) as raised:
        warnings.simplefilter("always", ExtrapolationWarning)
        film = _film(place, asked, row, reasons)
        if asked.trace is not None:
            _roughness(place, asked, row, reasons)
    row["doubts"] = "\n".join(dict.fromkeys(" ".join(str(one.message).split()) for one in raised))
    if place.slide_to_roll_ratio == 0 and asked.oil_over_flooded is None:
        row |= starved_row(place, row, asked.oil_layer_m)
    _power(place, row, film)
    row["refusal"] = "\n".join(dict.fromkeys(" ".join(one.split())[:LONGEST] for one in reasons))
    return row


def _film_without_heat(
    place: ElementContact, asked: Questions, row: Row, reasons: list[str]
) -> None:
    """Add the film without heat; its warnings belong to the film with heat, or to none."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ExtrapolationWarning)
            cold = place.contact_with(asked.options | {"heat": None}).film(**asked.chosen)
    except REFUSALS as error:
        reasons.append(f"without heat: {error}")
        return
    row["isothermal_central_film_m"] = cold.central_m
    row["isothermal_central_film_error"] = cold.central_error


def _film(place: ElementContact, asked: Questions, row: Row, reasons: list[str]) -> Film | None:
    """Add films, friction and temperatures."""
    if place.hertz_pressure_pa > STATIC_PA:
        warnings.warn(
            f"Hertz pressure of {place.hertz_pressure_pa * 1e-9:.3g} GPa: above 4 GPa hard steel "
            "keeps dents (ISO 76), and films are those of elastic bodies",
            ExtrapolationWarning,
            stacklevel=2,
        )
    try:
        film = place.contact.film(**asked.chosen)
    except REFUSALS as error:
        reasons.append(str(error))
        return None
    for name in ("central", "minimum"):
        row[f"{name}_film_m"] = getattr(film, f"{name}_m")
        row[f"{name}_film_error"] = getattr(film, f"{name}_error")
    rolls = place.slide_to_roll_ratio == 0
    row["friction"] = 0.0 if rolls else film.friction  # like surfaces of like speed
    row["friction_error"] = 0.0 if rolls else film.friction_error
    row["source"] = film.source
    if film.heated is not None:
        row["rise_mid_film_k"] = film.heated.rise_mid_film_k
        row["rise_surfaces_k"] = film.heated.rise_surfaces_k
        row["thermal_film_factor"] = film.heated.film_factor
    if film.friction is None and not rolls:
        reasons.append("friction: not known without heat and eyring_stress_pa of the oil")
    if asked.heat and place.assumes_eyring:
        warnings.warn(ASSUMED, ExtrapolationWarning, stacklevel=2)
    return film


def _roughness(place: ElementContact, asked: Questions, row: Row, reasons: list[str]) -> None:
    """Add lambda ratios and stresses; without heat where those with heat are refused."""
    deformed: tuple[Deformed, ...] = ()
    try:
        if asked.stress:
            deformed = _stress(place.contact, asked, row)
    except REFUSALS as error:
        reasons.append(str(error))
    try:
        row |= _lambda(place.contact, asked, deformed)
    except REFUSALS as error:
        reasons.append(str(error))
        if asked.heat:
            with contextlib.suppress(*REFUSALS):
                cold = _lambda(place.contact_with(asked.options | {"heat": None}), asked, ())
                row |= {f"isothermal_{name}": value for name, value in cold.items()}
    if place.length_m is not None:
        row["iso_film_m"] = iso_gear_film_m(
            place.radius_x_m,
            2 * abs(place.mean_speed_m_per_s),
            place.hertz_pressure_pa,
            reduced_modulus(*place.bodies),
            place.oil,
            row.get("rise_surfaces_k") or 0.0,
        )
        row["iso_specific_film"] = row["iso_film_m"] / asked.mean_ra_m


def _stress(contact: Contact, asked: Questions, row: Row) -> tuple[Deformed, ...]:
    """Add the worse of both bodies; return the deformed surfaces."""
    found = contact.stress(asked.trace, asked.second, **asked.chosen)
    worst = max(found.bodies, key=lambda body: body.dang_van)
    row["dang_van"], row["dang_van_error"] = worst.dang_van, worst.dang_van_error
    row["life_ratio"] = min(body.life_ratio for body in found.bodies)
    shears = [body.peaks["largest_shear"].value_pa for body in found.bodies]
    row["largest_shear_pa"] = max(shears)
    return found.surfaces


def _lambda(contact: Contact, asked: Questions, deformed: tuple[Deformed, ...]) -> Row:
    """Return the lambda ratios of one surface or of both."""
    found: Deformed | DeformedPair
    if asked.second is not None:
        found = contact.deform_pair(asked.trace, asked.second, **asked.chosen)
    else:
        found = deformed[0] if deformed else contact.deform(asked.trace, **asked.chosen)
    return {
        "lambda_ratio": found.statistics.lambda_ratio_after,
        "lambda_error": found.statistics.lambda_error,
        "lambda_ratio_before": found.statistics.lambda_ratio_before,
    }


def _power(place: ElementContact, row: Row, film: Film | None) -> None:
    """Add rolling resistance and both powers; the warm inlet takes from the former."""
    speed = place.mean_speed_m_per_s
    if speed == 0:
        return
    force = force_of(place)
    if film is not None and film.heated is not None:
        force *= film.heated.inlet_factor
    row["rolling_resistance_n"] = force
    row["rolling_power_w"] = 2 * force * abs(speed)
    friction = row.get("friction")
    if friction is not None:
        first, second = place.speeds_m_per_s
        row["sliding_power_w"] = friction * place.load_n * abs(first - second)
