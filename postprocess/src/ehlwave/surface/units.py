"""Units of length, as names and in headers."""

import re

from ehlwave.errors import SurfaceError
from ehlwave.hints import did_you_mean

METRES = {
    "m": 1.0,
    "mm": 1e-3,
    "um": 1e-6,
    "µm": 1e-6,  # micro sign
    "μm": 1e-6,  # Greek mu
    "Âµm": 1e-6,  # a micro sign in UTF-8 that a reader took for Latin-1
    "micron": 1e-6,
    "nm": 1e-9,
    "pm": 1e-12,
    "inch": 0.0254,
    "in": 0.0254,
}
CHOICES = ("m", "mm", "um", "nm", "inch")


def metres(unit: str, place: str) -> float:
    """Return the length of a unit in metres.

    Raises SurfaceError if the unit is not known.
    """
    known = METRES.get(unit.strip()) if isinstance(unit, str) else None
    if known is None:
        near = did_you_mean(unit.lower(), CHOICES) if isinstance(unit, str) else ""
        raise SurfaceError(
            f"{place}: unknown unit of length {unit!r}{near}; use one of {', '.join(CHOICES)}"
        )
    return known


def unit_in_heading(heading: str) -> str | None:
    """Return the unit in a heading such as ``x [um]``, ``height (nm)``, ``x/mm`` or ``x_m``."""
    found = re.search(r"(?:[\[(/]\s*|_)([A-Za-zµμ]+)\s*[\])]?\s*$", heading.strip())
    if found and found[1] in METRES:
        return found[1]
    return None
