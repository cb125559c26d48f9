"""Numbers with derivatives, and numpy and math for both: laws are written once.

Laws take ``np`` and ``math`` from here. With plain numbers they are numpy and math themselves; with
:class:`Dual` they carry derivatives along.
"""

from ehlwave.duals.dual import Dual, count_of, log_slopes, part_of, seeded, valued
from ehlwave.duals.namespaces import implicit, math, np, placed, root, spline, to_complex, to_float

__all__ = [
    "Dual",
    "count_of",
    "implicit",
    "log_slopes",
    "math",
    "np",
    "part_of",
    "placed",
    "root",
    "seeded",
    "spline",
    "to_complex",
    "to_float",
    "valued",
]
