"""The command behind ``scripts/study heat-map``: random contacts with heat, and their cost."""

import argparse
import cmath
import json
import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass

import numpy as np

from ehlwave.contact import conditions_from_keys
from ehlwave.contact.scales import radius_ratio
from ehlwave.results.schema import SETTLED
from studies.command import maps
from studies.command.options import step_parser
from studies.programs import Groups, last_line, processor_seconds
from studies.sweeps import run_command, write_rows

PRESSURE = 0.3e9, 2e9
SPEED = 0.1, 30.0
KINDS = ("line", "circle", "ellipse", "circle")
LINE_CELLS = 8
"""Cells of a line contact over those of a point contact, at most."""
LEVELS = 12
"""Across the film, unless a case says how many."""
WAVES = 0.05
"""Amplitude over the film, of small waves."""
COMPARED = {"central_film": "central_film_error", "friction_coefficient": "friction_error"}
"""Results and their estimated errors."""


@dataclass
class Row:
    """One contact: its conditions, what became of it, and processor times without the start."""

    number: int
    kind: str
    flow_law: str
    mean_speed_m_per_s: float
    slide_to_roll_ratio: float
    status: str
    message: str
    hertz_pressure_pa: float = math.nan
    cells_x: float = math.nan
    cells_y: float = math.nan
    largest_rise_mid_film_k: float = math.nan
    isothermal_friction_coefficient: float = math.nan
    friction_coefficient: float = math.nan
    heat_balance_error: float = math.nan
    seconds: float = math.nan
    isothermal_seconds: float = math.nan
    ratio: float = math.nan
    worst_share_of_error: float = math.nan
    """Change with twice the levels and half the mesh over the stated error, of film or friction."""
    frozen_change: float = math.nan
    """Change of Ad/Ai, as complex numbers, by temperatures that follow waves of length a."""
    frozen_share: float = math.nan
    """The same over its estimate."""


def draw(number: int) -> Groups:
    """Return a contact as groups of keys.

    The Hertz pressure is 0.3 to 2 GPa, the mean speed 0.1 to 30 m/s, the slide-to-roll ratio 0 to
    2.
    """
    rng = np.random.default_rng([38, number])

    def between(low: float, high: float, digits: int = 4) -> float:
        return float(f"{low * (high / low) ** rng.random():.{digits}g}")

    kind = KINDS[number % len(KINDS)]
    pressure, modulus = between(*PRESSURE), 2.26e11
    conditions = {
        "radius_x_m": between(5e-3, 4e-2),
        "reduced_modulus_pa": modulus,
        "mean_speed_m_per_s": between(*SPEED),
        "viscosity_pa_s": between(0.01, 0.2),
        "slide_to_roll_ratio": float(f"{2 * rng.random():.4g}"),
    }
    lubricant = {
        "pressure_viscosity_per_pa": between(1.2e-8, 2.4e-8),
        "temperature_k": between(300, 380),
    }
    lubricant["roelands_index"] = between(0.45, 0.7)
    flow = ("eyring", "carreau", "eyring", "newtonian")[int(4 * rng.random())]
    lubricant["flow_law"] = flow
    if flow == "eyring":
        lubricant["eyring_stress_pa"] = between(3e6, 1e7)
    elif flow == "carreau":
        lubricant |= {
            "carreau_modulus_pa": between(3e6, 1e7),
            "carreau_exponent": between(0.35, 0.8),
        }
    heat = {
        "oil_conductivity_w_per_m_k": between(0.12, 0.16),
        "oil_heat_capacity_j_per_kg_k": between(1700, 2300),
        "oil_density_kg_per_m3": between(820, 950),
        "oil_expansion_per_k": 7e-4,
        "viscosity_temperature_per_k": between(0.025, 0.06),
    }
    ratio = {"line": 0.0, "circle": 1.0, "ellipse": float(rng.uniform(0.25, 0.9))}[kind]
    conditions |= load(kind, ratio, pressure, conditions["radius_x_m"], modulus)
    return {"conditions": conditions, "lubricant": lubricant, "heat": heat}


