"""Draw random legal inputs over every key, run each and the same on twice the cells, and compare."""

import argparse
import json
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

from ehlwave.programs import namelist
from studies import programs
from studies.all_keys import compare
from studies.all_keys.draw import Row, draw
from studies.all_keys.table import key_groups
from studies.sweeps import write_rows

LARGEST_COST = 4e8
"""Of the finer run: planned work times cells. About half a minute."""
LONGEST_S = 900


def groups_of(row: Row, known: dict[str, str]) -> dict[str, dict[str, Any]]:
    """Return the input of a row."""
    groups: dict[str, dict[str, Any]] = {}
    for key, value in row.items():
        groups.setdefault(known[key], {})[key] = value
    return groups


def plan_of(row: Row, known: dict[str, str], folder: Path) -> Row | None:
    """Return the plan of a row, None where the program refuses the input."""
    path = folder / "plan.nml"
    path.write_text(namelist(groups_of(row, known)), encoding="utf-8")
    outcome = programs.run("case", path, "--plan", "--json", seconds=LONGEST_S)
    if outcome.returncode == 2:
        return None
    if outcome.returncode != 0:
        raise SystemExit(f"{row}: {outcome.stdout}{outcome.stderr}")
    plan: Row = programs.last_line(outcome)
    return plan


def finer_row(row: Row, plan: Row, found: Row) -> Row:
    """Return the same case on twice the cells and half the time step, without an accuracy."""
    finer = dict(row)
    for key in ("accuracy", "largest_cells", "largest_total_steps", "largest_steps"):
        finer.pop(key, None)
    is_line = found["radius_ratio_d"] == 0
    for axis in ("x",) if is_line else ("x", "y"):
        finer[f"cells_{axis}"] = 2 * int(found[f"cells_{axis}"])
    for key in ("x_min", "x_max") if is_line else ("x_min", "x_max", "y_max"):
        if abs(found[f"domain_{key}"] - row.get(key, DOMAIN[key])) > 1e-9:
            finer[key] = found[f"domain_{key}"]
    if "accuracy" in row:
        step = plan["time_step"] * plan["cells_x"] / (plan["domain_x_max"] - plan["domain_x_min"])
        if step > 0:
            finer["time_step_over_cell"] = round(step, 6)
        if "settling_periods" not in row and row.get("edges", "flooded") == "flooded":
            finer["settling_periods"] = 2
    for key, usual in {"tolerance": 1e-6, "step_tolerance": 1e-4, "response_tolerance": 1e-5}.items():
        finer[key] = min(usual, row.get(key, usual))
    return {**finer, "error_estimate": "model"}


DOMAIN = {"x_min": -2.5, "x_max": 1.5, "y_max": 2.0}


def draw_planned(count: int, seed: int, folder: Path, known: dict[str, str]) -> list[tuple[Row, Row]]:
    """Return so many legal inputs whose finer run is not too long, with their plans."""
    rng = np.random.default_rng(seed)
    found: list[tuple[Row, Row]] = []
    refused = long = 0
    while len(found) < count:
        row = draw(rng, known, folder)
        plan = plan_of(row, known, folder)
        if plan is None:
            refused += 1
        elif cost_of_finer(plan) > LARGEST_COST:
            long += 1
        else:
            found.append((row, plan))
    print(f"{count} inputs; {refused} more are not legal, {long} too long", flush=True)
    return found


def cost_of_finer(plan: Row) -> float:
    """Return planned work times cells of the run on twice the cells."""
    units = plan["expected_work_units"] or 50 + 20 * plan["time_steps"]
    growth = 8 if plan["time_steps"] > 0 else 4
    return float(growth * units * plan["cells_x"] * plan["cells_y"])


def run(path: Path) -> Row:
    """Return the result of an input file."""
    outcome = programs.run("case", path, "--json", "--quiet", seconds=LONGEST_S)
    if outcome.returncode not in (0, 1):
        raise SystemExit(f"{path}: exit status {outcome.returncode}\n{outcome.stdout}{outcome.stderr}")
    result: Row = programs.last_line(outcome)
    return result


