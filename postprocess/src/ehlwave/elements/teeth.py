"""Teeth of involute gear pairs: angles, radii, centre distance, thickness, start of the involute.

Niemann and Winter, *Maschinenelemente II* (2003), chapter 21; ISO 21771:2007. Tips are shortened so
that the root clearance is kept: d_a = m (z + 2 + 2 x - 2 (x_1 + x_2 - y)), y = (a - a_0)/m.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import scipy

from ehlwave.elements.rack import involute_start_m
from ehlwave.errors import SurfaceError

ROUNDED = 0.01
"""Centre distance below the distance without backlash that is accepted, over the module: published
profile shifts are rounded. Gears of FZG type A, 0.8635 and -0.5 at 91.5 mm, are 0.0092 below."""


def involute(angle_rad: float) -> float:
    """Return tan(angle) - angle."""
    return math.tan(angle_rad) - angle_rad


@dataclass(frozen=True)
class InvoluteTeeth:
    """Teeth of a pair of external involute gears.

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
            If the centre distance is too small for the teeth.
        """
        needed = self._tight_angle_rad
        if self.centre_distance_m is None:
            return needed
        distance, bases = self.centre_distance_m, sum(self.base_radii_m)
        least = bases / math.cos(needed)
        if distance <= bases or distance < least - ROUNDED * self.module_m:
            raise SurfaceError(
                f"centre_distance_m = {distance:g} must be at least {least:.6g}, at which teeth "
                f"with profile_shift = {self.profile_shift} mesh without backlash: raise it, or "
                "lower the profile shifts"
            )
        return math.acos(bases / distance)

    @cached_property
    def _tight_angle_rad(self) -> float:
        """Return the working pressure angle without backlash, by the profile shifts."""
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
    def backlash_m(self) -> float:
        """Return the transverse backlash on the working circles, 2 a (inv(alpha_wt) - inv(t)).

        t is alpha_wt without backlash.
        """
        wide = involute(self.working_angle_rad) - involute(self._tight_angle_rad)
        return 2 * self.working_distance_m * wide

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

    @cached_property
    def starts_m(self) -> tuple[tuple[float, bool], tuple[float, bool]]:
        """Return where the involute of each gear starts, and whether the rack undercuts it."""
        first, second = (
            involute_start_m(
                self.transverse_module_m * z / 2,
                self.transverse_angle_rad,
                (self.addendum - x) * self.module_m,
            )
            for z, x in zip(self.teeth, self.profile_shift, strict=True)
        )
        return first, second

    @property
    def least_shifts(self) -> tuple[float, float]:
        """Return the profile shifts below which the rack undercuts (:mod:`.rack`)."""
        beta = math.radians(self.helix_angle_deg)
        sine = math.sin(self.transverse_angle_rad) ** 2 / (2 * math.cos(beta))
        return self.addendum - self.teeth[0] * sine, self.addendum - self.teeth[1] * sine
