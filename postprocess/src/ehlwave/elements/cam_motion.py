"""Motion of a cam and its follower: lift, curvature, speeds past the contact, reversals."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from ehlwave.errors import SurfaceError
from ehlwave.quantities import number

Floats = NDArray[np.float64]

ROUND_OFF = 1e-6
"""Lift and derivatives over the base radius in a dwell, as far as lift tables have digits."""

WIDEST_GAP = 45.0 * (1 + 1e-9)
"""Largest distance of two angles of a lift table, degrees: eight even angles have 45."""


def periodic(angle_deg: ArrayLike, lift_m: ArrayLike, name: str) -> Any:  # noqa: ANN401
    """Return the lift over the angle in rad as a periodic cubic spline.

    Parameters
    ----------
    angle_deg, lift_m : array_like
        Lift over one turn.
    name : str
        Name of the element, for messages.

    Raises
    ------
    SurfaceError
        If angles do not rise over one turn.
    """
    try:
        angle, lift = (np.array(one, dtype=np.float64) for one in (angle_deg, lift_m))
    except (TypeError, ValueError):
        raise SurfaceError(f"{name}: angle_deg and lift_m must be lists of numbers") from None
    if angle.shape != lift.shape or angle.ndim != 1 or angle.size < 8:
        raise SurfaceError(
            f"{name}: angle_deg and lift_m must be two lists of the same length, 8 or more"
        )
    if not (np.isfinite(angle).all() and np.isfinite(lift).all()):
        raise SurfaceError(f"{name}: angle_deg and lift_m must be finite numbers")
    number(float(np.ptp(lift)), "lift_m", name)
    if not (np.all(np.diff(angle) > 0) and angle[-1] - angle[0] <= 360 * (1 + 1e-12)):
        raise SurfaceError(f"{name}: angle_deg must rise over at most one turn, 360 degrees")
    if angle[-1] - angle[0] < 360 * (1 - 1e-9):
        angle, lift = np.append(angle, angle[0] + 360), np.append(lift, lift[0])
    gap = np.diff(angle).max()
    if gap > WIDEST_GAP:
        raise SurfaceError(
            f"{name}: angle_deg leaves {gap:.4g} degrees without a lift: give the lift over the "
            f"whole turn, in degrees, at most {WIDEST_GAP:g} apart"
        )
    lift[-1] = lift[0]
    return scipy.interpolate.CubicSpline(np.radians(angle), lift, bc_type="periodic")


class CamMotion:
    """Motion of a cam on a flat follower or on a roller."""

    _lift: Any
    base_radius_m: float
    """r_b."""
    roller_radius_m: float | None
    """r_f; None: flat."""

    def _state(self, angle_deg: ArrayLike) -> tuple[Floats, Floats, Floats]:
        turn = np.radians(np.asarray(angle_deg, dtype=np.float64))
        states = (self._lift(turn, order) for order in range(3))
        smallest = ROUND_OFF * self.base_radius_m
        lift, first, second = (np.where(np.abs(one) > smallest, one, 0.0) for one in states)
        return lift, first, second

    def _turned(self, angle_deg: ArrayLike) -> tuple[Floats, Floats]:
        """Return, of a roller, the radius of its pitch curve and the turn of the normal."""
        lift, first, second = self._state(angle_deg)
        r = self.base_radius_m + float(self.roller_radius_m or 0) + lift
        square = r**2 + first**2
        bend = r**2 + 2 * first**2 - r * second
        return square**1.5 / bend, bend / square

    def curvature_radius_m(self, angle_deg: ArrayLike) -> Floats:
        """Return the radius of curvature of the cam; below 0 where it is hollow.

        Parameters
        ----------
        angle_deg : array_like
            Angle of the cam.
        """
        lift, _, second = self._state(angle_deg)
        if self.roller_radius_m is None:
            return np.asarray(self.base_radius_m + lift + second)
        return np.asarray(self._turned(angle_deg)[0] - self.roller_radius_m)

    def surface_speeds_m_per_s(
        self, angle_deg: ArrayLike, cam_speed_rpm: float
    ) -> tuple[Floats, Floats]:
        """Return the speeds of cam and follower past the contact.

        Parameters
        ----------
        angle_deg : array_like
            Angle of the cam.
        cam_speed_rpm : float
            Its speed.
        """
        turn = 2 * math.pi / 60 * cam_speed_rpm
        radius = self.curvature_radius_m(angle_deg)
        if self.roller_radius_m is None:
            return turn * radius, turn * self._state(angle_deg)[2]
        rolled = turn * radius * self._turned(angle_deg)[1]
        return rolled, rolled.copy()

    def reversals_deg(self, points: int = 3600) -> list[float]:
        """Return the angles at which the entrainment is 0 and changes its direction.

        Parameters
        ----------
        points : int
            Angles that are looked at.
        """
        angles = np.linspace(0, 360, points + 1)
        mean = np.mean(self.surface_speeds_m_per_s(angles, 60), axis=0)
        signs = np.flatnonzero(np.diff(np.sign(mean)) != 0)
        share = mean[signs] / (mean[signs] - mean[signs + 1])
        return [float(one) for one in angles[signs] + share * (angles[1] - angles[0])]
