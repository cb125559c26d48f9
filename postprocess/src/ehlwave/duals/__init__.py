"""Numbers with derivatives, and numpy and math for both: laws are written once.

Laws take ``np`` and ``math`` from here. With plain numbers they are numpy and math themselves; with
:class:`Dual` they carry derivatives along.

Examples
--------
The power of the speed in Ad/Ai, d ln(Ad/Ai)/d ln(speed):

>>> import ehlwave
>>> from ehlwave.duals import log_slopes, seeded
>>> given = {"radius_x_m": 0.0127, "radius_y_m": 0.0127, "reduced_modulus_pa": 2.26e11,
...     "load_n": 40.0, "mean_speed_m_per_s": 4.0, "viscosity_pa_s": 0.05}
>>> contact = ehlwave.Contact(**given | seeded({"mean_speed_m_per_s": 4.0}))
>>> ratio = abs(contact.response(wavelength_over_a=1, by="laws").film)
>>> print(f"{log_slopes(ratio, 1)[0]:.2f}")
0.08
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
