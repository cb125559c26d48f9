"""Waves under slip in Carreau oils, of which no atlas is."""

import json
import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import ehlwave
from ehlwave.contact import conditions_from_keys
from ehlwave.contact.scales import moes_per_film
from ehlwave.contact.two_waves import MOST_CARREAU_SHEAR, SLIP_ERRORS, two_waves
from ehlwave.laws.atlas.coordinates import wave_components
from ehlwave.laws.sheared_ridges import error_of, gained, regained
from ehlwave.writing import Writer
from studies.atlas.waves import pattern
from studies.folds import held_out
from studies.judged.runs import groups_of, kept, log_uniform, solved
from studies.sweeps import Row

Floats = NDArray[np.float64]

RANGES = {
    "load_parameter_m": (20.0, 1000.0),
    "lubricant_parameter_l": (2.5, 20.0),
    "radius_ratio_d": (0.1, 1.0),
    "pressure_viscosity_per_pa": (1.2e-8, 2.4e-8),
    "roelands_index": (0.45, 0.7),
}
MODULUS_PA = 2.26e11
SLIP, WAVES = (0.3, 1.8), (0.25, 2.0)
CARREAU_PA, EXPONENT = (1e6, 3e7), (0.3, 0.9)
LONGITUDINAL_SHARE = 0.5
SIZES, FEWEST_POINTS = (128, 192, 256), 16
LENGTH = 4.0


def drawn(number: int) -> dict[str, float]:
    """Return keys of a contact and its wave, within the law of the two waves."""
    random = np.random.default_rng([520, number])
    while True:
        keys = {name: log_uniform(random, *ends) for name, ends in RANGES.items()}
        keys["reduced_modulus_pa"] = MODULUS_PA
        keys["slip_parameter"] = float(f"{random.uniform(*SLIP):.4g}")
        keys["carreau_modulus_pa"] = log_uniform(random, *CARREAU_PA)
        keys["carreau_exponent"] = log_uniform(random, *EXPONENT)
        sheared = zip(_stresses(keys), MOST_CARREAU_SHEAR, strict=True)
        if any(stress > most for stress, most in sheared):
            continue
        angle = 90.0 if random.random() < LONGITUDINAL_SHARE else random.uniform(0, 90)
        return keys | {
            "wavelength_over_a": log_uniform(random, *WAVES),
            "angle_deg": float(f"{angle:.4g}"),
        }


def _stresses(keys: dict[str, float]) -> tuple[float, float]:
    return conditions_from_keys(keys, needs_lengths=False).stresses_in_inlet


def study(number: int, folder: Path) -> Row:
    """Return the response of a wave, extrapolated, and the film."""
    row: Row = dict(drawn(number))
    keys = {k: v for k, v in row.items() if k not in ("wavelength_over_a", "angle_deg")}
    waves = pattern(row["wavelength_over_a"], row["angle_deg"])
    lengths = [length for length in waves.values() if length > 0]
    need = FEWEST_POINTS * LENGTH / min(lengths)
    cells = next((n for n in SIZES if n >= need), SIZES[-1])
    found = solved(
        groups_of(
            keys,
            waviness={"orientation": "custom", "response": "harmonic", **waves},
            grid={"cells_x": cells, "cells_y": cells},
            output={"mean_rise": False},
        ),
        folder,
    )
    if found is None:
        return row
    scale = found["central_film_moes"] / found["central_film"]
    return row | {
        "central": found["central_film_moes"],
        "minimum": found["minimum_film"] * scale,
        "central_error": found["central_film_error"],
        "real": found["harmonic_extrapolated_real"],
        "imaginary": found["harmonic_extrapolated_imaginary"],
        "error": found["harmonic_error"]
        * math.hypot(found["harmonic_real"], found["harmonic_imaginary"]),
    }


def computed(path: Path, count: int, at_once: int) -> list[Row]:
    """Return rows of so many waves."""
    return kept(path, range(count), study, at_once)


PACKAGE = Path(__file__).resolve().parents[2] / "src/ehlwave/laws/sheared_ridges.json"
START, ROBUST = (0.55, 0.73), {"loss": "soft_l1", "f_scale": 0.01}
FOLDS, LARGEST_ERROR = 12, 0.05
WITHIN, FAR, MOST_FAR = 0.98, 1.5, 0.01


