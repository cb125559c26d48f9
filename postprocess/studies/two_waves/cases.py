"""The cases of the study of two waves: space-filling over conditions, slip, oil and waves.

Every operating condition (M, L, D, alpha) is computed in pure rolling with a Newtonian oil and
under slip with an oil of its own, with the same waves: pairs show the effect of slip.
"""

import math
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_from_keys import conditions_from_keys
from studies.sweeps import Row, write_rows

REDUCED_MODULUS_PA = 226e9
"""Modulus of all cases: films depend on its product with the Eyring stress alone."""

LOADS = (20.0, 1000.0)
LUBRICANTS = (2.5, 20.0)
RATIOS = (0.1, 1.0)
ALPHAS_PER_PA = (1.2e-8, 3e-8)
STRESSES_PA = (1e6, 3e7)
SLIPS = (0.03, 0.8)
"""Range of |S - 1|."""

NEWTONIAN_SHARE = 0.2
"""Share of the conditions under slip."""

HERTZ_PA = (0.3e9, 2.5e9)
"""Conditions with other Hertz pressures are left out: no bearing has them."""

WAVES = 10
TRANSVERSE_SHARE = 0.4
PARAMETERS = (0.2, 5.0)
"""Range of the wave parameter (lambda_n/a) (gamma M)^(1/2) L^(-cos^2(theta)/3) times 0.263."""

SHORTEST, LONGEST = 0.15, 3.0
"""Range of lambda_n/a."""

LARGEST_ANGLE = math.radians(80)
"""Between wave vector and X; longitudinal ridges do not move."""

CASE_FILES = {"two_waves": (20000, 160), "two_waves_fresh": (11, 30)}
"""Seed and number of conditions of each; the fresh conditions share none with the others."""


def cases(seed: int, count: int) -> Iterator[Row]:
    """Yield the rows of so many operating conditions: for each wave pure rolling, then slip."""
    chosen = 0
    for unit in _sobol(7, seed):
        keys = _condition(unit)
        if keys is None:
            continue
        moes, rolling, sliding = keys
        for wave in _waves(moes, seed + 1 + chosen):
            yield {**moes, **rolling, **wave}
            yield {**moes, **sliding, **wave}
        chosen += 1
        if chosen == count:
            return


def _condition(unit: NDArray[np.float64]) -> tuple[Row, Row, Row] | None:
    """Return M, L, D and alpha; rolling and sliding keys; nothing outside bearings."""
    bounds = (LOADS, LUBRICANTS, RATIOS, ALPHAS_PER_PA, STRESSES_PA)
    m, l, d, alpha, stress = (
        _between(pair, share) for pair, share in zip(bounds, unit, strict=False)
    )
    hertz_pa = _contact(m, l, d).alphabar / alpha
    if not HERTZ_PA[0] <= hertz_pa <= HERTZ_PA[1]:
        return None
    moes = {
        "load_parameter_m": m,
        "lubricant_parameter_l": l,
        "radius_ratio_d": d,
        "pressure_viscosity_per_pa": alpha,
    }
    side = 1 if unit[5] >= 0.5 else -1
    slip = 1 + side * _between(SLIPS, abs(2 * unit[5] - 1))
    sliding: Row = {"slip_parameter": slip, "flow_law": "newtonian"}
    if unit[6] >= NEWTONIAN_SHARE:
        sliding |= {
            "flow_law": "eyring",
            "eyring_stress_pa": stress,
            "reduced_modulus_pa": REDUCED_MODULUS_PA,
        }
    return moes, {"slip_parameter": 1.0, "flow_law": "newtonian"}, sliding


def _waves(moes: Row, seed: int) -> Iterator[Row]:
    """Yield wavelengths along X and Y over a; 0 is infinite."""
    contact = _contact(*list(moes.values())[:3])
    found = 0
    for unit in _sobol(2, seed):
        oblique = max(0.0, (unit[0] - TRANSVERSE_SHARE) / (1 - TRANSVERSE_SHARE))
        angle = oblique * LARGEST_ANGLE
        per_wave = 0.263 * math.sqrt(contact.gamma * contact.m)
        per_wave *= contact.l ** (-(math.cos(angle) ** 2) / 3)
        wave = _between(PARAMETERS, unit[1]) / per_wave
        if not SHORTEST <= wave <= LONGEST:
            continue
        yield {
            "orientation": "custom",
            "wavelength_x_over_a": wave / math.cos(angle),
            "wavelength_y_over_a": wave / math.sin(angle) if angle > 0 else 0.0,
        }
        found += 1
        if found == WAVES:
            return


def _contact(m: float, l: float, d: float) -> Conditions:
    keys = {"load_parameter_m": m, "lubricant_parameter_l": l, "radius_ratio_d": d}
    return conditions_from_keys(keys, needs_lengths=False)


def _between(bounds: tuple[float, float], share: float) -> float:
    """Return the value at this share of the way between two bounds, in logarithms."""
    return float(bounds[0] * (bounds[1] / bounds[0]) ** share)


def _sobol(dimensions: int, seed: int) -> Iterator[NDArray[np.float64]]:
    sequence = qmc.Sobol(dimensions, seed=seed)
    while True:
        yield from sequence.random(64)


def write_cases(name: str, path: Path) -> int:
    """Write one of ``CASE_FILES`` for ``ehlwave-sweep``; return the number of cases."""
    rows = list(cases(*CASE_FILES[name]))
    write_rows(path, rows, digits=8)
    return len(rows)


if __name__ == "__main__":
    print(f"{write_cases(sys.argv[1], Path(sys.argv[2]))} cases in {sys.argv[2]}")
