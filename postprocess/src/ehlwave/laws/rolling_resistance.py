"""Rolling resistance of the oil in the inlet: Biboulet and Houpert (2010).

N. Biboulet and L. Houpert, *Hydrodynamic force and moment in pure rolling lubricated contacts*,
Proc. IMechE Part J, 224 (2010): part 1, line contacts, 765-775, formula 42; part 2, point
contacts, 777-787, formula 32. The force acts at each of both surfaces, so that the power is twice
force times mean speed. Flooded, isothermal; fitted from M = 0.2 to 200 (lines) and 800 (points), L
of 4 to 16.
"""

from typing import NamedTuple

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.scales import ellipticity, integral_combinations
from ehlwave.duals import math, to_float
from ehlwave.error_bars import bar

LINE_ERROR, POINT_ERROR = bar("rolling.line"), bar("rolling.point")
"""Relative (theory, after (T14)). A test has computed values."""


class Rolling(NamedTuple):
    """Force that resists rolling at each surface: over the load, in N (lines: N/m), its error."""

    coefficient: float
    force: float
    error: float


def error_of(length_m: float | None) -> float:
    """Return the relative error of the force.

    Parameters
    ----------
    length_m : float or None
        Of a line contact; None: a point.
    """
    return POINT_ERROR if length_m is None else LINE_ERROR


def rolling_force(
    load_n: float,
    radius_x_m: float,
    radius_y_m: float,
    reduced_modulus_pa: float,
    viscosity_pa_s: float,
    mean_speed_m_per_s: float,
    length_m: float | None = None,
) -> float:
    """Return the force that rolling takes at each surface, N.

    Parameters
    ----------
    load_n, radius_x_m, radius_y_m, reduced_modulus_pa, viscosity_pa_s, mean_speed_m_per_s : float
        Load, reduced radii, E', viscosity at ambient pressure, mean speed.
    length_m : float, optional
        Of a line contact.

    Examples
    --------
    >>> from ehlwave.laws.rolling_resistance import rolling_force
    >>> print(f"{rolling_force(600, 4.23e-3, 0.1495, 2.31e11, 0.02, 3.18):.3f} N")
    0.164 N
    """
    speed = 2 * viscosity_pa_s * abs(mean_speed_m_per_s) / (reduced_modulus_pa * radius_x_m)
    if length_m is not None:
        return _line_force(load_n / length_m, radius_x_m, reduced_modulus_pa, speed) * length_m
    kappa = ellipticity(radius_x_m / radius_y_m)
    first, second = integral_combinations(kappa)
    ellipse_e = second + kappa**2 * first  # E of parameter 1 - kappa^2, see contact.scales
    beta = 4 / math.pi * ellipse_e / (1 + radius_x_m / radius_y_m)
    load = load_n / (reduced_modulus_pa * radius_x_m**2)
    half_width = radius_x_m / kappa * (1.5 * kappa * load * beta) ** (1 / 3)
    m = beta**0.25 * kappa * load / speed**0.75
    rigid = 0.77 * beta ** (-1 / 3) * kappa**0.12 * speed ** (-1 / 12)
    elastic = 1.8 * beta**-0.25
    moment = 2 * half_width / radius_x_m * ((rigid - elastic) / (1 + m / 6.6) + elastic)
    return reduced_modulus_pa * radius_x_m**2 * moment * speed**0.75


def _line_force(load_n_per_m: float, radius_m: float, modulus_pa: float, speed: float) -> float:
    """Return the force over the length, N/m: formula 42 of part 1, T times p_h b^2/R."""
    load = load_n_per_m / (modulus_pa * radius_m)
    m = load / math.sqrt(speed)
    t = 1.4 / m / (1 + (1.4 / 1.45 * math.sqrt(m)) ** 10) ** 0.1
    half = radius_m * math.sqrt(8 * load / math.pi)
    pressure = 2 * load_n_per_m / (math.pi * half)
    return t * pressure * half**2 / radius_m


def rolling_of(conditions: Conditions, film_factor: float = 1.0) -> Rolling | None:
    """Return the rolling resistance of a contact; None of starved contacts and of M, L and D.

    Parameters
    ----------
    conditions : Conditions
        Of the contact.
    film_factor : float
        Factor of the warm inlet on the film, which the force follows.
    """
    c, given = conditions, dict(conditions.given)
    if "viscosity_pa_s" not in given or c.is_starved:
        return None
    radius_x = to_float(given["radius_x_m"])
    load = to_float(given["load_n_per_m"] if c.is_line else given["load_n"])
    force = film_factor * rolling_force(
        load,
        radius_x,
        math.inf if c.is_line else radius_x / c.d,
        to_float(given["reduced_modulus_pa"]),
        to_float(given["viscosity_pa_s"]),
        to_float(given["mean_speed_m_per_s"]),
        1.0 if c.is_line else None,
    )
    return Rolling(force / load, force, LINE_ERROR if c.is_line else POINT_ERROR)
