"""Contacts with heat, drawn for the studies of warm films."""

import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ehlwave.contact import Conditions, conditions_from_keys
from ehlwave.contact.heat_data import BodyHeat, Heat
from ehlwave.laws.inlet_warming import thermal_loading
from studies.sweeps import Row, write_sweep

RANGES = {
    "radius_x_m": (4e-3, 4e-2),
    "reduced_modulus_pa": (1.1e11, 3.2e11),
    "hertz_pa": (3e8, 1.8e9),
    "mean_speed_m_per_s": (0.2, 30.0),
    "viscosity_pa_s": (3e-3, 0.2),
    "eyring_stress_pa": (2e6, 1.5e7),
    "body_conductivity_w_per_m_k": (0.5, 60.0),
    "slide_to_roll_ratio": (0.01, 1.9),
}
"""Drawn evenly in their logarithms."""
EVEN_RANGES = {
    "pressure_viscosity_per_pa": (1.1e-8, 2.6e-8),
    "roelands_index": (0.4, 0.7),
    "temperature_k": (293.0, 383.0),
    "viscosity_temperature_per_k": (0.015, 0.07),
    "oil_conductivity_w_per_m_k": (0.11, 0.17),
    "oil_heat_capacity_j_per_kg_k": (1700.0, 2400.0),
}
ROLLING_SHARE = 0.3
UNLIKE_SHARE = 0.3
"""Share of contacts with unlike conductivities."""
WIDE_RADII, WIDE_UNLIKE_SHARE = (4e-3, 1e-1), 0.5
"""Ranges of the contacts of this study."""
DENSITY, EXPANSION = 870.0, 7e-4
LARGEST_ERROR, RATIO_ERROR = 0.03, 0.15
"""Error of films of computed contacts, above which they are left out; of heavy films of bearings,
whose ratio to the cold film on the same grid counts.
"""
BEARING_LOADS, BEARING_OILS, BEARING_RATIOS = (100.0, 2e4), (2.0, 25.0), (0.012, 0.25)
"""M, L and D of contacts of rolling bearings, which roll."""
BEARING_RADII, BEARING_HERTZ_PA, BEARING_LOADINGS = (8e-4, 2e-2), (5e8, 3.5e9), (5e-3, 8.0)
BEARING_SEED, THICK_SEED = 54, 77
THICK_LOADS, THICK_OILS, THICK_FILMS, LIGHT = (2.0, 1500.0), (2.0, 20.0), (0.4, 1.0), 5.0
"""M, L, and film by the formula over the Hertz approach of thick films; light lines have any."""
MORE = {
    "bearings": {"x_min": -3.0, "x_max": 1.5, "y_max": 2.0, "cells_x": 256, "cells_y": 192},
    "thick": {"x_min": -8.0, "x_max": 2.5, "cells_x": 1536},
}
"""Grids of the groups of :func:`write_more`."""


def contact(rng: np.random.Generator, is_line: bool, is_wide: bool = False) -> Row:
    """Return a contact drawn from the ranges, or the wide ranges; for a point contact also D."""
    radii = {"radius_x_m": WIDE_RADII} if is_wide else {}
    unlike = WIDE_UNLIKE_SHARE if is_wide else UNLIKE_SHARE
    row: Row = {
        name: low * (high / low) ** rng.random() for name, (low, high) in (RANGES | radii).items()
    } | {name: low + (high - low) * rng.random() for name, (low, high) in EVEN_RANGES.items()}
    if rng.random() < ROLLING_SHARE:
        row["slide_to_roll_ratio"] = 0.0
    other = row["body_conductivity_w_per_m_k"]
    if rng.random() < unlike:
        low, high = RANGES["body_conductivity_w_per_m_k"]
        other = low * (high / low) ** rng.random()
    row["body2_conductivity_w_per_m_k"] = other
    hertz, load = row.pop("hertz_pa"), "load_n_per_m" if is_line else "load_n"
    if not is_line:
        row["radius_y_m"] = row["radius_x_m"] / 0.2 ** rng.random()
    one = conditions_from_keys({**dimensional_keys(row), load: 1.0}).hertz_pa
    row[load] = (hertz / one) ** (2 if is_line else 3)
    return {name: float(f"{value:.4g}") for name, value in row.items()}


