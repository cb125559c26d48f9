"""Common parts of ball bearings: grooves, stiffness and loads of balls."""

from __future__ import annotations

import math
from typing import Any

from ehlwave.choices import chosen
from ehlwave.contact.bodies import Body
from ehlwave.elements.bearing import RollingBearing
from ehlwave.elements.given import above, at_least, elements_of, pair
from ehlwave.elements.hertz import hertz_point, reduced_modulus, reduced_radius
from ehlwave.elements.load_zone import (
    BALL_HALF_LOADED,
    BALL_POWER,
    RINGS,
    LoadZone,
    combined_zone,
    radial_zone,
)
from ehlwave.elements.material import elastic_of
from ehlwave.elements.races import Grooves
from ehlwave.errors import SurfaceError


class BallBearing(RollingBearing):
    """A single-row ball bearing; subclasses define the contact angle without load."""

    power = BALL_POWER
    conformity: tuple[float, float]
    """Groove radius over ball diameter, inner and outer ring."""
    clearance_m: float = 0.0
    """Radial internal clearance, of the diameter."""

    def _take(self, diameter: Any, pitch: Any, balls: Any, conformity: Any, material: Any) -> None:  # noqa: ANN401
        """Check and keep the arguments of all ball bearings."""
        name = type(self).__name__
        found = elements_of("ball", diameter, pitch, balls, name)
        self.element_diameter_m, self.pitch_diameter_m, self.elements = found
        self.conformity = pair(conformity, "conformity", name)
        for value in self.conformity:
            if not 0.5 < value < 1:
                raise SurfaceError(
                    f"{name}: conformity = {value:g} must be above 0.5 and below 1: groove radius "
                    "over ball diameter, such as (0.52, 0.53)"
                )
        self.elastic = elastic_of(*material)

    def bodies(self, ring: str, contact_angle_deg: float = 0.0) -> tuple[Body, Body]:
        """Return race and ball.

        Parameters
        ----------
        ring : {"inner", "outer"}
            The race.
        contact_angle_deg : float
            Contact angle under load.
        """
        make = Body.inner_race if ring == "inner" else Body.outer_race
        race = make(
            self.element_diameter_m,
            self.pitch_diameter_m,
            osculation=self.conformity[RINGS.index(ring)],
            contact_angle_deg=contact_angle_deg,
            **self.elastic,
        )
        return race, Body.ball(self.element_diameter_m, **self.elastic)

    def spin_to_roll_ratio(self, ring: str, contact_angle_deg: float) -> float:
        """Return spin over rolling of the ball on a ring, without spin on the other.

        Race control (Jones 1959; Harris and Kotzalas, *Advanced Concepts of Bearing Technology*,
        chapter 2, from memory): the axis of the ball meets the tangent of the race without spin on
        the axis of the bearing. Films and powers leave spin out.

        Parameters
        ----------
        ring : {"inner", "outer"}
            The ring that spins.
        contact_angle_deg : float
            Contact angle under load.
        """
        chosen(ring, "ring", RINGS, type(self).__name__)
        alpha = math.radians(contact_angle_deg)
        gamma = self.element_diameter_m / self.pitch_diameter_m
        side = 1.0 if ring == "inner" else -1.0
        # Pitch of the ball's axis from the bearing's, with no spin on the other ring.
        pitch = math.atan2(math.sin(alpha), math.cos(alpha) + side * gamma)
        own = 1 - side * gamma * math.cos(alpha)
        return abs(own * math.tan(alpha - pitch) + side * gamma * math.sin(alpha))

    @property
    def stiffnesses(self) -> tuple[float, float]:
        """Return K of both Hertz contacts, N/m^(3/2), at the angle without load."""
        return self._stiffness("inner"), self._stiffness("outer")

    def _stiffness(self, ring: str) -> float:
        race, ball = self.bodies(ring, self.free_angle_deg)
        along = reduced_radius(race.radius_x_m, ball.radius_x_m)
        across = reduced_radius(race.radius_y_m, ball.radius_y_m)
        modulus = reduced_modulus(race, ball)
        return float(hertz_point(1.0, along, across, modulus).approach_m ** -BALL_POWER)

    @property
    def grooves(self) -> Grooves:
        """Return the distances of the groove centres and the angle without load."""
        diameter, pitch = self.element_diameter_m, self.pitch_diameter_m
        radii = tuple((groove - 0.5) * diameter for groove in self.conformity)
        distance = sum(radii)
        angle, clearance = math.radians(self.free_angle_deg), self.clearance_m
        if clearance >= 2 * distance:
            raise SurfaceError(
                f"{type(self).__name__}: clearance_m = {clearance:g} leaves the rings no hold "
                f"along the axis: with an axial load it must be below {2 * distance:.3g}"
            )
        if clearance > 0:
            angle = math.acos(1 - clearance / (2 * distance))
        groove = pitch / 2 + radii[0] * math.cos(angle)
        return Grooves((radii[0], radii[1]), angle, groove, preload_m=max(-clearance / 2, 0.0))

    def load_zone(
        self,
        radial_load_n: float = 0.0,
        axial_load_n: float = 0.0,
        is_free_to_tilt: bool = False,
        inner_speed_rpm: float = 0.0,
        outer_speed_rpm: float = 0.0,
    ) -> LoadZone:
        """Return the loads around the bearing.

        Parameters
        ----------
        radial_load_n, axial_load_n : float
            Loads, at least one above 0.
        is_free_to_tilt : bool
            Whether the rings tilt until no moment is left; otherwise they stay parallel.
        inner_speed_rpm, outer_speed_rpm : float
            Speeds of the rings, for the centrifugal force of the balls.
        """
        name = type(self).__name__
        radial = at_least(radial_load_n, "radial_load_n", name)
        axial = at_least(axial_load_n, "axial_load_n", name)
        races = self.races(inner_speed_rpm, outer_speed_rpm)
        if axial == 0:
            above(radial, "radial_load_n", name, example="1000")
            if self.free_angle_deg:
                usual = BALL_HALF_LOADED * radial * math.tan(math.radians(self.free_angle_deg))
                raise SurfaceError(
                    f"{name}: axial_load_n is missing: a radial load alone pushes the rings of an "
                    f"angular contact bearing apart: give it, such as {usual:.3g}"
                )
            return radial_zone(radial, self.elements, self.clearance_m, races)
        loads = (radial, axial)
        return combined_zone(loads, self.elements, self.grooves, races, is_free_to_tilt)
