"""Heights that were not measured: missing heights, and marks far outside all others."""

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from ehlwave.errors import SurfaceError

Heights = NDArray[np.floating]

FARTHEST = 20.0
"""Ranges of all other heights by which no height of a surface lies outside them."""

LARGEST_SHARE = 0.1
"""Share of heights that may be filled, or are outliers."""


@dataclass(frozen=True)
class Gaps:
    """Treatment of heights that were not measured.

    ``fill``: they become their nearest neighbour's; the notes contain ``unit``.
    """

    fill: bool
    unit: str = ""


def without_gaps(place: str, height: Heights, gaps: Gaps) -> tuple[Heights, list[str]]:
    """Return heights with those that were not measured filled, and notes about it.

    Raises SurfaceError if a height lies far outside all others and is not to be filled, or more
    than a tenth would be filled: then it is not the surface any more.
    """
    if not gaps.fill:
        if (text := outliers_text(height)) is not None:
            raise SurfaceError(f"{place}: {text}")
        return height, []
    outside = outliers(height)
    missing = ~np.isfinite(height)
    count, marks = int(missing.sum()), int(outside.sum())
    if count + marks == 0:
        return height, []
    if count + marks > LARGEST_SHARE * height.size:
        raise SurfaceError(
            f"{place}: {count + marks} of {height.size} heights are missing, more than a tenth: "
            "measure again or cut the surface to a measured part"
        )
    if height.ndim == 1 and outside[:2].any() and not missing[:2].any():
        raise SurfaceError(
            f"{place}: {_described(height, outside)}; numbers above the heights are not filled: "
            "remove them"
        )
    notes = [f"filled with the nearest height: {count} missing of {height.size} heights"]
    if marks:
        notes = [f"{notes[0]}, and {_described(height, outside)} {gaps.unit}".rstrip()]
    lost = missing | outside
    nearest = scipy.ndimage.distance_transform_edt(
        lost, return_distances=False, return_indices=True
    )
    return height[tuple(nearest)], notes


def outliers(height: Heights) -> NDArray[np.bool_]:
    """Return which heights lie outside all others by twenty ranges of these; at most a tenth."""
    found = np.zeros(height.shape, dtype=bool)
    if height.size and _is_narrow(height):
        return found
    values = height[np.isfinite(height)].astype(np.float64)
    if values.size < 8:
        return found
    most = max(1, int(LARGEST_SHARE * values.size))
    # Only the ends are sorted: a map has millions of heights.
    places = sorted({0, values.size - 1, most, values.size - 1 - most})
    ends = np.partition(values, places)
    low, high = ends[most], ends[values.size - 1 - most]
    width = high - low
    if width <= 0 or max(high - ends[-1], ends[-1] - high, low - ends[0]) <= FARTHEST * width:
        return found
    lower = np.append(low, np.sort(values[values < low])[::-1])
    upper = np.append(high, np.sort(values[values > high]))
    bounds = []
    for edge, sign in ((lower, -1), (upper, 1)):
        steps = sign * np.diff(edge)
        spread = np.maximum(width, sign * (edge[:-1] - edge[0]) + width)
        far = np.flatnonzero(steps > FARTHEST * spread)
        bounds.append(edge[far[0]] if far.size else sign * np.inf)
    found[np.isfinite(height)] = False
    with np.errstate(invalid="ignore"):
        found |= (height < bounds[0]) | (height > bounds[1])
    found &= np.isfinite(height)
    return found


def _is_narrow(height: Heights) -> bool:
    """Return whether all heights lie within 20 widths of the inner ones, as a sample shows.

    True without sorting: at least a tenth of the heights lie below, and above, two heights a width
    apart.
    """
    least, most = float(height.min()), float(height.max())
    sample = height[tuple(slice(None, None, max(1, count // 64)) for count in height.shape)]
    low, high = np.quantile(sample, (0.2, 0.8)) if np.isfinite(most - least) else (0.0, 0.0)
    if not most - least <= FARTHEST * (high - low):
        return False
    count = LARGEST_SHARE * height.size + 1
    return bool(min(np.sum(height <= low), np.sum(height >= high)) > count)


def outliers_text(height: Heights) -> str | None:
    """Return a message about heights far outside all others; None if there are none."""
    found = outliers(height)
    if not found.any():
        return None
    return (
        f"{_described(height, found)}: if nothing was measured there, fill it with "
        "fill_missing=True, or remove it; numbers above the heights, such as a length and a count, "
        "must be removed"
    )


def _described(height: Heights, found: NDArray[np.bool_]) -> str:
    """Return which heights lie outside: the first of them with its index."""
    first = tuple(int(index) for index in np.argwhere(found)[0])
    rest = height[np.isfinite(height) & ~found]
    held = [index for index, size in zip(first, height.shape, strict=True) if size > 1]
    place = held[0] if len(held) == 1 else tuple(held)
    return (
        f"{int(found.sum())} of {height.size} heights lie far outside all others, which are "
        f"{rest.min():.4g} to {rest.max():.4g}: the first at index {place} is {height[first]:.6g}"
    )
