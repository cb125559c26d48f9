"""Estimates of the pressure-viscosity coefficient from viscosity, each with its scatter.

alpha is the slope of ln eta at ambient pressure, as in Roelands' law. Scatters are the largest
deviations from the oils of :data:`ehlwave.contact.measured_oils.MEASURED`; a test compares.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

from ehlwave.choices import chosen
from ehlwave.contact.oils import Oil, log_viscosity
from ehlwave.contact.viscosity_grade import Walther
from ehlwave.errors import SurfaceError, see

SECANT_PA = 2e8
"""Gold's alpha is the slope of a straight line from ambient pressure to here."""

GOLD = {
    "mineral": (9.904, 0.139),
    "pao": (7.382, 0.1335),
    "ester": (6.605, 0.136),
    "polyglycol": (5.489, 0.1485),
}
"""s and t of alpha = s nu^t, 1/GPa and mm2/s, by the kind of base oil."""


class State(NamedTuple):
    """Data of an oil at a temperature."""

    kinematic_mm2_per_s: float
    density_kg_per_m3: float
    walther: Walther
    kind: str


class Estimate(NamedTuple):
    """An estimate."""

    value: Callable[[State], float]
    """alpha, 1/Pa, of a state."""
    scatter: float
    """Relative; all measured oils lie within."""
    kinds: tuple[str, ...]
    """Base oils that it is for."""
    source: str
    """Its source."""


def _gold(state: State) -> float:
    s, t = GOLD[state.kind]
    secant = 1e-9 * s * state.kinematic_mm2_per_s**t * SECANT_PA
    return float(secant / log_viscosity(1.0, Oil.roelands_index, SECANT_PA))


def _wooster(state: State) -> float:
    viscosity_mpa_s = state.kinematic_mm2_per_s * state.density_kg_per_m3 * 1e-3
    return 1e-8 * (0.6 + 0.965 * math.log10(viscosity_mpa_s))


def _so_klaus(state: State) -> float:
    log, slope = math.log10(state.kinematic_mm2_per_s), state.walther.b
    density = state.density_kg_per_m3 * 1e-3
    return 1e-8 * (
        1.216
        + 4.143 * log**3.0627
        + 2.848e-4 * slope**5.1903 * log**1.5976
        - 3.999 * log**3.0975 * density**0.1162
    )


ESTIMATES = {
    "gold": Estimate(
        _gold,
        0.31,
        tuple(GOLD),
        "Gold, Schmidt, Dicke, Loos and Assmann, J. Synthetic Lubrication 18, 2001, 51-79",
    ),
    "wooster": Estimate(
        _wooster, 0.31, ("mineral",), "Wooster, as quoted by Stachowiak and Batchelor, section 2.4"
    ),
    "so-klaus": Estimate(
        _so_klaus, 0.40, ("mineral",), "So and Klaus, ASLE Transactions 23, 1980, 409-421"
    ),
}
"""By name."""


def estimate_alpha(name: str, state: State) -> tuple[float, float, str]:
    """Return alpha, 1/Pa, its relative scatter, and the method of the estimate.

    Raises SurfaceError if there is no such estimate, or it is not for this kind of oil.
    """
    more = f", or pressure_viscosity_per_pa{see('oil')}"
    found = ESTIMATES[chosen(name, "alpha", ESTIMATES, "Oil", more)]
    if state.kind not in found.kinds:
        raise SurfaceError(
            f"Oil: alpha = {name!r} is for {', '.join(found.kinds)} oils, kind = {state.kind!r}: "
            f"give alpha='gold', or pressure_viscosity_per_pa{see('oil')}"
        )
    if not 1 <= state.kinematic_mm2_per_s <= 5000:
        raise SurfaceError(
            f"Oil: {state.kinematic_mm2_per_s:.3g} mm2/s at this temperature: estimates of the "
            "pressure-viscosity coefficient are for 1 to 5000 mm2/s: give pressure_viscosity_per_pa"
        )
    return found.value(state), found.scatter, f"{name} ({found.source})"
