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
from studies.elements.draw import places
from studies.sweeps import Row

COMPUTE_S = 60
"""Most seconds of a processor for each run of a computed contact."""
MOST_PLACES = 100
"""Contacts have the number of the element times this, plus the number of the place."""
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
        found.append({"place": index} | answer(place, "laws"))
    return {"kind": kind, "places": found}


def by_program(number: int, _folder: Path) -> Row:
    """Return the computed answer for a contact."""
    kind, place = _contact(number)
    return {"kind": kind} | computed(place)


def by_both(number: int, _folder: Path) -> Row:
    """Return the answers of laws and of ``ehlwave-case`` for a contact.

    The oil's data count as exact: law and program take the same, so that their errors would hide
    differences.
    """
    kind, place = _contact(number)
    place = replace(place, oil=replace(place.oil, **EXACT))
    found = {"law": answer(place, "laws"), "case": computed(place)}
    contact = place.contact.conditions
    keys = {"m": contact.m, "l": contact.l, "d": contact.d, "slip": place.slide_to_roll_ratio}
    return {"kind": kind} | keys | found


def _contact(number: int) -> tuple[str, ElementContact]:
    element, place = divmod(number, MOST_PLACES)
    kind, drawn = places(element)
    return kind, drawn[place]


def _processor_s() -> float:
    found = os.times()
    return found.user + found.system + found.children_user + found.children_system
