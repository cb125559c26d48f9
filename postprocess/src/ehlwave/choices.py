"""Words that options and arguments take, in one place that needs the standard library alone."""

from typing import Literal

Form = Literal["none", "mean", "plane", "quadratic"]
FORMS: dict[Form, int | None] = {"none": None, "mean": 0, "plane": 1, "quadratic": 2}
"""Polynomials to remove from a surface, by their total degree."""

Window = Literal["none", "taper", "mirror"]
WINDOWS: tuple[Window, ...] = ("mirror", "taper", "none")
"""Treatments of the ends of a surface."""

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

REPLICATES, SEED = 1000, 20000
"""Samples of the bootstrap, and the seed of its random numbers."""

TRACTION_RATIOS = (
    *(0.0002, 0.0006, 0.002, 0.005, 0.01, 0.02, 0.035, 0.06, 0.1),
    *(0.16, 0.25, 0.4, 0.6, 0.9, 1.3, 1.8),
)
"""Slide-to-roll ratios of ``ehlwave traction``."""
