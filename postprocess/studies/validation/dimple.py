"""The rolling dimple where the published simulation has it, and how far the two are apart."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from studies.validation.dimple_runs import (
    RADIUS_UM,
    WIDE_DOMAIN,
    Floats,
    Grid,
    Line,
    dimple_lines,
    smooth_lines,
)
from studies.validation.published import centre_line

OUTSIDE, INSIDE = 0.05, 0.08
"""Allowed deviation of the film from the published simulation, outside the dimple and inside."""

INSTANTS = (1, 4)

GRIDS = (Grid(32), Grid(64))
DOMAINS = (Grid(16), Grid(16, WIDE_DOMAIN))
"""Two mesh sizes, of which the second counts, and two domains."""


@dataclass(frozen=True)
class Dimple:
    """Result of the runs: lines of both instants on the finer grid, and their errors."""

    centre_um: float
    lines: dict[int, Line]
    coarse: dict[int, Line]
    domain_error: float
    """Relative: central film of the smooth contact on the wide domain less that on ours."""

    def deviations(self, instant: int, quantity: str) -> tuple[Floats, Floats, Floats, Floats]:
        """Return places, published values, ours, and ours on the coarser grid."""
        x, value = (np.array(one) for one in centre_line("simulated", instant, quantity))
        fine, coarse = (run[instant].at(quantity, x) for run in (self.lines, self.coarse))
        return x, value, fine, coarse

    def is_inside(self, instant: int, x_um: Floats) -> np.ndarray:
        """Whether places are inside the dimple, which is in the contact at instant 4 only."""
        return (np.abs(x_um - self.centre_um) <= RADIUS_UM) & (instant == INSTANTS[-1])


def dimple_place(x_um: Floats, film_nm: Floats) -> float:
    """Return the middle of the dimple's film, um: between its two crossings of half its height.

    Looked for within 60 um of the centre of the contact; the height is counted from the median of
    the film there.
    """
    near = np.abs(x_um) <= 60
    x, film = x_um[near], film_nm[near]
    half = 0.5 * (film.max() + np.median(film))
    above = np.flatnonzero(film > half)
    first, last = above[0], above[-1]
    left = np.interp(half, film[first - 1 : first + 1], x[first - 1 : first + 1])
    right = np.interp(half, film[last : last + 2][::-1], x[last : last + 2][::-1])
    return float(0.5 * (left + right))


def computed(folder: Path) -> Dimple:
    """Run what is needed in `folder`; the dimple is put where the published film has it."""
    published = (np.array(one) for one in centre_line("simulated", 4, "film"))
    wanted = dimple_place(*published)
    (found,) = dimple_lines(folder, "dimple_first", GRIDS[:1], wanted)
    places = np.linspace(-60, 60, 2401)
    centre = wanted - (dimple_place(places, found.at("film", places)) - wanted)
    rough = dimple_lines(folder, "dimple", GRIDS, centre)
    *smooth, near, wide = smooth_lines(folder, (*GRIDS, *DOMAINS))
    middle = np.zeros(1)
    return Dimple(
        centre,
        dict(zip(INSTANTS, (smooth[1], rough[1]), strict=True)),
        dict(zip(INSTANTS, (smooth[0], rough[0]), strict=True)),
        float(wide.at("film", middle)[0] / near.at("film", middle)[0] - 1),
    )
