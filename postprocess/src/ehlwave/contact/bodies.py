"""A body of a contact: radii of curvature, elastic constants, and thermal properties."""

import math
from dataclasses import dataclass
from typing import Any

from ehlwave.contact.heat_data import BodyHeat
from ehlwave.contact.materials import material as known_material
from ehlwave.errors import SurfaceError, see
from ehlwave.quantities import is_quantity, number

FLAT = math.inf


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
    conductivity_w_per_m_k, density_kg_per_m3, heat_capacity_j_per_kg_k : float, optional
        For films and friction with heat; defaults come from the material.

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
    conductivity_w_per_m_k: float | None = None
    density_kg_per_m3: float | None = None
    heat_capacity_j_per_kg_k: float | None = None

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
        for name, value in (values | self._heat()).items():
            object.__setattr__(self, name, value)

    def _heat(self) -> dict[str, float]:
        """Return its thermal properties: its own numbers before its material's."""
        known = {} if self.material is None else known_material(self.material).heat._asdict()
        for name in BodyHeat._fields:
            if (value := getattr(self, name)) is not None:
                known[name] = number(value, name, "Body")
                if not known[name] > 0:
                    raise SurfaceError(f"Body: {name} = {value} must be above 0")
        return known

    def __repr__(self) -> str:
        """Return radii and constants."""
        radii = {"Rx": self.radius_x_m, "Ry": self.radius_y_m}
        curved = [f"{name} = {1e3 * r:.5g} mm" for name, r in radii.items() if math.isfinite(r)]
        constants = (
            f"E = {(self.elastic_modulus_pa or 0) / 1e9:.4g} GPa, nu = {self.poisson_ratio:g}"
        )
        return f"Body({', '.join(curved) or 'flat'}, {constants})"

    @classmethod
    def ball(cls, ball_diameter_m: float, **elastic: Any) -> "Body":  # noqa: ANN401
        """Return a ball of a diameter.

        Parameters
        ----------
        ball_diameter_m : float
            Diameter, m.
        **elastic
            Material, or both constants.

        Examples
        --------
        >>> import ehlwave
        >>> ehlwave.Body.ball(19.05e-3, material="steel")
        Body(Rx = 9.525 mm, Ry = 9.525 mm, E = 206 GPa, nu = 0.3)
        """
        d = _diameter(ball_diameter_m, "ball_diameter_m", "Body.ball")
        return cls(d / 2, d / 2, **elastic)

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
        d, pitch, groove = _race(
            element_diameter_m, pitch_diameter_m, osculation, contact_angle_deg
        )
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

        Parameters
        ----------
        element_diameter_m, pitch_diameter_m, osculation, contact_angle_deg
            As of :meth:`inner_race`.
        **elastic
            Material, or both constants.

        Examples
        --------
        >>> import ehlwave
        >>> ehlwave.Body.outer_race(7.94e-3, 39e-3, osculation=0.53, material="steel")
        Body(Rx = -23.47 mm, Ry = -4.2082 mm, E = 206 GPa, nu = 0.3)
        """
        d, pitch, groove = _race(
            element_diameter_m, pitch_diameter_m, osculation, contact_angle_deg
        )
        return cls(-(pitch + d) / 2, groove, **elastic)


def _radius(value: Any, name: str) -> float:  # noqa: ANN401 - user input
    if isinstance(value, float) and math.isinf(value):
        return float(value)
    radius = number(value, name, "Body")
    if radius == 0:
        raise SurfaceError(f"Body: {name} = {value} is no radius: remove it where a body is flat")
    if not is_quantity(value):  # a hollow body has a plausible radius, too
        number(abs(radius), name, "Body")
    return radius


def _diameter(value: Any, name: str, place: str) -> float:  # noqa: ANN401
    found = number(value, name, place)
    if found <= 0:
        raise SurfaceError(f"{place}: {name} = {value} must be above 0{see('bodies')}")
    return found


def _race(
    diameter: Any,  # noqa: ANN401
    pitch: Any,  # noqa: ANN401
    osculation: Any,  # noqa: ANN401
    angle_deg: Any,  # noqa: ANN401
) -> tuple[float, float, float]:
    """Return the diameter, the pitch diameter over the cosine, and the radius of the groove."""
    d = _diameter(diameter, "element_diameter_m", "Body")
    dm = number(pitch, "pitch_diameter_m", "Body")
    if dm <= d:
        raise SurfaceError(
            f"Body: pitch_diameter_m = {dm:g} must be above element_diameter_m = {d:g}, "
            f"such as {5 * d:g}"
        )
    groove = FLAT
    if osculation is not None:
        share = number(osculation, "osculation", "Body")
        if not 0.5 < share < 1:
            raise SurfaceError(
                f"Body: osculation = {share:g} must be above 0.5 and below 1: the radius of the "
                "groove over the diameter of the ball, such as 0.52"
            )
        groove = -share * d
    angle = number(angle_deg, "contact_angle_deg", "Body")
    if not 0 <= angle < 90:
        raise SurfaceError(f"Body: contact_angle_deg = {angle:g} must be at least 0 and below 90")
    return d, dm / math.cos(math.radians(angle)), groove
