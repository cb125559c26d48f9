"""From the input of the page to a contact, and to the Python code that makes it.

The only module of the page that makes contacts and oils.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ehlwave.contact.bodies import Body
from ehlwave.contact.data_sheet import Oil
from ehlwave.laws.table import HarmonicTable
from ehlwave.operating_point import Contact

Numbers = Mapping[str, Any]
"""Numbers in SI by keys; other texts unchanged."""


@dataclass(frozen=True)
class Given:
    """Input of the page."""

    keys: Numbers
    """Arguments of :class:`ehlwave.Contact`, or of its ``from_bodies``."""
    bodies: tuple[Numbers, Numbers] | None = None
    """Arguments of :class:`ehlwave.Body`, the rough body first."""
    oil: Numbers = field(default_factory=dict)
    """Arguments of `maker`."""
    maker: str = ""
    """Arguments of :class:`ehlwave.Oil`; without any, `keys` contains the oil."""


def made(given: Given, table: HarmonicTable | None = None) -> Contact:
    """Return the contact, whose waves a harmonic table answers for where there is one.

    Raises ResultsError if something is missing or makes no sense.
    """
    oil = getattr(Oil, given.maker)(**given.oil) if given.maker else None
    if given.bodies is not None:
        first, second = (Body(**body) for body in given.bodies)
        return Contact.from_bodies(first, second, oil=oil, table=table, **given.keys)
    return Contact(table=table, **given.keys, **({} if oil is None else oil.keys()))


def source(given: Given, table: str | None = None) -> str:
    """Return Python that makes the contact; `table` names the file of a harmonic table."""
    keys = dict(given.keys) | ({} if table is None else {"table": table})
    text = call(f"oil = ehlwave.Oil.{given.maker}", given.oil) if given.maker else ""
    if given.bodies is None:
        last = ["**oil.keys()"] if given.maker else []
        return text + call("contact = ehlwave.Contact", keys, last=last)
    for number, body in enumerate(given.bodies, 1):
        text += call(f"body{number} = ehlwave.Body", body)
    last = ["oil=oil"] if given.maker else []
    return text + call("contact = ehlwave.Contact.from_bodies", keys, ["body1", "body2"], last)


def call(
    start: str, given: Numbers, first: list[str] | None = None, last: list[str] | None = None
) -> str:
    """Return a call, an argument per line."""
    words = [*(first or []), *(f"{key}={value!r}" for key, value in given.items()), *(last or [])]
    return f"{start}(\n" + "".join(f"    {word},\n" for word in words) + ")\n"
