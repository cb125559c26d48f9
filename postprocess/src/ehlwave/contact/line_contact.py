"""Scales of a line contact, D = 0: a the half width, c = a^2/(2 Rx), w the load per length.

M = W (2U)^(-1/2) with W = w/(E' Rx); a^2 = 8 w Rx/(pi E'), ph = 2 w/(pi a); K = 1 replaces the
elliptic integral, gamma = M^(1/2), for which V holds in line contacts (``src/contact/README.md``).
"""

from collections.abc import Mapping

from numpy.typing import ArrayLike, NDArray

from ehlwave.duals import math, np

Floats = NDArray[np.float64]

LOAD_KEY = "load_n_per_m"
LINE_KEYS = ("radius_x_m", "reduced_modulus_pa", LOAD_KEY, "mean_speed_m_per_s", "viscosity_pa_s")

SLENDER_OVER_LINE = (2 * math.pi**3 / 3) / (2 * math.pi) ** 1.5
"""gamma M of slender elliptical contacts over the line contact of equal alphabar and L."""

_SLENDER = "take a slender elliptical contact of equal Hertz pressure (radius_y_m = 25 radius_x_m)"
TRANSVERSE_ALONE = (
    "a line contact answers for transverse waves alone (angle_deg = 0, traces along rolling): for "
    f"others {_SLENDER}"
)
ROLLS_ALONE = (
    "a line contact answers in pure rolling (equal speeds, slip_parameter = 1, "
    "slide_to_roll_ratio = 0), and under slip with a Newtonian or Ree-Eyring oil alone: with a "
    f"Carreau oil compute it (ehlwave.Case, ehlwave-case), or {_SLENDER}"
)
"""Advice in refusals of line contacts."""


def line_values(values: Mapping[str, float], alpha: float) -> dict[str, float]:
    """Return M, L, D and the half width a, m, that dimensional data give."""
    radius, modulus, load, speed, viscosity = (values[key] for key in LINE_KEYS)
    speed_2u = viscosity * 2 * speed / (modulus * radius)
    return {
        "load_parameter_m": load / (modulus * radius) * speed_2u**-0.5,
        "lubricant_parameter_l": alpha * modulus * speed_2u**0.25,
        "radius_ratio_d": 0.0,
        "semi_axis_a_m": math.sqrt(8 * load * radius / (math.pi * modulus)),
    }


def line_alphabar(m: ArrayLike, l: ArrayLike) -> Floats:  # noqa: E741
    """Return alpha ph = L (M/(2 pi))^(1/2)."""
    return np.asarray(l * np.sqrt(np.asarray(m) / (2 * math.pi)))


def line_lambdabar(m: float) -> float:
    """Return the speed parameter, 3 pi^2/(2 M^2)."""
    return 1.5 * (math.pi / m) ** 2


def moes_per_line_film(m: ArrayLike) -> Floats:
    """Return the film in the Moes scale, (h/Rx)(2U)^(-1/2), per unit of H: 4 M/pi."""
    return 4 / math.pi * np.asarray(m, dtype=float)


def line_film(m: ArrayLike, l: ArrayLike) -> Floats:  # noqa: E741
    """Return the central film of a smooth line contact in the Moes scale: Moes (1992)."""
    m, l = np.asarray(m, dtype=float), np.asarray(l, dtype=float)  # noqa: E741
    h_ri, h_ei = 3 / m, 2.621 * m ** (-1 / 5)
    h_rp, h_ep = 1.287 * l ** (2 / 3), 1.311 * m ** (-1 / 8) * l ** (3 / 4)
    s = (7 + 8 * np.exp(-2 * h_ei / h_ri)) / 5
    with np.errstate(divide="ignore"):  # L = 0: no piezoviscous part
        piezoviscous = (h_rp ** (-7 / 2) + h_ep ** (-7 / 2)) ** (-2 * s / 7)
    return np.asarray(
        ((h_ri ** (7 / 3) + h_ei ** (7 / 3)) ** (3 * s / 7) + piezoviscous) ** (1 / s)
    )
