"""Conditions of a contact from the keys of an input file of ``ehlwave-case``.

Equation numbers are those of ``src/theory.md``.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from scipy.special import ellipe

from ehlwave.contact.conditions import (
    FIT_ERROR,
    FIT_TEXT,
    GIVEN_TEXT,
    LINE_FIT_ERROR,
    LINE_FIT_TEXT,
    MOES_KEYS,
    Conditions,
)
from ehlwave.contact.line_contact import LINE_KEYS, LOAD_KEY, line_values
from ehlwave.contact.oils import Oil
from ehlwave.contact.scales import (
    ellipticity,
    first_integral,
    moes_film,
    moes_per_film,
    pressure_factor,
)
from ehlwave.errors import SurfaceError
from ehlwave.extras import load
from ehlwave.hints import did_you_mean, see
from ehlwave.quantities import PLAUSIBLE, number
from ehlwave.slip import RATIO, SLIP, refuse_both, slip_of
from ehlwave.starvation import FILM_BAR, UNDER_SLIP, film_over_flooded

SMALLEST_RADIUS_RATIO = 0.005

ROUND_OFF = 1e-12
"""Relative: D of equal radii is 1 but for it."""

CONTRADICTION = 0.1
"""Relative difference of the reduced modulus as it is given and as it follows from M, L and lengths
from which on they contradict each other. Data rounded to two digits differ by less."""

DIMENSIONAL_KEYS = (
    "radius_x_m",
    "radius_y_m",
    "reduced_modulus_pa",
    "load_n",
    "mean_speed_m_per_s",
    "viscosity_pa_s",
)
SCALE_KEYS = ("semi_axis_a_m", "radius_x_m", "central_film_m")
"""Lengths that M, L and D leave open."""

CARREAU_KEYS = ("carreau_modulus_pa", "carreau_exponent")
OIL_KEYS = ("pressure_viscosity_per_pa", "roelands_index", "eyring_stress_pa", *CARREAU_KEYS)

DATA_ERRORS = ("viscosity_error", "pressure_viscosity_error")
"""Relative errors of what the oil is known by; the film carries them."""

OIL_OVER_FLOODED = "oil_over_flooded"

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
        and ``roelands_index`` (0.68 if absent), of a line contact ``load_n_per_m`` in place of
        ``radius_y_m`` and ``load_n``;
        or ``load_parameter_m``, ``lubricant_parameter_l``, ``radius_ratio_d`` with
        ``semi_axis_a_m`` and, for the film thickness, ``radius_x_m``. In both cases
        ``slip_parameter`` (1 if absent) or ``slide_to_roll_ratio``, and ``central_film_m``, which
        replaces the film thickness formula where it is better known; of a Ree-Eyring oil
        ``eyring_stress_pa``, of a Carreau oil ``carreau_modulus_pa`` and ``carreau_exponent``
        (with M, L and D also ``reduced_modulus_pa``), of which and of ``roelands_index`` waves
        under slip depend.
        Relative errors of the oil's data, ``viscosity_error`` and ``pressure_viscosity_error``,
        count in that of the film. Of a starved contact ``oil_over_flooded``.
    place : str
        Begins every message.
    needs_lengths : bool
        Whether M, L and D must come with ``semi_axis_a_m``; NaN stands for it otherwise.

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
        values.setdefault("semi_axis_a_m", math.nan)
    else:
        if "semi_axis_a_m" in values:
            raise SurfaceError(
                f"{place}: semi_axis_a_m follows from the dimensional data: remove it"
            )
        values |= moes_values(values, place)
    found = _complete(values, place, given)
    if has_moes:
        _refuse_contradiction(values, found, place)
    return found


def moes_values(values: Mapping[str, float], place: str) -> dict[str, float]:
    """Return M, L, D and the semi-axis a, m, that dimensional data give, eq. (1) and (2)."""
    alpha = values.get("pressure_viscosity_per_pa", Oil.pressure_viscosity_per_pa)
    if LOAD_KEY in values:
        return line_values(values, alpha)
    radius_x, radius_y, modulus, load, speed, viscosity = (values[key] for key in DIMENSIONAL_KEYS)
    speed_2u = viscosity * 2 * speed / (modulus * radius_x)
    load_w = load / (modulus * radius_x**2)
    d = _checked_ratio(
        radius_x / radius_y, f"{place}: radius_x_m = {radius_x:g} and radius_y_m = {radius_y:g}"
    )
    kappa = ellipticity(d)
    radius = 1 / (1 / radius_x + 1 / radius_y)
    e = float(ellipe(1 - kappa**2))
    return {
        "load_parameter_m": load_w * speed_2u**-0.75,
        "lubricant_parameter_l": alpha * modulus * speed_2u**0.25,
        "radius_ratio_d": d,
        "semi_axis_a_m": (3 * load * radius / modulus * 2 * kappa * e / math.pi) ** (1 / 3),
    }


def _complete(
    values: Mapping[str, float], place: str, given: tuple[tuple[str, float], ...]
) -> Conditions:
    """Add what follows from M, L, D and the lengths, eq. (1) to (6)."""
    m, l, d = (values[key] for key in MOES_KEYS)  # noqa: E741
    d = _checked_ratio(d, f"{place}: radius_ratio_d = {d:g}")
    semi_axis_a_m, film_m = values["semi_axis_a_m"], values.get("central_film_m")
    slip, oil = values.get("slip_parameter", 1.0), _oil(values, place)
    oil_error = _oil_error(values, m, l, d)
    kappa = ellipticity(d) if d > 0 else 0.0
    ratio = _film_ratio(values, m, l, d, place)
    starved = FILM_BAR / ratio if OIL_OVER_FLOODED in values else 0.0
    approach, metres_per_moes = None, None
    source, error = GIVEN_TEXT, 0.0
    if "radius_x_m" in values and math.isfinite(semi_axis_a_m):
        k, e = first_integral(kappa), float(ellipe(1 - kappa**2))  # E = 1 of a line contact
        approach = semi_axis_a_m**2 * (1 + d) / (2 * values["radius_x_m"]) * k / e
        metres_per_moes = approach / moes_per_film(m, kappa)
        if film_m is None:
            film_m = moes_film(m, l, d) * metres_per_moes * ratio
            source, error = (FIT_TEXT, FIT_ERROR) if d > 0 else (LINE_FIT_TEXT, LINE_FIT_ERROR)
            error += oil_error + starved
            if starved:
                source += f", times R = {ratio:.3g} of the law of starved contacts"
    if film_m is None:
        source = "unknown: give central_film_m or radius_x_m"
    found = Conditions(
        m=m,
        l=l,
        d=d,
        kappa=kappa,
        gamma=pressure_factor(kappa) if d > 0 else math.sqrt(m),
        slip_parameter=slip,
        semi_axis_a_m=semi_axis_a_m,
        hertz_approach_c_m=approach,
        central_film_m=film_m,
        film_source=source,
        oil=oil,
        metres_per_moes=metres_per_moes,
        central_film_error=None if film_m is None else error,
        oil_error=oil_error,
        oil_over_flooded=values.get(OIL_OVER_FLOODED),
        film_ratio=ratio,
        given=given,
    )
    # The formulas are of oils that nothing thins.
    return _with_loss(found) if film_m is not None and not found.has_given_film else found


def _with_loss(found: Conditions) -> Conditions:
    """Return conditions with a film by formula, whose error counts thinning in the inlet, too."""
    error, loss = found.central_film_error, found.film_loss
    if error is not None and math.isfinite(loss):
        return replace(found, central_film_error=error + loss)
    source = f"{found.film_source}, which does not know how much the oil thins"
    return replace(found, central_film_error=None, film_source=source)


def _film_ratio(values: Mapping[str, float], m: float, l: float, d: float, place: str) -> float:  # noqa: E741
    """Return R of a starved contact, 1 of a flooded one."""
    if OIL_OVER_FLOODED not in values:
        return 1.0
    if values.get(SLIP, 1.0) != 1:
        raise SurfaceError(f"{place}: {UNDER_SLIP}")
    if d == 0:
        raise SurfaceError(
            f"{place}: {OIL_OVER_FLOODED} of a line contact: the law of starved contacts was "
            "fitted to elliptical ones, D of 0.1 to 1: compute it with ehlwave-case"
        )
    if "central_film_m" in values:
        raise SurfaceError(
            f"{place}: gives both {OIL_OVER_FLOODED} and central_film_m: a given film is that of "
            "the contact as it runs: remove one"
        )
    return float(film_over_flooded(values[OIL_OVER_FLOODED], m, l, d))


def film_change(m: float, l: float, d: float, viscosity: float, alpha: float) -> float:  # noqa: E741
    """Return the film over that before, where viscosity and alpha become so many times as large.

    By the film formula: M goes with the viscosity as eta^(-3/4), of lines eta^(-1/2), L as
    alpha eta^(1/4), and the film in the Moes scale is in units that go as eta^(1/2).
    """
    power = -0.5 if d == 0 else -0.75
    other = moes_film(m * viscosity**power, l * alpha * viscosity**0.25, d)
    return float(other * viscosity**0.5 / moes_film(m, l, d))


def _oil_error(values: Mapping[str, float], m: float, l: float, d: float) -> float:  # noqa: E741
    """Return by how much the film changes, relative, as the oil's data change by their errors."""

    def change(viscosity: float, alpha: float) -> float:
        return abs(film_change(m, l, d, viscosity, alpha) - 1)

    eta, alpha = (values.get(key, 0.0) for key in DATA_ERRORS)
    return sum(
        max(change(1 + a, 1 + b), change(1 - a, 1 - b))
        for a, b in ((eta, 0.0), (0.0, alpha))
        if a + b
    )


