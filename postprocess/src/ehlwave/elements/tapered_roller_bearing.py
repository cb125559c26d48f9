"""Tapered roller bearings: line contacts at the mean section."""

from __future__ import annotations

import math

from ehlwave.contact.bodies import Body
from ehlwave.elements.given import RADIANS, above, at_least
from ehlwave.elements.load_zone import ROLLER_HALF_LOADED as HALF_LOADED
from ehlwave.elements.load_zone import LoadZone, tapered_zone
from ehlwave.elements.roller_bearing import RollerBearing
from ehlwave.errors import SurfaceError


class TaperedRollerBearing(RollerBearing):
    """A single-row tapered roller bearing, at the mean section.

    With the half angle nu = (alpha_o - alpha_i)/2 of the roller's cone and the angle
    beta = (alpha_o + alpha_i)/2 of its axis, radii normal to the lines are the section radii over
    the cosine of each cone: D/(2 cos(nu)), (d_m - D cos(beta))/(2 cos(alpha_i)) and (d_m + D
    cos(beta))/(2 cos(alpha_o)). gamma = D cos(beta)/d_m.

    Assumptions: apexes of all cones meet, so that the rollers roll; the contact at the rib is left
    out, and with it a part of the friction; the rib's force is along the roller's axis, so that
    both races bear the same load but for the centrifugal force; the load is even over the length.

    Parameters
    ----------
    roller_diameter_m : float
        At the middle of the roller.
    roller_length_m, pitch_diameter_m : float
        Effective length; diameter of the circle of the roller's middles.
    rollers : int
        Number of rollers.
    inner_angle_deg, outer_angle_deg : float
        Half angles of the cones of both races.
    material, elastic_modulus_pa, poisson_ratio
        As of :class:`DeepGrooveBallBearing`.

    Examples
    --------
    >>> from ehlwave.elements import TaperedRollerBearing
    >>> bearing = TaperedRollerBearing(roller_diameter_m=0.01, roller_length_m=0.015,
    ...     pitch_diameter_m=0.06, rollers=16, inner_angle_deg=12, outer_angle_deg=15.5)
    >>> speed = bearing.surface_speed_m_per_s(1000, contact_angle_deg=13.75)
    >>> print(f"{speed:.4f} m/s")
    1.5296 m/s
    """

    def __init__(
        self,
        *,
        roller_diameter_m: float,
        roller_length_m: float,
        pitch_diameter_m: float,
        rollers: int,
        inner_angle_deg: float,
        outer_angle_deg: float,
        material: str = "steel",
        elastic_modulus_pa: float | None = None,
        poisson_ratio: float | None = None,
    ) -> None:
        """Check the dimensions."""
        name = type(self).__name__
        self.inner_angle_deg = above(inner_angle_deg, "inner_angle_deg", name, RADIANS, "12")
        self.outer_angle_deg = above(
            outer_angle_deg, "outer_angle_deg", name, self.inner_angle_deg, example="15.5"
        )
        if not self.outer_angle_deg < 60:
            raise SurfaceError(f"{name}: outer_angle_deg = {outer_angle_deg:g} must be below 60")
        self.free_angle_deg = self.axis_angle_deg
        self._take({key: value for key, value in locals().items() if key != "self"})

    @property
    def axis_angle_deg(self) -> float:
        """Return beta, the angle of the roller's axis."""
        return (self.inner_angle_deg + self.outer_angle_deg) / 2

    @property
    def outward_share(self) -> float:
        """Return cos(beta)/cos(nu): the rib bears the part of the force along the axis."""
        half_cone = math.radians(self.outer_angle_deg - self.inner_angle_deg) / 2
        return math.cos(math.radians(self.axis_angle_deg)) / math.cos(half_cone)

    def bodies(self, ring: str, contact_angle_deg: float = 0.0) -> tuple[Body, Body]:
        """Return race and roller.

        Parameters
        ----------
        ring : {"inner", "outer"}
            The race.
        contact_angle_deg : float
            Not needed: both cones have their own.
        """
        half_cone = math.radians(self.outer_angle_deg - self.inner_angle_deg) / 2
        lift = self.element_diameter_m * math.cos(math.radians(self.axis_angle_deg))
        if ring == "inner":
            radius = (
                (self.pitch_diameter_m - lift) / 2 / math.cos(math.radians(self.inner_angle_deg))
            )
        else:
            radius = -(self.pitch_diameter_m + lift) / 2
            radius /= math.cos(math.radians(self.outer_angle_deg))
        roller = self.element_diameter_m / 2 / math.cos(half_cone)
        return Body(radius_x_m=radius, **self.elastic), Body(radius_x_m=roller, **self.elastic)

    def load_zone(
        self,
        radial_load_n: float = 0.0,
        axial_load_n: float = 0.0,
        inner_speed_rpm: float = 0.0,
        outer_speed_rpm: float = 0.0,
    ) -> LoadZone:
        """Return the loads around the bearing, normal to the races.

        Parameters
        ----------
        radial_load_n, axial_load_n : float
            Loads; the axial load is needed, since a radial load pushes the rings apart.
        inner_speed_rpm, outer_speed_rpm : float
            Speeds of the rings, for the centrifugal force of the rollers.
        """
        name = type(self).__name__
        radial = at_least(radial_load_n, "radial_load_n", name)
        axial = at_least(axial_load_n, "axial_load_n", name)
        angle = math.radians(self.outer_angle_deg)
        if axial == 0:
            usual = f"{max(HALF_LOADED * radial * math.tan(angle), 1):.3g}"
            raise SurfaceError(
                f"{name}: axial_load_n is missing: a radial load alone pushes the rings of a "
                f"tapered bearing apart: give it, such as {usual}"
            )
        races = self.races(inner_speed_rpm, outer_speed_rpm)
        return tapered_zone((radial, axial), self.elements, angle, races, self.axis_angle_deg)
