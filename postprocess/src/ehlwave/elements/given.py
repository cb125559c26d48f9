"""Checks of the input for an element: numbers in SI, above a bound, of a pair."""

from typing import Any

from ehlwave.errors import SurfaceError
from ehlwave.quantities import number, plain


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
