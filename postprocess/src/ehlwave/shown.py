"""How objects show themselves: a line of text, a table in notebooks; never their arrays."""

import math
import re
from collections.abc import Mapping
from html import escape

PLAIN = 0.995
"""Share from which two digits would be an exponent."""


def html_table(title: str, rows: Mapping[str, str]) -> str:
    """Return a title and rows of names and texts as HTML."""
    cells = "".join(
        f"<tr><th style='text-align:left'>{escape(name)}</th>"
        f"<td style='text-align:left'>{escape(text)}</td></tr>"
        for name, text in rows.items()
    )
    return f"<div><strong>{escape(title)}</strong><table>{cells}</table></div>"


class Shown:
    """Displays the rows of ``_shown_rows``."""

    def _shown_rows(self) -> dict[str, str]:
        """Return the rows to show, short texts by their names."""
        raise NotImplementedError

    def __repr__(self) -> str:
        """Return the rows in a single line."""
        inside = "; ".join(f"{name}: {text}" for name, text in self._shown_rows().items())
        return f"<{type(self).__name__} {inside}>"

    def _repr_html_(self) -> str:
        """Return the rows as a table, for notebooks."""
        return html_table(type(self).__name__, self._shown_rows())


def split_words(name: str) -> str:
    """Return the words of a name such as DeepGrooveBallBearing."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).lower()


def micrometres(length_m: float | None) -> str:
    """Return a length in um, or that it is not known."""
    return "not known" if length_m is None else f"{length_m * 1e6:.4g} um"


def percent(share: float) -> str:
    """Return a share with two digits, from 100 % on without a fraction: "3.4 %", "115 %"."""
    return f"{100 * share:.2g} %" if abs(share) < PLAIN else f"{100 * share:.0f} %"


def within(value: float, error: float | None, unit: str = "") -> str:
    """Return a number with its relative error, where it is known."""
    said = f"{value:.4g}{unit}"
    return said if error is None else f"{said} {spread_of(value, error, unit)}"


def spread_of(value: float, error: float, unit: str = "") -> str:
    """Return the relative error of a number in words: see :func:`spread`."""
    return spread(error, f"{value * (1 + error):.2g}{unit}")


def spread(error: float, most: str) -> str:
    """Return a relative error in words, from 100 % on as the range up to `most`.

    Examples
    --------
    >>> spread(0.35, "0.27 um")
    'within 35 %'
    >>> spread(1.11, "2.1 um")
    '(0 to 2.1 um: error 111 %)'
    """
    if abs(error) < PLAIN or not math.isfinite(error):
        return f"within {percent(error)}"
    return f"(0 to {most}: error {percent(error)})"
