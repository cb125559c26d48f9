"""The simulations as sweeps: single waves for harmonic tables, and each surface at all speeds."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ehlwave import Contact
from ehlwave.results.points import select_points
from ehlwave.results.read import read_results
from ehlwave.surface import Conditions, Surface
from ehlwave.surface.harmonics import write_harmonic_table
from studies import sweeps

# Table 1 of the paper: ball on disc.
CONTACT = {
    "radius_x_m": 12.52e-3,
    "radius_y_m": 12.52e-3,
    "reduced_modulus_pa": 1.17e11,
    "load_n": 39.2,
    "viscosity_pa_s": 1.22,
}
LUBRICANT = {"pressure_viscosity_per_pa": 2.25e-8, "roelands_index": 0.484}
SPEEDS = (0.024, 0.096)

TABLE = "waves"
"""Of the files of the sweep of single waves."""
TABLE_WAVES = (0.25, 0.35, 0.5, 0.7, 1.0, 1.5, 2.2, 3.2)  # min(lambda)/a
TABLE_RATIOS = (0.0, 0.5, 1.0, 2.0, np.inf)  # lambda_x/lambda_y


def contact_at(speed: float) -> Contact:
    """Return the contact at a mean speed, m/s, as a user has it."""
    return Contact(**CONTACT, **LUBRICANT, mean_speed_m_per_s=speed)


def conditions_at(speed: float) -> Conditions:
    """Return its conditions, the film by formula."""
    return contact_at(speed).conditions


def write_waves(
    folder: Path,
    cells: int,
    speeds: Sequence[float] = SPEEDS,
    ratios: Sequence[float] = TABLE_RATIOS,
    waves: Sequence[float] = TABLE_WAVES,
) -> Path:
    """Write the sweep of linear responses to single waves; return the path of its file."""
    # Single plane waves, also oblique ones: only these have a mean film of their own.
    rows = (
        {
            "mean_speed_m_per_s": speed,
            "wavelength_x_over_a": x,
            "wavelength_y_over_a": y,
            "oblique": x > 0 and y > 0,
        }
        for speed in speeds
        for x, y in _wavelengths(ratios, waves)
    )
    waviness = {"orientation": "custom", "response": "harmonic"}
    return sweeps.write_sweep(folder, TABLE, rows, {**_shared(cells), "waviness": waviness})


def write_tables(folder: Path, speeds: Sequence[float] = SPEEDS) -> None:
    """Write the harmonic table of each speed from the results of the single waves."""
    points = select_points(read_results([folder / f"{TABLE}.h5"]), include_unresolved=True)
    for speed in speeds:
        chosen = np.isclose(points["load_parameter_m"], conditions_at(speed).m, rtol=1e-6)
        write_harmonic_table(table_file(folder, speed), points.isel(case=np.flatnonzero(chosen)))


def table_file(folder: Path, speed: float) -> Path:
    """Return where the harmonic table of a speed is."""
    return folder / f"harmonics-{speed:g}.csv"


def write_surface(
    folder: Path, surface: Surface, cells: int, speeds: Sequence[float] = SPEEDS
) -> Path:
    """Write a surface and its sweep over the speeds; return the path of the sweep's file."""
    groups = {
        **_shared(cells),
        "surface": {"file": str(sweeps.write_surface(folder, surface).resolve())},
        "output": {"fields": True},
    }
    rows = ({"mean_speed_m_per_s": speed} for speed in speeds)
    return sweeps.write_sweep(folder, surface.name, rows, groups)


def _shared(cells: int) -> dict[str, dict[str, Any]]:
    return {
        "conditions": CONTACT,
        "lubricant": LUBRICANT,
        "grid": {"cells_x": cells, "cells_y": cells, "edges": "flooded"},
        "solver": {"error_estimate": "model"},
    }


def _wavelengths(ratios: Sequence[float], waves: Sequence[float]) -> Iterator[tuple[float, float]]:
    """Yield lambda_x/a and lambda_y/a, the shorter one from `waves`; 0 is no variation."""
    for ratio in ratios:
        for wave in waves:
            if np.isinf(ratio):
                yield 0.0, wave
            else:
                wave_x = wave * max(1.0, ratio)
                yield wave_x, wave_x / ratio if ratio else 0.0
