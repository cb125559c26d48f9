"""Films and friction computed by ``ehlwave-case``, for contacts that no law holds for."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.heat_data import CONDUCTIVITY_ERROR, Heat
from ehlwave.errors import ProgramError
from ehlwave.laws.answers import Film
from ehlwave.laws.heat_laws import Heated, warmed
from ehlwave.laws.inlet_warming import inlet_warming
from ehlwave.laws.isothermal_friction import isothermal_error_by_data
from ehlwave.programs.case_input import case_keys
from ehlwave.programs.computing import Result, run_case
from ehlwave.programs.progress import Following

ACCURACY, WARM_ACCURACY, DATA_ACCURACY = 0.005, 0.01, 0.03
"""Relative errors of the central film that are asked for: without heat, with heat, and where only
the effect of changed data counts. Halving it takes four times as long.
"""
DATA_SHARE = 10
"""Film error by errors of the oil's data over the accuracy that suffices beside it."""
LARGE_MINIMUM_ERROR = 0.05
"""Error of the smallest film above which the grid is refined; at least four times the accuracy."""
LARGEST_LINE = 8192
"""Cells of the refined grids of line contacts at most."""
LARGEST_GRID, STARVED_SHARE, WARM_SHARE = 2**18, 2, 4
"""Cells of other contacts (3 s on two cores), and divisors for starved and warm contacts.
"""

NEGLIGIBLE_LOSS = 0.002
"""Loss of the film by the warm inlet below which contacts in pure rolling are computed without
heat: less than the error of the film, and heat takes many times as long."""

SOURCE = "computed by ehlwave-case"


def computed_film(
    conditions: Conditions, heat: Heat | None = None, progress: Following = None
) -> Film:
    """Return films and friction of a smooth contact, computed.

    Errors are the program's estimates, and the effect of errors of the oil's data.

    Parameters
    ----------
    conditions : Conditions
        Contact of any shape, oil and slip; flooded or starved.
    heat : Heat, optional
        Heat data; film and friction are those with heat.
    progress : callable or False, optional
        As of :meth:`ehlwave.Case.run`.

    Raises
    ------
    ProgramError
        If there is no program, or if it does not solve the contact.
    RangeError
        If the central film is given.
    """
    if heat is not None and conditions.rolls:
        loss = inlet_warming(conditions, heat=heat).loss
        if loss < NEGLIGIBLE_LOSS:
            return _slightly_warmed(computed_film(conditions, None, progress), loss)
    found = smooth_case(conditions, heat, progress)
    central, minimum = found["central_film_moes"], found["minimum_film"]
    minimum *= central / found["central_film"]
    known = math.isfinite(_number(found, "minimum_film_error"))
    by_data, friction_by_data = _by_data(conditions, heat, found, progress)
    scale = conditions.metres_per_moes
    friction = _friction(conditions, found)
    friction_error = None
    if friction is not None:
        friction_error = _number(found, "friction_error") + friction_by_data
        friction_error = friction_error if math.isfinite(friction_error) else 1.0
    error = _central_error(found) + by_data
    return Film(
        central_m=None if scale is None else central * scale,
        minimum_m=minimum * scale if scale and known else None,
        central_moes=central,
        minimum_moes=minimum if known else math.nan,
        central_error=error,
        minimum_error=found["minimum_film_error"] + by_data if known else math.nan,
        friction=friction,
        friction_error=friction_error,
        source=SOURCE,
        rolling_resistance_coefficient=_known(found, "rolling_resistance_coefficient"),
        rolling_resistance=_known(found, "rolling_resistance"),
        rolling_resistance_error=_known(found, "rolling_resistance_error"),
        heated=None if heat is None else _heated(found, by_data, friction, friction_error),
    )


def _slightly_warmed(cold: Film, loss: float) -> Film:
    """Return a film without heat as a film with heat; its errors grow by the loss."""
    central, minimum = cold.central_error + loss, cold.minimum_error + loss
    return replace(
        cold,
        central_error=central,
        minimum_error=minimum,
        heated=Heated(1.0, 1.0, 1.0, central, minimum),
    )


def smooth_case(
    conditions: Conditions, heat: Heat | None = None, progress: Following = None
) -> Result:
    """Return the program's result; the grid is refined where the smallest film needs it."""
    keys = case_keys(conditions, heat)
    accuracy = max(ACCURACY if heat is None else WARM_ACCURACY, conditions.oil_error / DATA_SHARE)
    found = run_case({**keys, "accuracy": accuracy}, progress)
    largest = LARGEST_GRID // (STARVED_SHARE if conditions.is_starved else 1)
    largest //= 1 if heat is None else WARM_SHARE
    while _number(found, "minimum_film_error") > max(LARGE_MINIMUM_ERROR, 4 * accuracy):
        # The smallest film lies in the side lobes: cells across are refined first.
        x, y = found["cells_x"], found["cells_y"]
        finer = {"cells_x": x if y < x else 2 * x}
        if not conditions.is_line:
            finer["cells_y"] = 2 * y
        cells = finer["cells_x"] * finer.get("cells_y", 1)
        if cells > (LARGEST_LINE if conditions.is_line else largest):
            break
        try:
            found = run_case({**keys, **finer, "scheme": found["scheme"]}, progress)
        except ProgramError:
            break  # the result on the coarser grid holds, with its error
    return found


