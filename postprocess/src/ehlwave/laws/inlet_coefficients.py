"""The law of warm inlets, eq. (T15): coefficients, errors, and the contacts of the fit.

Made from ``postprocess/record/inlet/law.csv`` by ``python -m studies.inlet_tables``,
with the table of ``ehlwave-case``.
"""

COEFFICIENTS = (
    0.21776,
    0.93042,
    0.94565,
    2.1696,
    6.9248,
    0.81289,
    0.25734,
    -0.28921,
    -0.83828,
    1.8291,
    0.067384,
)
"""Coefficients c1 to c11."""
ERROR_SHARE = (0.17288, 0.47554, 1.0339)
"""Error over the loss and known_loss, by the sliding."""
ERROR_SLIP = (0.2, 1.0)
"""Slide-to-roll ratios |u1 - u2|/ubar above which the next share holds."""
M_RANGE = (2.0, 20000.0)
"""Load parameter M of the contacts of the fit."""
L_RANGE = (2.0, 25.0)
"""Lubricant parameter L."""
FILM_RANGE = (0.0, 1.0)
"""Central film over the Hertz approach."""
LOADING_RANGE = (0.0, 8.0)
"""Thermal loading L_t."""
KNOWN_LOSS = 0.01
"""Smallest loss that is known."""
LOWEST_D = 0.012
"""Smallest D of an elliptical contact."""
LARGEST_SLIDE_ROLL = 1.9
"""Largest |u1 - u2|/ubar."""
USUAL_CONDUCTIVITY = 0.14
"""Conductivity of usual oils, W/(m K)."""
USUAL_BETA = 0.04
"""-d ln(eta)/dT of usual oils, 1/K."""
USUAL_EFFUSIVITY = 13000.0
"""Effusivity (k rho c)^(1/2) of steel, W s^(1/2)/(m2 K)."""
