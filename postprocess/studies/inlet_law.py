"""Steps of ``scripts/study inlet``: by how much the shear of its own inlet thins a film."""

import argparse
import math
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from ehlwave.contact import conditions_from_keys
from ehlwave.laws.inlet_warming import inlet_factor, thermal_loading, wall_parameter
from ehlwave.laws.sheared_film import Sheared
from studies.folds import held_out
from studies.heated_contacts import (
    BEARING_LOADS,
    BEARING_RATIOS,
    DENSITY,
    EXPANSION,
    MORE,
    THICK_FILMS,
    THICK_LOADS,
    contact,
    dimensional_keys,
    film_over_approach,
    heat_of,
    largest_error,
    loading_of,
    write_more,
)
from studies.inlet_tables import write_tables
from studies.sweeps import Row, read_sweep, run_command, write_rows, write_sweep

Floats = NDArray[np.float64]

SEED = 52
LOADS, OILS = (4.0, 3000.0), (2.0, 25.0)
"""M and L of the contacts that are taken."""
THICKEST = 0.8
"""Film by the formula over the Hertz approach; thicker films are rather rigid."""
LOADINGS = (5e-3, 8.0)
CIRCLE_SHARE, LOWEST_RATIO = 0.3, 0.03
EVEN_SHARE, LARGEST_RATIO = 0.5, 1.9
"""Sliding contacts: this share is even in the ratio, the others are even in its logarithm."""
FOLDS = 20
SHARE_WITHIN = 95
"""Percentage of contacts within the error."""
KNOWN = 0.01
"""Uncertainty of a film factor: losses are fitted with a relative weight plus this."""
ROBUST = {"loss": "soft_l1", "f_scale": 1.0}
ERROR_SLIP = (0.2, 1.0)
"""Slide-to-roll ratios above which the error has another share of the loss."""
START = (0.25, 0.92, 1.0, 2.1, 6.1, 0.8, 0.3, -0.8, -1.8, 5.0, 0.0)
COLUMNS = (
    "loading",
    "slide_to_roll_ratio",
    "wall",
    "film_over_approach",
    "radius_ratio_d",
    "load_parameter_m",
)
"""Input of the law."""


def contacts(count: int, is_line: bool) -> list[Row]:
    """Return `count` contacts, drawn as in ``studies.heat``, also rounder contacts."""
    rng = np.random.default_rng(SEED + is_line)
    rows: list[Row] = []
    while len(rows) < count:
        row = contact(rng, is_line)
        if row["slide_to_roll_ratio"] > 0 and rng.random() < EVEN_SHARE:
            row["slide_to_roll_ratio"] = float(f"{LARGEST_RATIO * rng.random():.4g}")
        if not is_line:
            d = 1.0 if rng.random() < CIRCLE_SHARE else LOWEST_RATIO ** rng.random()
            row["load_n"] *= d**-0.5 * (row["radius_x_m"] / row["radius_y_m"]) ** 0.5
            row["radius_y_m"] = float(f"{row['radius_x_m'] / d:.4g}")
        c = conditions_from_keys(dimensional_keys(row))
        film = film_over_approach(c)
        loading = loading_of(row)
        ranges = (LOADS[0] <= c.m <= LOADS[1], OILS[0] <= c.l <= OILS[1], film < THICKEST)
        if all(ranges) and LOADINGS[0] <= loading <= LOADINGS[1]:
            rows.append(row)
    return rows


def write_cases(folder: Path, lines: int, points: int, more: int, cells: int) -> None:
    """Write the sweeps of line contacts, of elliptical contacts, of bearings and of thick films."""
    groups = {
        "lubricant": {"flow_law": "eyring"},
        "heat": {"oil_density_kg_per_m3": DENSITY, "oil_expansion_per_k": EXPANSION},
    }
    grid = {"x_min": -6.0, "x_max": 2.0, "edges": "flooded", "cells_x": 4 * cells}
    write_sweep(folder, "lines", contacts(lines, is_line=True), groups | {"grid": grid})
    grid = {"x_min": -5.0, "x_max": 1.5, "y_max": 3.0, "edges": "flooded"}
    grid |= {"cells_x": cells, "cells_y": cells}
    write_sweep(folder, "points", contacts(points, is_line=False), groups | {"grid": grid})
    write_more(folder, more)


def usable(folder: Path) -> pd.DataFrame:
    """Return the input of the law for contacts that converged on a resolving grid."""
    rows = []
    for name in ("lines", "points", *MORE):
        for case in read_sweep(folder, name):
            if case["status"] == "converged" and case["central_film_error"] < largest_error(name):
                rows.append(_compared(case))
    table = pd.DataFrame(rows)
    return table[table["loading"] <= LOADINGS[1]]


