"""Steps of ``scripts/study heat-ends``: laws of heat at ends of their ranges, beyond their fit.

Light line contacts with thick films, and oils with a small Eyring stress, are computed with and
without heat. The laws of ``scripts/study heat`` are not fitted to them. Friction of light
lines has a factor fitted here, contacts held out.
"""

import argparse
import math
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ehlwave.contact import conditions_from_keys
from ehlwave.contact.scales import moes_per_film
from ehlwave.laws.heat_laws import warmed
from ehlwave.laws.light_lines import COEFFICIENTS, light_factor
from ehlwave.laws.rigid_films import is_rigid, rigid_film
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
from studies.programs import Groups
from studies.sweeps import Row, read_sweep, run_command, write_rows, write_sweep

SEED = 5858
OILS, LOADINGS = (2.0, 20.0), (0.0, 4.0)
LINE, POINT = {"x_min": -8.0, "x_max": 2.5, "cells_x": 1536}, {"cells_x": 128, "cells_y": 128}
LIGHT_LINE = {"x_min": -20.0, "x_max": 4.0, "cells_x": 2048}
FINE_POINT = {"cells_x": 256, "cells_y": 256}


RIGID, RIGID_ENDS = {"cells_x": 2048}, {"x_min": -10.0, "x_max": 3.0}
"""Grid of lines too light to deform; the ends of their domain, times (film/approach)^(1/2)."""


class Group(NamedTuple):
    """Contacts of one end of the laws: ranges, grid, and how many are computed."""

    seed: int
    count: int
    is_line: bool
    m: tuple[float, float]
    film: tuple[float, float]
    """Film over the Hertz approach."""
    tau: tuple[float, float]
    """Eyring stress, Pa."""
    grid: Mapping[str, float]
    l: tuple[float, float] = OILS
    rolls: bool | None = None
    """Whether all contacts roll, or none; None: as drawn."""


HARD, SOFT = (2e6, 1.5e7), (1e6, 2e6)
GROUPS = {
    "light": Group(0, 100, True, (0.4, 5.0), (0.0, 10.0), (1e6, 1.5e7), LIGHT_LINE, (2.0, 25.0)),
    "soft": Group(1, 60, True, (5.0, 1500.0), (0.0, 1.0), SOFT, LINE, (2.0, 25.0)),
    "soft_points": Group(2, 24, False, (5.0, 1500.0), (0.0, 0.4), SOFT, POINT, (2.0, 25.0)),
    "light_again": Group(3, 100, True, (0.4, 5.0), (0.0, 10.0), (1e6, 1.5e7), LIGHT_LINE),
    "light_fresh": Group(11, 100, True, (0.4, 5.0), (0.0, 10.0), (1e6, 1.5e7), LIGHT_LINE),
    "rigid": Group(4, 60, True, (0.02, 0.6), (0.0, 1e3), HARD, RIGID, (2.0, 25.0), True),
    "soft_ellipses": Group(5, 16, False, (5.0, 1500.0), (0.0, 0.4), SOFT, FINE_POINT, rolls=False),
    "thick_ellipses": Group(
        6, 14, False, (5.0, 1500.0), (0.4, 1.0), (1e6, 1.5e7), FINE_POINT, rolls=False
    ),
    "oily": Group(8, 60, True, (5.0, 1500.0), (0.0, 1.0), (1e6, 1.5e7), LINE, (20.0, 35.0), False),
    "oily_rolling": Group(
        9, 60, True, (0.4, 1500.0), (0.0, 10.0), HARD, LIGHT_LINE, (25.0, 42.0), True
    ),
}
"""Groups of contacts."""
FITTED = ("light", "light_again")
"""Groups that the friction factor is fitted to. Errors of light films were set on the first, of
soft ellipses and oily lines on their own groups; the fresh, rigid and soft lines judge. Friction of
thick ellipses does not hold: the laws refuse them."""
SCALED = (*FITTED, "light_fresh", "rigid")
"""Groups whose loads are drawn by M: Hertz pressures of the draw are too high for them."""
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
QUANTITIES = ("central", "smallest", "friction", "rigid")
"""Warm films over films without heat, friction, and films without heat between rigid bodies."""
LARGEST_FRICTION_ERROR = 0.1
"""Error of computed friction that judges nothing."""
FOLDS, ROBUST = 10, {"loss": "soft_l1", "f_scale": 0.1}
"""Parts of light contacts, each predicted by a fit to the others; how the law is fitted."""


