"""Quantities as users write them: their SI units, values with units of their own, plausible ranges.

The unit of a quantity is the end of its name. A value that has the interface of pint (``to`` and
``magnitude``) is converted; nothing of pint is imported. A plain number is SI, and is questioned
where no contact has it.
"""

import math
from dataclasses import dataclass
from typing import Any

from ehlwave.errors import SurfaceError, see

UNITS = {
    "_m_per_s": "m/s",
    "_n_per_m": "N/m",
    "_kg_per_m3": "kg/m**3",
    "_w_per_m_k": "W/(m*K)",
    "_j_per_kg_k": "J/(kg*K)",
    "_mm2_per_s": "mm**2/s",
    "_pa_s": "Pa*s",
    "_per_pa": "1/Pa",
    "_per_k": "1/K",
    "_pa": "Pa",
    "_deg": "degree",
    "_rpm": "rpm",
    "_n_m": "N*m",
    "_kg": "kg",
    "_k": "K",
    "_n": "N",
    "_m": "m",
}
"""Units by the ends of names, longer ends first; other quantities have none."""


@dataclass(frozen=True)
class Plausible:
    """Range of values in contacts: values outside ``low`` to ``high`` are refused."""

    low: float
    high: float
    """`low`, `high`: bounds of all known contacts, SI."""
    usual: tuple[float, float]
    """Usual range: a factor that leads here is suggested."""
    factors: tuple[float, ...] = (1e9, 1e6, 1e3, 1e-3, 1e-6, 1e-9)
    """Factors that are tried: prefixes, or per cent."""


_PER_CENT = (1e-2,)
_MILLI, _KILO = (1e-3,), (1e3, 1e-3)
_RADIUS = Plausible(1e-6, 5, (1e-4, 1))
_RADIUS_ACROSS = Plausible(1e-6, 1e4, (1e-4, 10))
_DIAMETER = Plausible(1e-4, 10, (1e-3, 5))
_LOAD = Plausible(1e-7, 1e8, (1, 1e6))
_MODULUS = Plausible(1e6, 3e12, (1e9, 1.2e12))
_KINEMATIC = Plausible(0.3, 1e5, (1, 5e3))
_BODY_CONDUCTIVITY = Plausible(0.1, 3e3, (0.2, 500))
_BODY_DENSITY = Plausible(500, 2.3e4, (1e3, 2e4))
_BODY_CAPACITY = Plausible(100, 5e3, (120, 2e3))

PLAUSIBLE = {
    "radius_x_m": _RADIUS,
    "radius_y_m": _RADIUS_ACROSS,
    "ball_diameter_m": _RADIUS,
    "element_diameter_m": _RADIUS,
    "pitch_diameter_m": Plausible(1e-4, 10, (1e-2, 5)),
    "length_m": Plausible(1e-6, 10, (1e-4, 1)),
    "face_width_m": Plausible(1e-4, 5, (1e-3, 1)),
    "module_m": Plausible(1e-5, 0.1, (1e-4, 0.05)),
    "centre_distance_m": Plausible(1e-4, 10, (1e-3, 2)),
    "pinion_torque_n_m": Plausible(1e-5, 1e7, (1e-2, 1e6)),
    "radial_load_n": _LOAD,
    "axial_load_n": _LOAD,
    **dict.fromkeys(("bore_m", "outside_m", "track_diameter_m", "diameters_m"), _DIAMETER),
    **dict.fromkeys(("base_radius_m", "roller_radius_m"), _RADIUS),
    "width_m": Plausible(1e-5, 2, (1e-3, 0.5)),
    "lift_m": Plausible(0, 0.5, (1e-3, 0.1)),
    "oil_layer_m": Plausible(1e-10, 1e-2, (1e-8, 1e-3)),
    "roller_diameter_m": _RADIUS,
    "roller_length_m": Plausible(1e-5, 2, (1e-4, 1)),
    "reduced_modulus_pa": _MODULUS,
    "elastic_modulus_pa": _MODULUS,
    "poisson_ratio": Plausible(0, 0.5, (0.1, 0.5), _PER_CENT),
    "load_n": Plausible(1e-6, 1e8, (0.1, 1e5)),
    "load_n_per_m": Plausible(1, 1e8, (1e3, 5e6)),
    "mean_speed_m_per_s": Plausible(1e-7, 300, (1e-3, 50)),
    "speeds_m_per_s": Plausible(0, 300, (1e-3, 50)),
    "viscosity_pa_s": Plausible(1e-5, 20, (1e-3, 2)),
    "viscosity_40c_mm2_per_s": _KINEMATIC,
    "viscosity_100c_mm2_per_s": _KINEMATIC,
    "density_15c_kg_per_m3": Plausible(300, 3000, (700, 1300)),
    "pressure_viscosity_per_pa": Plausible(1e-10, 1e-6, (5e-9, 5e-8)),
    "pressure_viscosity_error": Plausible(0, 1, (1e-3, 1), _PER_CENT),
    "eyring_stress_pa": Plausible(1e4, 1e9, (1e6, 5e7)),
    "carreau_modulus_pa": Plausible(1e2, 1e9, (1e4, 1e8)),
    "temperature_k": Plausible(200, 700, (250, 500)),
    "semi_axis_a_m": Plausible(1e-8, 0.1, (1e-5, 1e-2)),
    "friction": Plausible(-1, 1, (1e-3, 0.5), _PER_CENT),
    "central_film_m": Plausible(1e-11, 1e-3, (1e-8, 1e-5)),
    "slide_to_roll_ratio": Plausible(-2, 2, (0.01, 2), _PER_CENT),
    "viscosity_temperature_per_k": Plausible(0, 0.5, (5e-3, 0.2), (1e-2, 1e-3)),
    "oil_conductivity_w_per_m_k": Plausible(0.03, 1, (0.08, 0.7), _MILLI),
    "oil_heat_capacity_j_per_kg_k": Plausible(500, 1e4, (1e3, 5e3), _KILO),
    "oil_density_kg_per_m3": Plausible(300, 3e3, (700, 1300), _KILO),
    "oil_expansion_per_k": Plausible(0, 5e-3, (1e-4, 2e-3), _MILLI),
    "body_conductivity_w_per_m_k": _BODY_CONDUCTIVITY,
    "body_density_kg_per_m3": _BODY_DENSITY,
    "body_heat_capacity_j_per_kg_k": _BODY_CAPACITY,
    "body2_conductivity_w_per_m_k": _BODY_CONDUCTIVITY,
    "body2_density_kg_per_m3": _BODY_DENSITY,
    "body2_heat_capacity_j_per_kg_k": _BODY_CAPACITY,
}

