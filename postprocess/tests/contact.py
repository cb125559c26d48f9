"""Contacts of the tests: the paper's experiment (its Table 1), and a ball on a disc."""

from ehlwave.surface import Conditions, conditions_from_keys

EXPERIMENT = {
    "radius_x_m": 12.52e-3,
    "radius_y_m": 12.52e-3,
    "reduced_modulus_pa": 1.17e11,
    "load_n": 39.2,
    "mean_speed_m_per_s": 0.024,
    "viscosity_pa_s": 1.22,
    "pressure_viscosity_per_pa": 2.25e-8,
}

BALL = {
    "radius_x_m": 0.0127,
    "radius_y_m": 0.0127,
    "reduced_modulus_pa": 2.26e11,
    "load_n": 40,
    "mean_speed_m_per_s": 4,
    "viscosity_pa_s": 0.05,
}
"""A steel ball on a steel disc."""

LOADED_BALL = BALL | {"load_n": 120}

SLIDING_ELLIPSE = {
    "radius_x_m": 0.0127,
    "radius_y_m": 0.0254,
    "reduced_modulus_pa": 2.26e11,
    "load_n": 40,
    "mean_speed_m_per_s": 1.5,
    "viscosity_pa_s": 0.05,
    "pressure_viscosity_per_pa": 2e-8,
    "eyring_stress_pa": 5e6,
    "slide_to_roll_ratio": 0.1,
}
"""An elliptical contact under slip in a Ree-Eyring oil."""


def experiment(**changes: float) -> Conditions:
    """Return its conditions, some keys changed."""
    return conditions_from_keys(EXPERIMENT | changes)
