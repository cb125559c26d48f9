"""Effect of errors of the oil's data on friction without heat."""

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.scales import moes_per_film
from ehlwave.duals import to_float
from ehlwave.laws.friction_error import error_by_data
from ehlwave.laws.heat_laws import COLD_BAR, friction_factor
from ehlwave.laws.sheared_film import Sliding, shear_isothermal


def isothermal_error_by_data(
    conditions: Conditions, film_moes: float, eyring_stress_pa: float
) -> float:
    """Return the effect of errors of the oil's data on friction without heat, relative.

    `film_moes`: the central film in the Moes scale.

    Friction depends on the rate eta0 u/h, not on the size: Rx = 1 m, eta0 = 1 Pa s represent any,
    with u and h by M, L and D: 2U = (L/(alpha E'))^4 = 2 eta0 u/(E' Rx), h = H Rx (2U)^(1/2).
    """
    oil = conditions.oil
    modulus = to_float(oil.stress_modulus_pa2 or 0.0) / eyring_stress_pa
    speed_2u = (conditions.l / (oil.pressure_viscosity_per_pa * modulus)) ** 4
    case = Sliding(
        hertz_pa=conditions.hertz_pa,
        semi_axis_a_m=1.0,
        film_m=film_moes * speed_2u**0.5,
        mean_speed_m_per_s=speed_2u * modulus / 2,
        slide_to_roll_ratio=conditions.slide_to_roll_ratio,
        viscosity_pa_s=1.0,
        pressure_viscosity_per_pa=oil.pressure_viscosity_per_pa,
        roelands_index=oil.roelands_index,
        eyring_stress_pa=eyring_stress_pa,
        is_line=conditions.is_line,
    )
    c = conditions
    per_film = moes_per_film(c.m, c.kappa)

    def friction(one: Sliding, _: float) -> float:
        found, over_c = shear_isothermal(one), film_moes / per_film * one.film_m / case.film_m
        stress = found.friction * one.hertz_pa / one.eyring_stress_pa
        ratio = one.slide_to_roll_ratio
        return found.friction * to_float(friction_factor(over_c, c.is_line, stress, 0.0, ratio))

    # A ratio of two frictions, each within the bar of the law.
    return (1 + 2 * COLD_BAR) * error_by_data(conditions, case, friction)