def _number(found: Mapping[str, Any], key: str) -> float:
    value = found.get(key)
    return math.nan if value is None else float(value)


def _known(found: Result, key: str) -> float | None:
    value = _number(found, key)
    return value if math.isfinite(value) else None


def _central_error(found: Result) -> float:
    """Return the error of the central film by all parts that the program has estimated."""
    parts = ("mesh", "meniscus", "domain", "time", "algebraic")
    values = [_number(found, f"film_error_{part}") for part in parts]
    return sum(value for value in values if math.isfinite(value))


def _friction(c: Conditions, found: Result) -> float | None:
    """Return the size of the friction coefficient; None in pure rolling."""
    value = found.get("friction_coefficient")
    return None if value is None or c.rolls else abs(float(value))


def _by_data(
    c: Conditions, heat: Heat | None, found: Result, progress: Following
) -> tuple[float, float]:
    """Return relative errors of film and friction by errors of the oil's data.

    The film's share of viscosity and alpha is `oil_error`. Other shares have a closed form in pure
    rolling and for Ree-Eyring oils, and are differences to contacts computed with changed data for
    others.
    """
    given = dict(c.given)
    changed: list[tuple[Conditions, Heat | None]] = []
    for key, error in (
        ("viscosity_pa_s", "viscosity_error"),
        ("pressure_viscosity_per_pa", "pressure_viscosity_error"),
    ):
        if given.get(error) and key in given and not c.rolls:
            values = given | {key: given[key] * (1 + given[error])}
            oil = c.oil
            if key == "pressure_viscosity_per_pa":
                oil = replace(oil, pressure_viscosity_per_pa=values[key])
            changed.append((replace(c, given=tuple(values.items()), oil=oil), heat))
    if heat is not None and heat.oil_conductivity_error:
        more = 1 + getattr(heat, CONDUCTIVITY_ERROR)
        conductivity = heat.oil_conductivity_w_per_m_k * more
        changed.append((c, replace(heat, oil_conductivity_w_per_m_k=conductivity)))
    film, friction = c.oil_error, 0.0
    if not changed:
        return film, friction
    if c.rolls or "eyring_stress_pa" in given:
        return _by_laws(c, heat, found)
    first, *others = (
        run_case({**case_keys(one, its_heat), "accuracy": DATA_ACCURACY}, progress)
        for one, its_heat in ((c, heat), *changed)
    )
    for (one, _), other in zip(changed, others, strict=True):
        if one is c:
            film += abs(other["central_film_moes"] / first["central_film_moes"] - 1)
        before, after = first.get("friction_coefficient"), other.get("friction_coefficient")
        if before and after:
            friction += abs(after / before - 1)
    return film, friction


def _by_laws(c: Conditions, heat: Heat | None, found: Result) -> tuple[float, float]:
    """Return the same errors by the laws of warm inlets and of the friction of an even film."""
    stress_pa = dict(c.given).get("eyring_stress_pa")
    if heat is None:
        film_moes = float(found["central_film_moes"])
        return c.oil_error, isothermal_error_by_data(c, film_moes, float(stress_pa or math.nan))
    cold_m = found["isothermal_central_film"] * float(c.hertz_approach_c_m or math.nan)
    law = warmed(c, heat, cold_m, stress_pa)
    return c.oil_error + law.film_error_by_data, law.friction_error_by_data


def _heated(
    found: Result, by_data: float, friction: float | None, friction_error: float | None
) -> Heated:
    """Return the effect of heat; of friction without heat the program has the value."""
    factor = found["central_film"] / found["isothermal_central_film"]
    cold = found.get("isothermal_friction_coefficient")
    walls = (_number(found, f"central_rise_wall_{k}_k") for k in (1, 2))
    return Heated(
        film_factor=factor,
        inlet_factor=factor,
        minimum_factor=None,
        film_error=_central_error(found) + by_data,
        minimum_error=math.nan,
        friction=friction,
        friction_error=friction_error,
        isothermal_friction=None if friction is None or cold is None else abs(float(cold)),
        rise_mid_film_k=_number(found, "central_rise_mid_film_k"),
        rise_surfaces_k=max(walls),
    )