def _oil(values: Mapping[str, float], place: str) -> Oil:
    alpha = values.get("pressure_viscosity_per_pa", Oil.pressure_viscosity_per_pa)
    index = values.get("roelands_index", Oil.roelands_index)
    given = [key for key in ("eyring_stress_pa", *CARREAU_KEYS) if key in values]
    if not given:
        return Oil(alpha, index)
    if given not in (["eyring_stress_pa"], [*CARREAU_KEYS]):
        raise SurfaceError(
            f"{place}: {', '.join(given)}: give eyring_stress_pa of a Ree-Eyring oil, or "
            f"{' and '.join(CARREAU_KEYS)} of a Carreau oil"
        )
    if "reduced_modulus_pa" not in values:
        raise SurfaceError(f"{place}: {given[0]} needs reduced_modulus_pa beside M, L and D")
    exponent = values.get("carreau_exponent")
    if exponent is not None and exponent > 1:
        raise SurfaceError(f"{place}: carreau_exponent = {exponent:g} must be at most 1")
    return Oil(alpha, index, values[given[0]] * values["reduced_modulus_pa"], exponent)


def _checked_ratio(d: float, given: str) -> float:
    """Return D, 1 where radii are equal but for round-off; refuse what is out of range."""
    if abs(d - 1) <= ROUND_OFF:
        return 1.0
    if d != 0 and not SMALLEST_RADIUS_RATIO <= d <= 1:
        raise SurfaceError(
            f"{given}: D = Rx/Ry = {d:.10g} must lie in {SMALLEST_RADIUS_RATIO} to 1, or be 0 "
            "(line contact); for Rx > Ry the contact is wider along rolling, which is outside the "
            f"model's range{see('keys')}"
        )
    return d


def _refuse_contradiction(values: Mapping[str, float], found: Conditions, place: str) -> None:
    """Refuse lengths beside M, L and D that do not belong to them, or to the bodies.

    Raises SurfaceError where a is as large as the radius, and where E' by the lengths and the Hertz
    pressure is that of no body, or another one than is given.
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
    """Return what is to be said of a key that a contact does not take."""
    what = f"unknown key {key}{did_you_mean(key, known)}"
    if key in load("ehlwave.keys").CaseKeys.__annotations__:
        what = f"{key} is a key of ehlwave.Case and input files, which is not taken here"
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
    return values
