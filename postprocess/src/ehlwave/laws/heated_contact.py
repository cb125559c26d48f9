"""Film and friction of a contact with heat by the laws of :mod:`ehlwave.laws.heat_laws`."""

from collections.abc import Mapping, Sequence

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.heat_data import Heat
from ehlwave.duals import np, to_float
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.laws import inlet_coefficients as inlet
from ehlwave.laws.heat_laws import LOWEST_RATIO, RANGES, Heated, loading_of, warmed
from ehlwave.laws.light_lines import LIGHT
from ehlwave.laws.rigid_films import HIGHEST_L, LOWEST_ELLIPSE_M, LOWEST_M, is_rigid

EYRING_PA = (1e6, RANGES["eyring_stress_pa"][1])
POINT_RANGES = RANGES | {
    "eyring_stress_pa": EYRING_PA,
    "load_parameter_m": (RANGES["load_parameter_m"][0], 4000.0),
    "Peclet number of a surface": (0.1, np.inf),
}
"""Ranges of elliptical contacts that slide."""
ROLLING_FIT = POINT_RANGES | {
    "load_parameter_m": inlet.M_RANGE,
    "lubricant_parameter_l": inlet.L_RANGE,
    "hertz_pressure_pa": (3e8, 3.5e9),
    "film over Hertz approach": inlet.FILM_RANGE,
    "eta0 beta u^2/k": inlet.LOADING_RANGE,
    "Peclet number of a surface": (0.0, np.inf),
}
"""Contacts in pure rolling of the fit, where the warm inlet alone thins the film."""
ROLLING_RANGES = ROLLING_FIT | {
    "load_parameter_m": (inlet.M_RANGE[0], 70000.0),
    "lubricant_parameter_l": (inlet.L_RANGE[0], 40.0),
    "hertz_pressure_pa": (2.6e8, 3.5e9),
    "film over Hertz approach": (0.0, 1.8),
}
"""Ranges of elliptical contacts in pure rolling: ``scripts/study elements`` judges them."""
LINE_RANGES = RANGES | {
    "load_parameter_m": (LIGHT.load_parameter_m[0], RANGES["load_parameter_m"][1]),
    "hertz_pressure_pa": LIGHT.hertz_pressure_pa,
    "film over Hertz approach": LIGHT.film_over_approach,
    "eyring_stress_pa": EYRING_PA,
    "lubricant_parameter_l": (RANGES["lubricant_parameter_l"][0], 30.0),
}
"""Ranges of line contacts that slide."""
LINE_ROLLING_RANGES = ROLLING_RANGES | {
    "load_parameter_m": (LOWEST_M, inlet.M_RANGE[1]),
    "hertz_pressure_pa": (0.0, ROLLING_RANGES["hertz_pressure_pa"][1]),
    "film over Hertz approach": (0.0, np.inf),
    "lubricant_parameter_l": (inlet.L_RANGE[0], 35.0),
}
"""Ranges of line contacts in pure rolling."""
RIGID_RANGES = LINE_ROLLING_RANGES | {
    "load_parameter_m": (LOWEST_ELLIPSE_M, inlet.M_RANGE[1]),
    "lubricant_parameter_l": (inlet.L_RANGE[0], HIGHEST_L),
}
"""Ranges of elliptical contacts in pure rolling whose load hardly deforms the bodies."""


def heated(
    conditions: Conditions, heat: Heat, film_m: float, eyring_stress_pa: float | None
) -> Heated:
    """Return film and friction of a contact with heat.

    Parameters
    ----------
    conditions : Conditions
        From dimensional data.
    heat : Heat
        Of its oil and bodies.
    film_m : float
        Central film without heat, m.
    eyring_stress_pa : float or None
        Of a Ree-Eyring oil.

    Raises
    ------
    RangeError
        If the contact lies outside the contacts that the laws were fitted to.
    """
    is_ball = conditions.slip_parameter == 1 and not conditions.is_line and is_rigid(conditions)
    _check(conditions, heat, film_m, eyring_stress_pa, is_ball)
    return warmed(conditions, heat, film_m, eyring_stress_pa, is_ball)


