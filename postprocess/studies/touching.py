"""Random marches of touching surfaces: how many reach the end, and shares on half the mesh.

Waves, pairs and maps; a sixteenth of the first surfaces rests.
"""

import argparse
import json
import math
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ehlwave.writing import Writer, write_new_text
from studies import programs
from studies.judged.runs import kept

Groups = dict[str, dict[str, Any]]
Array = np.ndarray[Any, Any]

MODULUS_PA = 226e9
ALPHA = 2.2e-8
RADIUS_M = 0.01
BOUNDARY_M = 2e-8
_POINTS = 200
_AT_REST = 1 / 16
"""Share of the contacts whose first surface rests."""
_FINER_BALLS = 10
"""Each tenth ball is also marched on twice the cells, as all lines are."""
_SECONDS = 900.0
"""Wall time of a march, at most."""
_NOTABLE = 1e-4
"""Share of the load from which on solids bear."""
_REACHED = 0.95
"""Share of the marches that must reach the end."""
_VALUES = (
    *("status", "message", "touching_share", "touching_share_error", "touching_area", "residual"),
    *("touching_is_artefact", "mean_film_um", "nonlinear_steps", "linear_steps", "seconds"),
    *("counted_work_units", "expected_work_units", "oil_friction_coefficient"),
)


def contact(chance: random.Random, *, is_line: bool) -> tuple[dict[str, Any], float, float]:
    """Return drawn conditions, half width and central film in metres."""
    hertz = chance.uniform(0.4e9, 1e9)
    speed = math.exp(chance.uniform(math.log(0.02), math.log(0.5)))
    return contact_of(hertz, speed, round(chance.uniform(0.1, 1.9), 2), is_line=is_line)


def contact_of(
    hertz: float, speed: float, slip: float, *, is_line: bool
) -> tuple[dict[str, Any], float, float]:
    """Return conditions, half width and central film in metres by the usual formulas."""
    conditions = {
        **{"radius_x_m": RADIUS_M, "reduced_modulus_pa": MODULUS_PA, "viscosity_pa_s": 0.04},
        **{"mean_speed_m_per_s": speed, "slip_parameter": slip},
    }
    u, g = 0.04 * speed / (MODULUS_PA / 2 * RADIUS_M), ALPHA * MODULUS_PA
    if is_line:
        width = 4 * hertz * RADIUS_M / MODULUS_PA
        load = math.pi * hertz * width / 2
        film = 2.65 * RADIUS_M * (u / 2) ** 0.7 * g**0.54 / (load / (MODULUS_PA * RADIUS_M)) ** 0.13
        return conditions | {"load_n_per_m": load}, width, film
    width = math.pi * hertz * RADIUS_M / MODULUS_PA
    load = 2 * math.pi * hertz * width**2 / 3
    film = 1.9 * RADIUS_M * (u / 2) ** 0.67 * g**0.53 / (load / (MODULUS_PA * RADIUS_M**2)) ** 0.067
    return conditions | {"load_n": load, "radius_y_m": RADIUS_M}, width, film


def _wave(chance: random.Random, rq: float, *, is_line: bool) -> dict[str, Any]:
    orientation = "transverse" if is_line else chance.choice(("transverse", "isotropic"))
    amplitude = rq * (2 if orientation == "isotropic" else math.sqrt(2))
    length = round(chance.uniform(0.5 if is_line else 1, 1.5), 2)
    return {"orientation": orientation, "wavelength_over_a": length, "amplitude_m": amplitude}


def smooth_case(conditions: dict[str, Any], cells: int, *, is_line: bool) -> Groups:
    """Return the groups of smooth surfaces that may touch, of a Newtonian oil."""
    grid = {"x_min": -3, "x_max": 1.5, "cells_x": cells, "edges": "truncated"}
    return {
        "conditions": conditions,
        "lubricant": {"pressure_viscosity_per_pa": ALPHA, "roelands_index": 0.68},
        "touching": {"film_m": BOUNDARY_M},
        "grid": grid if is_line else grid | {"y_max": 2, "cells_y": cells},
    }


def _ramp(x: Array, length: float) -> Array:
    """Return the factor that rises from 0 at both ends to 1 over a length."""
    ends = np.minimum(1, np.minimum(x - x[0], x[-1] - x) / length)
    return np.sin(math.pi / 2 * ends) ** 2


