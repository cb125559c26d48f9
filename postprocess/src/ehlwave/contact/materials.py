"""Elastic constants of materials that contacts are made of, and how they conduct and store heat."""

from typing import NamedTuple

from ehlwave.contact.heat_data import BodyHeat
from ehlwave.errors import SurfaceError, did_you_mean, see


class Material(NamedTuple):
    """A material."""

    elastic_modulus_pa: float
    """Young's modulus, Pa."""
    poisson_ratio: float
    """Poisson's ratio."""
    source: str
    """Where they are from."""
    heat: BodyHeat
    """Conductivity, density and heat capacity at 20 to 25 C."""
    heat_source: str
    """Where these are from."""


_HARRIS = "Harris and Kotzalas, Rolling Bearing Analysis, 5th edition, CRC Press, 2007"
_ASHBY = "Ashby, Materials Selection in Mechanical Design, middle of the range"
_HARDENED = (
    "conductivity of through-hardened AISI 52100: Reddyhoff, Schmidt and Spikes, Tribology Letters "
    "67, 2019 (soft steel has 46 W/(m K), the default of &heat); the others " + _ASHBY
)
_BK7 = "SCHOTT N-BK7, data sheet"
_GOTO = "isotropic mean of Goto et al., J. Geophys. Res. 94, 1989, 7588-7602"

MATERIALS = {
    name: Material(modulus, ratio, source, BodyHeat(*heat), heat_source)
    for name, modulus, ratio, source, heat, heat_source in (
        (
            *("steel", 2.06e11, 0.30, "through-hardened bearing steel; " + _HARRIS),
            *((21.0, 7850.0, 470.0), _HARDENED),
        ),
        (
            *("stainless steel", 2.00e11, 0.30, "AISI 440C; " + _HARRIS),
            *((24.0, 7700.0, 460.0), "AISI 440C, makers' data sheets"),
        ),
        (
            *("silicon nitride", 3.10e11, 0.26, "hot-pressed Si3N4; " + _HARRIS),
            *((29.0, 3200.0, 700.0), "bearing grades, makers' data sheets: 20 to 35 W/(m K)"),
        ),
        ("alumina", 3.80e11, 0.23, _ASHBY, (30.0, 3900.0, 800.0), _ASHBY),
        ("sapphire", 4.03e11, 0.235, _GOTO, (35.0, 3980.0, 760.0), "makers' data sheets"),
        (
            *("tungsten carbide", 6.30e11, 0.22, "with 6 % cobalt; " + _ASHBY),
            *((84.0, 14900.0, 210.0), _ASHBY + ": 60 to 110 W/(m K)"),
        ),
        ("glass", 8.2e10, 0.206, _BK7, (1.114, 2510.0, 858.0), _BK7),
        ("bk7", 8.2e10, 0.206, _BK7, (1.114, 2510.0, 858.0), _BK7),
        (
            *("fused silica", 7.27e10, 0.16, "Corning 7980, data sheet"),
            *((1.38, 2203.0, 703.0), "makers' data sheets"),
        ),
        ("bronze", 1.10e11, 0.34, "tin bronze; " + _ASHBY, (60.0, 8800.0, 380.0), _ASHBY),
        ("cast iron", 1.20e11, 0.26, "grey; " + _ASHBY, (50.0, 7150.0, 470.0), _ASHBY),
        ("aluminium", 7.0e10, 0.33, _ASHBY, (155.0, 2700.0, 900.0), _ASHBY),
        ("titanium", 1.14e11, 0.33, "Ti-6Al-4V; " + _ASHBY, (7.0, 4430.0, 550.0), _ASHBY),
        ("peek", 3.7e9, 0.40, "unfilled; " + _ASHBY, (0.25, 1310.0, 1450.0), _ASHBY),
    )
}
"""By name. Where a maker states a value, that is better."""


def material(name: str) -> Material:
    """Return a material by its name.

    Raises SurfaceError if there is none of this name.
    """
    key = str(name).lower()
    found = MATERIALS.get(key.replace("_", " "))
    if found is None:
        raise SurfaceError(
            f"material = {name!r} is not known{did_you_mean(key, MATERIALS)}; known are "
            f"{', '.join(MATERIALS)}; or give elastic_modulus_pa and poisson_ratio{see('bodies')}"
        )
    return found