ZERO_CELSIUS_K = 273.15


def unit_of(name: str) -> str:
    """Return the unit of a quantity by the end of its name, as pint writes it; '' without one."""
    return next((unit for end, unit in UNITS.items() if name.endswith(end)), "")


def is_quantity(value: object) -> bool:
    """Return whether a value brings a unit along, as pint's do."""
    return hasattr(value, "magnitude") and hasattr(value, "to")


def plain(value: Any, name: str) -> Any:  # noqa: ANN401 - a number, an array, or a sequence of them
    """Return a value in the unit of a quantity; values without unit stay unchanged.

    Parameters
    ----------
    value : object
        Plain, or with a unit; a sequence of such values becomes a list.
    name : str
        Of the quantity: ``load_n`` is in newtons.

    Raises
    ------
    SurfaceError
        If the unit is of another kind.
    """
    if isinstance(value, (list, tuple)) and any(map(is_quantity, value)):
        return type(value)(plain(one, name) for one in value)
    if not is_quantity(value):
        return value
    unit = unit_of(name)
    try:
        converted = value.to(unit).magnitude
    except Exception as error:  # pint's own error, which is not imported
        wanted = f"give it in {unit}" if unit else "it is a number without unit"
        raise SurfaceError(f"{name} = {value}: {wanted}, or in what converts to it") from error
    return converted


def number(value: Any, name: str, place: str = "") -> float:  # noqa: ANN401 - user input
    """Return a finite number in SI; a plain number only within the range of contacts.

    Raises SurfaceError if it is no number, or a plain number outside the range of contacts: a
    prefix forgotten.
    """
    if hasattr(value, "slopes"):  # of ehlwave.duals
        return value  # type: ignore[no-any-return]
    start = f"{place}: " if place else ""
    has_unit = is_quantity(value)
    if type(value).__name__ in ("bool", "bool_"):  # numbers of Python, and of numpy
        raise SurfaceError(f"{start}{name} = {value} is not a number")
    try:
        found = float(plain(value, name))
    except (TypeError, ValueError, OverflowError):
        raise SurfaceError(f"{start}{name} = {value!r:.60} is not a number") from None
    if not math.isfinite(found):
        raise SurfaceError(f"{start}{name} = {value} is not a finite number")
    if not has_unit:
        question(found, name, start)
    return found


def in_si(value: Any, name: str) -> Any:  # noqa: ANN401 - a value, or a list of them
    """Return the value of a key, or a list of values, in SI; question numbers as `number` does."""
    found = plain(value, name)
    if not is_quantity(value):
        for one in found if isinstance(found, (list, tuple)) else [found]:
            if isinstance(one, (bytes, bytearray)):  # lists of their codes in a namelist
                raise SurfaceError(f"{name} = {one!r:.60} is bytes: give a number, or text")
            if isinstance(one, (int, float)) and not isinstance(one, bool):
                question(one, name)
    return found


def question(value: float, name: str, start: str = "") -> None:
    """Raise SurfaceError, which asks about a forgotten prefix, outside the plausible range."""
    known = PLAUSIBLE.get(name)
    if known is None or known.low <= value <= known.high or value <= 0 <= known.low:
        return
    unit = unit_of(name).replace("**", "").replace("*", " ")
    ends = f"{known.low:g} to {known.high:g} {unit}".rstrip()
    raise SurfaceError(
        f"{start}{name} = {value:g}: {_meant(value, name, known)}contacts have {ends}"
        f"{'; plain numbers are in ' + unit if unit else ''}{see('units')}"
    )


def _meant(value: float, name: str, known: Plausible) -> str:
    low, high = known.usual
    if name == "temperature_k" and low <= value + ZERO_CELSIUS_K <= high:
        return f"did you mean {value + ZERO_CELSIUS_K:g} ({value:g} C)? "
    for factor in known.factors:
        if low <= abs(value) * factor <= high:
            return f"did you mean {_written(value, factor)}? "
    return ""


def _written(value: float, factor: float) -> str:
    """Return value times factor, as people write it: 220e9."""
    power = round(math.log10(factor))
    return (
        f"{value:g}e{power}"
        if abs(power) > 3 and "e" not in f"{value:g}"
        else f"{value * factor:g}"
    )
