"""Test of requested errors: random contacts with an accuracy, and again on far finer grids."""

import argparse
import math
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from studies import programs, sweeps
from studies.command import checks
from studies.command.options import step_parser

ASKED = "asked"
FINER = "finer"
ACCURACIES = (0.01, 0.005)
"""Requested in turn."""
SILENT = 2
"""Errors above it, over the requested, must have a status."""

WAVY_AMPLITUDE = 0.02
ORIENTATIONS = ("transverse", "isotropic", "longitudinal", "custom")
COMMON = {
    "conditions": {"reduced_modulus_pa": 2.26e11},
    "lubricant": {"eyring_stress_pa": 5e6},
    "grid": {"edges": "flooded"},
}
Row = dict[str, Any]


def draw(rng: np.random.Generator, accuracy: float, wavy: bool, march: bool = False) -> Row:
    """Return the keys of a random contact with a requested accuracy."""
    row: Row = {
        "load_parameter_m": float(f"{3 * 1000 ** rng.random():.4g}"),
        "lubricant_parameter_l": round(20 * rng.random(), 2),
        "radius_ratio_d": float(f"{0.04 ** rng.random():.3g}"),
        "slip_parameter": round(2 * rng.random(), 2) if rng.random() < 0.5 else 1.0,
        "flow_law": str(rng.choice(["newtonian", "eyring"])),
        "accuracy": accuracy,
    }
    if not wavy:
        return row
    orientation = str(rng.choice(ORIENTATIONS))
    wave = round(0.3 * 8 ** rng.random(), 3)
    row |= {
        "orientation": orientation,
        "amplitude_over_film": WAVY_AMPLITUDE,
        "response": "transient" if march else "harmonic",
    }
    if orientation == "custom":
        across = round(0.3 * 8 ** rng.random(), 3)
        return row | {
            "wavelength_x_over_a": wave,
            "wavelength_y_over_a": across,
            "oblique": bool(rng.random() < 0.5),
        }
    return row | {"wavelength_over_a": wave}


def groups_of(row: Row) -> dict[str, dict[str, Any]]:
    """Return the input of a row."""
    keys = dict(row)
    groups = {name: dict(keys_of) for name, keys_of in COMMON.items()}
    for group, names in {
        "lubricant": ("flow_law",),
        "solver": ("accuracy",),
        "waviness": (
            *("orientation", "amplitude_over_film", "response", "wavelength_over_a", "oblique"),
            *("wavelength_x_over_a", "wavelength_y_over_a"),
        ),
    }.items():
        some = {name: keys.pop(name) for name in names if name in keys}
        if some:
            groups[group] = {**groups.get(group, {}), **some}
    groups["conditions"] |= keys
    if row["flow_law"] != "eyring":
        del groups["lubricant"]["eyring_stress_pa"]
    return groups


def draw_planned(
    count: int, wavy: bool, march: bool, cells: int, seconds: float, seed: int
) -> Iterator[Row]:
    """Yield contacts that are resolved within `cells` and `seconds`; others are drawn again."""
    rng = np.random.default_rng(seed)
    while count > 0:
        row = draw(rng, ACCURACIES[count % 2], wavy, march)
        outcome = programs.run_case(groups_of(row), "--plan", "--json")
        if outcome.returncode != 0:
            raise SystemExit(f"{row}: {outcome.stdout}{outcome.stderr}")
        plan = programs.last_line(outcome)
        is_small = max(plan["cells_x"], plan["cells_y"]) <= cells
        is_fast = plan["expected_seconds"] <= seconds
        error = plan["expected_error"] + plan["domain_error"]
        if plan["is_resolved"] and is_small and is_fast and error <= row["accuracy"]:
            count -= 1
            yield row


def write_asked(folder: Path, options: argparse.Namespace) -> Path:
    """Write the sweep of the contacts as asked for."""
    rows: list[Row] = []
    for number, (count, wavy, march) in enumerate(
        [(options.smooth, False, False), (options.wavy, True, False), (options.marches, True, True)]
    ):
        limits = options.cells, options.seconds, options.seed + number
        rows += draw_planned(count, wavy, march, *limits)
    return sweeps.write_sweep(folder, ASKED, rows, COMMON)


