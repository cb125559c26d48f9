"""Pressure-viscosity coefficient of a reference oil from measured films: Dao (2018), FVA 3.

``python -m studies.published.films`` prints the table ``record/validation/identified.csv``.
"""

import csv
import sys

import pandas as pd

from ehlwave.contact.viscosity_grade import Walther
from ehlwave.identify import identify
from studies.published.values import rig_films

ALPHA_PER_PA = 2.0e-8
"""The thesis has it at 40, 60 and 80 C."""

_KINEMATIC = ((313.15, 96.0), (333.15, 36.0))
"""mm2/s, of the thesis."""
_DENSITY, _PER_K = 865.0, 0.75
"""kg/m3 at 40 C, and its fall to 850 at 60 C; of the thesis."""
_STEEL, _GLASS = (210e9, 0.3), (70e9, 0.21)

BALL = {
    "radius_x_m": 19.05e-3 / 2,
    "radius_y_m": 19.05e-3 / 2,
    "reduced_modulus_pa": 2 / sum((1 - nu**2) / modulus for modulus, nu in (_STEEL, _GLASS)),
}


def viscosity_pa_s(temperature_c: float) -> float:
    """Return the viscosity of FVA 3 by the thesis, between its temperatures by D341."""
    kinematic = Walther.through(*_KINEMATIC).viscosity(temperature_c + 273.15)
    return 1e-6 * kinematic * (_DENSITY - _PER_K * (temperature_c - 40))


def alpha_of_runs() -> pd.DataFrame:
    """Return alpha with its 95 % interval, 1/GPa, of each run and of all."""
    films = rig_films()
    films["viscosity_pa_s"] = [viscosity_pa_s(value) for value in films.temperature_c]
    rows = []
    for run in [*films.run.unique(), "all"]:
        chosen = films if run == "all" else films[films.run == run]
        found = identify(chosen.drop(columns=["run", "temperature_c"]), BALL, ["alpha"], by="laws")
        (alpha,) = found.parameters
        rows.append(
            (run, len(chosen), *(1e9 * v for v in (alpha.value, alpha.low, alpha.high)), found.rms)
        )
    columns = ["run", "films", "alpha_per_gpa", "low", "high", "residual_rms"]
    return pd.DataFrame(rows, columns=columns)


if __name__ == "__main__":
    table = alpha_of_runs()
    writer = csv.writer(sys.stdout)
    writer.writerow(table.columns)
    for run, count, *values in table.values:
        writer.writerow([run, count, *(f"{value:.3g}" for value in values)])
