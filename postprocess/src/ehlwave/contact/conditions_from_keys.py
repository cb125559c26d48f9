"""Conditions of a contact from the keys of an input file of ``ehlwave-case``."""

from collections.abc import Mapping, Sequence
from typing import Any

from ehlwave.contact.conditions import MOES_KEYS, Conditions
from ehlwave.contact.conditions_from_moes import conditions_from_moes
from ehlwave.contact.data_errors import DATA_ERRORS, OF_ERRORS, OIL_ERRORS
from ehlwave.contact.line_contact import LINE_KEYS, LOAD_KEY
from ehlwave.contact.moes_parameters import DIMENSIONAL_KEYS, moes_values
from ehlwave.contact.oil_keys import OIL_KEYS
from ehlwave.contact.starvation import OIL_OVER_FLOODED
from ehlwave.duals import math
from ehlwave.errors import SurfaceError, did_you_mean, see
from ehlwave.extras import load
from ehlwave.inputs.slip import RATIO, SLIP, refuse_both, slip_of
from ehlwave.quantities import PLAUSIBLE, number

CONTRADICTION = 0.1
"""Relative difference of the reduced modulus as it is given and as it follows from M, L and lengths
from which on they contradict each other. Data rounded to two digits differ by less."""

SCALE_KEYS = ("semi_axis_a_m", "radius_x_m", "central_film_m")
"""Lengths that M, L and D leave open."""

_OF_CONTACTS = (*DIMENSIONAL_KEYS, LOAD_KEY, *MOES_KEYS, *SCALE_KEYS)
KNOWN_KEYS = tuple(
    dict.fromkeys((*_OF_CONTACTS, *OIL_KEYS, *DATA_ERRORS, SLIP, RATIO, OIL_OVER_FLOODED))
)
"""All that conditions are given by; ``python -m studies.typed_keys`` makes types of them."""


def conditions_from_keys(
    keys: Mapping[str, Any], place: str = "conditions", *, needs_lengths: bool = True
) -> Conditions:
    """Return the conditions given by keys of ``ehlwave-case``.

    Parameters
    ----------
    keys : mapping
        Either all of ``radius_x_m``, ``radius_y_m``, ``reduced_modulus_pa``, ``load_n``,
        ``mean_speed_m_per_s``, ``viscosity_pa_s`` (reduced radii and E' with
        2/E' = (1-nu1^2)/E1 + (1-nu2^2)/E2), and ``pressure_viscosity_per_pa`` (2.2e-8 if absent)
        and ``roelands_index`` (0.68 if absent); for a line contact ``load_n_per_m`` in place of
        ``radius_y_m`` and ``load_n``; or ``load_parameter_m``, ``lubricant_parameter_l``,
        ``radius_ratio_d`` with ``semi_axis_a_m`` and, for the film thickness, ``radius_x_m``. In
        both cases ``slip_parameter`` (1 if absent) or ``slide_to_roll_ratio``, and
        ``central_film_m``, which replaces the film thickness formula where it is better known; of a
        Ree-Eyring oil ``eyring_stress_pa``, of a Carreau oil ``carreau_modulus_pa`` and
        ``carreau_exponent`` (with M, L and D also ``reduced_modulus_pa``), of which and of
        ``roelands_index`` waves under slip depend. Relative standard errors
        of data (``viscosity_error``, ``load_error`` and others of
        :mod:`ehlwave.contact.data_errors`) count in that of the film. Of a
        starved contact ``oil_over_flooded``.
    place : str
        Begins every message.
    needs_lengths : bool
        Whether M, L and D must come with ``semi_axis_a_m``; otherwise it is NaN.

    Raises
    ------
    SurfaceError
        If a key is unknown, missing or not a positive number, or both kinds are given; if a starved
        contact slides.
    RangeError
        If a starved contact lies outside the range of the law of starved contacts.
    """
    values = _checked(keys, place)
    given = tuple(values.items())
    has_moes = any(key in values for key in MOES_KEYS)
    both = ("radius_x_m", "reduced_modulus_pa")
    every = (*DIMENSIONAL_KEYS, LOAD_KEY)
    extra = [key for key in every if key in values and key not in both]
    if has_moes and extra:
        raise SurfaceError(
            f"{place}: gives both {MOES_KEYS[0]}, ... and {extra[0]}: give the Moes parameters or "
            "dimensional data"
        )
    both_loads = [key for key in ("radius_y_m", "load_n") if key in values and LOAD_KEY in values]
    if both_loads:
        raise SurfaceError(
            f"{place}: gives both {LOAD_KEY}, of a line contact, and {both_loads[0]}: remove one"
        )
    dimensional = LINE_KEYS if LOAD_KEY in values else DIMENSIONAL_KEYS
    needed = (*MOES_KEYS, *(("semi_axis_a_m",) * needs_lengths)) if has_moes else dimensional
    advice = (
        f"M, L and D need all of {', '.join(MOES_KEYS)}, and semi_axis_a_m (the Hertz semi-axis "
        "along rolling) to relate metres to the contact"
        if has_moes
        else f"give all of {', '.join(DIMENSIONAL_KEYS)} ({LOAD_KEY} in place of radius_y_m and "
        f"load_n: line contact), or {', '.join(MOES_KEYS)} with semi_axis_a_m"
    )
    missing = [key for key in needed if key not in values]
    if missing:
        raise SurfaceError(f"{place}: {missing[0]} is missing: {advice}{see('keys')}")
    if has_moes:
        if "radius_x_m" in values and "semi_axis_a_m" not in values:
            raise SurfaceError(
                f"{place}: radius_x_m beside M, L and D gives no lengths without semi_axis_a_m, "
                f"the Hertz semi-axis along rolling: give both, or remove it{see('keys')}"
            )
        values.setdefault("semi_axis_a_m", math.nan)
    else:
        if "semi_axis_a_m" in values:
            raise SurfaceError(
                f"{place}: semi_axis_a_m follows from the dimensional data: remove it"
            )
        values |= moes_values(values, place)
    found = conditions_from_moes(values, place, given)
    if has_moes:
        _refuse_contradiction(values, found, place)
    return found


