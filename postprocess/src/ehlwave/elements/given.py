"""Checks of the input for an element: numbers in SI, above a bound, of a pair."""

import inspect
import math
from collections.abc import Callable, Collection, Iterable
from typing import Any

from ehlwave.errors import SurfaceError, did_you_mean
from ehlwave.quantities import number, plain

RADIANS = 0.8
"""Angles of elements in degrees lie above; 45 degrees are 0.79 in radians."""


def check_names(given: Iterable[str], known: Collection[str], place: str) -> None:
    """Refuse names of arguments that a call does not take.

    Parameters
    ----------
    given, known : iterable of str
        Names given, and names that the call takes.
    place : str
        Name of the element.
    """
    for name in given:
        if name not in known:
            near = did_you_mean(name, known) or f": give one of {', '.join(known)}"
            raise SurfaceError(f"{place}: unknown {name}{near}")


def loads_of(load_zone: Callable[..., Any]) -> list[str]:
    """Return the names of the loads that a bearing takes."""
    return [name for name in inspect.signature(load_zone).parameters if "speed" not in name]


def above(value: Any, name: str, place: str, least: float = 0.0, example: str = "") -> float:  # noqa: ANN401
    """Return a number in SI that must lie above a bound.

    Parameters
    ----------
    value : object
        Plain, or with a unit.
    name, place : str
        Of the argument, and of the element.
    least : float
        The bound.
    example : str
        A value that works.

    Raises
    ------
    SurfaceError
        If it is no number, or not above the bound.
    """
    found = number(value, name, place)
    if not found > least:
        such = f", such as {example}" if example and float(example) > least else ""
        raise SurfaceError(f"{place}: {name} = {value} must be above {least:g}{such}")
    return found


def at_least(value: Any, name: str, place: str, least: float = 0.0) -> float:  # noqa: ANN401
    """Return a number in SI that must not lie below a bound.

    Parameters
    ----------
    value, name, place, least
        As of :func:`above`.
    """
    found = number(value, name, place)
    if found < least:
        raise SurfaceError(f"{place}: {name} = {value} must be at least {least:g}")
    return found


def count(value: Any, name: str, place: str, least: int = 1) -> int:  # noqa: ANN401
    """Return a whole number.

    Parameters
    ----------
    value, name, place, least
        As of :func:`above`.
    """
    found = number(value, name, place)
    if found != int(found) or found < least:
        raise SurfaceError(f"{place}: {name} = {value} must be a whole number of at least {least}")
    return int(found)


def elements_of(
    kind: str,
    diameter: Any,  # noqa: ANN401
    pitch: Any,  # noqa: ANN401
    number_of: Any,  # noqa: ANN401
    place: str,
) -> tuple[float, float, int]:
    """Return diameter, pitch diameter and number of balls or rollers, which fit on their circle.

    Parameters
    ----------
    kind : {"ball", "roller"}
        Name of an element.
    diameter, pitch, number_of, place
        As given, and the name of the bearing, for messages.
    """
    d = above(diameter, f"{kind}_diameter_m", place, example="0.012")
    circle = above(pitch, "pitch_diameter_m", place, d, example="0.06")
    elements = count(number_of, f"{kind}s", place, 3)
    most = math.pi / math.asin(d / circle)  # touching elements are chords of their circle
    if elements > most * (1 + 1e-12):
        raise SurfaceError(
            f"{place}: {kind}s = {elements} of {kind}_diameter_m = {d:g} do not fit on "
            f"pitch_diameter_m = {circle:g}: give fewer"
        )
    return d, circle, elements


def pair(value: Any, name: str, place: str) -> tuple[float, float]:  # noqa: ANN401
    """Return two numbers in SI; a single number applies to both.

    Parameters
    ----------
    value, name, place
        As of :func:`above`.
    """
    both = plain(value, name)
    if isinstance(both, (int, float)):
        both = (both, both)
    try:
        first, second = both
    except (TypeError, ValueError):
        raise SurfaceError(f"{place}: {name} = {value!r:.60}: give two numbers") from None
    return number(first, name, place), number(second, name, place)


def clearance_of(value: Any, element_diameter_m: float, place: str) -> float:  # noqa: ANN401
    """Return a radial internal clearance, of the diameter, in SI.

    Parameters
    ----------
    value : object
        Plain, or with a unit.
    element_diameter_m : float
        Of balls or rollers; catalogues have clearances of at most a few per cent of it.
    place : str
        Name of the element, for messages.
    """
    found = at_least(value, "clearance_m", place, -1e-4)
    if found > element_diameter_m / 10:
        raise SurfaceError(
            f"{place}: clearance_m = {found:g} is above a tenth of the diameter of an element, "
            f"{element_diameter_m / 10:.3g} m: give it in m, such as 1e-5"
        )
    return found