def write_map(path: Path, chance: random.Random, rq: float, width: float, *, is_line: bool) -> None:
    """Write random heights without waves shorter than half the contact's half width."""
    step = 0.04 * width
    x = step * np.arange(_POINTS)
    y = np.zeros(1) if is_line else step * (np.arange(_POINTS // 2) - _POINTS // 4)
    heights = np.zeros((len(y), len(x)))
    for _ in range(12):
        k = 2 * math.pi / (width * chance.uniform(0.5, 2))
        angle = 0.0 if is_line else chance.uniform(0, math.pi)
        phase = chance.uniform(0, 2 * math.pi)
        heights += np.cos(k * (math.cos(angle) * x + math.sin(angle) * y[:, None]) + phase)
    heights *= rq / heights.std() * _ramp(x, width)
    if not is_line:
        heights *= _ramp(y, width / 4)[:, None]
    data = xr.Dataset({"height": (("y", "x"), heights)}, coords={"x": x, "y": y})
    Writer().dataset(path, data)


def draw(number: int, folder: Path) -> tuple[str, Groups]:
    """Return the kind of a march and its groups; maps are written to the folder."""
    chance = random.Random(number)
    is_line = chance.random() < 0.5
    kind = chance.choice(
        ("wave", "pair") if is_line else ("wave", "pair", "map")
    )  # lines take waves
    conditions, width, film = contact(chance, is_line=is_line)
    least, most = (0.1, 1.95) if kind == "pair" else (0, 2)  # both surfaces of a pair move
    at_rest = chance.random() < _AT_REST
    slip = least if at_rest else min(most, round(chance.uniform(0.1, 2), 2))
    conditions["slip_parameter"] = slip
    rq = film * math.exp(chance.uniform(math.log(0.3), math.log(3)))
    cells = 192 if is_line else 48 if number % _FINER_BALLS < 2 else 32
    groups = smooth_case(conditions, cells, is_line=is_line)
    if chance.random() < 0.5:
        groups["lubricant"] |= {"flow_law": "eyring", "eyring_stress_pa": 1e7}
    if kind == "map":
        write_map(folder / f"map{number}.h5", chance, rq, width, is_line=is_line)
        groups |= {"surface": {"file": f"map{number}.h5"}, "dynamics": {"end_time": 5}}
    else:
        share = 1 if kind == "wave" else math.sqrt(0.5)
        groups["waviness"] = _wave(chance, share * rq, is_line=is_line)
        if kind == "pair":
            groups["waviness2"] = _wave(chance, share * rq, is_line=is_line)
    return f"{'line' if is_line else 'ball'} {kind}, Rq/film {rq / film:.2f}", groups


def _has_finer(entry: dict[str, Any]) -> bool:
    """Return whether a march is also computed on twice the cells."""
    is_line: bool = entry["kind"].startswith("line")
    return entry["status"] == "converged" and (is_line or entry["number"] % _FINER_BALLS == 0)


def solve(groups: Groups, folder: Path) -> dict[str, Any]:
    """Run a case; its numbers, or the message of the program."""
    write_new_text(folder / "case.nml", programs.namelist(groups))
    try:
        words = ("case.nml", "--json", "--quiet")
        outcome = programs.run("case", *words, folder=folder, seconds=_SECONDS)
    except subprocess.TimeoutExpired:
        return {"message": f"not finished after {_SECONDS:.0f} s"}
    lines = outcome.stdout.strip().splitlines()
    if not lines or not lines[-1].startswith("{"):
        return {"message": outcome.stderr[-300:]}
    found: dict[str, Any] = json.loads(lines[-1])
    return found


def run_one(number: int, *, is_finer: bool = False) -> dict[str, Any]:
    """Run a march; with `is_finer` on twice the cells."""
    with tempfile.TemporaryDirectory() as name:
        kind, groups = draw(number, Path(name))
        if is_finer:
            doubled = {key: 2 * value for key, value in groups["grid"].items() if "cells" in key}
            groups["grid"] = groups["grid"] | doubled
        start = time.monotonic()
        found = solve(groups, Path(name))
    entry = {"kind": kind, "slip": groups["conditions"]["slip_parameter"]}
    return entry | {"wall_s": time.monotonic() - start} | {key: found.get(key) for key in _VALUES}


def summary(marches: list[dict[str, Any]], finer: list[dict[str, Any]]) -> str:
    """Return how many marches reached the end, and those whose share half the mesh contradicts.

    A share that is flagged contradicts nothing: an artefact, one of an unresolved case, or one
    without an error.
    """
    coarse = {entry["number"]: entry for entry in marches}
    ended = [entry for entry in marches if entry["touching_share"] is not None]
    touches = [entry for entry in ended if entry["touching_share"] > _NOTABLE]
    pairs = [
        (coarse[entry["number"]], entry)
        for entry in finer
        if entry["touching_share"] is not None and coarse[entry["number"]]["status"] == "converged"
    ]
    off = [
        one["number"]
        for one, half in pairs
        if one["touching_share_error"] is not None
        and abs(one["touching_share"] - half["touching_share"])
        > one["touching_share_error"] + _NOTABLE
    ]
    return (
        f"{len(ended)} of {len(marches)} marches reached the end, {len(touches)} of them touch; "
        f"{len(pairs)} converged ones on half the mesh: shares off by more than the error: "
        f"{off or 'none'}"
    )


def main() -> int:
    """Run the marches that the record lacks."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200, help="marches (default 200)")
    parser.add_argument(
        "--record", type=Path, required=True, help="lines of JSON; goes on where it ends"
    )
    options = parser.parse_args()
    marches = kept(options.record, range(1, options.count + 1), lambda n, _: run_one(n), 1)
    numbers = [entry["number"] for entry in marches if _has_finer(entry)]
    record = options.record.with_stem(options.record.stem + "_finer")
    finer = kept(record, numbers, lambda n, _: run_one(n, is_finer=True), 1)
    sys.stdout.write(summary(marches, finer) + "\n")
    ended = sum(entry["touching_share"] is not None for entry in marches)
    return int(ended < _REACHED * len(marches))


if __name__ == "__main__":
    sys.exit(main())
