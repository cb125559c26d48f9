"""Run random legal inputs, each again on twice the cells, and compare."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from ehlwave.results.schema import SETTLED
from ehlwave.writing import Writer
from studies import programs
from studies.all_keys import compare
from studies.all_keys.draw import Row, draw

LARGEST_COST = 1.5e8
"""Cost of the finer run: planned work times cells. About ten seconds."""
LONGEST_S = 1800
UNRESOLVED = 0.3
"""Share of kept inputs among those that, by the plan, their grid does not resolve."""
USUAL_DOMAIN = {"x_min": -2.5, "x_max": 1.5, "y_max": 2.0}
USUAL_TOLERANCES = {"tolerance": 1e-6, "step_tolerance": 1e-4, "response_tolerance": 1e-5}
TOLD = ("status", "rung", "cells_x", "cells_y", "load_parameter_m", "lubricant_parameter_l")
TOLD += ("radius_ratio_d", "slip_parameter", "orientation", "response", "refinements")


def draw_planned(
    count: int, seed: int, folder: Path, known: dict[str, str], largest_cost: float = LARGEST_COST
) -> list[tuple[Row, Row]]:
    """Return so many legal inputs whose finer run is not too long, with their plans."""
    rng = np.random.default_rng(seed)
    found: list[tuple[Row, Row]] = []
    while len(found) < count:
        row = draw(rng, known, folder)
        plan = plan_of(row, known, folder)
        if plan is None or _cost_of_finer(plan) > largest_cost:
            continue
        if plan["is_resolved"] or rng.random() < UNRESOLVED:
            found.append((row, plan))
    return found


def run_both(number: int, row: Row, plan: Row, folder: Path, known: dict[str, str]) -> Row:
    """Run a case and, where it converges, the finer case; keep inputs and results."""
    path = folder / f"{number:04d}.nml"
    _write(path, row, known)
    found = _run(path)
    both = {"number": number, "row": row, "plan": plan, "found": found, "finer": None}
    if found["status"] == "converged":
        finer = folder / f"{number:04d}-finer.nml"
        _write(finer, finer_row(row, plan, found), known)
        both["finer"] = _run(finer)
    Writer().text(path.with_suffix(".json"), json.dumps(both))
    return both


def finer_row(row: Row, plan: Row, found: Row) -> Row:
    """Return the same case on twice the cells and half the time step, without an accuracy.

    Domain, settling and time step over cell follow the accuracy; tolerances are the defaults where
    the case has looser ones, and nothing caps the steps.
    """
    finer = dict(row)
    for key in ("accuracy", "largest_cells", "largest_total_steps", "largest_steps"):
        finer.pop(key, None)
    axes = ("x",) if found["radius_ratio_d"] == 0 else ("x", "y")
    finer |= {f"cells_{axis}": 2 * int(found[f"cells_{axis}"]) for axis in axes}
    for key, usual in USUAL_DOMAIN.items():
        if key[0] in axes and abs(found[f"domain_{key}"] - row.get(key, usual)) > 1e-9:
            finer[key] = found[f"domain_{key}"]
    if "accuracy" in row:
        step = plan["time_step"] * plan["cells_x"] / (plan["domain_x_max"] - plan["domain_x_min"])
        if step > 0:
            finer["time_step_over_cell"] = round(step, 6)
        if row.get("edges", "flooded") == "flooded":
            finer.setdefault("settling_periods", 2)
    for key, usual in USUAL_TOLERANCES.items():
        finer[key] = min(usual, row.get(key, usual))
    return {**finer, "error_estimate": "model"}


def offenders(cases: list[Row]) -> tuple[list[Row], str]:
    """Return the offenders, with the identity of the case, and a summary."""
    rows: list[Row] = []
    judged = numbers = 0
    for case in cases:
        number, found, finer = case["number"], case["found"], case["finer"]
        off: list[Row] = [
            {"number": name, "value": found[name]} for name in compare.negative_films(found)
        ]
        work = compare.work_over_plan(found, case["plan"])
        has_own_cap = case["row"].get("largest_total_steps", 0) > 0  # replaces the plan's value
        most = compare.MOST_WORK * (compare.FINER_RUNS if "accuracy" in case["row"] else 1)
        if not has_own_cap and not work <= most:
            off.append({"number": "work over plan", "value": work})
        if finer is not None and finer["status"] in SETTLED:
            judged += 1
            tolerance = case["row"].get(
                "response_tolerance", USUAL_TOLERANCES["response_tolerance"]
            )
            all_of_it = compare.findings(found | {"response_tolerance": tolerance}, finer)
            numbers += len(all_of_it)
            off += [vars(finding) for finding in all_of_it if finding.is_offender]
        rows += [{"case": number, **one, **{key: found.get(key) for key in TOLD}} for one in off]
    return rows, _summary(cases, rows, judged, numbers)


def _summary(cases: list[Row], rows: list[Row], judged: int, numbers: int) -> str:
    statuses = [case["found"]["status"] for case in cases]
    rungs = [case["found"]["rung"] for case in cases if case["found"]["status"] == "converged"]
    heavy = sum(row["number"] == "work over plan" for row in rows)
    counts = ", ".join(f"{statuses.count(one)} {one}" for one in sorted(set(statuses)))
    return "\n".join(
        [
            f"{len(cases)} cases: {counts}; {len(rungs) - rungs.count('direct')} rescued",
            f"{judged} compared with twice the cells, {numbers} numbers, "
            f"{sum('off' in row for row in rows)} of them further off than {compare.FACTOR} times "
            f"their error plus {compare.SLACK:.1%}",
            f"{sum(row['number'] in compare.FILMS for row in rows)} negative films",
            f"{len(cases) - heavy} of {len(cases)} within {compare.MOST_WORK} times their plan, "
            f"{compare.MOST_WORK * compare.FINER_RUNS} with an accuracy",
        ]
    )


def _write(path: Path, row: Row, known: dict[str, str]) -> None:
    groups: dict[str, dict[str, Any]] = {}
    for key, value in row.items():
        groups.setdefault(known[key], {})[key] = value
    Writer().text(path, programs.namelist(groups))


def plan_of(row: Row, known: dict[str, str], folder: Path) -> Row | None:
    """Return the plan of a row, None where the program refuses the input."""
    path = folder / "plan.nml"
    _write(path, row, known)
    outcome = programs.run("case", path, "--plan", "--json", seconds=LONGEST_S)
    if outcome.returncode == 2:
        return None
    if outcome.returncode != 0:
        raise RuntimeError(f"{row}: {outcome.stdout}{outcome.stderr}")
    plan: Row = programs.last_line(outcome)
    return plan


def _cost_of_finer(plan: Row) -> float:
    """Return planned work times cells of the run on twice the cells."""
    growth = 8 if plan["time_steps"] > 0 else 4
    return float(growth * plan["expected_work_units"] * plan["cells_x"] * plan["cells_y"])


def _run(path: Path) -> Row:
    outcome = programs.run("case", path, "--json", "--quiet", seconds=LONGEST_S)
    if outcome.returncode not in (0, 1):
        said = outcome.stdout + outcome.stderr
        raise RuntimeError(f"{path}: exit status {outcome.returncode}\n{said}")
    result: Row = programs.last_line(outcome)
    return result