def contacts(name: str, count: int) -> list[Row]:
    """Return contacts of a group."""
    own = GROUPS[name]
    rng = np.random.default_rng([SEED, own.seed])

    def between(low: float, high: float) -> float:
        return float(f"{low * (high / low) ** rng.random():.4g}")

    rows: list[Row] = []
    while len(rows) < count:
        row = contact(rng, own.is_line, is_wide=True)
        row["eyring_stress_pa"] = between(*own.tau)
        if own.rolls:
            row |= {
                "slide_to_roll_ratio": 0.0,
                "body2_conductivity_w_per_m_k": row["body_conductivity_w_per_m_k"],
            }
        c = conditions_from_keys(dimensional_keys(row))
        if name in SCALED:
            wanted = own.m[0] * (own.m[1] / own.m[0]) ** rng.random()
            row["load_n_per_m"] = float(f"{row['load_n_per_m'] * wanted / c.m:.4g}")
            c = conditions_from_keys(dimensional_keys(row))
        ranges = (
            (c.m, own.m),
            (c.l, own.l),
            (film_over_approach(c), own.film),
            (loading_of(row), LOADINGS),
        )
        is_right = own.rolls is None or own.rolls == (row["slide_to_roll_ratio"] == 0)
        if own.grid is RIGID:
            width = film_over_approach(c) ** 0.5
            row |= {key: float(f"{end * width:.4g}") for key, end in RIGID_ENDS.items()}
        if is_right and all(low <= value <= high for value, (low, high) in ranges):
            rows.append(row)
    return rows


def write_cases(folder: Path, names: Sequence[str], count: int | None) -> None:
    """Write the sweeps of each group, with heat and without."""
    heat = {"oil_density_kg_per_m3": DENSITY, "oil_expansion_per_k": EXPANSION}
    for name in names:
        own = GROUPS[name]
        rows = contacts(name, count or own.count)
        shared: Groups = {"lubricant": {"flow_law": "eyring"}, "grid": {"edges": "flooded"}}
        shared["grid"] |= own.grid
        write_sweep(folder, name, rows, shared | {"heat": heat})
        cold = [
            dimensional_keys(row) | {key: row[key] for key in RIGID_ENDS if key in row}
            for row in rows
        ]
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
    if cold["status"] == "converged" and rolls and is_rigid(c):
        rigid = rigid_film(c)
        row |= {
            "rigid": cold["central_film"],
            "rigid_law": rigid.central_moes / moes_per_film(c.m, c.kappa),
            "rigid_law_error": rigid.central_error,
            "rigid_own": cold["central_film_error"],
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
    light = [row for row in rows if row["group"] in FITTED and "warm_ratio" in row]
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
    """Write ends.csv.xz, ends_law.csv, and the share of each group within errors of the laws."""
    rows = []
    names = [name for name in GROUPS if (folder / f"{name}_cold.h5").is_file()]
    for name in names:
        pairs = zip(read_sweep(folder, name), read_sweep(folder, f"{name}_cold"), strict=True)
        rows += [judged(name, *pair) for pair in pairs if pair[0]["status"] == "converged"]
    write_rows(folder / "ends.csv.xz", rows, digits=5)
    table = []
    for name in names:
        for quantity in QUANTITIES:
            off = np.array([times(row, quantity) for row in rows if row["group"] == name])
            off = off[np.isfinite(off)]
            if not off.size:
                continue
            line: Row = {"group": name, "quantity": quantity, "contacts": off.size}
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
    parser.add_argument("--group", action="append", choices=tuple(GROUPS))
    parser.add_argument("--contacts", type=int)
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> int:
    if options.step == "cases":
        write_cases(options.folder, options.group or tuple(GROUPS), options.contacts)
        return 0
    return report(options.folder)


if __name__ == "__main__":
    sys.exit(main())
