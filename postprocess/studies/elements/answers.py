"""Answers for contacts of random elements: by laws, and by ``ehlwave-case``."""

import math
import multiprocessing
import os
import resource
from dataclasses import replace
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from ehlwave.elements.answers import REFUSALS
from ehlwave.elements.place import ElementContact
from ehlwave.laws.heat_laws import RANGES
from ehlwave.laws.heated_contact import EYRING_PA, ROLLING_FIT, outside, quantities
from ehlwave.laws.rigid_films import is_rigid
from studies.elements.draw import places
from studies.sweeps import Row

COMPUTE_S = 60
"""Most seconds of a processor for each run of a computed contact."""
MOST_PLACES = 100
"""Contacts have the number of the element times this, plus the number of the place."""
SLIDING_FIT = RANGES | {"eyring_stress_pa": EYRING_PA}
"""Ranges of sliding ellipses of the fit."""
EXACT = {"viscosity_error": 0.0, "pressure_viscosity_error": 0.0, "conductivity_error": 0.0}
Answer = dict[str, Any]


def answer(place: ElementContact, by: str) -> Answer:
    """Return film and friction of a contact, their errors and source, or the reason for none."""
    try:
        film = place.contact.film(by=by)
    except REFUSALS as error:
        return {"reason": str(error)[:150]}
    rolls = place.slide_to_roll_ratio == 0
    found: Answer = {"source": film.source[:40]}
    for name, value, error in (
        ("central", film.central_m, film.central_error),
        ("minimum", film.minimum_m, film.minimum_error),
        ("friction", 0.0 if rolls else film.friction, 0.0 if rolls else film.friction_error),
    ):
        if value is not None and error is not None and math.isfinite(value + error):
            found |= {name: value, f"{name}_error": error}
    if "central" not in found or "friction" not in found:
        found["reason"] = f"no {'friction' if 'central' in found else 'film'}"
    return found


def _send(pipe: Connection, place: ElementContact) -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (COMPUTE_S, COMPUTE_S))  # programs inherit it
    start = _processor_s()
    found = answer(place, "computed")
    pipe.send(found | {"seconds": _processor_s() - start})


def computed(place: ElementContact) -> Answer:
    """Return the answer of ``ehlwave-case`` within the limit of processor time."""
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=_send, args=(there, place))
    process.start()
    there.close()
    try:
        return dict(here.recv())
    except EOFError:
        return {"reason": f"more than {COMPUTE_S} s of a processor"}
    finally:
        process.join()


def by_laws(number: int, _folder: Path) -> Row:
    """Return the answers of laws for an element, by place."""
    kind, drawn = places(number)
    found = []
    for index, place in enumerate(drawn):
        if place.is_opposite or place.mean_speed_m_per_s == 0:
            continue  # surfaces move in opposite directions: the element names these angles
        one = {"place": index} | answer(place, "laws")
        found.append(one if "reason" in one else one | beyond(place))
    return {"kind": kind, "places": found}


def beyond(place: ElementContact) -> dict[str, str]:
    """Return the first quantity of a contact beyond the contacts of the fit of the laws of heat.

    Nothing within them, and for lines and rigid balls: ``scripts/study heat-ends`` judges these.
    """
    c, heat = place.contact.conditions, place.contact.heat
    if heat is None or c.is_line or (c.rolls and is_rigid(c)):
        return {}
    film = place.contact.film(by="laws")
    cold_m = (film.central_m or math.nan) / (film.heated.film_factor if film.heated else math.nan)
    stress_pa = dict(c.given).get("eyring_stress_pa")
    found = outside(quantities(c, heat, cold_m, stress_pa), ROLLING_FIT if c.rolls else SLIDING_FIT)
    return {"beyond": found[0]} if found else {}


def by_program(number: int, _folder: Path) -> Row:
    """Return the computed answer for a contact."""
    kind, place = _contact(number)
    return {"kind": kind} | computed(place)


def by_both(number: int, folder: Path) -> Row:
    """Return the answers of laws and of ``ehlwave-case`` for a contact.

    Law and program take the same data of the oil: the errors by these data, which would hide
    differences, are left out of both.
    """
    kind, place = _contact(number)
    exact = replace(place, oil=replace(place.oil, **EXACT))
    law = answer(exact, "laws")
    found = {"law": law, "case": own_errors(by_program(number, folder), law, answer(place, "laws"))}
    contact = place.contact.conditions
    keys = {"m": contact.m, "l": contact.l, "d": contact.d, "slip": place.slide_to_roll_ratio}
    return {"kind": kind} | keys | beyond(place) | found


def own_errors(case: Answer, law: Answer, with_data: Answer) -> Answer:
    """Return a computed answer without the errors by the oil's data.

    Parameters
    ----------
    case : dict
        Computed, with the errors of the oil's data.
    law, with_data : dict
        Answers of the law without and with these errors.
    """
    names = [name for name in case if name.endswith("_error") and name in law and name in with_data]
    return case | {name: max(0.0, case[name] - with_data[name] + law[name]) for name in names}


def _contact(number: int) -> tuple[str, ElementContact]:
    element, place = divmod(number, MOST_PLACES)
    kind, drawn = places(element)
    return kind, drawn[place]


def _processor_s() -> float:
    found = os.times()
    return found.user + found.system + found.children_user + found.children_system
