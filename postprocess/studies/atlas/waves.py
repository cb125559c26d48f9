"""Waves of which the atlas is computed or judged, and the grids that resolve them."""

from collections.abc import Iterator, Mapping

import numpy as np

from ehlwave.laws.atlas.ranges import WAVE_RANGE
from studies.atlas.design import SIZES, Design

LONGITUDINAL = 100.0
"""Degrees up to which directions are drawn where a tenth shall be longitudinal."""

MARGIN = 1.15
"""By which wavelengths go beyond the range, so that its ends are not ends of the data."""

FEWEST_FOR_RISES = 8
"""Mesh sizes in a wave of which only the mean film is asked, on half the cells of its contact."""

MOST_CELLS = SIZES[-1]
"""In one direction, of waves that the atlas is judged by."""


def patterns(
    design: Design, contact: dict[str, float], random: np.random.Generator
) -> Iterator[dict[str, float]]:
    """Yield wavelengths of the patterns of a contact that its grid resolves."""
    cells_x, cells_y = (max(cells, design.most_cells) for cells in design.grid(contact))
    shortest = design.fewest_points * np.array(design.extent(contact)) / (cells_x, cells_y)
    for angle, count in design.directions:
        order = random.permutation(count)
        for place in order:
            most = LONGITUDINAL if design.most_cells else 90
            theta = np.radians(min(random.uniform(0, most), 90) if angle is None else angle)
            # Waves that the mesh resolves in neither direction are left out.
            low = max(WAVE_RANGE[0] / MARGIN, *(shortest * np.abs([np.cos(theta), np.sin(theta)])))
            high = WAVE_RANGE[1] * MARGIN
            wave = low * (high / low) ** ((place + random.random()) / count)
            yield pattern(wave, np.degrees(theta))


def pattern(wavelength_over_a: float, angle_deg: float) -> dict[str, float]:
    """Return the keys of a pattern by its wavelength along the wave vector and its direction."""
    theta = np.radians(angle_deg)
    along, across = np.cos(theta), np.sin(theta)
    return {
        "wavelength_x_over_a": 0.0 if along < 1e-9 else float(f"{wavelength_over_a / along:.7g}"),
        "wavelength_y_over_a": 0.0 if across < 1e-9 else float(f"{wavelength_over_a / across:.7g}"),
    }


def random_wave(
    design: Design, contact: dict[str, float], random: np.random.Generator
) -> dict[str, float]:
    """Return a pattern of any length and direction in the range, and a grid that resolves it.

    A quarter are transverse. Waves that 1024 cells do not resolve are drawn again.
    """
    while True:
        wave = random_wavelength(random)
        angle = 0.0 if random.random() < 0.25 else random.uniform(0, 90)
        waves = pattern(wave, angle)
        cells = cells_for(design, contact, waves)
        if max(cells) <= MOST_CELLS:
            return {**waves, **dict(zip(("cells_x", "cells_y"), cells, strict=True))}


def random_wavelength(random: np.random.Generator) -> float:
    """Return a wavelength over a, its logarithm evenly spread over the range."""
    low, high = WAVE_RANGE
    return low * (high / low) ** random.random()


def cells_for(
    design: Design, contact: Mapping[str, float], waves: Mapping[str, float]
) -> tuple[int, int]:
    """Return cells along X and Y that resolve a contact and a pattern."""
    lengths = waves["wavelength_x_over_a"], waves["wavelength_y_over_a"]
    found = []
    for cells, extent, length in zip(
        design.grid(contact), design.extent(contact), lengths, strict=True
    ):
        need = design.fewest_points * extent / length if length > 0 else 0.0
        found.append(next((n for n in (cells, *SIZES) if n >= max(cells, need)), MOST_CELLS + 1))
    return found[0], found[1]


def grid_for_rise(
    design: Design, contact: dict[str, float], wave: float, angle_deg: float
) -> dict[str, int]:
    """Return half the cells of a contact, or as many more as the wave asks for."""
    theta = np.radians(angle_deg)
    extent = design.extent(contact)
    shares = np.cos(theta), np.sin(theta)
    cells = []
    for whole, length, share in zip(design.grid(contact), extent, shares, strict=True):
        least = max(whole // 2, FEWEST_FOR_RISES * length / wave * share)
        cells.append(next(n for n in (64, 96, *SIZES) if n >= least))
    return {"cells_x": cells[0], "cells_y": cells[1]}
