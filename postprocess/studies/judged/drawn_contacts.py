"""Random contacts over shape, oil, slip, heat, starvation and direction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

import ehlwave

OILS = ("Newtonian", "Ree-Eyring", "Carreau")


@dataclass(frozen=True)
class Drawn:
    """A contact as keys, and a wave."""

    keys: dict[str, Any]
    heat: bool
    wavelength_over_a: float
    angle_deg: float

    def contact(self) -> ehlwave.Contact:
        """Return the contact."""
        heat = ehlwave.Heat(**HEAT) if self.heat else None
        return ehlwave.Contact(heat=heat, **self.keys)


HEAT: dict[str, Any] = {
    "temperature_k": 333.15,
    "viscosity_temperature_per_k": 0.035,
    "oil_conductivity_w_per_m_k": 0.14,
    "oil_heat_capacity_j_per_kg_k": 2000.0,
    "oil_density_kg_per_m3": 850.0,
}


def drawn(count: int, seed: int) -> list[Drawn]:
    """Return random contacts of catalogue kind, in the ranges of the laws or a little outside.

    Parameters
    ----------
    count : int
        Number of contacts.
    seed : int
        Seed of the random numbers.
    """
    rng = np.random.default_rng(seed)
    return [_one(rng) for _ in range(count)]


def _one(rng: np.random.Generator) -> Drawn:
    keys: dict[str, Any] = {
        "radius_x_m": float(np.exp(rng.uniform(np.log(4e-3), np.log(4e-2)))),
        "reduced_modulus_pa": 2.26e11,
        "mean_speed_m_per_s": float(np.exp(rng.uniform(np.log(0.3), np.log(8)))),
        "viscosity_pa_s": float(np.exp(rng.uniform(np.log(0.01), np.log(0.2)))),
        "pressure_viscosity_per_pa": float(rng.uniform(1.5e-8, 2.4e-8)),
    }
    is_line = rng.random() < 0.2
    hertz = rng.uniform(0.4e9, 1.4e9)
    if is_line:
        keys["load_n_per_m"] = float(
            2 * np.pi * keys["radius_x_m"] * hertz**2 / keys["reduced_modulus_pa"]
        )
    else:
        ratio = float(np.exp(rng.uniform(0.0, np.log(8))))
        keys["radius_y_m"] = keys["radius_x_m"] * ratio
        keys["load_n"] = float(
            (2 * np.pi) ** 3
            * hertz**3
            * keys["radius_x_m"] ** 2
            * ratio
            / (12 * keys["reduced_modulus_pa"] ** 2)
        )
    is_starved = not is_line and rng.random() < 0.15
    if is_starved:
        keys["oil_over_flooded"] = float(rng.uniform(0.4, 1.5))
    elif rng.random() < 0.6:
        keys["slide_to_roll_ratio"] = float(rng.choice([-1, 1]) * rng.uniform(0.02, 1.0))
    oil = OILS[rng.integers(3)]
    if oil == "Ree-Eyring":
        keys["eyring_stress_pa"] = float(rng.uniform(4e6, 1e7))
    elif oil == "Carreau":
        keys |= {"carreau_modulus_pa": 7e6, "carreau_exponent": float(rng.uniform(0.4, 0.8))}
    angle = 0.0 if is_line else float(rng.choice([0.0, 90.0, rng.uniform(5, 85)]))
    wave = float(np.exp(rng.uniform(np.log(0.15), np.log(3))))
    return Drawn(keys, not is_starved and bool(rng.random() < 0.25), wave, angle)
