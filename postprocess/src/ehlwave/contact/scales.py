"""Scales of elliptical contacts and their film by formula, from M, L and D.

Equation numbers refer to ``src/theory.md``; line contacts: :mod:`ehlwave.contact.line_contact`. The
Fortran program has the same formulas in ``src/contact/conditions.f90`` and ``formula.f90``; a test
compares both to round-off.
"""

from functools import lru_cache
from typing import Any, TypeVar

from numpy.typing import NDArray

from ehlwave.contact.line_contact import line_film, moes_per_line_film
from ehlwave.duals import Dual, implicit, math, np, to_float, valued
from ehlwave.errors import SurfaceError

Number = TypeVar("Number", float, NDArray[np.float64])

NEARLY_CIRCULAR = 1e-4
"""1 - kappa^2 below which derivatives of elliptic integrals are series."""

MEANS = 8
"""Arithmetic-geometric means that elliptic integrals need, down to kappa = 1e-4."""

NEWTON_STEPS = 4
"""Steps that an ellipticity needs, for D of 0.001 to 1."""


def ellipticity(d: float) -> float:
    """Return kappa = a/b that solves D = kappa^2 (K - E)/(E - kappa^2 K), eq. (1).

    The elliptic integrals have the parameter 1 - kappa^2. Valid for 0.005 <= D <= 1.

    Raises SurfaceError for D = 0, a line contact, which has no width.
    """
    if d == 0:
        raise SurfaceError(
            "radius_ratio_d = 0 is a line contact: harmonic tables are for elliptical contacts, "
            "radius_ratio_d of 0.005 to 1"
        )
    found: float = implicit(_ellipticity(float(valued(d))), lambda kappa: radius_ratio(kappa) - d)
    return found


@lru_cache(maxsize=4096)
def _ellipticity(d: float) -> float:
    if d == 1:
        return 1.0

    kappa = d**0.64
    for _ in range(NEWTON_STEPS):  # ln D is nearly linear in ln kappa
        ratio = radius_ratio(Dual(kappa, np.ones(1)))
        kappa *= float((d / ratio.value) ** (ratio.value / (kappa * ratio.slopes[0])))
    return kappa


def radius_ratio(kappa: float) -> float:
    """Return D of an ellipticity a/b, eq. (1)."""
    k_minus_e, b = integral_combinations(kappa)
    return kappa**2 * k_minus_e / b


def pressure_factor(kappa: float) -> float:
    """Return gamma, by which M counts in V: 1 for a circular contact, eq. (3)."""
    return math.pi**2 * kappa / (16 * integral_combinations(kappa)[1] ** 2)


def alphabar(m: Number, l: Number, gamma: Number) -> Number:  # noqa: E741
    """Return alpha ph of M, L and gamma, eq. (3)."""
    return l / math.pi * (1.5 * gamma * m) ** (1 / 3)


def lambdabar(m: float, kappa: float) -> float:
    """Return the speed parameter, eq. (4)."""
    a, b = integral_combinations(kappa)
    k = a + b
    shape = b ** (5 / 3) / (6 ** (1 / 3) * kappa ** (4 / 3) * k**2)
    return 16 * math.pi ** (4 / 3) * m ** (-4 / 3) * shape


def moes_film(m: float, l: float, d: float) -> float:  # noqa: E741
    """Return the central film of a smooth contact in the Moes scale, (h/Rx)(2U)^(-1/2).

    Nijenbanning, Venner and Moes (1994), *Wear* 176: a fit for all D. Converged solutions lie
    below it, by :data:`FIT_ERROR` at most in 97.5 % of contacts. Line contacts (D = 0): Moes
    (1992), :data:`LINE_FIT_ERROR`.
    """
    if d == 0:
        return to_float(line_film(m, l))
    shape = 1 + 0.006 * math.log(d) + 0.63 * d ** (4 / 7)
    h_ri = 145 * (1 + 0.796 * d ** (14 / 15)) ** (-15 / 7) / d / m**2
    h_ei = 3.18 * shape ** (-14 / 25) * d ** (-1 / 15) * m ** (-2 / 15)
    h_00 = 1.8 / d
    h_rp = 1.29 * (1 + 0.691 * d) ** (-2 / 3) * l ** (2 / 3)
    h_ep = 1.48 * shape ** (-7 / 20) * d ** (-1 / 24) * m ** (-1 / 12) * l**0.75
    ratio = h_ei / h_ep if l > 0 else math.inf
    s = 1.5 * (1 + math.exp(-1.2 * ratio))
    rigid_elastic = (h_ri**1.5 + (h_ei**-4 + h_00**-4) ** (-3 / 8)) ** (2 * s / 3)
    piezoviscous = (h_rp**-8 + h_ep**-8) ** (-s / 8) if l > 0 else 0.0
    return to_float((rigid_elastic + piezoviscous) ** (1 / s))