def check_heat(conditions: Conditions, heat: Heat) -> None:
    """Refuse contacts that the laws are not for.

    Raises SurfaceError if the contact has no dimensional data or is starved, or `heat` is no Heat.
    """
    if not isinstance(heat, Heat):
        raise SurfaceError(
            f"Contact: heat = {heat!r} is no ehlwave.Heat; Contact.from_bodies(..., heat=True) "
            "takes the own data of oil and bodies"
        )
    if "viscosity_pa_s" not in dict(conditions.given):
        raise SurfaceError(
            "Contact: heat needs dimensional conditions (viscosity_pa_s, ...), not M, L and D"
        )


def _check(
    conditions: Conditions, heat: Heat, film_m: float, stress_pa: float | None, is_ball: bool
) -> None:
    """Refuse contacts outside the fit; `is_ball`: an ellipse that rolls and hardly deforms."""
    rolls = conditions.slip_parameter == 1
    if conditions.is_line:
        ranges = LINE_ROLLING_RANGES if rolls else LINE_RANGES
    elif is_ball:
        ranges = RIGID_RANGES
    else:
        ranges = ROLLING_RANGES if rolls else POINT_RANGES
    found = outside(quantities(conditions, heat, film_m, stress_pa), ranges)
    if found:
        raise RangeError(_outside(*found))
    lowest = inlet.LOWEST_D if rolls else LOWEST_RATIO
    if 0 < conditions.d < lowest:
        raise RangeError(_outside("radius_ratio_d", conditions.d, f"{lowest:g} to 1, or 0"))


def quantities(
    conditions: Conditions, heat: Heat, film_m: float, stress_pa: float | None
) -> dict[str, list[float]]:
    """Return the values that the laws have ranges for, by name; arguments as of :func:`heated`."""
    oil = conditions.oil
    return {
        "load_parameter_m": [conditions.m],
        "lubricant_parameter_l": [conditions.l],
        "hertz_pressure_pa": [conditions.hertz_pa],
        "pressure_viscosity_per_pa": [oil.pressure_viscosity_per_pa],
        "roelands_index": [oil.roelands_index],
        "eyring_stress_pa": [] if stress_pa is None else [stress_pa],
        "abs(slide_to_roll_ratio)": [abs(conditions.slide_to_roll_ratio)],
        "film over Hertz approach": [film_m / to_float(conditions.hertz_approach_c_m or np.nan)],
        "eta0 beta u^2/k": [loading_of(conditions, heat)],
        "effusivity of a body": [body.effusivity for body in heat.bodies],
        "Peclet number of a surface": _peclet_numbers(conditions, heat),
    }


def outside(
    values: Mapping[str, Sequence[float]], ranges: Mapping[str, tuple[float, float]]
) -> tuple[str, float, str] | None:
    """Return the name, value and range of the first of `quantities` outside its range, if any."""
    for name, found in values.items():
        low, high = ranges[name]
        for value in found:
            if not low * (1 - 1e-9) <= value <= high * (1 + 1e-9):
                return name, value, f"{low:g} to {high:g}"
    return None


def _peclet_numbers(conditions: Conditions, heat: Heat) -> list[float]:
    """Return u a rho c/(2 k) of both surfaces: their motion against conduction along it."""
    mean = to_float(dict(conditions.given)["mean_speed_m_per_s"])
    product = mean * to_float(conditions.semi_axis_a_m or np.nan)
    shares = (conditions.slip_parameter, 2 - conditions.slip_parameter)
    return [body.peclet(s * product) for body, s in zip(heat.bodies, shares, strict=True)]


def _outside(name: str, value: float, range_text: str) -> str:
    return (
        f"{name} = {value:.4g} is outside {range_text}, the range of the laws of heat: compute the "
        "contact with ehlwave-case, &heat, or leave heat out"
    )
