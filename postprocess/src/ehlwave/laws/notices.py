"""Warnings about the answers of laws: a common list for all entry points of the package."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ehlwave.errors import ExtrapolationWarning, RangeError, SurfaceError
from ehlwave.laws.inlet_warming import inlet_warming
from ehlwave.shown import percent

if TYPE_CHECKING:
    from ehlwave.laws.answers import Film
    from ehlwave.laws.asked import Asked

LEAST_LOSS = 0.02
"""Share of the film that the warm inlet must take for a warning; ``ehlwave-case`` has the same."""
LARGE_ERROR = 0.3
"""Relative error above which a printed quantity is named; ``ehlwave-case`` has the same."""


def notices_of(asked: Asked, film: Film) -> list[str]:
    """Return the warnings about the films of a contact.

    Parameters
    ----------
    asked : Asked
        The contact.
    film : Film
        Its answer.
    """
    errors = {
        "central film": film.central_error,
        "smallest film": film.minimum_error,
        "friction": film.friction_error,
    }
    large = [
        f"{name} {percent(error)}"
        for name, error in errors.items()
        if error is not None and error > LARGE_ERROR
    ]
    found = [f"large errors: {', '.join(large)}"] if large else []
    return found + _inlet(asked, film)


def _inlet(asked: Asked, film: Film) -> list[str]:
    """Return the warning of a warm inlet, for contacts without heat data."""
    c = asked.conditions
    if asked.heat is not None or film.central_m is None or c.has_given_film:
        return []
    try:
        warming = inlet_warming(c, film.central_m)
    except (RangeError, SurfaceError):  # M, L and D alone
        return []
    if warming.loss <= LEAST_LOSS:
        return []
    size = f"{percent(warming.loss)} thinner"
    if warming.error is not None:
        size += f" (within {100 * warming.error:.1g} %)"
    else:
        size += " (a rough upper estimate)"
    return [
        f"the inlet would warm by about {warming.rise_k:.2g} K, which makes the film {size}, and "
        "the film is isothermal: give heat data (heat=)"
    ]


def warn(texts: Sequence[str]) -> None:
    """Warn of each text at the line of the user's code."""
    for text in texts:
        warnings.warn(text, ExtrapolationWarning, stacklevel=_callers())


def _callers() -> int:
    """Return the stack level, for a warning, of the line outside this package that led here."""
    level, frame = 1, sys._getframe(1)
    while frame is not None and str(frame.f_globals.get("__name__")).startswith("ehlwave."):
        level, frame = level + 1, frame.f_back  # type: ignore[assignment]
    return level
