"""Published film formulas, all in the Moes scale (h/Rx)(2U)^(-1/2).

U = eta0 ubar/(E' Rx), G = alpha E', W = F/(E' Rx^2), 2/E' = (1-nu1^2)/E1 + (1-nu2^2)/E2. The power
laws are no functions of (M, L, D) alone: they need G besides, 2U = (L/G)^4, and what they miss
by changes with it, by a few per cent over a factor of two in G.
"""

import math
from collections.abc import Callable

from ehlwave.contact.oils import Oil
from ehlwave.contact.scales import moes_film

Formula = Callable[[float, float, float], float]

STEEL_PA = 226e9
"""E' of steel on steel, Pa."""

G = Oil.pressure_viscosity_per_pa * STEEL_PA
"""alpha E' of steel and the default oil."""


def hamrock_dowson_central(m: float, l: float, d: float) -> float:
    """Return the central film of Hamrock and Dowson (1977), J. Lubrication Technology 99, 264."""
    shape = 1 - 0.61 * math.exp(-0.73 * ellipticity_fit(d))
    return _power_law(m, l, (2.69, 0.67, 0.53, -0.067)) * shape


def hamrock_dowson_smallest(m: float, l: float, d: float) -> float:
    """Return the smallest film of Hamrock and Dowson (1977)."""
    return _power_law(m, l, (3.63, 0.68, 0.49, -0.073)) * (1 - math.exp(-0.68 * ellipticity_fit(d)))


def chittenden_central(m: float, l: float, d: float) -> float:
    """Return the central film of Chittenden and others (1985), Proc. R. Soc. Lond. A 397, 245."""
    return _power_law(m, l, (4.31, 0.68, 0.49, -0.073)) * (1 - math.exp(-1.23 * d ** (-2 / 3)))


def chittenden_smallest(m: float, l: float, d: float) -> float:
    """Return the smallest film of Chittenden and others (1985)."""
    return _power_law(m, l, (3.68, 0.68, 0.49, -0.073)) * (1 - math.exp(-0.67 * d ** (-2 / 3)))


def ellipticity_fit(d: float) -> float:
    """Return the k = b/a that goes with the formulas of Hamrock and Dowson, 1.03 (Ry/Rx)^0.64."""
    return 1.03 * d**-0.64


CENTRAL: dict[str, Formula] = {
    "Nijenbanning, Venner, Moes": moes_film,
    "Hamrock, Dowson": hamrock_dowson_central,
    "Chittenden and others": chittenden_central,
}
SMALLEST: dict[str, Formula] = {
    "Hamrock, Dowson": hamrock_dowson_smallest,
    "Chittenden and others": chittenden_smallest,
}
"""Formulas of the central and the smallest film, by their authors."""


def _power_law(m: float, l: float, law: tuple[float, float, float, float]) -> float:
    """Return c U^u G^g W^w in the Moes scale."""
    c, u, g, w = law
    speed_2u = (l / G) ** 4
    load_w = m * speed_2u**0.75
    return c * (speed_2u / 2) ** u * G**g * load_w**w / math.sqrt(speed_2u)
