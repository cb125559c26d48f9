"""The contact of the paper's experiment (its Table 1), for the tests of deformed surfaces."""

from ehlwave.deform import Conditions, conditions_from_keys

EXPERIMENT = {
    "radius_x_m": 12.52e-3,
    "radius_y_m": 12.52e-3,
    "reduced_modulus_pa": 1.17e11,
    "load_n": 39.2,
    "mean_speed_m_per_s": 0.024,
    "viscosity_pa_s": 1.22,
    "pressure_viscosity_per_pa": 2.25e-8,
}


def experiment(**changes: float) -> Conditions:
    """Return its conditions, some keys changed."""
    return conditions_from_keys(EXPERIMENT | changes)