def _refuse_contradiction(values: Mapping[str, float], found: Conditions, place: str) -> None:
    """Refuse lengths beside M, L and D that do not belong to them, or to the bodies.

    Raises SurfaceError where a is as large as the radius, and where E' by the lengths and the Hertz
    pressure is impossible, or differs from the given value.
    """
    own = found.modulus_pa
    if own is None:
        return
    a, radius = values["semi_axis_a_m"], values["radius_x_m"]
    if a >= radius:
        raise SurfaceError(
            f"{place}: semi_axis_a_m = {a:g} must be below radius_x_m = {radius:g}; both are in m"
            f"{see('units')}"
        )
    given, plausible = values.get("reduced_modulus_pa"), PLAUSIBLE["reduced_modulus_pa"]
    low, high = plausible.low, plausible.high
    if given is not None:
        low, high = given * (1 - CONTRADICTION), given * (1 + CONTRADICTION)
    if not low <= own <= high:
        than = "contacts have" if given is None else f"reduced_modulus_pa = {given:g} says"
        raise SurfaceError(
            f"{place}: M, L and pressure_viscosity_per_pa give a Hertz pressure of "
            f"{found.hertz_pa / 1e9:.3g} GPa. With semi_axis_a_m = {a:g} and radius_x_m = "
            f"{radius:g} it needs a reduced modulus of {own / 1e9:.3g} GPa, which is not what "
            f"{than}: change one of them, or give dimensional data{see('keys')}"
        )


def unknown_key(key: str, known: Sequence[str]) -> str:
    """Return the message about a key that does not apply to a contact."""
    what, near = f"unknown key {key}", did_you_mean(key, known)
    if key in load("ehlwave.inputs.keys").CaseKeys.__annotations__:
        what = f"{key} is a key of ehlwave.Case and input files, which is not taken here"
    elif near:
        return f"{what}{near}"
    return f"{what}; known are {', '.join(known)}"


def _checked(keys: Mapping[str, Any], place: str) -> dict[str, float]:
    refuse_both(keys, place)
    values: dict[str, float] = {}
    for key, value in keys.items():
        if key not in KNOWN_KEYS:
            raise SurfaceError(f"{place}: {unknown_key(key, KNOWN_KEYS)}{see('keys')}")
        found = number(value, key, place)
        if key == RATIO:
            key, found = SLIP, slip_of(found)
        lowest_is_zero = key in (SLIP, "radius_ratio_d", *DATA_ERRORS)
        if key == SLIP and not 0 <= found <= 2:
            raise SurfaceError(f"{place}: {SLIP} = {value} must lie in 0 to 2{see('slip')}")
        if found < 0 or (found == 0 and not lowest_is_zero):
            raise SurfaceError(
                f"{place}: {key} = {value} must be {'at least' if lowest_is_zero else 'above'} 0"
            )
        if key in DATA_ERRORS and found >= 1:
            raise SurfaceError(f"{place}: {key} = {value} is relative: 0.1 is 10 %; give 0 to 1")
        values[key] = found
    for error in values:
        keys_of = OF_ERRORS.get(error, ())
        if error not in OIL_ERRORS and keys_of and not any(key in values for key in keys_of):
            raise SurfaceError(f"{place}: {error} is that of {keys_of[0]}: give it, too")
    return values