def finer(found: Row) -> Row:
    """Return the row of half the mesh on twice the domain, with the scheme of the result.

    Waves are a linear response.
    """
    x_min, x_max, y_max = found["domain_x_min"], found["domain_x_max"], found["domain_y_max"]
    wider = {"x_min": 2 * x_min, "x_max": 1.5 * x_max, "y_max": 2 * y_max}
    h_x = (x_max - x_min) / found["cells_x"] / 2
    cells = 16 * math.ceil((wider["x_max"] - wider["x_min"]) / h_x / 16)
    keys = [
        *("load_parameter_m", "lubricant_parameter_l", "radius_ratio_d", "slip_parameter"),
        *("flow_law", "orientation", "wavelength_over_a", "wavelength_x_over_a"),
        *("wavelength_y_over_a", "oblique", "amplitude_over_film", "scheme"),
    ]
    row = {key: found[key] for key in keys if key in found}
    if row["orientation"] == "custom":
        del row["wavelength_over_a"]
        row["oblique"] = bool(row["oblique"])
    else:
        for key in ("wavelength_x_over_a", "wavelength_y_over_a", "oblique"):
            row.pop(key, None)
    if row["orientation"] == "none":
        row = {key: value for key, value in row.items() if "wave" not in key and "ampl" not in key}
    else:
        row["response"] = "harmonic"
    return {**row, **wider, "cells_x": cells, "cells_y": 4 * int(found["cells_y"])}


def write_finer(folder: Path) -> Path:
    """Write the sweep that the contacts as asked for are compared with."""
    rows = [finer(found) for found in sweeps.read_sweep(folder, ASKED)]
    return sweeps.write_sweep(folder, FINER, rows, {**COMMON, "solver": {"tolerance": 1e-7}})


def value(row: Row) -> float:
    """Return the number that a case is about."""
    if row["orientation"] == "none":
        return float(row["central_film"])
    fit = row["amplitude_ratio_fit"]
    return float(fit if math.isfinite(fit) else row["harmonic_ratio"])


def compare(folder: Path) -> list[Row]:
    """Return every contact with its error, and the estimated error."""
    rows = []
    asked = sweeps.read_sweep(folder, ASKED)
    for found, truth in zip(asked, sweeps.read_sweep(folder, FINER, len(asked)), strict=True):
        names = ["load_parameter_m", "lubricant_parameter_l", "radius_ratio_d", "slip_parameter"]
        names += ["flow_law", "orientation", "wavelength_x_over_a", "wavelength_y_over_a"]
        names += ["response", "accuracy", "cells_x", "cells_y", "refinements", "status", "message"]
        names += ["error_estimate", "counted_work_units", "expected_work_units"]
        error = abs(value(found) / value(truth) - 1)
        parts = [name for name in found if name.startswith(("film_error_", "ratio_error_"))]
        row = {name: found[name] for name in [*names, *parts]}
        rows.append({**row, "error": error, "truth": truth["status"]})
    return rows


def report(folder: Path) -> int:
    """Print the results and write them as a table; return 1 if too much is off."""
    rows = compare(folder)
    sweeps.write_rows(folder / "accuracy.csv", rows)
    judged = [row for row in rows if row["truth"] == "converged"]
    converged = [row for row in judged if row["status"] == "converged"]
    good = [row for row in converged if row["error"] <= row["accuracy"]]
    silent = [row for row in converged if not row["error"] <= SILENT * row["accuracy"]]
    told = [row for row in judged if row["status"] != "converged"]
    work = [row["counted_work_units"] / row["expected_work_units"] for row in rows]
    planned = sum(0.5 <= one <= 2 for one in work)
    print(f"{len(rows)} contacts, {len(judged)} with a converged finer solution")
    print(f"{len(good)} converged and within the accuracy; {len(told)} with another status")
    print(f"{len(silent)} above {SILENT} times the accuracy without a status that says so")
    print(f"{planned} took the work that was planned within a factor of 2")
    for row in sorted(judged, key=lambda row: -row["error"])[:12]:
        print(
            f"  error {row['error']:.4f}, estimated {row['error_estimate']:.4f}, "
            f"asked {row['accuracy']:g}, {row['status']}: "
            f"M = {row['load_parameter_m']:g}, L = {row['lubricant_parameter_l']:g}, "
            f"D = {row['radius_ratio_d']:g}, S = {row['slip_parameter']:g}, {row['flow_law']}, "
            f"{row['orientation']}, {row['cells_x']} x {row['cells_y']} cells"
        )
    return int(bool(silent) or len(good) < 0.95 * len(judged))


def main() -> int:
    """Write a sweep, or report."""
    parser = step_parser(checks.accuracy, __doc__)
    parser.add_argument("what", choices=["asked", "finer", "report"])
    parser.add_argument("folder", type=Path)
    parser.set_defaults(seed=14)
    options = parser.parse_args()
    if options.what == "report":
        return report(options.folder)
    make = write_finer if options.what == "finer" else lambda folder: write_asked(folder, options)
    print(make(options.folder))
    return 0


if __name__ == "__main__":
    sys.exit(main())
