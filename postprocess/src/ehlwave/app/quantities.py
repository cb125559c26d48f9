"""The numbers that the page asks for: key of the input files, label, units, example."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from decimal import Decimal

from ehlwave.quantities import ZERO_CELSIUS_K

Units = Mapping[str, int | None]
"""Powers of ten to SI by the names of units; None: degrees Celsius."""

ZERO_CELSIUS = Decimal(str(ZERO_CELSIUS_K))
LENGTHS: Units = {"mm": -3, "um": -6, "m": 0}
PRESSURES: Units = {"GPa": 9, "MPa": 6, "Pa": 0}


@dataclass(frozen=True)
class Quantity:
    """A number with a unit."""

    key: str
    """Key of the input files, or an argument."""
    label: str
    """Beside the field."""
    example: str = ""
    """In the field at the beginning, in the first unit."""
    units: Units = field(default_factory=dict)
    """Units that it can be typed in; nothing of a number without unit."""
    help: str = ""
    """One sentence."""

    @property
    def chosen(self) -> tuple[str, int | None]:
        """The first unit, with its power of ten."""
        return next(iter(self.units.items()), ("", 0))


def in_si(text: str, unit: int | None) -> float | str:
    """Return a number in SI to its last digit; other texts unchanged, for the checks to name.

    12.7 mm are 0.0127 m, as typed there, and not 0.012700000000000001 m. `unit` is a power of ten;
    None: degrees Celsius.
    """
    try:
        value = Decimal(text.strip())
        found = float(value + ZERO_CELSIUS if unit is None else value.scaleb(unit))
    except (ArithmeticError, ValueError):
        return text
    return found if math.isfinite(found) else text


def body(radius: str) -> tuple[Quantity, ...]:
    """Return the radii of a body, and the properties of a material."""
    flat = "Blank: flat. Negative: hollow."
    return (
        Quantity("radius_x_m", "Radius along rolling", radius, LENGTHS, flat),
        Quantity("radius_y_m", "Radius across", radius, LENGTHS, flat),
        Quantity("elastic_modulus_pa", "Young's modulus", "206", PRESSURES),
        Quantity("poisson_ratio", "Poisson ratio", "0.3"),
    )


SURFACE_SPEED = Quantity("speeds_m_per_s", "Surface speed", "4", {"m/s": 0})
LINE_LENGTH = Quantity("length_m", "Length of a line", "", LENGTHS, "Where both are flat across.")
LOAD = Quantity("load_n", "Load", "40", {"N": 0, "kN": 3})
LINE_LOAD = Quantity("load_n_per_m", "Load per length", "150", {"N/mm": 3, "N/m": 0})
RADIUS_X = Quantity("radius_x_m", "Reduced radius along rolling", "12.7", LENGTHS)
RADIUS_Y = Quantity("radius_y_m", "Reduced radius across", "12.7", LENGTHS)
MODULUS = Quantity(
    "reduced_modulus_pa",
    "Reduced modulus E'",
    "226",
    PRESSURES,
    "2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; steel on steel 226 GPa.",
)
SPEED = Quantity("mean_speed_m_per_s", "Mean speed", "4", {"m/s": 0}, "(u1 + u2)/2, not the sum.")
RATIO = Quantity(
    "slide_to_roll_ratio",
    "Slide-to-roll ratio",
    "0",
    {},
    "(u1 - u2)/mean speed; surface 1 is the rough one.",
)
STARVED = Quantity(
    "oil_over_flooded",
    "Oil offered over flooded",
    "",
    {},
    "Over the oil that the flooded contact passes. Blank: flooded.",
)
REDUCED = (RADIUS_X, RADIUS_Y, MODULUS, LOAD, SPEED, RATIO, STARVED)
LINE = (RADIUS_X, MODULUS, LINE_LOAD, SPEED, RATIO)
MOES = (
    Quantity("load_parameter_m", "Load parameter M", "100"),
    Quantity("lubricant_parameter_l", "Lubricant parameter L", "10"),
    Quantity("radius_ratio_d", "Ratio D = Rx/Ry", "1", {}, "0: line contact."),
    Quantity("semi_axis_a_m", "Hertz semi-axis a", "0.2", LENGTHS, "Along rolling; for a trace."),
    Quantity("radius_x_m", "Reduced radius along rolling", "12.7", LENGTHS, "For lengths."),
    RATIO,
    STARVED,
)
VISCOSITY = Quantity(
    "viscosity_pa_s",
    "Viscosity",
    "50",
    {"mPa s": -3, "Pa s": 0},
    "Dynamic, at the inlet's temperature and ambient pressure.",
)
OIL = (
    Quantity(
        "pressure_viscosity_per_pa",
        "Pressure coefficient",
        "22",
        {"1/GPa": -9, "1/Pa": 0},
        "alpha of Roelands' law at ambient pressure.",
    ),
    Quantity("roelands_index", "Roelands index z", "0.68"),
)
STRESS = Quantity("eyring_stress_pa", "Eyring stress", "5", {"MPa": 6, "Pa": 0})
CARREAU = (
    Quantity("carreau_modulus_pa", "Carreau modulus G", "7", {"MPa": 6, "Pa": 0}),
    Quantity("carreau_exponent", "Carreau exponent n", "0.35"),
)
HEAT_HELP = "With heat: two bodies, and an oil by data sheet or name."
FLOWS = {"Newtonian": (), "Ree-Eyring": (STRESS,), "Carreau": CARREAU}
TEMPERATURE = Quantity("temperature_k", "Temperature of the inlet", "60", {"C": None, "K": 0})
GRADE = (
    Quantity("iso_vg", "ISO VG", "68", {}, "Or leave it blank and give the viscosity at 40 C."),
    TEMPERATURE,
    Quantity("viscosity_40c_mm2_per_s", "Viscosity at 40 C", "", {"mm2/s": 0}),
    Quantity("viscosity_100c_mm2_per_s", "Viscosity at 100 C", "", {"mm2/s": 0}),
    Quantity("viscosity_index", "Viscosity index", "", {}, "Blank: usual one of the oil."),
    Quantity("density_15c_kg_per_m3", "Density at 15 C", "", {"kg/m3": 0}, "Blank: usual one."),
)
STEP = Quantity("step", "Step, if not in the file", "", {}, "In the unit of lengths.")
CUTOFFS = (
    Quantity("cutoff", "Filter: longest wave", "", {"um": -6, "mm": -3}),
    Quantity("short_cutoff", "Filter: shortest wave", "", {"um": -6, "mm": -3}),
)


def every_quantity() -> tuple[Quantity, ...]:
    """Return all numbers that the tab of a contact asks for."""
    single = (SURFACE_SPEED, LINE_LENGTH, LINE_LOAD, VISCOSITY, STEP)
    flows = tuple(one for flow in FLOWS.values() for one in flow)
    return (*body(""), *single, *MOES, *LINE, *REDUCED, *OIL, *flows, *GRADE, *CUTOFFS)
