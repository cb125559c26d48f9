"""Steps of ``scripts/study heat-ends``: laws of heat at ends of their ranges, beyond their fit.

Light line contacts with thick films, and oils with a small Eyring stress, are computed with and
without heat. The laws of ``scripts/study heat`` are not fitted to them. Friction of light
lines has a factor fitted here, contacts held out.
"""

import argparse
import math
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ehlwave.contact import conditions_from_keys
from ehlwave.laws.heat_laws import warmed
from ehlwave.laws.light_lines import COEFFICIENTS, light_factor
from studies.folds import held_out
from studies.heated_contacts import (
    DENSITY,
    EVEN_RANGES,
    EXPANSION,
    RANGES,
    contact,
    dimensional_keys,
    film_over_approach,
    heat_of,
    loading_of,
)
from studies.sweeps import Row, read_sweep, run_command, write_rows, write_sweep

SEED = 5858
GROUPS = {
    "light": {"is_line": True, "m": (0.4, 5.0), "film": (0.0, 10.0), "tau": (1e6, 1.5e7)},
    "soft": {"is_line": True, "m": (5.0, 1500.0), "film": (0.0, 1.0), "tau": (1e6, 2e6)},
    "soft_points": {"is_line": False, "m": (5.0, 1500.0), "film": (0.0, 0.4), "tau": (1e6, 2e6)},
}
"""Shape, M, film over the Hertz approach and Eyring stress of each group."""
OILS, LOADINGS = (2.0, 25.0), (0.0, 4.0)
LINE, POINT = {"x_min": -8.0, "x_max": 2.5, "cells_x": 1536}, {"cells_x": 128, "cells_y": 128}
LIGHT_LINE = {"x_min": -20.0, "x_max": 4.0, "cells_x": 2048}
LARGEST_OWN = 0.03
"""Error of a computed value that judges nothing."""
INPUT = (
    *RANGES,
    *EVEN_RANGES,
    "load_n",
    "load_n_per_m",
    "radius_y_m",
    "body2_conductivity_w_per_m_k",
)
"""Keys of a contact that the record keeps."""
QUANTITIES = ("central", "smallest", "friction")
LARGEST_FRICTION_ERROR = 0.1
"""As before, of friction."""
FOLDS, ROBUST = 10, {"loss": "soft_l1", "f_scale": 0.1}
"""Parts of light contacts, each predicted by a fit to the others; how the law is fitted."""


def contacts(name: str, count: int) -> list[Row]:
    """Return contacts of a group."""
    own = GROUPS[name]
    rng = np.random.default_rng([SEED, list(GROUPS).index(name)])
    rows: list[Row] = []
    while len(rows) < count:
        row = contact(rng, bool(own["is_line"]), is_wide=True)
        low, high = own["tau"]
        row["eyring_stress_pa"] = float(f"{low * (high / low) ** rng.random():.4g}")
        c = conditions_from_keys(dimensional_keys(row))
        if name == "light":  # Hertz pressures of the draw are too high for small M
            wanted = own["m"][0] * (own["m"][1] / own["m"][0]) ** rng.random()
            row["load_n_per_m"] = float(f"{row['load_n_per_m'] * wanted / c.m:.4g}")
            c = conditions_from_keys(dimensional_keys(row))
        ranges = (
            (c.m, own["m"]),
            (c.l, OILS),
            (film_over_approach(c), own["film"]),
            (loading_of(row), LOADINGS),
        )
        if all(low <= value <= high for value, (low, high) in ranges):
            rows.append(row)
    return rows


def write_cases(folder: Path, counts: Sequence[int]) -> None:
    """Write the sweeps of each group, with heat and without."""
    heat = {"oil_density_kg_per_m3": DENSITY, "oil_expansion_per_k": EXPANSION}
    for name, count in zip(GROUPS, counts, strict=True):
        rows = contacts(name, count)
        grid = LIGHT_LINE if name == "light" else LINE if name == "soft" else POINT
        shared = {"lubricant": {"flow_law": "eyring"}, "grid": grid | {"edges": "flooded"}}
        write_sweep(folder, name, rows, shared | {"heat": heat})
        cold = [dimensional_keys(row) for row in rows]
        write_sweep(folder, f"{name}_cold", cold, shared)


