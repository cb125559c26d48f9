"""Coverage of the intervals of ``ehlwave identify``: films and a traction curve with noise.

``python -m studies.identified`` prints ``record/validation/identified_draws.csv``: whether the 95 %
intervals hold the true values, deviations over standard errors, and standard errors. The standard
error of the noise is estimated by the fit: intervals are those of the t distribution.
"""

import argparse
import math
import warnings
from pathlib import Path

import numpy as np
import pandas as pd

from ehlwave.errors import ExtrapolationWarning
from ehlwave.identify import identify
from ehlwave.identify.model import by_laws

RECORD = Path(__file__).parents[1] / "record" / "validation" / "identified_draws.csv"
NOISE = 0.02
STRESS_PA = 6e6
OIL = {"viscosity_pa_s": 0.05, "pressure_viscosity_per_pa": 1.8e-8}
BALL = {
    "radius_x_m": 0.0127,
    "radius_y_m": 0.0127,
    "reduced_modulus_pa": 2.26e11,
    "load_n": 40,
} | OIL
FAR = BALL | {"pressure_viscosity_per_pa": 2.4e-8}
"""Where the fit begins."""
SPEEDS = (0.2, 0.5, 1.0, 2.0, 4.0)
FIRST, DRAWS = 1000, 300
FRICTIONS_AFTER = 5000
"""Seed of a traction curve less that of the films."""


def films(seed: int, decay: float = 0.0, temperatures: tuple[float, ...] = (60.0,)) -> pd.DataFrame:
    """Return films over speed and temperature with noise."""
    rng = np.random.default_rng(seed)
    rows = []
    for celsius in temperatures:
        eta = OIL["viscosity_pa_s"] * math.exp(-decay * (celsius - 60))
        for speed in SPEEDS:
            keys = BALL | {"mean_speed_m_per_s": speed, "viscosity_pa_s": eta}
            film = math.exp(by_laws(keys, "central_film_m") + NOISE * rng.standard_normal())
            rows.append((speed, celsius, film * 1e9))
    table = pd.DataFrame(rows, columns=["mean_speed_m_per_s", "temperature_c", "central_film_nm"])
    return table if decay else table.drop(columns="temperature_c")


def frictions(seed: int, stress_pa: float = STRESS_PA) -> pd.DataFrame:
    """Return a traction curve with noise."""
    rng = np.random.default_rng(seed)
    keys = BALL | {"mean_speed_m_per_s": 1.0, "eyring_stress_pa": stress_pa}
    ratios = np.geomspace(0.02, 0.5, 6)
    values = [
        math.exp(
            by_laws(keys | {"slide_to_roll_ratio": ratio}, "friction_coefficient")
            + NOISE * rng.standard_normal()
        )
        for ratio in ratios
    ]
    return pd.DataFrame({"slide_to_roll_ratio": ratios, "friction_coefficient": values})


def drawn(seed: int) -> dict[str, float]:
    """Return the row of a draw."""
    traction = frictions(seed + FRICTIONS_AFTER).assign(mean_speed_m_per_s=1.0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ExtrapolationWarning)
        both = pd.concat([films(seed), traction])
        found = identify(both, FAR, ["alpha", "eyring_stress"], by="laws").parameters
    true = {"alpha": OIL["pressure_viscosity_per_pa"], "stress": STRESS_PA}
    row: dict[str, float] = {"draw": seed}
    for (name, value), one in zip(true.items(), found, strict=True):
        row[f"{name}_held"] = int(one.low <= value <= one.high)
        row[f"{name}_deviation"] = math.log(one.value / value) / one.error
        row[f"{name}_error"] = one.error
    return row


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--draws", type=int, default=DRAWS)
    table = pd.DataFrame([drawn(FIRST + k) for k in range(parser.parse_args().draws)])
    print(table.to_csv(index=False, float_format="%.4g"), end="")
