"""M, L and D of dimensional data; of line contacts: :mod:`ehlwave.contact.line_contact`.

Equation numbers refer to ``src/theory.md``.
"""

from collections.abc import Mapping

from ehlwave.contact.line_contact import LOAD_KEY, line_values
from ehlwave.contact.oils import Oil
from ehlwave.contact.scales import ellipticity, second_integral
from ehlwave.duals import math, valued
from ehlwave.errors import SurfaceError, see

DIMENSIONAL_KEYS = (
    "radius_x_m",
    "radius_y_m",
    "reduced_modulus_pa",
    "load_n",
    "mean_speed_m_per_s",
    "viscosity_pa_s",
)

SMALLEST_RADIUS_RATIO = 0.005

ROUND_OFF = 1e-12
"""Relative: D of equal radii is 1 but for it."""


def moes_values(values: Mapping[str, float], place: str) -> dict[str, float]:
    """Return M, L, D and the semi-axis a, m, that dimensional data give, eq. (1) and (2)."""
    alpha = values.get("pressure_viscosity_per_pa", Oil.pressure_viscosity_per_pa)
    if LOAD_KEY in values:
        return line_values(values, alpha)
    radius_x, radius_y, modulus, load, speed, viscosity = (values[key] for key in DIMENSIONAL_KEYS)
    speed_2u = viscosity * 2 * speed / (modulus * radius_x)
    load_w = load / (modulus * radius_x**2)
    d = checked_ratio(
        radius_x / radius_y, f"{place}: radius_x_m = {radius_x:g} and radius_y_m = {radius_y:g}"
    )
    kappa = ellipticity(d)
    radius = 1 / (1 / radius_x + 1 / radius_y)
    e = second_integral(kappa)
    return {
        "load_parameter_m": load_w * speed_2u**-0.75,
        "lubricant_parameter_l": alpha * modulus * speed_2u**0.25,
        "radius_ratio_d": d,
        "semi_axis_a_m": (3 * load * radius / modulus * 2 * kappa * e / math.pi) ** (1 / 3),
    }


def checked_ratio(d: float, given: str) -> float:
    """Return D, 1 where radii are equal up to round-off; refuse values out of range."""
    if abs(d - 1) <= ROUND_OFF:
        return d - valued(d - 1)
    if d != 0 and not SMALLEST_RADIUS_RATIO <= d <= 1:
        raise SurfaceError(
            f"{given}: D = Rx/Ry = {d:.10g} must lie in {SMALLEST_RADIUS_RATIO} to 1, or be 0 "
            "(line contact); for Rx > Ry the contact is wider along rolling, which is outside the "
            f"model's range{see('keys')}"
        )
    return d
