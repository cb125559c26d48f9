"""Cylindrical roller bearings: line contacts of both rings."""

from __future__ import annotations

from ehlwave.contact.bodies import Body
from ehlwave.elements.given import above, clearance_of
from ehlwave.elements.load_zone import LoadZone, radial_zone
from ehlwave.elements.roller_bearing import RollerBearing


class CylindricalRollerBearing(RollerBearing):
    """A single-row cylindrical roller bearing under a radial load.

    Radii: 1/Rx = 2/D -+ 2/d_race, that is (D/2)(1 -+ gamma), gamma = D/d_m. Loads:
    c_L (d cos - s/2)^(10/9), c_L = 35948 L^(8/9) of steel in N and mm (ISO 16281:2008).

    Assumptions: rollers are cylinders, not tilted, with an even load over their length; the rest
    as of :class:`DeepGrooveBallBearing`.

    Parameters
    ----------
    roller_diameter_m, roller_length_m : float
        Diameter and effective length.
    pitch_diameter_m : float
        Of the circle of the roller axes.
    rollers : int
        Number of rollers.
    clearance_m : float
        Radial internal clearance, of the diameter.
    material, elastic_modulus_pa, poisson_ratio
        As of :class:`DeepGrooveBallBearing`.

    Examples
    --------
    The bearing of Hamrock's example, 10.8 kN:

    >>> import ehlwave
    >>> from ehlwave.elements import CylindricalRollerBearing
    >>> bearing = CylindricalRollerBearing(roller_diameter_m=0.016, roller_length_m=0.016,
    ...     pitch_diameter_m=0.08, rollers=9)
    >>> oil = ehlwave.Oil(viscosity_pa_s=0.01, pressure_viscosity_per_pa=2.2e-8)
    >>> place = bearing.contacts(radial_load_n=10800, inner_speed_rpm=5003.8, oil=oil)[0]
    >>> print(f"{place.radius_x_m * 1e3:.1f} mm, {place.load_n:.0f} N")
    6.4 mm, 4934 N
    """

    def __init__(
        self,
        *,
        roller_diameter_m: float,
        roller_length_m: float,
        pitch_diameter_m: float,
        rollers: int,
        clearance_m: float = 0.0,
        material: str = "steel",
        elastic_modulus_pa: float | None = None,
        poisson_ratio: float | None = None,
    ) -> None:
        """Check the dimensions."""
        self._take({key: value for key, value in locals().items() if key != "self"})
        self.clearance_m = clearance_of(clearance_m, self.element_diameter_m, type(self).__name__)

    def bodies(self, ring: str, contact_angle_deg: float = 0.0) -> tuple[Body, Body]:
        """Return race and roller.

        Parameters
        ----------
        ring : {"inner", "outer"}
            The race.
        contact_angle_deg : float
            Always 0.
        """
        make = Body.inner_race if ring == "inner" else Body.outer_race
        race = make(self.element_diameter_m, self.pitch_diameter_m, **self.elastic)
        return race, Body(radius_x_m=self.element_diameter_m / 2, **self.elastic)

    def load_zone(
        self,
        radial_load_n: float = 0.0,
        inner_speed_rpm: float = 0.0,
        outer_speed_rpm: float = 0.0,
    ) -> LoadZone:
        """Return the loads around the bearing.

        Parameters
        ----------
        radial_load_n : float
            Radial load.
        inner_speed_rpm, outer_speed_rpm : float
            Speeds of the rings, for the centrifugal force of the rollers.
        """
        name = type(self).__name__
        load = above(radial_load_n, "radial_load_n", name, example="10000")
        races = self.races(inner_speed_rpm, outer_speed_rpm)
        return radial_zone(load, self.elements, self.clearance_m, races)
