"""Effect of errors of the oil's data on friction, with heat and without.

Friction goes nearly as the viscosity under the contact's pressure, which grows exponentially with
alpha: it is computed anew, by the laws of :mod:`ehlwave.laws.heat_laws`, at the ends of all errors.
"""

from collections.abc import Callable
from dataclasses import replace

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.data_errors import EYRING_ERROR, OIL_ERRORS, film_change
from ehlwave.duals import to_float
from ehlwave.laws.sheared_film import Sliding


def error_by_data(
    conditions: Conditions,
    case: Sliding,
    friction: Callable[[Sliding, float], float],
    conductivity_error: float = 0.0,
) -> float:
    """Return by how much friction changes, relative, where the oil's data change by their errors.

    Errors of viscosity, pressure-viscosity coefficient, Eyring stress and conductivity, each at
    both ends. Factors that raise friction multiply; so do factors that lower it. The film changes
    as by the film formula.

    Parameters
    ----------
    conditions : Conditions
        With the errors of the first three, as they were given.
    case : Sliding
        The film.
    friction : callable
        Friction coefficient of a film whose oil has a conductivity times the second argument.
    conductivity_error : float
        Relative.
    """
    given = dict(conditions.given)
    errors = [to_float(given.get(key, 0.0)) for key in (*OIL_ERRORS, EYRING_ERROR)]
    errors.append(conductivity_error)
    if not any(errors):
        return 0.0
    start, most, least = friction(case, 1.0), 1.0, 1.0
    for place, error in enumerate(errors):
        if error:
            ends = []
            for end in (1 - error, 1 + error):
                *oil, k = (end if place == i else 1.0 for i in range(len(errors)))
                ends.append(friction(_changed(conditions, case, *oil), k) / start)
            most, least = most * max(1.0, *ends), least * min(1.0, *ends)
    return max(most - 1, 1 - least)


def _changed(
    conditions: Conditions, case: Sliding, eta: float, alpha: float, eyring: float
) -> Sliding:
    """Return a film whose oil has eta0, alpha and Eyring stress times factors."""
    c = conditions
    return replace(
        case,
        viscosity_pa_s=case.viscosity_pa_s * eta,
        pressure_viscosity_per_pa=case.pressure_viscosity_per_pa * alpha,
        eyring_stress_pa=case.eyring_stress_pa * eyring,
        film_m=case.film_m * film_change(c.m, c.l, c.d, eta, alpha),
    )
