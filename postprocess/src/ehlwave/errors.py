"""The errors a user is meant to see, and their advice: the nearest known word, a manual page."""

import difflib
import re
from collections.abc import Iterable

_UNPRINTABLE = re.compile("[\x00-\x1f\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")
"""Control characters, marks that turn the direction of text, and bytes that are no text."""


def printable(text: str, kept: str = "") -> str:
    r"""Return text with control and unprintable characters as numbers (``\x1b``)."""

    def number(found: re.Match[str]) -> str:
        code = ord(found[0])
        if found[0] in kept:
            return found[0]
        if 0xDC80 <= code <= 0xDCFF:  # a byte of a file name that is not UTF-8
            code -= 0xDC00
        return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}"

    return _UNPRINTABLE.sub(number, text)


MANUAL = "postprocess/manual"
"""The folder of the pages; the site of ``scripts/manual`` has them by the same names."""

PAGES = {
    "atlas": "howto.md#know-what-the-atlas-covers",
    "bodies": "howto.md#enter-two-bodies",
    "keys": "howto.md#enter-a-contact",
    "oil": "howto.md#enter-an-oil-from-its-data-sheet",
    "slip": "howto.md#enter-a-slide-to-roll-ratio",
    "units": "howto.md#enter-units",
}
"""Pages by subject; a test checks that the manual has them."""


def see(topic: str) -> str:
    """Return the end of a message: which page of the manual explains."""
    return f" (manual: {MANUAL}/{PAGES[topic]})"


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Return a question for the nearest known word, in brackets; '' when none is near."""
    near = difflib.get_close_matches(word, list(known), n=1, cutoff=0.6)
    return f" (did you mean {near[0]}?)" if near else ""


class EhlwaveError(Exception):
    """The base of all errors that this package raises on purpose.

    Errors about arguments are also a :class:`ValueError`. The message shows control characters of
    names and files by their numbers.

    Examples
    --------
    >>> import ehlwave
    >>> try:
    ...     ehlwave.Contact(load_parameter_m=100)
    ... except ehlwave.EhlwaveError as error:
    ...     print(type(error).__name__)
    SurfaceError
    """

    def __str__(self) -> str:
        """Return the message."""
        return printable(super().__str__(), kept="\n\t")


class ArgumentError(EhlwaveError, ValueError):
    """An argument of a function makes no sense; the message names it.

    Examples
    --------
    >>> import ehlwave
    >>> try:
    ...     ehlwave.f_of_r(-1)
    ... except ehlwave.ArgumentError as error:
    ...     print(error)
    r is negative
    """


class ResultsError(EhlwaveError):
    """A results file, or its content, cannot be used.

    The message names the file and its problem; the command prints it without a traceback.

    Examples
    --------
    >>> import ehlwave
    >>> try:
    ...     ehlwave.read_results("absent.h5")
    ... except ehlwave.ResultsError as error:
    ...     print(error)
    absent.h5: no such file
    """


class SurfaceError(ResultsError):
    """A measured surface, operating conditions or a harmonic table cannot be used.

    The message names the file or key, its value, and the change needed.

    Examples
    --------
    >>> import ehlwave
    >>> try:
    ...     ehlwave.read_surface("absent.csv")
    ... except ehlwave.SurfaceError as error:
    ...     print(error)
    absent.csv: no such file
    """


class RangeError(ResultsError, ValueError):
    """A value lies outside the computed range; nothing is extrapolated.

    The message names the quantity, its value and the range.

    Examples
    --------
    >>> import ehlwave
    >>> contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10, radius_ratio_d=1)
    >>> try:
    ...     contact.response(wavelength_over_a=9)
    ... except ehlwave.RangeError as error:
    ...     print(error)
    wavelength_over_a = 9 at angle_deg = 0: the law leaves out waves outside 0.1 to 4 a
    """


class OutputError(ResultsError):
    """A file is not written, because something of its name must not be lost.

    The message names it and the action needed.
    """


class ProgramError(ResultsError):
    """A program is missing, or refused its input; the message quotes it.

    Examples
    --------
    >>> import ehlwave
    >>> try:
    ...     ehlwave.Case(wavelength_over_b=1)
    ... except ehlwave.ProgramError as error:
    ...     print(str(error).split(";")[0])
    unknown key wavelength_over_b (did you mean wavelength_over_a?)
    """


class StressError(ResultsError, ValueError):
    """Loads, depths or an oil film cannot be turned into stresses below the surface.

    The message names the argument or file, its value, and the change needed.

    Examples
    --------
    >>> import ehlwave.stress
    >>> try:
    ...     ehlwave.stress.hertz_axis_stress(1e-4, a_m=0, b_m=1e-3)
    ... except ehlwave.StressError as error:
    ...     print(error)
    semi-axes of 0 and 0.001 m: give two lengths above 0
    """


class ExtrapolationWarning(UserWarning):
    """A number is outside the compared range; its error grows with the distance from it.

    Examples
    --------
    A script that must not use extrapolated numbers makes errors of the warnings:

    >>> import warnings
    >>> import numpy as np
    >>> import ehlwave
    >>> contact = ehlwave.Contact(radius_x_m=0.0127, radius_y_m=0.0127, reduced_modulus_pa=2.26e11,
    ...     load_n=40, mean_speed_m_per_s=4, viscosity_pa_s=0.05)
    >>> x = np.arange(0, 2e-3, 2e-6)
    >>> height = 1500e-9 * np.cos(2 * np.pi * x / 1e-4)
    >>> trace = ehlwave.surface.trace_surface(height, step_m=2e-6, axis="x", name="waves")
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("error", ehlwave.ExtrapolationWarning)
    ...     try:
    ...         contact.lambda_ratio(trace)
    ...     except ehlwave.ExtrapolationWarning as warning:
    ...         print("extrapolated")
    extrapolated
    """
