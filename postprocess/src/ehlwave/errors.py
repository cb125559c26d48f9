"""The errors a user is meant to see."""

import re

_UNPRINTABLE = re.compile("[\x00-\x1f\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")
"""Control characters, marks that turn the direction of text, and bytes that are no text."""


def printable(text: str, kept: str = "") -> str:
    r"""Return text with what a terminal would obey, or cannot show, as its number (``\x1b``)."""

    def number(found: re.Match[str]) -> str:
        code = ord(found[0])
        if found[0] in kept:
            return found[0]
        if 0xDC80 <= code <= 0xDCFF:  # a byte of a file name that is not UTF-8
            code -= 0xDC00
        return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}"

    return _UNPRINTABLE.sub(number, text)


class ResultsError(Exception):
    """A results file, or what it holds, cannot be used.

    The message names the file and says what is wrong with it; the command prints it without a
    traceback.
    """


class SurfaceError(ResultsError):
    """A measured surface, operating conditions or a harmonic table cannot be used.

    The message names the file or key, its value, and what to change.
    """


class RangeError(ResultsError, ValueError):
    """What is asked for lies outside what was computed; nothing is extrapolated.

    The message names the quantity, its value and the range.
    """


class OutputError(ResultsError):
    """A file is not written, because something of its name must not be lost.

    The message names it and says what to do.
    """


class ProgramError(ResultsError):
    """A program is not there, or refused its input; the message has what it said."""


class StressError(ResultsError, ValueError):
    """Loads, depths or an oil film cannot be turned into stresses below the surface.

    The message names the argument or file, its value, and what to change.
    """


class ExtrapolationWarning(UserWarning):
    """A number lies beyond what predictions were compared with; its error says by how much."""
