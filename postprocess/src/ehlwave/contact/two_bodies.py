"""Two bodies, and the contact that they make: reduced radii, reduced modulus, mean speed and slip.

1/Rx = 1/R1x + 1/R2x, 1/Ry = 1/R1y + 1/R2y, 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, and the mean
speed (u1 + u2)/2: the definitions of ``src/theory.md``, section 1.
"""

import math
from collections.abc import Mapping
from typing import Any

from ehlwave.contact.bodies import FLAT, Body
from ehlwave.contact.conditions import MOES_KEYS
from ehlwave.contact.conditions_from_keys import KNOWN_KEYS, unknown_key
from ehlwave.contact.data_sheet import Oil
from ehlwave.contact.line_contact import LOAD_KEY
from ehlwave.contact.moes_parameters import ROUND_OFF
from ehlwave.errors import SurfaceError, see
from ehlwave.inputs.slip import RATIO, SLIP, slip_of
from ehlwave.quantities import number, plain

BODY_KEYS = ("load_n", LOAD_KEY, "length_m", "speeds_m_per_s", "mean_speed_m_per_s", SLIP, RATIO)
"""Keys of the contact of two bodies, besides the oil."""

FROM_BODIES = ("radius_x_m", "radius_y_m", "reduced_modulus_pa", "semi_axis_a_m")
"""Keys that follow from the bodies."""

Names = list[tuple[str, str, float]]


def contact_keys(
    body1: Body, body2: Body, oil: Oil | None, given: Mapping[str, Any]
) -> tuple[dict[str, Any], Names]:
    """Return keys of the contact of two bodies, and the users' names of renamed keys.

    Parameters
    ----------
    body1, body2 : Body
        The rough body first.
    oil : Oil or None
        In place of the keys of an oil.
    given : mapping
        ``load_n``, of lines with ``length_m``, or ``load_n_per_m``; ``speeds_m_per_s`` (u1, u2), or
        ``mean_speed_m_per_s`` with ``slide_to_roll_ratio`` or ``slip_parameter``. Others stay.

    Raises
    ------
    SurfaceError
        If the bodies do not touch as a contact that the model has, or data are missing.
    """
    for name, body in (("body1", body1), ("body2", body2)):
        if not isinstance(body, Body):
            raise SurfaceError(f"Contact: {name} = {body!r} is no ehlwave.Body{see('bodies')}")
    _check_names(oil, given)
    keys: dict[str, Any] = {key: value for key, value in given.items() if value is not None}
    keys |= {} if oil is None else oil.keys()
    keys["reduced_modulus_pa"] = 2 / sum(
        (1 - body.poisson_ratio**2) / body.elastic_modulus_pa  # type: ignore[operator]
        for body in (body1, body2)
    )
    across = _sum(body1.radius_y_m, body2.radius_y_m, "radius_y_m", may_be_flat=True)
    keys["radius_x_m"] = _sum(body1.radius_x_m, body2.radius_x_m, "radius_x_m", may_be_flat=False)
    names: Names = [(key, f"reduced {key}", 1.0) for key in FROM_BODIES[:2]]
    if math.isinf(across):
        _take_line_load(keys, names)
    else:
        keys["radius_y_m"] = across
        _refuse_line_load(keys, keys["radius_x_m"] / across)
    _take_speeds(keys, names)
    _refuse_missing(keys)
    return keys, names


def _check_names(oil: Oil | None, given: Mapping[str, Any]) -> None:
    """Refuse unknown names, and names given by the bodies or the oil."""
    others = (*FROM_BODIES, *MOES_KEYS)
    known = [key for key in dict.fromkeys((*BODY_KEYS, *KNOWN_KEYS)) if key not in others]
    if oil is not None and not isinstance(oil, Oil):
        raise SurfaceError(f"Contact: oil = {oil!r} is no ehlwave.Oil{see('oil')}")
    said = {} if oil is None else oil.keys()
    for key in given:
        if key in FROM_BODIES:
            raise SurfaceError(f"Contact: {key} follows from the bodies: remove it{see('bodies')}")
        if key not in known:
            raise SurfaceError(f"Contact: {unknown_key(key, known)}{see('bodies')}")
        if key in said:
            raise SurfaceError(f"Contact: gives oil and {key}: remove one{see('oil')}")


