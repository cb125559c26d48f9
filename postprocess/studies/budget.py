"""Error budget of a lambda ratio against random draws, of the README's contact and trace.

The oil is a data sheet's, with its scatter. ``python -m studies.budget`` prints
``record/lambda/budget.csv``. Draws of alpha outside the atlas are interpolated between contacts
that ``python -m studies.budget --tails`` computes in a quarter of an hour, the table
``record/lambda/tails.csv``.
"""

import argparse
import math
import warnings
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator

import ehlwave
from ehlwave.laws.atlas.ranges import CONTACT_RANGES

FOLDER = Path(__file__).parents[1]
RECORD, TAILS = (FOLDER / "record" / "lambda" / name for name in ("budget.csv", "tails.csv"))
SURFACE = FOLDER / "examples" / "catalogue" / "ground.csv"
CONTACT = {
    "radius_x_m": 0.0127,
    "radius_y_m": 0.0127,
    "reduced_modulus_pa": 2.26e11,
    "load_n": 40,
    "mean_speed_m_per_s": 1,
}
OIL = ehlwave.Oil.from_grade(iso_vg=68, viscosity_index=95, temperature_k=333.15)
DRAWS, SEED = 1000, 1
ALPHA = "pressure_viscosity_per_pa"
FACTORS = (0.75, 1.33)
"""Viscosities of computed contacts over the data sheet's."""
BEYOND = (7e-9, 4.5e-8)
"""Coefficients of computed contacts, 1/Pa."""


def contact(alpha: float, viscosity: float, **errors: float) -> ehlwave.Contact:
    """Return the contact with an oil."""
    return ehlwave.Contact(
        **CONTACT, pressure_viscosity_per_pa=alpha, viscosity_pa_s=viscosity, **errors
    )


def budget() -> pd.DataFrame:
    """Return the error budget by the scatter of the data sheet."""
    errors = {
        "viscosity_error": OIL.viscosity_error,
        "pressure_viscosity_error": OIL.pressure_viscosity_error,
    }
    own = contact(OIL.pressure_viscosity_per_pa, OIL.viscosity_pa_s, **errors)
    return own.error_budget(ehlwave.read_surface(str(SURFACE)), by="laws")


def spread(draws: int = DRAWS) -> tuple[float, int]:
    """Return the standard deviation of ln(lambda) of random oils, and draws beyond the atlas."""
    surface = ehlwave.read_surface(str(SURFACE))
    random = np.random.default_rng(SEED).standard_normal((draws, 2))
    alphas = OIL.pressure_viscosity_per_pa * np.exp(OIL.pressure_viscosity_error * random[:, 0])
    factors = np.exp(OIL.viscosity_error * random[:, 1])
    low, high = CONTACT_RANGES[ALPHA]
    inside = (low <= alphas) & (alphas <= high)

    def by_law(alpha: float, factor: float) -> float:
        return contact(alpha, factor * OIL.viscosity_pa_s).lambda_ratio(surface, by="laws")

    found = np.empty(draws)
    for k in np.flatnonzero(inside):
        found[k] = math.log(by_law(alphas[k], factors[k]))
    tails = pd.read_csv(TAILS).set_index(["alpha_per_pa", "viscosity_factor"]).lambda_ratio
    nodes = [BEYOND[0], low, high, BEYOND[1]]
    table = [[tails[a, f] if a in BEYOND else by_law(a, f) for f in FACTORS] for a in nodes]
    outer = RegularGridInterpolator(
        (np.log(nodes), np.log(FACTORS)), np.log(table), bounds_error=False, fill_value=None
    )
    found[~inside] = outer(np.column_stack([np.log(alphas), np.log(factors)])[~inside])
    return float(np.std(found)), int((~inside).sum())


def computed_tails() -> pd.DataFrame:
    """Return lambda ratios of computed contacts beyond the atlas."""
    surface = ehlwave.read_surface(str(SURFACE))
    rows: list[tuple[float, ...]] = []
    for alpha in BEYOND:
        for factor in FACTORS:
            found = contact(alpha, factor * OIL.viscosity_pa_s).deform(surface, by="computed")
            s = found.statistics
            rows.append((alpha, factor, s.lambda_ratio_after, s.lambda_error))
    columns = ["alpha_per_pa", "viscosity_factor", "lambda_ratio", "error"]
    return pd.DataFrame(rows, columns=columns)


def compared() -> pd.DataFrame:
    """Return the budget beside the spread of draws."""
    table = budget()
    found, beyond = spread()
    row: dict[str, NDArray[np.float64] | float] = {
        "alpha_part": table.lambda_ratio[ALPHA],
        "viscosity_part": table.lambda_ratio["viscosity_pa_s"],
        "budget": table.lambda_ratio["total"],
        "spread": found,
        "draws": DRAWS,
        "beyond": beyond,
    }
    return pd.DataFrame([row])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tails", action="store_true", help="compute contacts beyond the atlas")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ehlwave.ExtrapolationWarning)
        result = computed_tails() if parser.parse_args().tails else compared()
    print(result.to_csv(index=False, float_format="%.4g"), end="")
