"""The rolling dimple where the published simulation has it, and how far the two are apart."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from studies.validation.dimple_runs import (
    CELLS_PER_A,
    RADIUS_UM,
    WIDE_DOMAIN,
    Floats,
    Line,
    dimple_line,
    smooth_line,
)
from studies.validation.published import centre_line

OUTSIDE, INSIDE = 0.05, 0.08
"""Allowed deviation of the film from the published simulation, outside the dimple and inside."""

INSTANTS = (1, 4)


@dataclass(frozen=True)
class Dimple:
    """What was run: the lines of both instants on the finer grid, and by how much they are off."""

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
    coarse, fine = CELLS_PER_A
    wanted = dimple_place(*(np.array(one) for one in centre_line("simulated", 4, "film")))
    found = dimple_line(folder, "dimple_first", coarse, wanted)
    places = np.linspace(-60, 60, 2401)
    lag = dimple_place(places, found.at("film", places)) - wanted
    smooth, rough = (
        {per_a: run(per_a) for per_a in CELLS_PER_A}
        for run in (
            lambda per_a: smooth_line(folder, per_a),
            lambda per_a: dimple_line(folder, f"dimple_{per_a}", per_a, wanted - lag),
        )
    )
    near, wide = (smooth_line(folder, coarse // 2, *one) for one in ((), (WIDE_DOMAIN,)))
    centre = np.zeros(1)
    return Dimple(
        wanted - lag,
        {1: smooth[fine], 4: rough[fine]},
        {1: smooth[coarse], 4: rough[coarse]},
        float(wide.at("film", centre)[0] / near.at("film", centre)[0] - 1),
    )
