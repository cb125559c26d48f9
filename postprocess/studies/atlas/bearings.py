"""Bearings as catalogues have them.

Boundary dimensions follow ISO 15; the inside of a bearing, and its operation, is drawn.
"""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

import ehlwave

BOUNDARIES_MM = {
    "60": ((10, 26), (15, 32), (20, 42), (30, 55), (40, 68), (50, 80), (70, 110), (100, 150)),
    "62": ((10, 30), (15, 35), (20, 47), (30, 62), (40, 80), (50, 90), (70, 125), (100, 180)),
    "63": ((10, 35), (15, 42), (20, 52), (30, 72), (40, 90), (50, 110), (70, 150), (100, 215)),
}
"""Bore and outer diameter of bearings of these dimension series, ISO 15."""

ROLLER_SERIES = ("62", "63")
"""Those that cylindrical roller bearings share, as N 2 and N 3 (DIN 5412)."""

ANGLES_DEG = (0.0, 0.0, 15.0, 25.0, 40.0)
"""Contact angles: half of the bearings have deep grooves, the others are of the usual angles."""

BALL_SHARE = (0.28, 0.33)
"""Diameter of balls over the difference of outer diameter and bore, usual in these series."""

OSCULATION = (0.515, 0.53)
"""Radius of grooves over the diameter of balls (Harris and Kotzalas 2007)."""

ROLLER_SHARE = (0.24, 0.29)
"""Diameter of cylindrical rollers over the same difference, usual in series 62 and 63."""

RATED_PA, RATED_LINE_PA = 4.2e9, 4e9
"""Hertz pressure of the most loaded ball, or roller, under the static load rating, ISO 76."""

LOAD_SHARE = (0.01, 0.3)
"""Load of a ball or roller, over the load at this pressure: static safety factors of 100 to 3.3."""

SPEED_FACTOR = (2e4, 5e5)
"""Revolutions a minute times mean diameter, mm: up to the catalogue limits for oil and grease."""

VISCOSITY_PA_S = (0.005, 0.2)
"""Where they run: ISO VG 15 to 460 at 40 to 100 C."""

PRESSURE_VISCOSITY_PER_PA = (1.2e-8, 2.5e-8)
ROELANDS = (0.5, 0.7)

CONTACTS, SEED = 300, 76


def ball_contacts(count: int = CONTACTS, seed: int = SEED) -> Iterator[ehlwave.Contact]:
    """Yield contacts of balls with inner and outer rings in turn."""
    random = np.random.default_rng(seed)
    for number in range(count):
        series = BOUNDARIES_MM[str(random.choice(list(BOUNDARIES_MM)))]
        bore, outer = series[random.integers(len(series))]
        pitch = (bore + outer) / 2
        ball_mm = (outer - bore) * random.uniform(*BALL_SHARE)
        angle = float(random.choice(ANGLES_DEG))
        race = _race_of(number)(
            *(1e-3 * ball_mm, 1e-3 * pitch), random.uniform(*OSCULATION), angle, material="steel"
        )
        oil = _oil(random, ball_mm, pitch, angle)
        ball = ehlwave.Body.ball(1e-3 * ball_mm, material="steel")
        one = ehlwave.Contact.from_bodies(ball, race, load_n=1.0, **oil)
        rated = (RATED_PA / one.conditions.hertz_pa) ** 3
        load = rated * log_uniform(random, LOAD_SHARE)
        yield ehlwave.Contact.from_bodies(ball, race, load_n=load, **oil)


def roller_contacts(count: int = CONTACTS, seed: int = SEED) -> Iterator[ehlwave.Contact]:
    """Yield line contacts of cylindrical rollers with inner and outer rings in turn."""
    random = np.random.default_rng(seed)
    for number in range(count):
        series = BOUNDARIES_MM[str(random.choice(ROLLER_SERIES))]
        bore, outer = series[random.integers(len(series))]
        pitch = (bore + outer) / 2
        roller_mm = (outer - bore) * random.uniform(*ROLLER_SHARE)
        race = _race_of(number)(1e-3 * roller_mm, 1e-3 * pitch, material="steel")
        oil = _oil(random, roller_mm, pitch)
        roller = ehlwave.Body(radius_x_m=5e-4 * roller_mm, material="steel")
        one = ehlwave.Contact.from_bodies(roller, race, load_n_per_m=1.0, **oil)
        rated = (RATED_LINE_PA / one.conditions.hertz_pa) ** 2
        load = rated * log_uniform(random, LOAD_SHARE)
        yield ehlwave.Contact.from_bodies(roller, race, load_n_per_m=load, **oil)


def _race_of(number: int) -> Callable[..., ehlwave.Body]:
    return ehlwave.Body.outer_race if number % 2 else ehlwave.Body.inner_race


def log_uniform(random: np.random.Generator, ends: tuple[float, float]) -> float:
    """Return a number between two ends, its logarithm evenly spread."""
    return float(np.exp(random.uniform(*np.log(ends))))


def _oil(
    random: np.random.Generator, element_mm: float, pitch: float, angle: float = 0.0
) -> dict[str, Any]:
    """Return the oil of a bearing, and the speed of its contacts."""
    rolling = 1e-3 * (pitch - element_mm**2 * np.cos(np.radians(angle)) ** 2 / pitch) / 2
    speed = rolling * np.pi * log_uniform(random, SPEED_FACTOR) / pitch / 60
    return {**oil_of(random, VISCOSITY_PA_S), "mean_speed_m_per_s": float(speed)}


def oil_of(random: np.random.Generator, viscosity: tuple[float, float]) -> dict[str, Any]:
    """Return the oil of a contact, of a viscosity in this range."""
    return {
        "viscosity_pa_s": log_uniform(random, viscosity),
        "pressure_viscosity_per_pa": random.uniform(*PRESSURE_VISCOSITY_PER_PA),
        "roelands_index": random.uniform(*ROELANDS),
    }