def run_both(number: int, row: Row, plan: Row, folder: Path, known: dict[str, str]) -> Row:
    """Run a case and, where it converges, the finer one; keep inputs and results."""
    path = folder / f"{number:04d}.nml"
    path.write_text(namelist(groups_of(row, known)), encoding="utf-8")
    found = run(path)
    both = {"number": number, "row": row, "plan": plan, "found": found, "finer": None}
    if found["status"] == "converged":
        finer = folder / f"{number:04d}-finer.nml"
        finer.write_text(
            namelist(groups_of(finer_row(row, plan, found), known)), encoding="utf-8"
        )
        both["finer"] = run(finer)
    path.with_suffix(".json").write_text(json.dumps(both), encoding="utf-8")
    return both


def report(cases: list[Row], folder: Path) -> int:
    """Print and write what is off; return 1 if anything is."""
    rows = []
    judged = numbers = heavy = 0
    for case in cases:
        found, finer = case["found"], case["finer"]
        rows += [
            {"case": case["number"], "number": name, "value": found[name]}
            for name in compare.negative_films(found)
        ]
        work = compare.work_over_plan(found, case["plan"])
        if not work <= compare.MOST_WORK:
            heavy += 1
            rows.append({"case": case["number"], "number": "work over plan", "value": work})
        if finer is None or finer["status"] not in ("converged", "unresolved"):
            continue
        judged += 1
        tolerance = {"response_tolerance": case["row"].get("response_tolerance", 1e-5)}
        for finding in compare.findings(found | tolerance, finer):
            numbers += 1
            if finding.is_offender:
                rows.append({"case": case["number"], **vars(finding)})
    by_number = {case["number"]: case["found"] for case in cases}
    keys = ("status", "rung", "cells_x", "cells_y", "load_parameter_m", "lubricant_parameter_l")
    keys += ("radius_ratio_d", "slip_parameter", "orientation", "response", "refinements")
    for row in rows:
        row |= {key: by_number[row["case"]].get(key) for key in keys}
    write_rows(folder / "offenders.csv", rows)
    statuses = [case["found"]["status"] for case in cases]
    counts = ", ".join(f"{statuses.count(one)} {one}" for one in sorted(set(statuses)))
    print(f"{len(cases)} cases: {counts}; {judged} judged against twice the cells, {numbers} numbers")
    wrong = sum("off" in row for row in rows)
    print(f"{wrong} numbers further off than {compare.FACTOR} times their error plus {compare.SLACK:.1%}")
    print(f"{sum('film' in row['number'] for row in rows)} negative films")
    print(f"{len(cases) - heavy} of {len(cases)} within {compare.MOST_WORK} times the planned work")
    for row in rows:
        print("  " + ", ".join(f"{key} {_short(value)}" for key, value in row.items()))
    return int(bool(rows))


def _short(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def main() -> int:
    """Draw, run, compare."""
    parser = argparse.ArgumentParser(prog="python -m studies.all_keys", description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--count", type=int, default=300, help="inputs")
    parser.add_argument("--seed", type=int, default=33, help="of the random numbers")
    parser.add_argument("--ranks", type=int, default=1, help="cases at once")
    parser.add_argument("--report", action="store_true", help="of what is there, run nothing")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    if options.report:
        files = sorted(options.folder.glob("[0-9][0-9][0-9][0-9].json"))
        return report([json.loads(file.read_text()) for file in files], options.folder)
    known = key_groups()
    drawn = draw_planned(options.count, options.seed, options.folder, known)
    with ThreadPoolExecutor(options.ranks) as pool:
        cases = list(
            pool.map(
                lambda one: run_both(one[0], *one[1], options.folder, known), enumerate(drawn)
            )
        )
    return report(cases, options.folder)


if __name__ == "__main__":
    sys.exit(main())
