"""Parts missing in the friction of the atlas: slight slip, and oil outside its domain.

Friction of the atlas is relative to the mean of asinh(B) under the Hertz pressure. Where slip is
slight, B is about 1: friction goes as the mean of the viscosity, to which the pressure spike and
the ends of the contact contribute, not as the mean of its logarithm.
"""

from numpy.typing import NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.medium import hertz_medium
from ehlwave.contact.scales import (
    first_integral,
    integral_combinations,
    moes_per_film,
    second_integral,
)
from ehlwave.duals import math, np, to_float
from ehlwave.error_bars import bar

Floats = NDArray[np.float64]

DOMAIN_X, DOMAIN_Y = 2.5, 2.0
"""Ends of the domain of the atlas, upstream and across, in semi-axes."""

WITH_DOWNSTREAM, FEWEST_DOMAINS = 1.3, 2.0
"""Ratio of the friction outside to the friction upstream, and the least distance in domains, as in
``src/reynolds/shear_stress.f90`` and ``src/run/rolling_result.f90``.
"""

ANGLES, STEPS = 48, 64
"""Points of the sum over the oil outside."""

SLIGHT_SLIP, SLIGHTEST_SLIP = 0.1, 1e-3
"""Deviations of S from 1: friction is less well known below the first, and below the second as
little as there."""

SLIGHT_SLIP_ERROR, THICKENED = bar("friction.slight_slip"), 10.0
"""Times M^(-1/2) the relative error of friction that slight slip adds at most, where alpha ph is
the latter or more; in proportion below."""
LINE_ERROR = bar("friction.slight_slip_line")
"""Error of lines at any M: few contacts of their atlas slip so little."""


def slight_slip_error(conditions: Conditions) -> float:
    """Return the relative error of friction that slight slip adds."""
    slip = max(abs(conditions.slip_parameter - 1), SLIGHTEST_SLIP)
    share = math.log(SLIGHT_SLIP / slip) / math.log(SLIGHT_SLIP / SLIGHTEST_SLIP)
    thickened = min(1.0, conditions.alphabar / THICKENED)
    most = LINE_ERROR if conditions.is_line else SLIGHT_SLIP_ERROR * conditions.m**-0.5
    return most * thickened * max(0.0, share)


def friction_outside(
    conditions: Conditions, central_moes: float, stress: float, modulus_pa: float
) -> float:
    """Return the friction of the oil outside the domain over that inside, theory eq. (T11).

    Out to x = -Rx as the program has it, but with the viscosity of ambient pressure.

    Parameters
    ----------
    conditions : Conditions
        Of a contact that slides in a Ree-Eyring oil.
    central_moes : float
        Central film, Moes scale.
    stress : float
        Mean shear stress inside over the Eyring stress.
    modulus_pa : float
        E'.
    """
    c = conditions
    film = central_moes / moes_per_film(c.m, c.kappa)
    state = c.oil, c.kappa, c.alphabar, c.lambdabar, film, c.slip_parameter
    thinning = hertz_medium(*state).thinning
    second = second_integral(c.kappa)
    radius_over_a = (1 + c.d) * modulus_pa / (4 * second * c.hertz_pa)
    farthest = max(FEWEST_DOMAINS, radius_over_a / DOMAIN_X)
    edges = np.geomspace(1, farthest, STEPS + 1)
    times, widths = np.sqrt(edges[1:] * edges[:-1]), np.diff(edges)
    if c.is_line:
        x, area = DOMAIN_X * times, DOMAIN_X * widths / 2
        far = _far_line_film(x)
    else:
        turn = np.pi * (np.arange(ANGLES)[:, None] + 0.5) / ANGLES
        along, across = np.sin(turn), np.abs(np.cos(turn))
        end = 1 / np.maximum(along / DOMAIN_X, across / DOMAIN_Y)
        far = _far_film(c.kappa, end * times * along, end * times * across)
        area = end**2 * times * widths / ANGLES
    sheared = np.arcsinh(thinning * film / (film + far))
    return WITH_DOWNSTREAM * to_float((sheared * area).sum()) / stress


def _far_line_film(x: Floats) -> Floats:
    """Return H outside a dry line contact."""
    root = np.sqrt(x**2 - 1)
    return np.asarray(x * root - np.log(x + root))


def _far_film(kappa: float, x: Floats, y: Floats) -> Floats:
    """Return H far outside a dry elliptical contact: the deflection equals a point load's."""
    k = first_integral(kappa)
    k_minus_e, b = integral_combinations(kappa)
    along = b / (b + k_minus_e)
    deflection = 2 / (3 * k * np.hypot(kappa * x, y))
    return np.asarray(along * x**2 + (1 - along) * y**2 - 1 + deflection)
