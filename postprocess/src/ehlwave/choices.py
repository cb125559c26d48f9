"""Words that options and arguments take, and their check: needs the standard library alone."""

from collections.abc import Iterable
from typing import Any, Literal

from ehlwave.errors import SurfaceError, did_you_mean

Form = Literal["none", "mean", "plane", "quadratic"]
FORMS: dict[Form, int | None] = {"none": None, "mean": 0, "plane": 1, "quadratic": 2}
"""Polynomials to remove from a surface, by their total degree."""
FORM: Form = "plane"
"""The one that commands remove."""

Axis = Literal["x", "y"]
AXES: tuple[Axis, ...] = ("x", "y")
"""Directions of a trace, and of rolling in a file."""

LAWS = ("table", "atlas", "starved", "two-waves", "computed", "recommended", "paper")
"""Laws that judge the components of a surface, by their names."""

FILM_BY = ("laws", "computed")
"""Values of ``by`` for films: nothing is computed, or the program answers."""

HOW = ("laws",)
"""Further values of ``by``: the first law that holds, and nothing is computed."""

Window = Literal["none", "taper", "mirror"]
WINDOWS: tuple[Window, ...] = ("mirror", "taper", "none")
"""Treatments of the ends of a surface; commands take the first."""

Decimal = Literal["point", "comma"]
DECIMALS: tuple[Decimal, ...] = ("point", "comma")
"""Marks that decimals of a text file begin with."""

Ratio = Literal["fit", "sampled", "harmonic"]
RATIO_COLUMNS: dict[Ratio, str] = {
    "fit": "amplitude_ratio_fit",
    "sampled": "amplitude_ratio",
    "harmonic": "harmonic_extrapolated",
}
"""Columns of results that Ad/Ai is taken from."""

POISSON_RATIO = 0.3
"""Steel: the default of bodies."""

REPLICATES, SEED = 1000, 20000
"""Samples of the bootstrap, and the seed of its random numbers."""

TRACTION_RATIOS = (
    *(0.0002, 0.0006, 0.002, 0.005, 0.01, 0.02, 0.035, 0.06, 0.1),
    *(0.16, 0.25, 0.4, 0.6, 0.9, 1.3, 1.8),
)
"""Slide-to-roll ratios of ``ehlwave traction``."""

STRIBECK_SHARES = (0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95)
"""Shares of the load on the solids of ``ehlwave stribeck``."""
STRIBECK_FACTORS = (1.1, 1.3, 1.7, 2.5, 4.0, 10.0)
"""Speeds over the speed at the smallest of these shares."""


def chosen_or_none(word: Any, name: str, known: Iterable[str]) -> None:  # noqa: ANN401
    """Check a word that an argument takes, or None."""
    if word is not None:
        chosen(word, name, known)


def chosen(word: Any, name: str, known: Iterable[str], place: str = "", more: str = "") -> str:  # noqa: ANN401
    """Return a word that an argument takes.

    Raises SurfaceError with the words that there are; `more` ends the message.
    """
    words = list(known)
    if isinstance(word, str) and word in words:
        return word
    near = did_you_mean(word.lower(), words) if isinstance(word, str) else ""
    start = f"{place}: " if place else ""
    raise SurfaceError(
        f"{start}{name} = {word!r}{near}: give one of {', '.join(map(repr, words))}{more}"
    )
