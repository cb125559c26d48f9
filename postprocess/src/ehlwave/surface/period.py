"""A period cut from a measured trace, whose copies join without a jump."""

from dataclasses import replace

import numpy as np
import scipy

from ehlwave.errors import SurfaceError
from ehlwave.surface.surface import Surface

BLENDED_SHARE = 0.25
"""Share of the period in which its end fades into the wave before."""


def cut_period(surface: Surface, length_m: float, start_m: float | None = None) -> Surface:
    """Return a period of a trace along rolling, mean 0, that continues smoothly in its copies.

    Over the last quarter of the period the heights fade over, by half a cosine, into the heights
    one period before: there the copy that follows begins, with this height and this slope.

    Parameters
    ----------
    surface : Surface
        A trace along rolling, its form removed.
    length_m : float
        The period, m; sampled anew so that it holds a whole number of steps, about as long as
        the trace's.
    start_m : float, optional
        Where the period begins, m from the first point of the trace; by default the period is in
        the middle of the trace.

    Raises
    ------
    SurfaceError
        If the surface is not such a trace, the period has fewer than 8 steps, or the trace does
        not hold the period and the quarter of a period before it.
    """
    name = surface.name
    if not surface.is_trace or surface.trace_axis == "y":
        raise SurfaceError(f"{name}: a period can be cut out of a trace along rolling only")
    points = surface.height.shape[0]
    total = (points - 1) * surface.step_x_m
    if not length_m >= 8 * surface.step_x_m:
        raise SurfaceError(
            f"{name}: a period of {length_m * 1e6:g} um is shorter than 8 steps of "
            f"{surface.step_x_m * 1e6:g} um"
        )
    start = 0.5 * (total - length_m) if start_m is None else start_m
    fade = BLENDED_SHARE * length_m
    rounding = 1e-9 * total
    if start - fade < -rounding or start + length_m > total + rounding:
        raise SurfaceError(
            f"{name}: a period of {length_m * 1e6:g} um from {start * 1e6:g} um needs the trace "
            f"from {(start - fade) * 1e6:g} to {(start + length_m) * 1e6:g} um; it reaches from 0 "
            f"to {total * 1e6:g} um"
        )
    height_at = scipy.interpolate.CubicSpline(
        np.arange(points) * surface.step_x_m, surface.height[:, 0]
    )
    count = max(8, round(length_m / surface.step_x_m))
    x = length_m * np.arange(count) / count
    share = np.clip((x - (length_m - fade)) / fade, 0, 1)
    before = 0.5 - 0.5 * np.cos(np.pi * share)
    # Positions where nothing is taken over may lie before the trace; their weight is 0.
    earlier = height_at(np.maximum(start + x - length_m, 0))
    height = (1 - before) * height_at(start + x) + before * earlier
    return replace(surface, height=(height - height.mean())[:, None], step_x_m=length_m / count)