def judged(name: str, case: Row, cold: Row) -> Row:
    """Return the laws beside a computed contact: deviations over errors of the laws."""
    given = {k: v for k, v in case.items() if not (isinstance(v, float) and math.isnan(v))}
    keys = dimensional_keys(given)
    c = conditions_from_keys(keys)
    tau, rolls = float(keys["eyring_stress_pa"]), c.rolls
    cold_m = case["isothermal_central_film"] * float(c.hertz_approach_c_m or math.nan)
    law = warmed(c, heat_of(case), cold_m, tau)
    row: Row = {name: value for name, value in given.items() if name in INPUT}
    row |= {
        "group": name,
        "m": c.m,
        "l": c.l,
        "d": c.d,
        "film_over_approach": case["isothermal_central_film"],
        "slide_to_roll_ratio": c.slide_to_roll_ratio,
        "hertz_pressure_pa": c.hertz_pa,
        "loading": loading_of(case),
        "central": case["central_film"] / case["isothermal_central_film"],
        "central_law": law.film_factor,
        "central_law_error": law.film_error - law.film_error_by_data,
        "central_own": case["central_film_error"],
    }
    if cold["status"] == "converged" and law.minimum_factor is not None:
        row |= {
            "smallest": case["minimum_film"] / cold["minimum_film"],
            "smallest_law": law.minimum_factor,
            "smallest_law_error": law.minimum_error - law.film_error_by_data,
            "smallest_own": case["minimum_film_error"],
        }
    if not rolls and law.friction is not None and law.friction_error is not None:
        heat, cold_friction = heat_of(case), law.isothermal_friction or math.nan
        warmth = heat.viscosity_temperature_per_k * law.rise_mid_film_k
        film = row["film_over_approach"]
        row |= {
            "inlet": law.inlet_factor,
            "warmth": warmth,
            # computed over the law without the factor of light lines
            "warm_ratio": abs(case["friction_coefficient"] / law.friction)
            * (light_factor(film, c.l, law.inlet_factor, warmth) if c.is_line else 1.0),
            "cold_ratio": abs(case["isothermal_friction_coefficient"] / cold_friction)
            * (light_factor(film, c.l, 1.0, 0.0) if c.is_line else 1.0),
            "friction": abs(case["friction_coefficient"]),
            "friction_law": abs(law.friction),
            "friction_law_error": law.friction_error - law.friction_error_by_data,
            "friction_own": case["friction_error"],
        }
    return row


def times(row: Row, name: str) -> float:
    """Return the deviation over the error of the law; NaN where it is not known."""
    largest = LARGEST_FRICTION_ERROR if name == "friction" else LARGEST_OWN
    if name not in row or not row[f"{name}_own"] <= largest:
        return math.nan
    return float(abs(row[f"{name}_law"] / row[name] - 1) / row[f"{name}_law_error"])


def fit(rows: Sequence[Row]) -> Row:
    """Return the coefficients of the friction of light lines, and errors of contacts held out."""
    light = [row for row in rows if row["group"] == "light" and "warm_ratio" in row]
    names = ("film_over_approach", "l", "inlet", "warmth")
    film, l, inlet, warmth = (np.array([row[name] for row in light]) for name in names)
    found = [np.log([row[f"{name}_ratio"] for row in light]) for name in ("warm", "cold")]

    def law(p: np.ndarray) -> np.ndarray:
        warm = light_factor(film, l, inlet, warmth, p)
        return np.log(np.r_[warm, light_factor(film, l, 1.0, 0.0, p)])

    fold = np.tile(np.random.default_rng(1).permutation(len(light)) % FOLDS, 2)
    best, errors = held_out(law, np.r_[found[0], found[1]], COEFFICIENTS, fold, **ROBUST)
    off = np.abs(np.expm1(errors[: len(light)]))
    row: Row = {"law": "friction of light lines", "contacts": len(light)}
    row |= {"within_95": float(np.percentile(off, 95)), "largest": float(off.max())}
    return row | {f"c{i + 1}": float(c) for i, c in enumerate(best)}


def report(folder: Path) -> int:
    """Write ends.csv, ends_law.csv, and the share of each group within the errors of the laws."""
    rows = []
    for name in GROUPS:
        pairs = zip(read_sweep(folder, name), read_sweep(folder, f"{name}_cold"), strict=True)
        rows += [judged(name, *pair) for pair in pairs if pair[0]["status"] == "converged"]
    write_rows(folder / "ends.csv", rows, digits=5)
    table = []
    for name in GROUPS:
        for quantity in QUANTITIES:
            off = np.array([times(row, quantity) for row in rows if row["group"] == name])
            off = off[np.isfinite(off)]
            line: Row = {"group": name, "quantity": quantity, "contacts": off.size}
            if off.size:
                line |= {"within": float(np.mean(off <= 1)), "largest": float(off.max())}
            table.append(line)
            print(", ".join(f"{k} {v}" for k, v in line.items()))
    write_rows(folder / "ends_coverage.csv", table, digits=4)
    law = fit(rows)
    write_rows(folder / "ends_law.csv", [law], digits=5)
    print(", ".join(f"{k} {v}" for k, v in law.items()))
    return 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the sweeps or report on their results."""
    parser = argparse.ArgumentParser("a step of scripts/study heat-ends", description=__doc__)
    parser.add_argument("step", choices=("cases", "report"))
    parser.add_argument("folder", type=Path)
    for name, count in zip(GROUPS, (100, 60, 24), strict=True):
        parser.add_argument(f"--{name.replace('_', '-')}", type=int, default=count)
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> int:
    if options.step == "cases":
        write_cases(options.folder, [getattr(options, name) for name in GROUPS])
        return 0
    return report(options.folder)


if __name__ == "__main__":
    sys.exit(main())
