"""Involute of a gear cut by a rack: where it starts, and where the rack undercuts it.

The straight flank of the rack ends in a corner, h_a m below its reference line (ISO 53, profile A,
to 0.0002 m; its rounding below takes at most 2 % more of an undercut flank). A gear with profile
shift x rolls on the reference circle r, so that the corner reaches

    s_0 = r sin(alpha_t) - (h_a - x) m/sin(alpha_t)

along the line of action from the base tangent point: the involute starts there. Below 0, that is
for x < h_a - z sin(alpha_t)^2/(2 cos(beta)) (ISO 21771), the corner passes the base tangent point
and undercuts the flank: its trochoid meets the involute above the base circle.
"""

from __future__ import annotations

import math

import scipy


def involute_start_m(
    radius_m: float, transverse_angle_rad: float, corner_m: float
) -> tuple[float, bool]:
    """Return s at which the involute starts, and whether the rack undercuts it.

    Parameters
    ----------
    radius_m, transverse_angle_rad : float
        r, alpha_t.
    corner_m : float
        Depth of the corner below the rolling line of the rack, (h_a - x) m.

    Examples
    --------
    Module 1, 18 and 12 teeth; 12 teeth have undercut flanks:

    >>> import math
    >>> from ehlwave.elements.rack import involute_start_m
    >>> [f"{involute_start_m(z / 2, math.radians(20), 1)[0]:.3f}" for z in (18, 12)]
    ['0.154', '0.383']
    """
    sine, cosine = math.sin(transverse_angle_rad), math.cos(transverse_angle_rad)
    start = radius_m * sine - corner_m / sine
    if start >= 0:
        return start, False
    base = radius_m * cosine
    back = corner_m * math.tan(transverse_angle_rad)

    def above(rolled: float) -> float:
        """Return s of the involute at the radius of the corner."""
        return math.sqrt(max((rolled - back) ** 2 + (radius_m - corner_m) ** 2 - base**2, 0.0))

    def cut(rolled: float) -> float:
        """Return the angle by which the corner lies inside the tooth."""
        s = above(rolled)
        corner = math.atan2(rolled - back, radius_m - corner_m) - rolled / radius_m
        whole = math.tan(transverse_angle_rad) - transverse_angle_rad
        return corner - (s / base - math.atan(s / base) - whole)

    # The corner leaves the tooth between the base circle and the line of action.
    low = back + math.sqrt(max(base**2 - (radius_m - corner_m) ** 2, 0.0))
    high = corner_m / (sine * cosine)
    if cut(low) <= 0:  # undercut by round-off alone
        return 0.0, True
    return above(scipy.optimize.brentq(cut, low, high)), True
