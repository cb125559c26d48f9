"""What errors of the oil's data make of friction, with heat and without.

Friction goes nearly as the viscosity under the contact's pressure, which grows exponentially with
alpha: it is computed anew, in an even film under Hertz pressure, at the ends of all errors.
"""

from collections.abc import Callable
from dataclasses import replace

from ehlwave.contact.conditions import DATA_ERRORS, Conditions, film_change
from ehlwave.sheared_film import Sliding, shear_isothermal


def error_by_data(
    conditions: Conditions,
    case: Sliding,
    friction: Callable[[Sliding, float], float],
    conductivity_error: float = 0.0,
) -> float:
    """Return by how much friction changes, relative, where the oil's data change by their errors.

    Those of viscosity, pressure-viscosity coefficient and conductivity, each at both ends; what
    raises friction multiplies, and what lowers it does. The film changes as by the film formula.

    Parameters
    ----------
    conditions : Conditions
        With the errors of the first two, as they were given.
    case : Sliding
        The film.
    friction : callable
        Friction coefficient of a film whose oil has a conductivity times the second argument.
    conductivity_error : float
        Relative.
    """
    given = dict(conditions.given)
    errors = [float(given.get(key, 0.0)) for key in DATA_ERRORS] + [conductivity_error]
    if not any(errors):
        return 0.0
    start, most, least = friction(case, 1.0), 1.0, 1.0
    for place, error in enumerate(errors):
        if error:
            ends = []
            for end in (1 - error, 1 + error):
                eta, alpha, k = (end if place == i else 1.0 for i in range(len(errors)))
                ends.append(friction(_changed(conditions, case, eta, alpha), k) / start)
            most, least = most * max(1.0, *ends), least * min(1.0, *ends)
    return max(most - 1, 1 - least)


def isothermal_error_by_data(
    conditions: Conditions, film_moes: float, eyring_stress_pa: float
) -> float:
    """Return :func:`error_by_data` of a contact without heat, for its central film, Moes.

    Friction depends on the rate eta0 u/h, not on the size: Rx = 1 m, eta0 = 1 Pa s stand for any,
    with u and h by M, L and D: 2U = (L/(alpha E'))^4 = 2 eta0 u/(E' Rx), h = H Rx (2U)^(1/2).
    """
    oil = conditions.oil
    modulus = float(oil.stress_modulus_pa2 or 0.0) / eyring_stress_pa
    speed_2u = (conditions.l / (oil.pressure_viscosity_per_pa * modulus)) ** 4
    case = Sliding(
        hertz_pa=conditions.hertz_pa,
        semi_axis_a_m=1.0,
        film_m=film_moes * speed_2u**0.5,
        mean_speed_m_per_s=speed_2u * modulus / 2,
        slide_to_roll_ratio=2 * (conditions.slip_parameter - 1),
        viscosity_pa_s=1.0,
        pressure_viscosity_per_pa=oil.pressure_viscosity_per_pa,
        roelands_index=oil.roelands_index,
        eyring_stress_pa=eyring_stress_pa,
        is_line=conditions.is_line,
    )
    return error_by_data(conditions, case, lambda one, _: shear_isothermal(one).friction)


def _changed(conditions: Conditions, case: Sliding, eta: float, alpha: float) -> Sliding:
    """Return a film whose oil has eta0 and alpha times factors."""
    c = conditions
    return replace(
        case,
        viscosity_pa_s=case.viscosity_pa_s * eta,
        pressure_viscosity_per_pa=case.pressure_viscosity_per_pa * alpha,
        film_m=case.film_m * film_change(c.m, c.l, c.d, eta, alpha),
    )