def corrected_film(m: float, l: float, d: float) -> float:  # noqa: E741
    """Return H of a smooth contact: :func:`moes_film` less its excess, in units of c.

    The correction is a fit to the contacts of ``studies.two_waves`` (20 <= M <= 1000,
    2.5 <= L <= 20, 0.1 <= D <= 1, flooded, Newtonian), of which it misses 2 per cent rms; the
    formula alone 11 per cent.
    """
    kappa = ellipticity(d)
    load = pressure_factor(kappa) * m
    share = 0.913 * (10 / l) ** 0.118 * (100 / load) ** 0.039 * d**0.021
    return share * moes_film(m, l, d) / moes_per_film(m, kappa)


def first_integral(kappa: float) -> float:
    """Return the elliptic integral K of eq. (3); 1 of a line contact, kappa = 0."""
    return to_float(sum(integral_combinations(kappa))) if kappa > 0 else 1.0


def second_integral(kappa: float) -> float:
    """Return the elliptic integral E of eq. (3); 1 of a line contact, kappa = 0."""
    if kappa == 0:
        return 1.0
    first, second = integral_combinations(kappa)
    return to_float(second + kappa**2 * first)


def moes_per_film(m: float, kappa: float) -> float:
    """Return the film in the Moes scale per unit of H, eq. (6); of a line contact kappa is 0."""
    if kappa == 0:
        return to_float(moes_per_line_film(m))
    b = integral_combinations(kappa)[1]
    return first_integral(kappa) / 2 * b ** (-1 / 3) * (6 * m * kappa / math.pi) ** (2 / 3)


def integral_combinations(kappa: Number) -> tuple[Number, Number]:
    """Return (K - E)/(1 - kappa^2) and (E - kappa^2 K)/(1 - kappa^2); pi/4 each at kappa = 1.

    Their sum is K. By the arithmetic-geometric mean of 1 and kappa: K - E is K times a sum in which
    nothing cancels (Abramowitz and Stegun 17.6), each term over 1 - kappa^2 here.
    """
    if isinstance(kappa, Dual):
        return _combinations_with_slopes(kappa)
    mean, geometric = (1 + kappa) / 2, kappa**0.5
    half_difference = (1 - kappa) / 2
    term = half_difference / (2 * (1 + kappa))
    total = 0.5 + term
    for n in range(1, MEANS):
        mean, geometric = (mean + geometric) / 2, (mean * geometric) ** 0.5
        growth = half_difference / (4 * mean)
        half_difference = half_difference * growth
        term = term * growth**2
        total = total + 2**n * term
    k = math.pi / 2 / mean
    return k * total, k * (1 - total)


def _combinations_with_slopes(kappa: Any) -> tuple[Any, Any]:  # noqa: ANN401 - a Dual
    """Return both with their derivatives by the parameter m = 1 - kappa^2, of E and K."""
    first, second = integral_combinations(kappa.value)
    m = 1 - kappa.value**2
    k_slope = second / (2 * (1 - m))
    series = math.pi / 2 * (3 / 16 + 15 / 64 * m)  # the difference cancels near a circle
    by_both = (second / (1 - m) - first) / (2 * np.maximum(m, NEARLY_CIRCULAR))
    first_slope = np.where(m < NEARLY_CIRCULAR, series, by_both)
    by_m = -2 * kappa.value * kappa.slopes
    return Dual(first, first_slope * by_m), Dual(second, (k_slope - first_slope) * by_m)
