"""Two bodies, and the contact that they make: reduced radii, reduced modulus, mean speed and slip.

1/Rx = 1/R1x + 1/R2x, 1/Ry = 1/R1y + 1/R2y, 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, and the mean
speed (u1 + u2)/2: the definitions of ``src/theory.md``, section 1.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ehlwave.contact.line_contact import LOAD_KEY
from ehlwave.contact.materials import material as known_material
from ehlwave.contact.slip import RATIO, SLIP, slip_of
from ehlwave.errors import SurfaceError
from ehlwave.hints import see
from ehlwave.quantities import number, plain

FLAT = math.inf

BODY_KEYS = ("load_n", LOAD_KEY, "length_m", "speeds_m_per_s", "mean_speed_m_per_s", SLIP, RATIO)
"""What users say of the contact of two bodies, besides the oil."""

FROM_BODIES = ("radius_x_m", "radius_y_m", "reduced_modulus_pa", "semi_axis_a_m")
"""What follows from them."""


@dataclass(frozen=True)
class Body:
    """One of the two bodies of a contact: its radii of curvature and its elastic constants.

    Parameters
    ----------
    radius_x_m : float
        Radius of curvature in the rolling direction, m; flat if left out, negative if hollow.
    radius_y_m : float
        The same across.
    elastic_modulus_pa, poisson_ratio : float, optional
        Young's modulus, Pa, and Poisson's ratio.
    material : str, optional
        In place of both: ``"steel"``, ``"silicon nitride"``, ``"glass"``, ``"sapphire"``,
        ``"tungsten carbide"``, ``"bronze"``, ... (:data:`ehlwave.contact.materials.MATERIALS`).

    Raises
    ------
    SurfaceError
        If the material is not known, or a number is none that a body has.

    Examples
    --------
    A ball, and a disc that is flat:

    >>> import ehlwave
    >>> ball = ehlwave.Body(radius_x_m=9.525e-3, radius_y_m=9.525e-3, material="steel")
    >>> disc = ehlwave.Body(elastic_modulus_pa=8.2e10, poisson_ratio=0.206)
    >>> disc
    Body(flat, E = 82 GPa, nu = 0.206)
    """

    radius_x_m: float = FLAT
    radius_y_m: float = FLAT
    elastic_modulus_pa: float | None = None
    poisson_ratio: float | None = None
    material: str | None = None

    def __post_init__(self) -> None:
        """Check, convert, and look the material up."""
        for name in ("radius_x_m", "radius_y_m"):
            object.__setattr__(self, name, _radius(getattr(self, name), name))
        names = ("elastic_modulus_pa", "poisson_ratio")
        given = [name for name in names if getattr(self, name) is not None]
        if self.material is not None:
            if given:
                raise SurfaceError(
                    f"Body: gives material = {self.material!r} and {given[0]}: remove one"
                )
            found = known_material(self.material)
            values = dict(zip(names, found[:2], strict=True))
        elif len(given) < 2:
            missing = next(name for name in names if name not in given)
            raise SurfaceError(
                f'Body: {missing} is missing: give {" and ".join(names)}, or material="steel"'
                f"{see('bodies')}"
            )
        else:
            values = {name: number(getattr(self, name), name, "Body") for name in names}
        if not (values[names[0]] > 0 and 0 <= values[names[1]] <= 0.5):
            raise SurfaceError(
                f"Body: elastic_modulus_pa = {values[names[0]]:g} must be above 0, and "
                f"poisson_ratio = {values[names[1]]:g} lie in 0 to 0.5"
            )
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        """Return radii and constants."""
        radii = {"Rx": self.radius_x_m, "Ry": self.radius_y_m}
        curved = [f"{name} = {1e3 * r:.5g} mm" for name, r in radii.items() if math.isfinite(r)]
        constants = f"E = {(self.elastic_modulus_pa or 0) / 1e9:.4g} GPa, nu = {self.poisson_ratio:g}"
        return f"Body({', '.join(curved) or 'flat'}, {constants})"

    @classmethod
    def ball(cls, ball_diameter_m: float, **elastic: Any) -> "Body":  # noqa: ANN401
        """Return a ball of a diameter, m; `elastic` is the material, or both constants.

        Examples
        --------
        >>> import ehlwave
        >>> ehlwave.Body.ball(19.05e-3, material="steel")
        Body(Rx = 9.525 mm, Ry = 9.525 mm, E = 206 GPa, nu = 0.3)
        """
        radius = number(ball_diameter_m, "ball_diameter_m", "Body.ball") / 2
        return cls(radius, radius, **elastic)

    @classmethod
    def inner_race(
        cls,
        element_diameter_m: float,
        pitch_diameter_m: float,
        osculation: float | None = None,
        contact_angle_deg: float = 0.0,
        **elastic: Any,  # noqa: ANN401
    ) -> "Body":
        """Return the inner race of a bearing, where a ball or roller touches it.

        Along rolling its radius is (dm/cos(angle) - d)/2; across it is a hollow groove of
        `osculation` times d (0.515 to 0.54 of ball bearings), or flat without (rollers).

        Parameters
        ----------
        element_diameter_m : float
            Of ball or roller, d.
        pitch_diameter_m : float
            Of the circle of their centres, dm.
        osculation : float, optional
            Radius of the groove over the diameter of the ball, above 0.5.
        contact_angle_deg : float
            Contact angle.
        **elastic
            Material, or both constants.

        Examples
        --------
        >>> import ehlwave
        >>> ehlwave.Body.inner_race(7.94e-3, 39e-3, osculation=0.52, material="steel")
        Body(Rx = 15.53 mm, Ry = -4.1288 mm, E = 206 GPa, nu = 0.3)
        """
        d, pitch, groove = _race(element_diameter_m, pitch_diameter_m, osculation, contact_angle_deg)
        return cls((pitch - d) / 2, groove, **elastic)

    @classmethod
    def outer_race(
        cls,
        element_diameter_m: float,
        pitch_diameter_m: float,
        osculation: float | None = None,
        contact_angle_deg: float = 0.0,
        **elastic: Any,  # noqa: ANN401
    ) -> "Body":
        """Return the outer race, hollow along rolling, too: -(dm/cos(angle) + d)/2.

        Parameters are those of :meth:`inner_race`.

        Examples
        --------
        >>> import ehlwave
        >>> ehlwave.Body.outer_race(7.94e-3, 39e-3, osculation=0.53, material="steel")
        Body(Rx = -23.47 mm, Ry = -4.2082 mm, E = 206 GPa, nu = 0.3)
        """
        d, pitch, groove = _race(element_diameter_m, pitch_diameter_m, osculation, contact_angle_deg)
        return cls(-(pitch + d) / 2, groove, **elastic)


def _radius(value: Any, name: str) -> float:  # noqa: ANN401 - what users give
    found = plain(value, name)
    try:
        radius = float(found)
    except (TypeError, ValueError):
        raise SurfaceError(f"Body: {name} = {value!r} is not a number") from None
    if math.isnan(radius) or radius == 0:
        raise SurfaceError(f"Body: {name} = {value} is no radius: leave it out where a body is flat")
    if math.isfinite(radius) and found is value:
        number(abs(radius), name, "Body")
    return radius


def _race(
    diameter: Any,  # noqa: ANN401
    pitch: Any,  # noqa: ANN401
    osculation: float | None,
    angle_deg: Any,  # noqa: ANN401
) -> tuple[float, float, float]:
    """Return the diameter, the pitch diameter over the cosine, and the radius of the groove."""
    d = number(diameter, "ball_diameter_m", "Body")
    dm = number(pitch, "pitch_diameter_m", "Body")
    if dm <= d:
        raise SurfaceError(
            f"Body: pitch_diameter_m = {dm:g} must be above the diameter of ball or roller, {d:g}"
        )
    if osculation is not None and not 0.5 < osculation < 1:
        raise SurfaceError(
            f"Body: osculation = {osculation:g} must be above 0.5 and below 1: the radius of the "
            "groove over the diameter of the ball, such as 0.52"
        )
    angle = number(angle_deg, "contact_angle_deg", "Body")
    if not 0 <= angle < 90:
        raise SurfaceError(f"Body: contact_angle_deg = {angle:g} must be at least 0 and below 90")
    groove = FLAT if osculation is None else -osculation * d
    return d, dm / math.cos(math.radians(angle)), groove


def contact_keys(
    body1: Body, body2: Body, given: Mapping[str, Any]
) -> tuple[dict[str, Any], list[tuple[str, str, float]]]:
    """Return keys of the contact of two bodies, and what users call those that have other names.

    Parameters
    ----------
    body1, body2 : Body
        The rough one first.
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
    keys: dict[str, Any] = {key: value for key, value in given.items() if value is not None}
    keys["reduced_modulus_pa"] = 2 / sum(
        (1 - body.poisson_ratio**2) / body.elastic_modulus_pa  # type: ignore[operator]
        for body in (body1, body2)
    )
    across = _sum(body1.radius_y_m, body2.radius_y_m, "radius_y_m", may_be_flat=True)
    keys["radius_x_m"] = _sum(body1.radius_x_m, body2.radius_x_m, "radius_x_m", may_be_flat=False)
    names: list[tuple[str, str, float]] = []
    if math.isinf(across):
        _take_line_load(keys, names)
    else:
        keys["radius_y_m"] = across
        _refuse_line_load(keys, keys["radius_x_m"] / across)
    _take_speeds(keys, names)
    return keys, names


