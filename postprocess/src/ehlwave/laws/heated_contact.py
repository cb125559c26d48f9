"""Film and friction of a contact with heat by the laws of :mod:`ehlwave.laws.heat_laws`."""

import numpy as np

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.heat_data import Heat
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.laws.heat_laws import LOWEST_RATIO, RANGES, Heated, loading_of, warmed


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
    _check(conditions, heat, film_m, eyring_stress_pa)
    return warmed(conditions, heat, film_m, eyring_stress_pa)


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


def _check(conditions: Conditions, heat: Heat, film_m: float, stress_pa: float | None) -> None:
    """Refuse contacts outside the fit."""
    oil = conditions.oil
    values = {
        "load_parameter_m": [conditions.m],
        "lubricant_parameter_l": [conditions.l],
        "hertz_pressure_pa": [conditions.hertz_pa],
        "pressure_viscosity_per_pa": [oil.pressure_viscosity_per_pa],
        "roelands_index": [oil.roelands_index],
        "eyring_stress_pa": [] if stress_pa is None else [stress_pa],
        "abs(slide_to_roll_ratio)": [abs(conditions.slide_to_roll_ratio)],
        "film over Hertz approach": [film_m / float(conditions.hertz_approach_c_m or np.nan)],
        "eta0 beta u^2/k": [loading_of(conditions, heat)],
        "effusivity of a body": [body.effusivity for body in heat.bodies],
    }
    for name, found in values.items():
        low, high = RANGES[name]
        for value in found:
            if not low * (1 - 1e-9) <= value <= high * (1 + 1e-9):
                raise RangeError(_outside(name, value, f"{low:g} to {high:g}"))
    if 0 < conditions.d < LOWEST_RATIO:
        raise RangeError(_outside("radius_ratio_d", conditions.d, f"{LOWEST_RATIO:g} to 1, or 0"))


def _outside(name: str, value: float, range_text: str) -> str:
    return (
        f"{name} = {value:.4g} is outside {range_text}, the range of the laws of heat: compute the "
        "contact with ehlwave-case, &heat, or leave heat out"
    )
