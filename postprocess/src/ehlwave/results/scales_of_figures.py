"""Widths of figures, and scales of maps: equal along both axes, unless the map becomes a sliver."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axis import Axis

COLUMN = 4.4
"""Width of figures for a printed column, inches: labels of 8 pt have 6 pt in a column of 84 mm."""

PAGE = 9.0
"""Largest width of other figures, inches: labels of 8 pt have 6 pt on a page of 174 mm."""

STEPS = (1, 1.5, 2, 3, 4, 5, 7)
"""Labelled multiples of powers of ten on short logarithmic axes."""

SLENDER = 2.0
"""Longest side over the other, up to which both axes have one scale."""

DRAWN = 1.5
"""Longest side over the other of maps that are more slender."""


def readable_aspect(width: float, height: float) -> float:
    """Return the ratio of the drawn lengths of units of y and x; 1 unless a map is slender."""
    if not (width > 0 and height > 0):
        return 1.0
    ratio = height / width
    if 1 / SLENDER <= ratio <= SLENDER:
        return 1.0
    return (DRAWN if ratio > 1 else 1 / DRAWN) / ratio


def aspect_note(width: float, height: float) -> str:
    """Return the note beside the axis of y where it has another scale."""
    found = readable_aspect(width, height)
    if found == 1:
        return ""
    return f", compressed {1 / found:.2g} times" if found < 1 else f", stretched {found:.2g} times"


def plain_numbers(axis: "Axis") -> None:
    """Label a logarithmic axis by plain numbers, more of them over less than a decade."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator(subs=STEPS if high < 10 * low else (1, 2, 5)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())
