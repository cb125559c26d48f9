"""Usual conductivities and heat capacities of oils at ambient pressure, with their scatter.

Under the pressure of a contact oils conduct better, by half to twice at 1 GPa (Larsson and
Andersson, Proc. IMechE J 214, 2000, 337-342); ``&heat`` and the laws of heat take a single value.
Kinds missing in `usual_heat` have no known source.
"""

from ehlwave.error_bars import bar
from ehlwave.quantities import ZERO_CELSIUS_K

CRAGOE_ERROR = bar("oil.cragoe")
"""Cragoe, Thermal Properties of Petroleum Products, Bureau of Standards, Miscellaneous Publication
97, 1929: from the density at 15 C; other handbooks' conductivities of mineral oils lie within.
Films and friction do not depend on the heat capacity."""

PAO = {"conductivity_w_per_m_k": 0.153, "heat_capacity_j_per_kg_k": 2046.0}
"""Mean of PAO 4, 10, 40 and 100, 0.141 to 0.165 W/(m K) and 2045 to 2049 J/(kg K): a thermal EHL
model's input, github.com/DausdasKreuz/Thermoelastohydrodynamics_time_transient, which names no
measurement."""
PAO_ERROR = bar("oil.pao")
WATER_15C = 999.1


def usual_heat(kind: str, temperature_k: float, density_15c: float) -> dict[str, float]:
    """Return conductivity, with its relative error, and heat capacity by the kind of base oil.

    Empty of esters and polyglycols, for which no source is known.

    Parameters
    ----------
    kind : str
        ``"mineral"``, ``"pao"``, ...
    temperature_k : float
        Temperature, K.
    density_15c : float
        Density at 15 C, kg/m3.

    Examples
    --------
    >>> from ehlwave.contact.oil_heat import usual_heat
    >>> found = usual_heat("mineral", 333.15, 880.0)
    >>> print(f"{found['conductivity_w_per_m_k']:.3f}, {found['heat_capacity_j_per_kg_k']:.0f}")
    0.129, 2012
    """
    celsius, gravity = temperature_k - ZERO_CELSIUS_K, density_15c / WATER_15C
    if kind == "mineral":
        return {
            "conductivity_w_per_m_k": 0.1172 / gravity * (1 - 0.00054 * celsius),
            "heat_capacity_j_per_kg_k": (1685 + 3.39 * celsius) / gravity**0.5,
            "conductivity_error": CRAGOE_ERROR,
        }
    return PAO | {"conductivity_error": PAO_ERROR} if kind == "pao" else {}


def own_heat(usual: dict[str, float], others: dict[str, float]) -> dict[str, float]:
    """Return usual values with others in their place; a given conductivity has no usual error."""
    is_own = "conductivity_w_per_m_k" in others
    return usual | ({"conductivity_error": 0.0} if is_own else {}) | others