def _compared(case: Row) -> Row:
    given = {k: v for k, v in case.items() if not (isinstance(v, float) and math.isnan(v))}
    c = conditions_from_keys(dimensional_keys(given))
    heat = heat_of(case)
    u = case["mean_speed_m_per_s"]
    warm_m = case["central_film_um"] * 1e-6
    film_m = warm_m * case["isothermal_central_film"] / case["central_film"]
    walls = (case["central_rise_wall_1_k"] + case["central_rise_wall_2_k"]) / 2
    mean = Sheared(0.0, case["central_rise_mid_film_k"], walls).rise_mean_k
    beta, k = heat.viscosity_temperature_per_k, heat.oil_conductivity_w_per_m_k
    return {
        "loading": float(thermal_loading(case["viscosity_pa_s"], beta, u, k)),
        "slide_to_roll_ratio": 2 * (case["slip_parameter"] - 1),
        "wall": wall_parameter(heat, film_m, c.semi_axis_a_m, u),
        "film_over_approach": case["isothermal_central_film"],
        "radius_ratio_d": c.d,
        "load_parameter_m": c.m,
        "lubricant_parameter_l": c.l,
        "hertz_over_modulus": c.hertz_pa / case["reduced_modulus_pa"],
        "inlet_factor": warm_m / film_m * (1 - EXPANSION * mean),
    }


def fit(table: pd.DataFrame) -> list[Row]:
    """Return the rows of law.csv: coefficients, shares of the error and ranges of the fit."""
    columns = [table[name].to_numpy() for name in COLUMNS]
    found = table["inlet_factor"].to_numpy()
    unit = 0.1 * (np.abs(1 - found) + KNOWN)

    def law(p: Floats) -> Floats:
        c10 = abs(p[9])  # G has no value for a negative coefficient, which a step of the fit tries
        return inlet_factor(*columns, np.r_[p[:9], c10, p[10:]]) / unit

    fold = np.random.default_rng(1).permutation(len(table)) % FOLDS
    best, errors = held_out(law, found / unit, START, fold, **ROBUST)
    off, slides = errors * unit, np.abs(columns[1])
    shares = np.abs(off) / (1 - found - off + KNOWN)
    groups = np.searchsorted(ERROR_SLIP, slides)
    rows: list[Row] = [{"name": f"c{i + 1}", "value": value} for i, value in enumerate(best)]
    for k in range(len(ERROR_SLIP) + 1):
        share = np.percentile(shares[groups == k], SHARE_WITHIN)
        rows.append({"name": f"error_share_{k + 1}", "value": float(share)})
    rows += [{"name": f"error_slip_{k + 1}", "value": slip} for k, slip in enumerate(ERROR_SLIP)]
    ranges = {
        "m": (THICK_LOADS[0], BEARING_LOADS[1]),
        "l": OILS,
        "film": (0.0, THICK_FILMS[1]),
        "loading": (0.0, LOADINGS[1]),
    }
    for name, (low, high) in ranges.items():
        rows += [
            {"name": f"lowest_{name}", "value": low},
            {"name": f"highest_{name}", "value": high},
        ]
    rows += [
        {"name": "known_loss", "value": KNOWN},
        {"name": "lowest_d", "value": BEARING_RATIOS[0]},
        {"name": "largest_slide_roll", "value": LARGEST_RATIO},
    ]
    for name, part in (("rolling", slides == 0), ("sliding", slides > 0)):
        rows.append({"name": f"contacts_{name}", "value": float(part.sum())})
        rows.append({"name": f"rms_{name}", "value": float(np.sqrt(np.mean(off[part] ** 2)))})
    return rows


def report(folder: Path) -> None:
    """Fit the law; write contacts.csv, law.csv and the tables of both languages."""
    table = usable(folder)
    write_rows(folder / "contacts.csv", table.to_dict("records"), digits=5)
    rows = fit(pd.read_csv(folder / "contacts.csv"))
    write_rows(folder / "law.csv", rows, digits=5)
    write_tables(folder / "law.csv", folder)
    for row in rows:
        print(f"{row['name']:20} {row['value']:.5g}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the sweeps or report on their results."""
    parser = argparse.ArgumentParser("a step of scripts/study inlet", description=__doc__)
    parser.add_argument("step", choices=("cases", "report"))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--lines", type=int, default=400)
    parser.add_argument("--points", type=int, default=500)
    parser.add_argument("--more", type=int, default=160)
    parser.add_argument("--cells", type=int, default=128)
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> None:
    if options.step == "cases":
        write_cases(options.folder, options.lines, options.points, options.more, options.cells)
    else:
        report(options.folder)


if __name__ == "__main__":
    sys.exit(main())
