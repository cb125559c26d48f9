"""What the atlas covers."""

CONTACT_RANGES = {
    "load_parameter_m": (20.0, 2000.0),
    "lubricant_parameter_l": (2.0, 20.0),
    "radius_ratio_d": (0.04, 1.0),
    "pressure_viscosity_per_pa": (1e-8, 3e-8),
    "roelands_index": (0.4, 0.8),
}
"""Smallest and largest value of each key of a contact."""

WAVE_RANGE = (0.1, 4.0)
"""Wavelength along the wave vector over a; directions are all there are."""
