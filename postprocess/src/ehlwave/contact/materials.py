"""Elastic constants of materials that contacts are made of."""

from typing import NamedTuple

from ehlwave.errors import SurfaceError
from ehlwave.hints import did_you_mean, see


class Material(NamedTuple):
    """A material.

    Attributes
    ----------
    elastic_modulus_pa : float
        Young's modulus, Pa.
    poisson_ratio : float
        Poisson's ratio.
    source : str
        Where they are from.
    """

    elastic_modulus_pa: float
    poisson_ratio: float
    source: str


_HARRIS = "Harris and Kotzalas, Rolling Bearing Analysis, 5th edition, CRC Press, 2007"
_ASHBY = "Ashby, Materials Selection in Mechanical Design, middle of the range"

MATERIALS = {
    "steel": Material(2.06e11, 0.30, "through-hardened bearing steel; " + _HARRIS),
    "stainless steel": Material(2.00e11, 0.30, "AISI 440C; " + _HARRIS),
    "silicon nitride": Material(3.10e11, 0.26, "hot-pressed Si3N4; " + _HARRIS),
    "alumina": Material(3.80e11, 0.23, _ASHBY),
    "sapphire": Material(
        4.03e11, 0.235, "isotropic mean of Goto et al., J. Geophys. Res. 94, 1989, 7588-7602"
    ),
    "tungsten carbide": Material(6.30e11, 0.22, "with 6 % cobalt; " + _ASHBY),
    "glass": Material(8.2e10, 0.206, "SCHOTT N-BK7, data sheet"),
    "bk7": Material(8.2e10, 0.206, "SCHOTT N-BK7, data sheet"),
    "fused silica": Material(7.27e10, 0.16, "Corning 7980, data sheet"),
    "bronze": Material(1.10e11, 0.34, "tin bronze; " + _ASHBY),
    "cast iron": Material(1.20e11, 0.26, "grey; " + _ASHBY),
    "aluminium": Material(7.0e10, 0.33, _ASHBY),
    "titanium": Material(1.14e11, 0.33, "Ti-6Al-4V; " + _ASHBY),
    "peek": Material(3.7e9, 0.40, "unfilled; " + _ASHBY),
}
"""By name. Where a maker states a modulus, that is better."""


def material(name: str) -> Material:
    """Return a material by its name.

    Raises
    ------
    SurfaceError
        If there is none of this name.
    """
    found = MATERIALS.get(name.lower().replace("_", " "))
    if found is None:
        raise SurfaceError(
            f"material = {name!r} is not known{did_you_mean(name.lower(), MATERIALS)}; known are "
            f"{', '.join(MATERIALS)}; or give elastic_modulus_pa and poisson_ratio{see('bodies')}"
        )
    return found
