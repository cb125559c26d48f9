"""Hertz contacts in closed form: semi-axes, pressure and approach of points, pressure of lines.

Sources: Hertz (1882); Johnson, *Contact Mechanics* (1985), sections 4.1 and 4.2; the elliptic
integrals come from :mod:`ehlwave.contact.scales`. E' is 2/((1 - nu1^2)/E1 + (1 - nu2^2)/E2), twice
the E* of Johnson.
"""

import math
from dataclasses import dataclass

from ehlwave.contact.bodies import Body
from ehlwave.contact.scales import ellipticity, first_integral, integral_combinations


def reduced_modulus(first: Body, second: Body) -> float:
    """Return E' of two bodies, Pa.

    Examples
    --------
    >>> import ehlwave
    >>> from ehlwave.elements.hertz import reduced_modulus
    >>> steel = ehlwave.Body(elastic_modulus_pa=2.1e11, poisson_ratio=0.3)
    >>> print(f"{reduced_modulus(steel, steel) / 1e9:.1f} GPa")
    230.8 GPa
    """
    soft = sum(
        (1 - (body.poisson_ratio or 0) ** 2) / float(body.elastic_modulus_pa or math.nan)
        for body in (first, second)
    )
    return 2 / soft


def reduced_radius(first_m: float, second_m: float) -> float:
    """Return 1/(1/R1 + 1/R2), infinite for two flat directions."""
    curvature = 1 / first_m + 1 / second_m
    return 1 / curvature if curvature != 0 else math.inf


@dataclass(frozen=True)
class HertzPoint:
    """Elliptical contact of a load.

    Attributes
    ----------
    semi_axis_x_m, semi_axis_y_m : float
        Along rolling, and across.
    pressure_pa : float
        Largest pressure.
    approach_m : float
        Approach of the bodies far from the contact.
    """

    semi_axis_x_m: float
    semi_axis_y_m: float
    pressure_pa: float
    approach_m: float


def hertz_point(
    load_n: float, radius_x_m: float, radius_y_m: float, reduced_modulus_pa: float
) -> HertzPoint:
    """Return the Hertz contact of reduced radii, either the larger one.

    With kappa = a/b of the short and the long semi-axis, K the first elliptic integral of
    parameter 1 - kappa^2 and B = (E - kappa^2 K)/(1 - kappa^2):

    a^3 = 6 B' kappa W R_a/(pi E'), where B' = B and 1/R_a is the curvature along a;
    the approach is 3 W K/(pi E' b).

    Parameters
    ----------
    load_n, radius_x_m, radius_y_m, reduced_modulus_pa : float
        Load, reduced radii along and across rolling, and E'.

    Examples
    --------
    Two steel balls of 20 and 30 mm diameter at 5 N:

    >>> from ehlwave.elements.hertz import hertz_point
    >>> found = hertz_point(5, 0.006, 0.006, 2.1e11 / 0.91)
    >>> print(f"a = {found.semi_axis_x_m * 1e6:.1f} um, {found.pressure_pa / 1e6:.0f} MPa")
    a = 58.0 um, 710 MPa
    """
    short_m, long_m = min(radius_x_m, radius_y_m), max(radius_x_m, radius_y_m)
    kappa = ellipticity(short_m / long_m)
    _, b_integral = integral_combinations(kappa)
    k = first_integral(kappa)
    short = (6 * b_integral * kappa * load_n * short_m / (math.pi * reduced_modulus_pa)) ** (1 / 3)
    long = short / kappa
    axes = (short, long) if radius_x_m <= radius_y_m else (long, short)
    return HertzPoint(
        *axes,
        pressure_pa=1.5 * load_n / (math.pi * short * long),
        approach_m=3 * load_n * k / (math.pi * reduced_modulus_pa * long),
    )


def hertz_line(
    load_n_per_m: float, radius_m: float, reduced_modulus_pa: float
) -> tuple[float, float]:
    """Return half width, m, and largest pressure, Pa, of a line contact.

    Parameters
    ----------
    load_n_per_m, radius_m, reduced_modulus_pa : float
        Load per length, reduced radius, and E'.

    Examples
    --------
    >>> from ehlwave.elements.hertz import hertz_line
    >>> half_width, pressure = hertz_line(3e5, 6.4e-3, 2.3077e11)
    >>> print(f"{half_width * 1e6:.1f} um, {pressure / 1e9:.3f} GPa")
    145.6 um, 1.312 GPa
    """
    half = math.sqrt(8 * load_n_per_m * radius_m / (math.pi * reduced_modulus_pa))
    return half, 2 * load_n_per_m / (math.pi * half)