def _sum(first: float, second: float, name: str, may_be_flat: bool) -> float:
    curvature = 1 / first + 1 / second
    if curvature < 0 or (curvature == 0 and not (may_be_flat and math.isinf(first))):
        start = f"Contact: {name} = {first:g} and {second:g} m: "
        if math.isinf(first) and math.isinf(second):
            text = f"both bodies are flat in this direction: give one a radius, such as {name}=0.01"
        elif max(first, second) > 0:
            larger = -1.1 * max(first, second)
            text = f"the hollow one must have the larger radius, such as {name}={larger:.4g}"
        else:
            text = (
                "bodies that are both hollow do not touch: radii of balls and rollers are above 0"
            )
        raise SurfaceError(f"{start}{text}{see('bodies')}")
    return 1 / curvature if curvature > 0 else FLAT


def _take_line_load(keys: dict[str, Any], names: Names) -> None:
    load, length = keys.pop("load_n", None), keys.pop("length_m", None)
    if LOAD_KEY in keys:
        for key, value in (("load_n", load), ("length_m", length)):
            if value is not None:
                raise SurfaceError(f"Contact: gives {key} and {LOAD_KEY}: remove one")
        return
    if load is None or length is None:
        missing = "load_n" if load is None else "length_m"
        raise SurfaceError(
            f"Contact: {missing} is missing: both bodies are flat across rolling (radius_y_m), a "
            f"line contact: give load_n and length_m, such as length_m=0.01{see('bodies')}"
        )
    total, over = number(load, "load_n", "Contact"), number(length, "length_m", "Contact")
    if not (total > 0 and over > 0):
        raise SurfaceError(f"Contact: load_n = {load} and length_m = {length} must be above 0")
    keys[LOAD_KEY] = total / over
    names.append((LOAD_KEY, "load_n", over))


def _refuse_line_load(keys: Mapping[str, Any], ratio: float) -> None:
    for key in (LOAD_KEY, "length_m"):
        if key in keys:
            raise SurfaceError(
                f"Contact: {key} is of line contacts, and the bodies are curved across rolling: "
                "give load_n alone, or leave radius_y_m out"
            )
    if ratio > 1 + ROUND_OFF:
        raise SurfaceError(
            f"Contact: reduced radii have Rx/Ry = {ratio:.4g}: the contact is wider along rolling "
            "than across, which is outside the model (Rx/Ry of 0.005 to 1): radius_x_m is the one "
            f"along rolling: exchange radius_x_m and radius_y_m where it is not{see('bodies')}"
        )


def _refuse_missing(keys: Mapping[str, Any]) -> None:
    load = LOAD_KEY if LOAD_KEY in keys else "load_n"
    for key in (load, "mean_speed_m_per_s", "viscosity_pa_s"):
        if key not in keys:
            name = key.replace("mean_speed", "speeds")
            raise SurfaceError(
                f"Contact: {name} is missing: two bodies need load_n (lines: load_n_per_m), "
                "speeds_m_per_s=(u1, u2) or mean_speed_m_per_s, and oil or viscosity_pa_s"
                f"{see('bodies')}"
            )


def _take_speeds(keys: dict[str, Any], names: Names) -> None:
    """Replace speeds of both surfaces by their mean and the slip of the first."""
    if "speeds_m_per_s" not in keys:
        return
    speeds = keys.pop("speeds_m_per_s")
    others = [key for key in ("mean_speed_m_per_s", SLIP, RATIO) if key in keys]
    if others:
        raise SurfaceError(f"Contact: {others[0]} follows from speeds_m_per_s: remove one")
    try:
        one, two = plain(speeds, "speeds_m_per_s")
    except (TypeError, ValueError):
        one = speeds if isinstance(speeds, (int, float)) and speeds > 0 else 1
        raise SurfaceError(
            f"Contact: speeds_m_per_s = {speeds!r:.60}: give both, (u1, u2), in pure rolling "
            f"({one}, {one}){see('slip')}"
        ) from None
    first, second = (number(u, "speeds_m_per_s", "Contact") for u in (one, two))
    for speed in (first, second):
        number(abs(speed), "speeds_m_per_s", "Contact")
    start = f"Contact: speeds_m_per_s = ({first:g}, {second:g})"
    if first == -second:
        what = "both are at rest" if first == 0 else "they are opposite and equal"
        raise SurfaceError(
            f"{start}: {what}, so that no oil is drawn in: give a mean other than 0, such as "
            f"({abs(first) or 1:g}, {abs(second) or 1:g})"
        )
    if first * second < 0:
        raise SurfaceError(
            f"{start}: the surfaces move in opposite directions, which is outside the model "
            f"(slide_to_roll_ratio of -2 to 2): give speeds of one sign, such as ({abs(first):g}, "
            f"{abs(second):g}){see('slip')}"
        )
    mean = (first + second) / 2
    keys["mean_speed_m_per_s"] = abs(mean)
    keys[SLIP] = slip_of((first - second) / mean)
    names.append(("mean_speed_m_per_s", "mean of speeds_m_per_s", 1.0))
