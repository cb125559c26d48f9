"""Ball bearings as catalogues have them: how many of their contacts the atlas answers, how well.

Boundary dimensions are those of ISO 15; what is in a bearing, and how it is run, is drawn.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

import ehlwave
from ehlwave.atlas.atlas import Atlas, chart_of
from ehlwave.atlas.kinds import WIDE
from ehlwave.errors import RangeError
from studies import sweeps
from studies.atlas.design import WIDE_DESIGN, random_wave

BOUNDARIES_MM = {
    "60": ((10, 26), (15, 32), (20, 42), (30, 55), (40, 68), (50, 80), (70, 110), (100, 150)),
    "62": ((10, 30), (15, 35), (20, 47), (30, 62), (40, 80), (50, 90), (70, 125), (100, 180)),
    "63": ((10, 35), (15, 42), (20, 52), (30, 72), (40, 90), (50, 110), (70, 150), (100, 215)),
}
"""Bore and outer diameter of bearings of these dimension series, ISO 15."""

ANGLES_DEG = (0.0, 0.0, 15.0, 25.0, 40.0)
"""Contact angles: half of the bearings have deep grooves, the others are of the usual angles."""

BALL_SHARE = (0.28, 0.33)
"""Diameter of balls over the difference of outer diameter and bore, usual in these series."""

OSCULATION = (0.515, 0.53)
"""Radius of grooves over the diameter of balls (Harris and Kotzalas 2007)."""

RATED_PA = 4.2e9
"""Hertz pressure of the most loaded ball under the static load rating, ISO 76."""

LOAD_SHARE = (0.01, 0.3)
"""Of a ball, over that at this pressure: static safety factors of 100 to 3.3."""

SPEED_FACTOR = (2e4, 5e5)
"""Revolutions a minute times mean diameter, mm: up to what catalogues give for oil and grease."""

VISCOSITY_PA_S = (0.005, 0.2)
"""Where they run: ISO VG 15 to 460 at 40 to 100 C."""

PRESSURE_VISCOSITY_PER_PA = (1.2e-8, 2.5e-8)
ROELANDS = (0.5, 0.7)

CONTACTS, COMPUTED, SEED = 300, 30, 76


def contacts(count: int = CONTACTS) -> Iterator[ehlwave.Contact]:
    """Yield contacts of balls with inner and outer rings in turn."""
    random = np.random.default_rng(SEED)

    def log(ends: tuple[float, float]) -> float:
        return float(np.exp(random.uniform(*np.log(ends))))

    for number in range(count):
        series = BOUNDARIES_MM[str(random.choice(list(BOUNDARIES_MM)))]
        bore, outer = series[random.integers(len(series))]
        pitch = (bore + outer) / 2
        ball_mm = (outer - bore) * random.uniform(*BALL_SHARE)
        angle = float(random.choice(ANGLES_DEG))
        race_of = ehlwave.Body.outer_race if number % 2 else ehlwave.Body.inner_race
        race = race_of(
            *(1e-3 * ball_mm, 1e-3 * pitch), random.uniform(*OSCULATION), angle, material="steel"
        )
        rolling = 1e-3 * (pitch - ball_mm**2 * np.cos(np.radians(angle)) ** 2 / pitch) / 2
        speed = rolling * np.pi * log(SPEED_FACTOR) / pitch / 60
        oil: dict[str, Any] = {
            "viscosity_pa_s": log(VISCOSITY_PA_S),
            "pressure_viscosity_per_pa": random.uniform(*PRESSURE_VISCOSITY_PER_PA),
            "roelands_index": random.uniform(*ROELANDS),
            "mean_speed_m_per_s": float(speed),
        }
        ball = ehlwave.Body.ball(1e-3 * ball_mm, material="steel")
        one = ehlwave.Contact.from_bodies(ball, race, load_n=1.0, **oil)
        rated = (RATED_PA / one.conditions.hertz_pa) ** 3
        yield ehlwave.Contact.from_bodies(ball, race, load_n=rated * log(LOAD_SHARE), **oil)


def answered(atlas: Atlas | None) -> tuple[list[ehlwave.Contact], list[str]]:
    """Return contacts that the atlas answers, and why it does not answer the others."""
    found, refused = [], []
    for contact in contacts():
        try:
            chart_of(contact.conditions, atlas)
        except RangeError as error:
            refused.append(str(error))
        else:
            found.append(contact)
    return found, refused


def write(folder: Path, atlas: Atlas | None) -> Path:
    """Write the sweep of some of those that are answered, two random waves in each."""
    random = np.random.default_rng(SEED)
    rows = []
    for contact in answered(atlas)[0][:COMPUTED]:
        place = contact.conditions.atlas_keys()
        keys = {key: float(f"{place[key]:.6g}") for key in WIDE.ranges}
        for _ in range(2):
            waves = random_wave(WIDE_DESIGN, keys, random)
            rows.append({**keys, **waves, **WIDE_DESIGN.domain(keys)})
    return sweeps.write_sweep(folder, "bearings", rows, WIDE_DESIGN.groups)


def text(atlas: Atlas | None) -> str:
    """Return how many are answered, and where all of them lie."""
    found, refused = answered(atlas)
    places = [contact.conditions.atlas_keys() for contact in contacts()]
    ends = "; ".join(
        f"{key} {np.quantile(values, 0.02):.3g} to {np.quantile(values, 0.98):.3g}"
        for key in WIDE.ranges
        for values in ([place[key] for place in places],)
    )
    share = 100 * len(found) / CONTACTS
    count = f"{len(found)} of {CONTACTS} contacts of bearings answered ({share:.1f} %)"
    return "\n".join([f"{count}; 96 % have {ends}", *(f"refused: {why}" for why in refused)])
