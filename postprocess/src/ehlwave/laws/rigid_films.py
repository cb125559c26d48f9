"""Films of rolling contacts whose load is too small to deform their bodies.

Reynolds' equation between a paraboloid and a plane; where the film ruptures, the pressure and its
gradient vanish (Swift and Stieber). Of constant viscosity: H = 2.446/M in lines (Martin 1916),
35.0/M^2 in circles (Brewe, Hamrock and Taylor 1979, Trans. ASME 101, 231-239). The reduced pressure
q, dq = dp eta0/eta, has the same profile for any viscosity: alpha q = L Q/(sqrt(2) H^(3/2)). M is
the integral of alpha p over the contact times sqrt(2 H)/L of lines, 2 H/(L sqrt(D)) of ellipses,
see :mod:`ehlwave.laws.rigid_profiles`.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import scipy

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.oils import log_viscosity
from ehlwave.contact.scales import moes_per_film
from ehlwave.duals import Dual, count_of, math, np, root, to_float, valued
from ehlwave.error_bars import bar
from ehlwave.laws.atlas.chart import SmoothFilm
from ehlwave.laws.atlas.coordinates import hertz_film
from ehlwave.laws.atlas.ranges import LINE_RANGES, THICKEST_FILM, WIDE_RANGES
from ehlwave.laws.rigid_profiles import ellipse_profile, line_profile

SOURCE = "Reynolds' equation between rigid bodies"
LOWEST_M, HIGHEST_M = 0.02, LINE_RANGES["load_parameter_m"][0]
"""M from which lines count as rigid: the range ends where the atlas begins."""
LOWEST_ELLIPSE_M = 0.1
HIGHEST_L = WIDE_RANGES["lubricant_parameter_l"][1]
PRESSURES, LARGEST_ALPHA_P = 2001, 200.0


class Deformed(NamedTuple):
    """Growth of the film by deformation, error of the film, and its part in this growth.

    The first and the last times the Hertz approach over the film.
    """

    growth: float
    error: float
    error_by_growth: float


LINE = Deformed(0.6, bar("rigid_films.line"), bar("rigid_films.line_by_growth"))
"""Set on contacts of ehlwave-case, M = 0.06 to 0.4 and L = 2 to 20."""
ELLIPSE = Deformed(0.08, bar("rigid_films.ellipse"), bar("rigid_films.ellipse_by_growth"))
"""Set on contacts of ehlwave-case, D = 0.012 to 1, L = 2 to 42, up to 10 Hertz approaches thick."""


def is_rigid(conditions: Conditions) -> bool:
    """Return whether a contact is flooded, of Roelands' oil, and too light for the atlas."""
    c = conditions
    if c.is_starved or c.oil.other_laws or math.isinf(c.film_loss):
        return False
    if c.is_line:
        return LOWEST_M <= c.m < HIGHEST_M
    if c.l > HIGHEST_L or c.m < LOWEST_ELLIPSE_M:
        return False
    return to_float(hertz_film(c.m, c.l, c.d)) > THICKEST_FILM


def rigid_film(conditions: Conditions) -> SmoothFilm:
    """Return the films of a contact that :func:`is_rigid` in pure rolling.

    Parameters
    ----------
    conditions : Conditions
        Of the contact.

    Examples
    --------
    The program finds 25.10 and 8.34:

    >>> import ehlwave
    >>> from ehlwave.laws.rigid_films import rigid_film
    >>> line = ehlwave.Contact(load_parameter_m=0.1, lubricant_parameter_l=8, radius_ratio_d=0)
    >>> ball = ehlwave.Contact(load_parameter_m=2.125, lubricant_parameter_l=8, radius_ratio_d=1)
    >>> print(", ".join(f"{rigid_film(c.conditions).central_moes:.2f}" for c in (line, ball)))
    25.07, 8.42
    """
    c, alpha = conditions, conditions.oil.pressure_viscosity_per_pa
    q, weights = line_profile() if c.is_line else ellipse_profile(c.d)
    of_shape = LINE if c.is_line else ELLIPSE
    alpha_p = np.append(0.0, np.geomspace(1e-6, LARGEST_ALPHA_P, PRESSURES))
    fluidity = np.exp(-log_viscosity(alpha, c.oil.roelands_index, alpha_p / alpha))
    means = (fluidity[1:] + fluidity[:-1]) / 2
    alpha_q = np.append(0.0, np.cumsum(np.diff(alpha_p) * means))
    rises = np.append(True, np.diff(alpha_q) > 0)  # until the oil hardly flows
    parts = alpha_q[rises], alpha_p[rises], 1 / fluidity[rises]
    pressure = _curve(*parts)

    def load(film: float) -> float:
        found = pressure(np.minimum(c.l * q / (math.sqrt(2) * film**1.5), alpha_q[-1]))
        factor = math.sqrt(2 * film) if c.is_line else 2 * film / math.sqrt(c.d)
        return factor / c.l * to_float((found * weights).sum())

    even = to_float((q * weights).sum()) / c.m  # with constant viscosity, the thinnest film
    thinnest = even if c.is_line else 2 * even**2 / c.d
    film = root(lambda h: load(h) - c.m, 0.99 * thinnest, 100 * thinnest)
    deformation = moes_per_film(c.m, c.kappa) / film
    film *= 1 + of_shape.growth * deformation
    error = of_shape.error + of_shape.error_by_growth * deformation + c.film_loss
    return SmoothFilm(film, film, error, error)


def _curve(x: Any, y: Any, slopes: Any) -> Callable[[Any], Any]:  # noqa: ANN401 - perhaps Duals
    """Return y between points, by a cubic spline with slopes there.

    Where x changes with parameters and y does not, y at a place falls by slope times change.
    """
    plain = scipy.interpolate.CubicHermiteSpline(*map(valued, (x, y, slopes)))
    moves = scipy.interpolate.CubicSpline(x.value, x.slopes, axis=1) if count_of(x) else None

    def curve(at: Any) -> Any:  # noqa: ANN401
        if not isinstance(at, Dual):
            return plain(at)
        moved = at.slopes - (moves(at.value) if moves else 0.0)
        return Dual(plain(at.value), plain(at.value, 1) * moved)

    return curve
