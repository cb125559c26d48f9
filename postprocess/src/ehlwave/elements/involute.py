"""Geometry and loads of involute gear pairs along the line of action.

Niemann and Winter, *Maschinenelemente II* (2003), chapter 21; ISO 21771:2007. At the distance s
from the base tangent point of the pinion, along the line of action of length N = a sin(alpha_wt):
transverse radii s and N - s, normal reduced radius s (N - s)/(N cos(beta_b)), speeds omega_1 s and
omega_2 (N - s). The path leads from A to E, between the tips of wheel and pinion. Where the rack
undercuts a flank, it ends at the involute that is left (:mod:`ehlwave.elements.rack`).

Load sharing as ISO/TR 15144-1 has it for unmodified flanks (from memory, as in
:mod:`ehlwave.elements.practice`): 1/3 at A rises to 2/3 at B, 1 from B to D, 2/3 at D falls to 1/3
at E. Helical pairs with an overlap ratio of 1 or more bear the mean load of the contact lines,
1/eps_alpha; below, both are weighted by the overlap ratio.
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ehlwave.elements.teeth import InvoluteTeeth
from ehlwave.errors import SurfaceError

ROUND_OFF = 1e-9
"""Length over the module below which a path is not shorter."""
LARGEST_BACKLASH = 0.2
"""Backlash over the module above which profile shifts were probably left out; cut gears have about
0.05 (AGMA 2002, from memory)."""

Floats = NDArray[np.float64]


class InvolutePair(InvoluteTeeth):
    """A pair of external involute gears along its line of action.

    Parameters
    ----------
    module_m, teeth, pressure_angle_deg, helix_angle_deg, profile_shift, centre_distance_m, addendum
        As of :class:`ehlwave.elements.teeth.InvoluteTeeth`.
    """

    @property
    def action_m(self) -> float:
        """Return N, the distance of both base tangent points."""
        return self.working_distance_m * math.sin(self.working_angle_rad)

    @cached_property
    def path_m(self) -> tuple[float, float]:
        """Return s of A, where the pinion's root meets the wheel's tip, and of E.

        The path ends at the tips, or where the involute of the other gear starts.

        Raises
        ------
        SurfaceError
            If the teeth do not pass the load on, or are pointed.
        """
        (first, last), (start, end) = self.tips_m, self.involutes_m
        first, last = max(first, start), min(last, end)
        ratio = (last - first) / self.base_pitch_m
        if ratio < 1:
            raise SurfaceError(
                f"contact ratio {ratio:.2f} is below 1: "
                + (self.shortening or "lower centre_distance_m or the profile shifts")
            )
        for z, tip in zip(self.teeth, self.thicknesses_m(self.tip_radii_m), strict=True):
            if tip <= 0:
                raise SurfaceError(
                    f"profile_shift = {self.profile_shift}: the teeth of the gear with {z} are "
                    "pointed below their tip circle: lower its profile shift or the addendum"
                )
        return first, last

    @property
    def tips_m(self) -> tuple[float, float]:
        """Return s at the tip of the wheel and at the tip of the pinion."""
        first, second = (
            math.sqrt(max(tip**2 - base**2, 0.0))
            for tip, base in zip(self.tip_radii_m, self.base_radii_m, strict=True)
        )
        return self.action_m - second, first

    @property
    def involutes_m(self) -> tuple[float, float]:
        """Return s at which the involutes of pinion and wheel start (:mod:`.rack`)."""
        (first, _), (second, _) = self.starts_m
        return first, self.action_m - second

    @property
    def notes(self) -> str:
        """Return why the path is shorter and whether the backlash is unusual; else nothing."""
        backlash = self.backlash_m
        wide = (
            f"backlash of {backlash * 1e3:.3g} mm: centre_distance_m = {self.working_distance_m:g} "
            "needs a larger sum of profile_shift to mesh closely"
        )
        is_wide = backlash > LARGEST_BACKLASH * self.module_m
        return "; ".join(filter(None, (self.shortening, wide if is_wide else "")))

    @property
    def shortening(self) -> str:
        """Return why the path ends before the tips, in words; nothing where it does not."""
        lost = (self.involutes_m[0] - self.tips_m[0], self.tips_m[1] - self.involutes_m[1])
        found = [
            (
                f"the rack undercuts the gear with {z} teeth, which shortens the path of contact "
                f"by {length * 1e3:.3g} mm: a profile_shift of {least:.3f} or more avoids it"
                if is_cut
                else f"the tip of the gear with {mate} teeth reaches the fillet of the gear with "
                f"{z}, where no involute is left over {length * 1e3:.3g} mm of the path: lower "
                "addendum, or raise profile_shift"
            )
            for z, mate, length, least, (_, is_cut) in zip(
                self.teeth, self.teeth[::-1], lost, self.least_shifts, self.starts_m, strict=True
            )
            if length > ROUND_OFF * self.module_m
        ]
        return "; ".join(found)

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
