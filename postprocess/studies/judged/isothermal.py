"""Isothermal contacts of all kinds: films, friction and responses of the package on fine grids."""

import math
from pathlib import Path

import numpy as np

import ehlwave
from ehlwave.errors import EhlwaveError
from studies.atlas.waves import pattern
from studies.judged.runs import groups_of, kept, log_uniform, solved
from studies.sweeps import Row

KINDS = ("rolling", "sliding", "line", "line_sliding", "line_newtonian", "slender")
RANGES = {
    "load_parameter_m": (20.0, 2000.0),
    "lubricant_parameter_l": (2.5, 20.0),
    "radius_ratio_d": (0.04, 1.0),
    "pressure_viscosity_per_pa": (1.1e-8, 2.8e-8),
    "roelands_index": (0.42, 0.78),
}
LINES = {"load_parameter_m": (2.0, 1000.0)}
SLENDER = {"load_parameter_m": (2000.0, 10000.0), "radius_ratio_d": (0.018, 0.1)}
EYRING_PA, MODULUS_PA, WAVES = (1e6, 2e7), 2.26e11, (0.25, 3.0)
SIZES, FEWEST_POINTS, LENGTH = (256, 384), 16, 4.0
LINE_GRID = {"cells_x": 3072, "x_min": -6.0, "x_max": 2.0}
WAVE_KEYS = ("wavelength_over_a", "angle_deg")


def drawn(number: int) -> Row:
    """Return the kind of a contact, its keys and a wave."""
    random = np.random.default_rng([522, number])
    kind = KINDS[number % len(KINDS)]
    ranges = RANGES | (LINES if "line" in kind else SLENDER if kind == "slender" else {})
    keys: Row = {name: log_uniform(random, *ends) for name, ends in ranges.items()}
    keys["reduced_modulus_pa"] = MODULUS_PA
    if "line" in kind:
        keys["radius_ratio_d"] = 0.0
    if kind in ("sliding", "line_sliding", "line_newtonian"):
        keys["slip_parameter"] = float(f"{random.uniform(0.5, 1.5):.4g}")
    if kind in ("sliding", "line_sliding"):
        keys["eyring_stress_pa"] = log_uniform(random, *EYRING_PA)
    angle = 0.0 if "line" in kind or random.random() < 0.25 else random.uniform(0, 90)
    keys |= {"wavelength_over_a": log_uniform(random, *WAVES), "angle_deg": float(f"{angle:.4g}")}
    return {"kind": kind, **keys}


def study(number: int, folder: Path) -> Row:
    """Return differences of the package and the program over the error of the former."""
    row = drawn(number)
    keys = {k: v for k, v in row.items() if k not in ("kind", *WAVE_KEYS)}
    wave = row["wavelength_over_a"], row["angle_deg"]
    try:
        contact = ehlwave.Contact(**keys)
        film, response = contact.film(), contact.response(*wave)
    except EhlwaveError as error:
        return row | {"refused": str(error)[:80]}
    waves = pattern(*wave)
    need = FEWEST_POINTS * LENGTH / min(length for length in waves.values() if length > 0)
    cells = next((n for n in SIZES if n >= need), SIZES[-1])
    is_line = keys["radius_ratio_d"] == 0
    grid: Row = LINE_GRID if is_line else {"cells_x": cells, "cells_y": cells}
    found = solved(
        groups_of(
            keys,
            grid=grid,
            waviness={"orientation": "custom", "response": "harmonic", **waves},
            output={"mean_rise": False},
        ),
        folder,
    )
    if found is None:
        return row
    true = complex(found["harmonic_extrapolated_real"], found["harmonic_extrapolated_imaginary"])
    scale = found["central_film_moes"] / found["central_film"]
    row |= {
        "central": found["central_film"] * scale,
        "central_own": found["central_film_error"],
        "central_law": film.central_moes,
        "central_law_error": film.central_error,
        "smallest": found["minimum_film"] * scale,
        "smallest_own": found["minimum_film_error"],
        "smallest_law": film.minimum_moes,
        "smallest_law_error": film.minimum_error,
        "response_off": abs(response.film - true),
        "response_own": found["harmonic_error"] * abs(true),
        "response_law_error": response.error,
    }
    if film.friction is not None:
        row |= {
            "friction": abs(found["friction_coefficient"]),
            "friction_own": found["friction_error"],
            "friction_law": abs(film.friction),
            "friction_law_error": film.friction_error,
        }
    return row


def times(row: Row, name: str, own: float = 1.0) -> float:
    """Return the deviation of the package over its error plus a share `own` of the computed one."""
    law, more = row.get(f"{name}_law_error"), row.get(f"{name}_own")
    if law is None or more is None:
        return math.nan
    if name == "response":
        return float(row["response_off"] / (law + own * more))
    return float(abs(row[f"{name}_law"] / row[name] - 1) / (law + own * more))


def computed(path: Path, count: int, at_once: int) -> list[Row]:
    """Return rows of so many contacts."""
    return kept(path, range(count), study, at_once)