def compared(rows: Sequence[Row]) -> list[Row]:
    """Return rows that the grid resolves, with the laws; ``law_off`` is not of ridges."""
    found = []
    for row in rows:
        if not row.get("error", 1.0) < LARGEST_ERROR:
            continue
        keys = {name: row[name] for name in (*RANGES, *_OWN)}
        contact = conditions_from_keys(keys, needs_lengths=False)
        rolls = ehlwave.Contact(**{name: row[name] for name in RANGES})
        film = rolls.film().central_moes / moes_per_film(contact.m, contact.kappa)
        wave, angle = row["wavelength_over_a"], row["angle_deg"]
        if angle == 90:
            rolling = rolls.response(wave, angle)
            gain = float(gained(contact, film, wave))
            more = {"rolling": rolling.film.real, "rolling_error": rolling.error, "gain": gain}
        else:
            both = two_waves(
                replace(contact, central_film_m=film, hertz_approach_c_m=1.0, film_source="study"),
                contact.slip_parameter,
                *wave_components(wave, angle),
            )
            more = {"law_off": abs(complex(both.at(0.0)) - complex(row["real"], row["imaginary"]))}
        found.append({**row, **more})
    return found


def fit(rows: Sequence[Row]) -> tuple[dict[str, list[float]], list[Row]]:
    """Return the coefficients of ridges, and a row for each law."""
    ridges = [row for row in rows if row["angle_deg"] == 90]
    columns = ("real", "rolling", "rolling_error", "gain")
    real, rolling, own, gain = (np.array([row[name] for row in ridges]) for name in columns)
    fold = np.random.default_rng(1).permutation(len(ridges)) % FOLDS
    best, off = held_out(lambda p: regained(rolling, gain, p).real, real, START, fold, **ROBUST)
    change = np.abs(regained(rolling, gain, best) - rolling)
    error = _error(_beyond(off, ridges), own, change)
    bars = own + error_of(change, error)
    waves = np.array([row["law_off"] for row in rows if "law_off" in row])
    table = [
        _row("ridges, rolling", _beyond(real - rolling, ridges), own),
        _row("ridges", _beyond(off, ridges), bars),
        _row("others, two waves", waves, np.full(waves.size, SLIP_ERRORS["Carreau"])),
    ]
    found = {"regained": best, "error": error}
    return {name: [float(f"{c:.4g}") for c in values] for name, values in found.items()}, table


def write(coefficients: dict[str, list[float]], path: Path = PACKAGE) -> None:
    """Write the coefficients where the package reads them."""
    Writer(overwrite=True).text(path, json.dumps(coefficients, indent=1) + "\n")


_OWN = ("reduced_modulus_pa", "slip_parameter", "carreau_modulus_pa", "carreau_exponent")


def _beyond(off: Floats, rows: Sequence[Row]) -> Floats:
    """Return differences beyond half the estimated error of the computed responses."""
    return np.maximum(np.abs(off) - 0.5 * np.array([row["error"] for row in rows]), 0)


def _error(off: Floats, own: Floats, change: Floats) -> Floats:
    """Return c0 and c1 of the least mean error that holds."""
    best, least = np.array([np.nan, np.nan]), np.inf
    for c in product(np.linspace(0, 0.03, 16), np.linspace(0, 0.6, 31)):
        bars = own + error_of(change, c)
        times = np.abs(off) / bars
        holds = np.mean(times <= 1) >= WITHIN and np.mean(times > FAR) <= MOST_FAR
        if holds and bars.mean() < least:
            best, least = np.array(c), float(bars.mean())
    return best


def _row(law: str, off: Floats, error: Floats) -> Row:
    times = np.abs(off) / error
    return {
        "law": law,
        "waves": len(off),
        "rms": float(np.sqrt(np.mean(off**2))),
        "mean_error": float(error.mean()),
        "within": float(np.mean(times <= 1)),
        "beyond_1.5": float(np.mean(times > FAR)),
    }
