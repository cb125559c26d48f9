"""Films of rolling line contacts whose load is too small to deform their bodies.

Reynolds' equation between a parabola and a plane, with the boundary condition of Swift and Stieber
(Martin 1916 of constant viscosity: H = 2.446/M). With the reduced pressure q, dq = dp eta0/eta, the
profile of q is that of constant viscosity, whatever Roelands' law makes of it:
alpha q = L Q(xi)/(sqrt(2) H^(3/2)), and M = sqrt(2 H)/L times the integral of alpha p over
xi = x/sqrt(2 R h).
"""

import math
from functools import cache

import numpy as np
import scipy
from numpy.typing import NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.oils import log_viscosity
from ehlwave.contact.scales import moes_per_film
from ehlwave.laws.atlas.chart import SmoothFilm
from ehlwave.laws.atlas.ranges import LINE_RANGES

Floats = NDArray[np.float64]

SOURCE = "Reynolds' equation between rigid bodies"
LOWEST_M, HIGHEST_M = 0.02, LINE_RANGES["load_parameter_m"][0]
"""M from which bodies count as rigid: the range ends where the atlas begins."""
OUTLET = 0.4753868
"""xi where the film ruptures, Swift and Stieber."""
PLACES, PRESSURES, LARGEST_ALPHA_P = 1001, 2001, 200.0
DEFORMED, ERROR, ERROR_BY_DEFORMATION = 0.6, 0.015, 0.4
"""Growth of the film by deformation, times the Hertz approach over the film; error of the film, and
its part in this growth. All three were set on 15 contacts of ehlwave-case, M = 0.06 to 0.4 and
L = 2 to 20; 54 drawn afresh, M = 0.02 to 0.4 and L = 2 to 25, are within 0.21 times the error.
"""


def is_rigid(conditions: Conditions) -> bool:
    """Return whether a contact is a flooded line of Roelands' oil too light for the atlas."""
    c = conditions
    is_light = c.is_line and LOWEST_M <= c.m < HIGHEST_M
    return is_light and not (c.is_starved or c.oil.other_laws or math.isinf(c.film_loss))


def rigid_film(conditions: Conditions) -> SmoothFilm:
    """Return the films of a contact that :func:`is_rigid` in pure rolling.

    Parameters
    ----------
    conditions : Conditions
        Of the contact.

    Examples
    --------
    The program finds 25.10:

    >>> import ehlwave
    >>> from ehlwave.laws.rigid_lines import rigid_film
    >>> light = ehlwave.Contact(load_parameter_m=0.1, lubricant_parameter_l=8, radius_ratio_d=0)
    >>> print(f"{rigid_film(light.conditions).central_moes:.1f}")
    25.1
    """
    c, alpha = conditions, conditions.oil.pressure_viscosity_per_pa
    profile, weight = _profile()
    alpha_p = np.append(0.0, np.geomspace(1e-6, LARGEST_ALPHA_P, PRESSURES))
    fluidity = np.exp(-log_viscosity(alpha, c.oil.roelands_index, alpha_p / alpha))
    means = (fluidity[1:] + fluidity[:-1]) / 2
    alpha_q = np.append(0.0, np.cumsum(np.diff(alpha_p) * means))

    def load(film: float) -> float:
        found = np.interp(c.l * profile / (math.sqrt(2) * film**1.5), alpha_q, alpha_p)
        return math.sqrt(2 * film) / c.l * float((found * weight).sum())

    martin = 2.44 / c.m  # with constant viscosity, the thinnest film
    film = float(scipy.optimize.brentq(lambda h: load(h) - c.m, martin, 100 * martin))
    deformation = moes_per_film(c.m, c.kappa) / film
    film *= 1 + DEFORMED * deformation
    error = ERROR + ERROR_BY_DEFORMATION * deformation + c.film_loss
    return SmoothFilm(film, film, error, error)


@cache
def _profile() -> tuple[Floats, Floats]:
    """Return Q at places tan(theta) = xi, and the weights of a sum over xi."""
    theta = np.linspace(-math.pi / 2, math.atan(OUTLET), PLACES)[1:]

    def integral(t: Floats) -> Floats:
        fourth = 3 * t / 8 + np.sin(2 * t) / 4 + np.sin(4 * t) / 32
        return np.asarray(t / 2 + np.sin(2 * t) / 4 - (1 + OUTLET**2) * fourth)

    profile = np.maximum(12 * (integral(theta) - integral(np.array(-math.pi / 2))), 0)
    return profile, np.gradient(theta) / np.cos(theta) ** 2
