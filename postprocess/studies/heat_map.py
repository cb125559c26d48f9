"""Steps of ``scripts/study heat-map``: contacts with heat, drawn at random over the conditions of machines."""

import argparse
import math
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from scipy.special import ellipe, ellipk

from studies.programs import Groups

PRESSURE = 0.3e9, 2e9
SPEED = 0.1, 30.0
KINDS = ("line", "circle", "ellipse", "circle")


def draw(number: int) -> Groups:
    """Return a contact as groups of keys.

    The Hertz pressure is 0.3 to 2 GPa, the mean speed 0.1 to 30 m/s, the slide-to-roll ratio 0 to 2.
    """
    rng = np.random.default_rng([38, number])

    def between(low: float, high: float, digits: int = 4) -> float:
        return float(f"{low * (high / low) ** rng.random():.{digits}g}")

    kind = KINDS[number % len(KINDS)]
    pressure, modulus = between(*PRESSURE), 2.26e11
    conditions = {
        "radius_x_m": between(5e-3, 4e-2),
        "reduced_modulus_pa": modulus,
        "mean_speed_m_per_s": between(*SPEED),
        "viscosity_pa_s": between(0.01, 0.2),
        "slide_to_roll_ratio": float(f"{2 * rng.random():.4g}"),
    }
    lubricant = {"pressure_viscosity_per_pa": between(1.2e-8, 2.4e-8), "temperature_k": between(300, 380)}
    lubricant["roelands_index"] = between(0.45, 0.7)
    flow = ("eyring", "carreau", "eyring", "newtonian")[int(4 * rng.random())]
    lubricant["flow_law"] = flow
    if flow == "eyring":
        lubricant["eyring_stress_pa"] = between(3e6, 1e7)
    elif flow == "carreau":
        lubricant |= {"carreau_modulus_pa": between(3e6, 1e7), "carreau_exponent": between(0.35, 0.8)}
    heat = {
        "oil_conductivity_w_per_m_k": between(0.12, 0.16),
        "oil_heat_capacity_j_per_kg_k": between(1700, 2300),
        "oil_density_kg_per_m3": between(820, 950),
        "oil_expansion_per_k": 7e-4,
        "viscosity_temperature_per_k": between(0.025, 0.06),
    }
    ratio = {"line": 0.0, "circle": 1.0, "ellipse": float(rng.uniform(0.25, 0.9))}[kind]
    conditions |= load(kind, ratio, pressure, conditions["radius_x_m"], modulus)
    return {"conditions": conditions, "lubricant": lubricant, "heat": heat}


def load(kind: str, ratio: float, pressure: float, radius: float, modulus: float) -> dict[str, float]:
    """Return the keys of the load, of `ratio` a/b, and of the radius across: (1), (20), (L2)."""
    if kind == "line":
        a = 4 * radius * pressure / modulus
        return {"load_n_per_m": math.pi * a * pressure / 2}
    k, e = ellipk(1 - ratio**2), ellipe(1 - ratio**2)
    d = 1.0 if ratio == 1 else ratio**2 * (k - e) / (e - ratio**2 * k)
    a = 4 * radius / (1 + d) * e * pressure / modulus
    return {"radius_y_m": radius / d, "load_n": 2 * math.pi * a**2 / ratio * pressure / 3}
