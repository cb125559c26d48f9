"""Names and numbers of an oil's data sheet: their checks, viscosity lines and errors."""

import contextlib
from collections.abc import Mapping
from itertools import product
from typing import Any

import numpy as np

from ehlwave.contact.alpha_estimates import State, estimate_alpha
from ehlwave.contact.viscosity_grade import (
    COLD_K,
    GRADE_ERROR,
    HOT_K,
    ISO_GRADES,
    THINNEST,
    Walther,
    hot_viscosity,
)
from ehlwave.errors import SurfaceError, did_you_mean, see
from ehlwave.quantities import number

USUAL_INDICES = {
    "mineral": (80.0, 95.0, 150.0),
    "pao": (130.0, 145.0, 170.0),
    "ester": (140.0, 150.0, 190.0),
    "polyglycol": (180.0, 220.0, 280.0),
}
"""Low, usual and high viscosity indices by the kind of base oil. Mineral: API 1509, groups I and
II, from 80; ISO 3448, tables for 95; with improvers to 150 (tribology-abc.com). PAO: about 130
(Noria, Machinery Lubrication 31106), 142 to 168 from PAO 4 to 100 (the source of
:data:`ehlwave.contact.oil_heat.PAO`). Esters: 140 to 160 (tribology-abc.com), oleates to 190;
aromatic ones lie below. Polyglycols: 180 to 280 (Beatty and Greaves, Machinery Lubrication 930);
205 of the copolymer in the source of :mod:`ehlwave.contact.measured_oils`."""

PASSED = (
    *("roelands_index", "eyring_stress_pa", "eyring_stress_error"),
    *("conductivity_w_per_m_k", "heat_capacity_j_per_kg_k"),
)
_SHEET = (
    "temperature_k",
    "iso_vg",
    "viscosity_40c_mm2_per_s",
    "viscosity_100c_mm2_per_s",
    "viscosity_index",
    "density_15c_kg_per_m3",
    "kind",
    "alpha",
    "pressure_viscosity_per_pa",
    "pressure_viscosity_error",
    *PASSED,
)
_CONTRADICTIONS = (
    ("iso_vg", "viscosity_40c_mm2_per_s"),
    ("viscosity_100c_mm2_per_s", "viscosity_index"),
    ("alpha", "pressure_viscosity_per_pa"),
)


def check_names(sheet: Mapping[str, Any]) -> None:
    """Refuse names that a data sheet does not have, and names that contradict each other."""
    for name in sheet:
        if name not in _SHEET:
            raise SurfaceError(
                f"Oil.from_grade: unknown {name}{did_you_mean(name, _SHEET)}; known are "
                f"{', '.join(_SHEET)}{see('oil')}"
            )
    for one, other in _CONTRADICTIONS:
        if one in sheet and other in sheet:
            raise SurfaceError(f"Oil.from_grade: gives {one} and {other}: remove one{see('oil')}")
    if "pressure_viscosity_error" in sheet and "pressure_viscosity_per_pa" not in sheet:
        raise SurfaceError(
            "Oil.from_grade: pressure_viscosity_error needs pressure_viscosity_per_pa (an "
            f"estimated alpha has an error of its own): give both{see('oil')}"
        )


def needed(sheet: Mapping[str, Any], name: str) -> float:
    """Return a number that a data sheet must have."""
    if name not in sheet:
        raise SurfaceError(
            f"Oil.from_grade: {name} is missing: give it, such as 313.15 (40 C){see('oil')}"
        )
    return positive(sheet[name], name)


def positive(value: Any, name: str) -> float:  # noqa: ANN401 - user input
    """Return a number above 0."""
    found = number(value, name, "Oil.from_grade")
    if not found > 0:
        raise SurfaceError(f"Oil.from_grade: {name} = {value} must be above 0")
    return found


def viscosity_lines(sheet: Mapping[str, Any], kind: str) -> tuple[Walther, list[Walther], str]:
    """Return the line of D341, its lower and upper bounds, and the source."""
    place = "Oil.from_grade"
    if "iso_vg" in sheet:
        cold = number(sheet["iso_vg"], "iso_vg", place)
        colds = [cold * (1 - GRADE_ERROR), cold * (1 + GRADE_ERROR)]
        if cold not in ISO_GRADES:
            near = min(ISO_GRADES, key=lambda grade: abs(np.log(grade / max(cold, 1e-9))))
            raise SurfaceError(
                f"{place}: iso_vg = {cold:g} is no grade of ISO 3448: take {near}, the "
                f"nearest, or give viscosity_40c_mm2_per_s{see('oil')}"
            )
        said = f"ISO VG {cold:g}"
    elif "viscosity_40c_mm2_per_s" in sheet:
        cold = needed(sheet, "viscosity_40c_mm2_per_s")
        colds, said = [cold], f"{cold:g} mm2/s at 40 C"
    else:
        raise SurfaceError(
            f"{place}: iso_vg is missing: give it, such as 68, or viscosity_40c_mm2_per_s"
            f"{see('oil')}"
        )
    if "viscosity_100c_mm2_per_s" in sheet:
        hot = needed(sheet, "viscosity_100c_mm2_per_s")
        points = [(one, hot) for one in colds]
        said += f", {hot:g} mm2/s at 100 C"
    else:
        low, index, high = USUAL_INDICES[kind]
        indices, word = [low, high], "usual viscosity index"
        if "viscosity_index" in sheet:
            index = number(sheet["viscosity_index"], "viscosity_index", place)
            indices, word = [index], "viscosity index"
        hot = hot_viscosity(cold, index)
        points = []
        for one, other in product(colds, indices):
            with contextlib.suppress(SurfaceError):  # so thin that no oil has both
                points.append((one, hot_viscosity(one, other)))
        said += f", {word} {index:g}"
    if not hot < cold:
        raise SurfaceError(
            f"{place}: viscosity_100c_mm2_per_s = {hot:g} must be below that at 40 C, "
            f"{cold:g}; mineral oils have {hot_viscosity(cold, USUAL_INDICES['mineral'][1]):.3g}"
        )
    lines = [Walther.through((COLD_K, one), (HOT_K, other)) for one, other in points if other < one]
    return Walther.through((COLD_K, cold), (HOT_K, hot)), lines, said


def viscosity_error(line: Walther, ends: list[Walther], at_k: float, is_grade: bool) -> float:
    """Return the relative error of a viscosity: largest of the ends, and of the extrapolation.

    The limit of a grade is at least its limit at 40 C.
    """
    known = line.viscosity(at_k)
    found = [GRADE_ERROR if is_grade else 0.0]
    for end in ends:
        try:
            found.append(abs(end.viscosity(at_k) / known - 1))
        except SurfaceError:  # thinner than ASTM D341 has it
            found.append(1 - THINNEST / known)
    return max(found) + line.extrapolation_error(at_k)


def alpha_of(sheet: Mapping[str, Any], state: State) -> tuple[float, float, str]:
    """Return alpha, its relative error and its source."""
    if "pressure_viscosity_per_pa" in sheet:
        alpha = needed(sheet, "pressure_viscosity_per_pa")
        error = number(
            sheet.get("pressure_viscosity_error", 0.0), "pressure_viscosity_error", "Oil"
        )
        return alpha, error, "given"
    return estimate_alpha(sheet.get("alpha", "gold"), state)
