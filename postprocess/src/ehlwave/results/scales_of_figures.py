"""Widths of figures, and scales of maps: equal along both axes, unless the map becomes a sliver."""

COLUMN = 5.6
"""Width of figures with two panels in a row, inches: labels have 5 pt in a column of 87 mm."""

LINE_COLUMN = 4.4
"""Width of figures with a single panel in a row, inches."""

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
