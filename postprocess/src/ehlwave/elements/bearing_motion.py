"""Motion of a rolling bearing: cage, surface speeds, overrolling, centrifugal force."""

from __future__ import annotations

import math
from typing import Any

from ehlwave.contact.bodies import Body
from ehlwave.quantities import number

STEEL_DENSITY = 7850.0
"""Density where elastic constants came without a material, kg/m3."""


class BearingMotion:
    """Motion of balls or rollers between two rings, without slip."""

    element_diameter_m: float
    """Diameter of balls, or of rollers at their middle."""
    pitch_diameter_m: float
    """Diameter of the circle of their centres."""
    elements: int
    """Number of balls or rollers."""

    def bodies(self, ring: str, contact_angle_deg: float) -> tuple[Body, Body]:
        """Return race and element at a contact; subclasses define them."""
        raise NotImplementedError

    def length_m(self) -> float | None:
        """Return the length of line contacts; None of balls."""
        return None

    def _speeds_rpm(self, inner: Any, outer: Any) -> tuple[float, float]:  # noqa: ANN401
        """Return the checked speeds of both rings."""
        name = type(self).__name__
        return number(inner, "inner_speed_rpm", name), number(outer, "outer_speed_rpm", name)

    def gamma(self, contact_angle_deg: float = 0.0) -> float:
        """Return D cos(angle)/d_m.

        Parameters
        ----------
        contact_angle_deg : float
            Contact angle, of tapered rollers the angle of their axis.
        """
        cosine = math.cos(math.radians(contact_angle_deg))
        return self.element_diameter_m * cosine / self.pitch_diameter_m

    def surface_speed_m_per_s(
        self, inner_speed_rpm: float, outer_speed_rpm: float = 0.0, contact_angle_deg: float = 0.0
    ) -> float:
        """Return the speed of both surfaces past either contact, without slip.

        The cage turns with [w_i (1 - gamma) + w_o (1 + gamma)]/2, so that the inner race has
        (w_i - w_o) d_m (1 - gamma^2)/4, the outer race and the element the same.

        Parameters
        ----------
        inner_speed_rpm, outer_speed_rpm, contact_angle_deg : float
            Speeds of the rings, contact angle.
        """
        gamma = self.gamma(contact_angle_deg)
        turn = 2 * math.pi / 60 * (inner_speed_rpm - outer_speed_rpm)
        return abs(turn) * self.pitch_diameter_m * (1 - gamma**2) / 4

    def cage_speed_rpm(
        self, inner_speed_rpm: float, outer_speed_rpm: float = 0.0, contact_angle_deg: float = 0.0
    ) -> float:
        """Return the speed of the cage.

        Parameters
        ----------
        inner_speed_rpm, outer_speed_rpm, contact_angle_deg : float
            Speeds of the rings, contact angle.
        """
        gamma = self.gamma(contact_angle_deg)
        return (inner_speed_rpm * (1 - gamma) + outer_speed_rpm * (1 + gamma)) / 2

    def centrifugal_load_n(
        self, inner_speed_rpm: float, outer_speed_rpm: float = 0.0, contact_angle_deg: float = 0.0
    ) -> float:
        """Return the centrifugal force of an element, m omega_c^2 d_m/2.

        With ``has_centrifugal_load`` the outer ring bears it beside its load.

        Parameters
        ----------
        inner_speed_rpm, outer_speed_rpm, contact_angle_deg : float
            Speeds of the rings, contact angle.
        """
        cage = self.cage_speed_rpm(inner_speed_rpm, outer_speed_rpm, contact_angle_deg)
        density = self.bodies("inner", contact_angle_deg)[1].density_kg_per_m3 or STEEL_DENSITY
        turn = 2 * math.pi / 60 * cage
        return density * self.element_volume_m3() * turn**2 * self.pitch_diameter_m / 2

    def element_volume_m3(self) -> float:
        """Return the volume of a ball, or of a roller."""
        length = self.length_m()
        if length is None:
            return math.pi / 6 * self.element_diameter_m**3
        return math.pi / 4 * self.element_diameter_m**2 * length

    def overrolling_time_s(self, inner_speed_rpm: float, outer_speed_rpm: float = 0.0) -> float:
        """Return the time between two elements at a place of the inner ring.

        Parameters
        ----------
        inner_speed_rpm, outer_speed_rpm : float
            Speeds of the rings.
        """
        past = abs(inner_speed_rpm - self.cage_speed_rpm(inner_speed_rpm, outer_speed_rpm))
        return 60 / (self.elements * past) if past > 0 else math.inf