def load(
    kind: str, ratio: float, pressure: float, radius: float, modulus: float
) -> dict[str, float]:
    """Return the keys of the load, by its Hertz pressure, and of the radius across, by a/b."""
    keys = {"radius_x_m": radius, "reduced_modulus_pa": modulus}
    keys |= {"mean_speed_m_per_s": 1.0, "viscosity_pa_s": 0.1}  # of which Hertz knows nothing
    if kind == "line":
        one = conditions_from_keys(keys | {"load_n_per_m": 1.0}).hertz_pa
        return {"load_n_per_m": float((pressure / one) ** 2)}
    across = {"radius_y_m": radius / radius_ratio(ratio)}
    one = conditions_from_keys(keys | across | {"load_n": 1.0}).hertz_pa
    return across | {"load_n": float((pressure / one) ** 3)}


def grid(groups: Groups, cells: int) -> Groups:
    """Return the groups with one thread and a grid of at most so many cells."""
    groups = {**groups, "solver": {"threads": 1}}
    if "load_n_per_m" in groups["conditions"]:
        return {
            **groups,
            "grid": {"edges": "flooded", "cells_x": 0, "largest_cells": LINE_CELLS * cells},
        }
    return {
        **groups,
        "grid": {"edges": "flooded", "cells_x": 0, "cells_y": 0, "largest_cells": cells},
    }


def isothermal(groups: Groups) -> Groups:
    """Return the same contact without heat."""
    cold = {name: keys for name, keys in groups.items() if name != "heat"}
    cold["lubricant"] = {k: v for k, v in groups["lubricant"].items() if k != "temperature_k"}
    return cold


def timed(groups: Groups, repeats: int) -> tuple[Mapping[str, object], float]:
    """Run a case; return its result, and its processor time in seconds without that to plan it."""
    _, start = processor_seconds(groups, repeats, "--plan", "--quiet")
    outcome, least = processor_seconds(groups, repeats, "--json", "--quiet")
    least = max(least - start, 1e-3)
    try:
        return last_line(outcome), least
    except json.JSONDecodeError:
        return {"status": "refused", "message": outcome.stderr.strip()[-300:]}, least


def finer(groups: Groups, result: Mapping[str, object]) -> float:
    """Return the change with twice the levels or half the mesh over the stated error."""
    cells = {name: int(result[name]) for name in ("cells_x", "cells_y") if name in groups["grid"]}
    fixed = {**groups, "grid": {**groups["grid"], **cells}}
    double = {name: 2 * count for name, count in cells.items()}
    others = (
        {**fixed, "heat": {**groups["heat"], "levels": 2 * LEVELS}},
        {**fixed, "grid": {**fixed["grid"], **double, "largest_cells": 4096}},
    )
    worst = 0.0
    for other in others:
        found, _ = timed(other, 1)
        for name, error in COMPARED.items():
            value, stated, there = (
                r.get(n) for r, n in ((result, name), (result, error), (found, name))
            )
            if value is None or stated is None or there is None:
                return math.nan
            worst = max(worst, abs(there / value - 1) / stated)
    return worst


def freezing(groups: Groups, number: int) -> tuple[float, float]:
    """Return how far Ad/Ai is off where temperatures stay as waves pass, and over its estimate.

    Small waves of length a are on the faster surface of even contacts, of odd ones on the slower.
    """
    conditions = dict(groups["conditions"])
    conditions["slide_to_roll_ratio"] *= (1, -1)[number % 2]
    waves = {"orientation": "transverse", "wavelength_over_a": 1.0, "response": "both"}
    wavy = {
        **groups,
        "conditions": conditions,
        "heat": {**groups["heat"], "wave_temperatures": "carried"},
        "waviness": {**waves, "amplitude_over_film": WAVES},
    }
    found, _ = timed(wavy, 1)
    names = ("amplitude_ratio_fit", "phase_fit", "harmonic_ratio", "harmonic_phase")
    march, march_phase, response, phase = (found.get(name) for name in names)
    if march is None or response is None:
        return math.nan, math.nan
    change = abs(cmath.rect(march, march_phase) - cmath.rect(response, phase))
    return change, change / found["frozen_heat_error"]