def dimensional_keys(row: Mapping[str, float]) -> dict[str, float]:
    """Return the keys of conditions."""
    names = (
        *("radius_x_m", "radius_y_m", "reduced_modulus_pa", "load_n", "load_n_per_m"),
        *("mean_speed_m_per_s", "viscosity_pa_s", "slide_to_roll_ratio", "eyring_stress_pa"),
        *("pressure_viscosity_per_pa", "roelands_index"),
    )
    return {name: row[name] for name in names if name in row}


def film_over_approach(c: Conditions) -> float:
    """Return the film by the formula over the Hertz approach."""
    return (c.central_film_m or math.nan) / (c.hertz_approach_c_m or math.nan)


def heat_of(row: Row) -> Heat:
    """Return the heat data of a drawn contact."""
    own = {name: row[name] for name in EVEN_RANGES if name not in dimensional_keys(row)}
    bodies = (BodyHeat(row[f"{name}_conductivity_w_per_m_k"]) for name in ("body", "body2"))
    return Heat(**own, oil_density_kg_per_m3=DENSITY, body=next(bodies), body2=next(bodies))


def largest_error(group: str) -> float:
    """Return the error of films up to which computed contacts of a group count."""
    return RATIO_ERROR if group == "bearings" else LARGEST_ERROR


def bearing_contacts(count: int) -> list[Row]:
    """Return as many heavy, slender contacts as `count`, which roll as in ball bearings."""
    rng = np.random.default_rng(BEARING_SEED)
    rows: list[Row] = []

    def drawn(low: float, high: float) -> float:
        return float(low * (high / low) ** rng.random())

    while len(rows) < count:
        row = contact(rng, is_line=False) | {"slide_to_roll_ratio": 0.0}
        row["body2_conductivity_w_per_m_k"] = row["body_conductivity_w_per_m_k"]
        row["radius_x_m"] = drawn(*BEARING_RADII)
        row["radius_y_m"] = row["radius_x_m"] / drawn(*BEARING_RATIOS)
        one = conditions_from_keys(dimensional_keys(row | {"load_n": 1.0})).hertz_pa
        row["load_n"] = (drawn(*BEARING_HERTZ_PA) / one) ** 3
        row = {name: float(f"{value:.4g}") for name, value in row.items()}
        c = conditions_from_keys(dimensional_keys(row))
        loading = loading_of(row)
        ranges = (
            BEARING_LOADS[0] <= c.m <= BEARING_LOADS[1],
            BEARING_OILS[0] <= c.l <= BEARING_OILS[1],
        )
        if all(ranges) and BEARING_LOADINGS[0] <= loading <= BEARING_LOADINGS[1]:
            rows.append(row)
    return rows


def loading_of(row: Row) -> float:
    """Return L_t of a drawn contact."""
    return float(
        thermal_loading(
            row["viscosity_pa_s"],
            row["viscosity_temperature_per_k"],
            row["mean_speed_m_per_s"],
            row["oil_conductivity_w_per_m_k"],
        )
    )


def thick_contacts(count: int) -> list[Row]:
    """Return as many line contacts as `count` that are light, or have a thick film."""
    rng = np.random.default_rng(THICK_SEED)
    rows: list[Row] = []
    while len(rows) < count:
        row = contact(rng, is_line=True, is_wide=True)
        c = conditions_from_keys(dimensional_keys(row))
        film = film_over_approach(c)
        is_thick = film < THICK_FILMS[1] and (film > THICK_FILMS[0] or c.m < LIGHT)
        ranges = (THICK_LOADS[0] <= c.m <= THICK_LOADS[1], THICK_OILS[0] <= c.l <= THICK_OILS[1])
        if is_thick and all(ranges):
            rows.append(row)
    return rows


def write_more(folder: Path, count: int, has_cold: bool = False) -> None:
    """Write the sweeps of contacts of bearings and of thick films, without heat too if asked."""
    heat = {"oil_density_kg_per_m3": DENSITY, "oil_expansion_per_k": EXPANSION}
    oil = {"flow_law": "eyring"}
    for name, rows in (("bearings", bearing_contacts(count)), ("thick", thick_contacts(count))):
        grid = MORE[name] | {"edges": "flooded"}
        write_sweep(folder, name, rows, {"lubricant": oil, "heat": heat, "grid": grid})
        if has_cold:
            cold = [dimensional_keys(row) for row in rows]
            write_sweep(folder, f"{name}_cold", cold, {"lubricant": oil, "grid": grid})
