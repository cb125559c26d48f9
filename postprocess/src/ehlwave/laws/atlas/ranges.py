"""The ranges that the atlas covers."""

CONTACT_RANGES = {
    "load_parameter_m": (20.0, 2000.0),
    "lubricant_parameter_l": (2.0, 20.0),
    "radius_ratio_d": (0.04, 1.0),
    "pressure_viscosity_per_pa": (1e-8, 3e-8),
    "roelands_index": (0.4, 0.8),
}
"""Smallest and largest value of each key of a contact."""

WIDE_RANGES = CONTACT_RANGES | {
    "load_parameter_m": (5.0, 100000.0),
    "lubricant_parameter_l": (2.0, 42.0),
    "radius_ratio_d": (0.01, 1.0),
}
"""Wider ranges of rolling contacts, such as ball bearings."""

THINNEST_FILM, THICKEST_FILM = 0.0015, 2.5
"""H of the formula, film over Hertz approach, in the wider ranges: thinner films have steep inlets,
thicker films hardly deform bodies.
"""

LARGEST_ALPHABAR = 160.0
"""Alpha times the Hertz pressure, beyond them: oils of more hardly flow."""

LARGEST_PRESSURE_PA = 1e10
"""Largest Hertz pressure of the wider ranges: above any contact."""

WAVE_RANGE = (0.1, 4.0)
"""Wavelength along the wave vector over a; directions are all there are."""

LARGEST_LINE_ALPHABAR = 500.0
"""Largest alphabar of line contacts."""

LINE_RANGES = {
    "load_parameter_m": (0.4, 2000.0),
    "lubricant_parameter_l": (2.0, 36.0),
    "pressure_viscosity_per_pa": CONTACT_RANGES["pressure_viscosity_per_pa"],
    "roelands_index": CONTACT_RANGES["roelands_index"],
}
"""Ranges of line contacts, whose M is defined by a load per length."""

SLIDING_RANGES = CONTACT_RANGES | {
    "slip_parameter": (0.5, 1.5),
    "stress_modulus_pa2": (1.936e17, 9.68e18),
}
"""Ranges of sliding contacts with a Ree-Eyring oil: also S of the rough surface, E' tau0.

The latter alone counts of both: 0.88 to 44 MPa between steel bodies.
"""

SLIDING_WIDE_RANGES = WIDE_RANGES | {
    "load_parameter_m": (5.0, 10000.0),
    "lubricant_parameter_l": CONTACT_RANGES["lubricant_parameter_l"],
    "slip_parameter": (0.0, 2.0),
    "stress_modulus_pa2": (1.936e16, 9.68e19),
}
"""Wider ranges of sliding contacts: E' tau0 ten times as far on either side."""

MOST_THINNING, THINNEST_SLIDING_FILM = 100.0, 0.004
"""Newtonian shear stress in the inlet over the Eyring stress, T, and H (1 + T)^(-1/4), about the
film under slip over the Hertz approach, beyond them: others have inlets too steep."""
