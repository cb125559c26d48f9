"""Kinematic viscosity over temperature, from data sheets.

ASTM D341-09 (Walther's equation with MacCoull's terms), ISO 3448 (grades) and ASTM D2270-10
(viscosity index; ISO 2909 has the same). Viscosities in mm2/s, temperatures in K.
"""

import math
from dataclasses import dataclass

import scipy

from ehlwave.error_bars import bar
from ehlwave.errors import SurfaceError, see

COLD_K, HOT_K = 313.15, 373.15
"""40 and 100 C, where data sheets state viscosities."""

ISO_GRADES = (2, 3, 5, 7, 10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500)
ISO_GRADES += (2200, 3200)
GRADE_ERROR = bar("oil.grade")
"""Tolerance of ISO 3448."""

THINNEST = 0.21
"""Lower limit of ASTM D341, mm2/s."""

BEND = 0.0195
"""Most by which log10 log10 Z of a measured oil leaves the straight line, over u (u - 1), u being 0
at 40 C and 1 at 100 C: of :data:`ehlwave.contact.measured_oils.MEASURED` without one oil, whose
bend is more than twice any other."""

INDEX_TERMS = (
    (2.0, 1.14673, 1.7576, -0.109, 0.84155, 1.5521, -0.077),
    (3.8, 3.38095, -15.4952, 33.196, 0.78571, 1.7929, -0.183),
    (4.4, 2.5000, -7.2143, 13.812, 0.82143, 1.5679, 0.119),
    (5.0, 0.10100, 16.6350, -45.469, 0.04985, 9.1613, -18.557),
    (6.4, 3.35714, -23.5643, 78.466, 0.22619, 7.7369, -16.656),
    (7.0, 0.01191, 21.4750, -72.870, 0.79762, -0.7321, 14.610),
    (7.7, 0.41858, 16.1558, -56.040, 0.05794, 10.5156, -28.240),
    (9.0, 0.88779, 7.5527, -16.600, 0.26665, 6.7015, -10.810),
    (12.0, 0.76720, 10.7972, -38.180, 0.20073, 8.4658, -22.490),
    (15.0, 0.97305, 5.3135, -2.200, 0.28889, 5.9741, -4.930),
    (18.0, 0.97256, 5.2500, -0.980, 0.24504, 7.4160, -16.730),
    (22.0, 0.91413, 7.4759, -21.820, 0.20323, 9.1267, -34.230),
    (28.0, 0.87031, 9.7157, -50.770, 0.18411, 10.1015, -46.750),
    (40.0, 0.84703, 12.6752, -133.310, 0.17029, 11.4866, -80.620),
    (55.0, 0.85921, 11.1009, -83.190, 0.17130, 11.3680, -76.940),
    (70.0, 0.83531, 14.6731, -216.246, 0.16841, 11.8493, -96.947),
)
"""ASTM D2270, appendix: from a viscosity at 100 C on, a, b, c of L and of H, a Y^2 + b Y + c."""


def _walther(viscosity: float) -> float:
    """Return log10 log10 Z of a viscosity, D341 equation (1)."""
    terms = math.exp(-1.47 - 1.84 * viscosity - 0.51 * viscosity**2)
    return math.log10(math.log10(viscosity + 0.7 + terms))


def _unwalther(ordinate: float) -> float:
    """Return the viscosity of a log10 log10 Z: the inverse, to round-off.

    D341 gives a fit of the inverse; its first terms are where the root is sought.
    """
    z = 10 ** (10**ordinate)
    return float(
        scipy.optimize.brentq(
            lambda v: _walther(v) - ordinate, max(z - 1.2, THINNEST), z, xtol=1e-13
        )
    )


@dataclass(frozen=True)
class Walther:
    """The straight line log10 log10 Z = A - B log10 T of an oil."""

    a: float
    b: float
    """`a`, `b`: A and B; T in K."""

    @classmethod
    def through(cls, one: tuple[float, float], other: tuple[float, float]) -> "Walther":
        """Return the line through two points (K, mm2/s)."""
        (t1, v1), (t2, v2) = one, other
        b = (_walther(v1) - _walther(v2)) / math.log10(t2 / t1)
        return cls(_walther(v1) + b * math.log10(t1), b)

    def viscosity(self, temperature_k: float) -> float:
        """Return the kinematic viscosity, mm2/s.

        Raises SurfaceError where it is so thin that the standard ends.
        """
        ordinate = self.a - self.b * math.log10(temperature_k)
        if ordinate < _walther(THINNEST):
            raise SurfaceError(
                f"temperature_k = {temperature_k:g}: the oil would be thinner than {THINNEST:g} "
                f"mm2/s, where ASTM D341 ends{see('oil')}"
            )
        return _unwalther(ordinate)

    def extrapolation_error(self, temperature_k: float) -> float:
        """Return the relative error of the viscosity by `BEND`, 0 from 40 to 100 C."""
        u = math.log(temperature_k / COLD_K) / math.log(HOT_K / COLD_K)
        if 0 <= u <= 1:
            return 0.0
        known = self.viscosity(temperature_k)
        return _unwalther(_walther(known) + BEND * u * (u - 1)) / known - 1


def _index_limits(hot: float) -> tuple[float, float]:
    """Return L and H of a viscosity at 100 C, D2270."""
    terms = [row for row in INDEX_TERMS if row[0] <= hot][-1]
    return (
        terms[1] * hot**2 + terms[2] * hot + terms[3],
        terms[4] * hot**2 + terms[5] * hot + terms[6],
    )


def viscosity_index(cold: float, hot: float) -> float:
    """Return the viscosity index of viscosities at 40 and 100 C, mm2/s, D2270 A and B.

    Raises SurfaceError below 2 mm2/s at 100 C, which the standard does not cover.
    """
    if hot < INDEX_TERMS[0][0]:
        raise SurfaceError(
            f"viscosity_100c_mm2_per_s = {hot:g}: a viscosity index is defined from 2 mm2/s on"
        )
    limit_l, limit_h = _index_limits(hot)
    if cold >= limit_h:
        return 100 * (limit_l - cold) / (limit_l - limit_h)
    power = math.log10(limit_h / cold) / math.log10(hot)
    return (10**power - 1) / 0.00715 + 100


def hot_viscosity(cold: float, index: float) -> float:
    """Return the viscosity at 100 C from the viscosity at 40 C and the index, mm2/s.

    Raises SurfaceError if no oil has both.
    """
    low, high = INDEX_TERMS[0][0], 0.95 * cold
    if not (high > low and -200 <= index <= 500) or (
        (viscosity_index(cold, low) - index) * (viscosity_index(cold, high) - index) > 0
    ):
        raise SurfaceError(
            f"viscosity_index = {index:g} with {cold:g} mm2/s at 40 C: no oil of ASTM D2270 (2 "
            f"mm2/s or more at 100 C) has both; mineral oils have 95; or give "
            f"viscosity_100c_mm2_per_s{see('oil')}"
        )
    return float(
        scipy.optimize.brentq(lambda hot: viscosity_index(cold, hot) - index, low, high, xtol=1e-12)
    )