def _sum(first: float, second: float, name: str, may_be_flat: bool) -> float:
    curvature = 1 / first + 1 / second
    if curvature < 0 or (curvature == 0 and not (may_be_flat and math.isinf(first))):
        what = "flat" if curvature == 0 and math.isinf(first) else "not touching in one place"
        raise SurfaceError(
            f"Contact: {name} = {first:g} and {second:g} m: bodies are {what} in this direction: "
            "give one of them a radius, and a hollow one (negative) a larger radius than the other"
            f"{see('bodies')}"
        )
    return 1 / curvature if curvature > 0 else FLAT


def _take_line_load(keys: dict[str, Any], names: list[tuple[str, str, float]]) -> None:
    load, length = keys.pop("load_n", None), keys.pop("length_m", None)
    if LOAD_KEY in keys:
        if load is not None:
            raise SurfaceError(f"Contact: gives load_n and {LOAD_KEY}: remove one")
        return
    if load is None or length is None:
        missing = "load_n" if load is None else "length_m"
        raise SurfaceError(
            f"Contact: {missing} is missing: both bodies are flat across rolling (radius_y_m), a "
            f"line contact: give load_n and length_m, or {LOAD_KEY}{see('bodies')}"
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
    if ratio > 1 + 1e-12:
        raise SurfaceError(
            f"Contact: reduced radii have Rx/Ry = {ratio:.4g}: the contact is wider along rolling "
            "than across, which is outside the model (Rx/Ry of 0.005 to 1): radius_x_m is the one "
            f"along rolling{see('bodies')}"
        )


def _take_speeds(keys: dict[str, Any], names: list[tuple[str, str, float]]) -> None:
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
        raise SurfaceError(
            f"Contact: speeds_m_per_s = {speeds}: give both, (u1, u2); in pure rolling they are "
            f"equal{see('slip')}"
        ) from None
    first, second = (number(u, "speeds_m_per_s", "Contact") for u in (abs(one), abs(two)))
    first, second = math.copysign(first, one), math.copysign(second, two)
    start = f"Contact: speeds_m_per_s = ({first:g}, {second:g})"
    if first == -second:
        what = "both are at rest" if first == 0 else "they are opposite and equal"
        raise SurfaceError(f"{start}: {what}, so that no oil is drawn in: give a mean other than 0")
    if first * second < 0:
        raise SurfaceError(
            f"{start}: the surfaces move in opposite directions, which is outside the model "
            f"(slide_to_roll_ratio of -2 to 2): give speeds of one sign{see('slip')}"
        )
    mean = (first + second) / 2
    keys["mean_speed_m_per_s"] = abs(mean)
    keys[SLIP] = slip_of((first - second) / mean)
    names.append(("mean_speed_m_per_s", "mean of speeds_m_per_s", 1.0))
