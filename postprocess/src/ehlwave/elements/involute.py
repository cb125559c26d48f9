"""Geometry and loads of involute gear pairs along the line of action.

Niemann and Winter, *Maschinenelemente II* (2003), chapter 21; ISO 21771:2007. At the distance s
from the base tangent point of the pinion, along the line of action of length N = a sin(alpha_wt):
transverse radii s and N - s, normal reduced radius s (N - s)/(N cos(beta_b)), speeds omega_1 s and
omega_2 (N - s). Tips are shortened so that the root clearance is kept:
d_a = m (z + 2 + 2 x - 2 (x_1 + x_2 - y)), y = (a - a_0)/m.

Load sharing as ISO/TR 15144-1 has it for unmodified flanks (from memory, as in
:mod:`ehlwave.elements.practice`): 1/3 at A rises to 2/3 at B, 1 from B to D, 2/3 at D falls to 1/3
at E. Helical pairs with an overlap ratio of 1 or more bear the mean load of the contact lines,
1/eps_alpha; below, both are weighted by the overlap ratio.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from ehlwave.errors import SurfaceError

Floats = NDArray[np.float64]


def involute(angle_rad: float) -> float:
    """Return tan(angle) - angle."""
    return math.tan(angle_rad) - angle_rad


@dataclass(frozen=True)
class InvolutePair:
    """A pair of external involute gears.

    Attributes
    ----------
    module_m : float
        Normal module.
    teeth : pair of int
        Of pinion and wheel.
    pressure_angle_deg, helix_angle_deg : float
        Normal pressure angle and helix angle at the reference circle.
    profile_shift : pair of float
        Profile shift coefficients x.
    centre_distance_m : float or None
        None: without backlash by the profile shifts.
    addendum : float
        Of the basic rack, over the module.
    """

    module_m: float
    teeth: tuple[int, int]
    pressure_angle_deg: float = 20.0
    helix_angle_deg: float = 0.0
    profile_shift: tuple[float, float] = (0.0, 0.0)
    centre_distance_m: float | None = None
    addendum: float = 1.0

    @property
    def transverse_module_m(self) -> float:
        """Return m/cos(beta)."""
        return self.module_m / math.cos(math.radians(self.helix_angle_deg))

    @property
    def transverse_angle_rad(self) -> float:
        """Return alpha_t of the reference circle."""
        beta = math.radians(self.helix_angle_deg)
        return math.atan(math.tan(math.radians(self.pressure_angle_deg)) / math.cos(beta))

    @property
    def base_helix_rad(self) -> float:
        """Return beta_b: tan(beta) cos(alpha_t)."""
        beta = math.radians(self.helix_angle_deg)
        return math.atan(math.tan(beta) * math.cos(self.transverse_angle_rad))

    @property
    def base_radii_m(self) -> tuple[float, float]:
        """Return the radii of both base circles."""
        half = self.transverse_module_m * math.cos(self.transverse_angle_rad) / 2
        return half * self.teeth[0], half * self.teeth[1]

    @cached_property
    def working_angle_rad(self) -> float:
        """Return alpha_wt, by the centre distance or by the profile shifts.

        Raises
        ------
        SurfaceError
            If the centre distance is too small for the base circles.
        """
        if self.centre_distance_m is not None:
            cosine = sum(self.base_radii_m) / self.centre_distance_m
            if not cosine < 1:
                raise SurfaceError(
                    f"centre_distance_m = {self.centre_distance_m:g} must be above "
                    f"{sum(self.base_radii_m):.5g}, the sum of both base radii"
                )
            return math.acos(cosine)
        alpha = self.transverse_angle_rad
        normal = math.tan(math.radians(self.pressure_angle_deg))
        wanted = involute(alpha) + 2 * normal * sum(self.profile_shift) / sum(self.teeth)
        if wanted <= 0:
            raise SurfaceError(
                f"profile_shift = {self.profile_shift}: the flanks do not meet: raise the sum"
            )
        return float(
            scipy.optimize.brentq(lambda x: involute(x) - wanted, 1e-6, 1.4, xtol=1e-16, rtol=1e-15)
        )

    @property
    def working_distance_m(self) -> float:
        """Return the centre distance."""
        return sum(self.base_radii_m) / math.cos(self.working_angle_rad)

    @property
    def tip_radii_m(self) -> tuple[float, float]:
        """Return the radii of both tip circles."""
        reference = self.transverse_module_m * sum(self.teeth) / 2
        shift = (self.working_distance_m - reference) / self.module_m
        shortened = max(sum(self.profile_shift) - shift, 0.0)
        first, second = (
            self.transverse_module_m * z / 2 + self.module_m * (self.addendum + x - shortened)
            for z, x in zip(self.teeth, self.profile_shift, strict=True)
        )
        return first, second

    @property
    def action_m(self) -> float:
        """Return N, the distance of both base tangent points."""
        return self.working_distance_m * math.sin(self.working_angle_rad)

    @cached_property
    def path_m(self) -> tuple[float, float]:
        """Return s of A, where the pinion's root meets the wheel's tip, and of E.

        Raises
        ------
        SurfaceError
            If the teeth do not pass the load on, are pointed, or a tip meets no involute.
        """
        ends = [
            math.sqrt(max(tip**2 - base**2, 0.0))
            for tip, base in zip(self.tip_radii_m, self.base_radii_m, strict=True)
        ]
        first, last = self.action_m - ends[1], ends[0]
        if last - first < self.base_pitch_m:
            raise SurfaceError(
                f"contact ratio {(last - first) / self.base_pitch_m:.2f} is below 1: lower "
                "centre_distance_m or the profile shifts"
            )
        if not 0 < first < last < self.action_m:
            raise SurfaceError(
                f"teeth = {self.teeth}, profile_shift = {self.profile_shift}: the path of contact "
                "ends beyond the base circles: raise the profile shift of the gear with fewer "
                "teeth, or its number of teeth"
            )
        for z, tip in zip(self.teeth, self.thicknesses_m(self.tip_radii_m), strict=True):
            if tip <= 0:
                raise SurfaceError(
                    f"profile_shift = {self.profile_shift}: the teeth of the gear with {z} are "
                    "pointed below their tip circle: lower its profile shift or the addendum"
                )
        return first, last

    def thicknesses_m(self, radii_m: tuple[float, float]) -> tuple[float, float]:
        """Return the transverse thickness of a tooth of each gear at a radius.

        2 r (pi/(2 z) + 2 x tan(alpha_n)/z + inv(alpha_t) - inv(alpha)), cos(alpha) = r_b/r.

        Parameters
        ----------
        radii_m : pair of float
            r of both gears.
        """
        normal = math.tan(math.radians(self.pressure_angle_deg))
        start = involute(self.transverse_angle_rad)
        first, second = (
            2 * r * ((math.pi / 2 + 2 * x * normal) / z + start - involute(math.acos(base / r)))
            for z, x, r, base in zip(
                self.teeth, self.profile_shift, radii_m, self.base_radii_m, strict=True
            )
        )
        return first, second

    @property
    def base_pitch_m(self) -> float:
        """Return p_bt, the distance of two flanks along the line of action."""
        return math.pi * self.transverse_module_m * math.cos(self.transverse_angle_rad)

    @property
    def contact_ratio(self) -> float:
        """Return eps_alpha."""
        first, last = self.path_m
        return (last - first) / self.base_pitch_m

    def overlap_ratio(self, face_width_m: float) -> float:
        """Return eps_beta = b tan(beta_b)/p_bt.

        Parameters
        ----------
        face_width_m : float
            b.
        """
        return face_width_m * math.tan(abs(self.base_helix_rad)) / self.base_pitch_m

    @property
    def pitch_point_m(self) -> float:
        """Return s of the pitch point C."""
        return self.base_radii_m[0] * math.tan(self.working_angle_rad)

    @property
    def named_points_m(self) -> dict[str, float]:
        """Return s of A, B, C, D and E; below a contact ratio of 2 one pair bears from B to D."""
        first, last = self.path_m
        points = {"A": first, "B": last - self.base_pitch_m, "C": self.pitch_point_m}
        return points | {"D": first + self.base_pitch_m, "E": last}

    def radii_m(self, distance_m: ArrayLike) -> tuple[Floats, Floats]:
        """Return the normal radii of both flanks at s.

        Parameters
        ----------
        distance_m : array_like
            s.
        """
        s = np.asarray(distance_m, dtype=np.float64)
        cosine = math.cos(self.base_helix_rad)
        return s / cosine, (self.action_m - s) / cosine

    def share(self, distance_m: ArrayLike, overlap: float = 0.0) -> Floats:
        """Return the load of a flank over the load of the pair, by width.

        Parameters
        ----------
        distance_m : array_like
            s.
        overlap : float
            eps_beta; 0 of spur gears.
        """
        s = np.asarray(distance_m, dtype=np.float64)
        first, last = self.path_m
        ratio, pitch = self.contact_ratio, self.base_pitch_m
        if ratio < 2:
            rising = 1 / 3 + (s - first) / (last - pitch - first) / 3
            falling = 1 / 3 + (last - s) / (last - pitch - first) / 3
            spur = np.where(s < last - pitch, rising, np.where(s > first + pitch, falling, 1.0))
        else:
            spur = np.full_like(s, 1 / ratio)
        weight = min(overlap, 1.0)
        return np.asarray((1 - weight) * spur + weight / ratio)