def study(number: int, cells: int, repeats: int, compares: bool, waves: bool) -> Row:
    """Run one contact with and without heat, and on request others besides.

    They have more levels and cells, and waves.
    """
    groups = grid(draw(number), cells)
    result, seconds = timed(groups, repeats)
    cold, cold_seconds = timed(isothermal(groups), repeats)
    conditions = groups["conditions"]
    row = Row(
        number=number,
        kind=KINDS[number % len(KINDS)],
        flow_law=groups["lubricant"]["flow_law"],
        mean_speed_m_per_s=conditions["mean_speed_m_per_s"],
        slide_to_roll_ratio=conditions["slide_to_roll_ratio"],
        status=result["status"],
        message=result.get("message") or "",
        seconds=seconds,
        isothermal_seconds=cold_seconds,
    )
    for name in asdict(row):
        if isinstance(result.get(name), int | float) and name != "seconds":
            setattr(row, name, result[name])
    if is_solved(result["status"]) and is_solved(cold["status"]):
        row.ratio = seconds / cold_seconds
    if compares and result["status"] == "converged":
        row.worst_share_of_error = finer(groups, result)
    if waves and is_solved(result["status"]):
        row.frozen_change, row.frozen_share = freezing(groups, number)
    return row


def is_solved(status: object) -> bool:
    """Return whether a steady state was found, on a grid that resolves it or not."""
    return status in SETTLED


def summary(rows: Sequence[Row]) -> str:
    """Return what became of the contacts."""
    solved = sum(is_solved(row.status) for row in rows)
    silent = [row.number for row in rows if not is_solved(row.status) and not row.message]
    lines = [f"{solved} of {len(rows)} contacts settled; without a reason: {silent or 'none'}"]
    ratios = [row.ratio for row in rows if row.kind != "line" and math.isfinite(row.ratio)]
    if ratios:
        lines.append(
            f"processor time over that without heat, {len(ratios)} point contacts: "
            f"median {np.median(ratios):.2f}, largest {max(ratios):.2f}, "
            f"above 4: {sum(ratio > 4 for ratio in ratios)}"
        )
    balances = [row.heat_balance_error for row in rows if is_solved(row.status)]
    if balances:
        above = sum(balance > 1e-3 for balance in balances)
        lines.append(f"heat balance: largest error {max(balances):.1e}, above 1e-3: {above}")
    said = "twice the levels and half the mesh: within the stated errors in"
    lines += _within(said, [row.worst_share_of_error for row in rows])
    said = "temperatures that follow waves change Ad/Ai by less than is stated in"
    lines += _within(said, [row.frozen_share for row in rows])
    return "\n".join(lines)


def _within(said: str, shares: Sequence[float]) -> list[str]:
    """Return a line on how many of the shares that were measured are at most 1; none if none."""
    shares = [share for share in shares if math.isfinite(share)]
    if not shares:
        return []
    count = sum(share <= 1 for share in shares)
    return [f"{said} {count} of {len(shares)}, largest share {max(shares):.2f}"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the contacts, print and write the table; return 1 if one fails without a reason."""
    return run_command(step_parser(maps.heat_map, __doc__), _run, arguments)


def _run(options: argparse.Namespace) -> int:
    rows = []
    for number in range(options.first, options.first + options.contacts):
        row = study(number, options.cells, options.repeats, options.finer, options.waves)
        rows.append(row)
        print(
            f"{row.number:3} {row.kind:8} {row.hertz_pressure_pa / 1e9:5.2f} GPa "
            f"{row.mean_speed_m_per_s:6.2f} m/s ratio {row.slide_to_roll_ratio:4.2f} "
            f"{row.flow_law:9} {row.status:10} {row.ratio:5.2f} {row.worst_share_of_error:5.2f} "
            f"{row.frozen_change:6.3f} {row.frozen_share:5.2f} "
            f"{row.message[:160]}",
            flush=True,
        )
    path = options.output / "heat_map.csv"
    write_rows(path, map(asdict, rows), digits=5)
    print(summary(rows))
    print(path)
    return int(any(not is_solved(row.status) and not row.message for row in rows))


if __name__ == "__main__":
    sys.exit(main())
