"""Random marches of touching surfaces: how many reach the end, and shares on half the mesh."""

import argparse
import json
import math
import random
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ehlwave.writing import Writer, write_new_text
from studies import programs
from studies.judged.runs import read_rows

Groups = dict[str, dict[str, Any]]
Array = np.ndarray[Any, Any]

_MODULUS_PA = 226e9
_ALPHA = 2.2e-8
_RADIUS_M = 0.01
BOUNDARY_M = 2e-8
_POINTS = 200
_REACHED = 0.95
"""Share of the marches that must reach the end."""
_VALUES = (
    *("status", "message", "touching_share", "touching_share_error", "touching_area", "residual"),
    *("touching_is_artefact", "mean_film_um", "nonlinear_steps", "linear_steps", "seconds"),
    *("counted_work_units", "expected_work_units", "oil_friction_coefficient"),
)


def contact(chance: random.Random, *, is_line: bool) -> tuple[dict[str, Any], float, float]:
    """Return conditions, half width and central film in metres by the usual formulas."""
    hertz = chance.uniform(0.4e9, 1e9)
    speed = math.exp(chance.uniform(math.log(0.02), math.log(0.5)))
    conditions = {
        **{"radius_x_m": _RADIUS_M, "reduced_modulus_pa": _MODULUS_PA, "viscosity_pa_s": 0.04},
        **{"mean_speed_m_per_s": speed, "slip_parameter": round(chance.uniform(0.1, 1.9), 2)},
    }
    u, g = 0.04 * speed / (_MODULUS_PA / 2 * _RADIUS_M), _ALPHA * _MODULUS_PA
    if is_line:
        width = 4 * hertz * _RADIUS_M / _MODULUS_PA
        load = math.pi * hertz * width / 2
        film = (
            2.65 * _RADIUS_M * (u / 2) ** 0.7 * g**0.54 / (load / (_MODULUS_PA * _RADIUS_M)) ** 0.13
        )
        return conditions | {"load_n_per_m": load}, width, film
    width = math.pi * hertz * _RADIUS_M / _MODULUS_PA
    load = 2 * math.pi * hertz * width**2 / 3
    film = (
        1.9 * _RADIUS_M * (u / 2) ** 0.67 * g**0.53 / (load / (_MODULUS_PA * _RADIUS_M**2)) ** 0.067
    )
    return conditions | {"load_n": load, "radius_y_m": _RADIUS_M}, width, film


def _wave(chance: random.Random, rq: float, *, is_line: bool) -> dict[str, Any]:
    orientation = "transverse" if is_line else chance.choice(("transverse", "isotropic"))
    amplitude = rq * (2 if orientation == "isotropic" else math.sqrt(2))
    length = round(chance.uniform(0.5, 1.5), 2)
    return {"orientation": orientation, "wavelength_over_a": length, "amplitude_m": amplitude}


def smooth_case(conditions: dict[str, Any], cells: int, *, is_line: bool) -> Groups:
    """Return the groups of smooth surfaces that may touch, of a Newtonian oil."""
    grid = {"x_min": -3, "x_max": 1.5, "cells_x": cells, "edges": "truncated"}
    return {
        "conditions": conditions,
        "lubricant": {"pressure_viscosity_per_pa": _ALPHA, "roelands_index": 0.68},
        "touching": {"film_m": BOUNDARY_M},
        "grid": grid if is_line else grid | {"y_max": 2, "cells_y": cells},
    }


def _ramp(x: Array, length: float) -> Array:
    """Return the factor that rises from 0 at both ends to 1 over a length."""
    ends = np.minimum(1, np.minimum(x - x[0], x[-1] - x) / length)
    return np.sin(math.pi / 2 * ends) ** 2


def _write_map(
    path: Path, chance: random.Random, rq: float, width: float, *, is_line: bool
) -> None:
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
    rq = film * math.exp(chance.uniform(math.log(0.3), math.log(3)))
    cells = 192 if is_line else 48
    groups = smooth_case(conditions, cells, is_line=is_line)
    if chance.random() < 0.5:
        groups["lubricant"] |= {"flow_law": "eyring", "eyring_stress_pa": 1e7}
    if kind == "map":
        _write_map(folder / f"map{number}.h5", chance, rq, width, is_line=is_line)
        groups |= {"surface": {"file": f"map{number}.h5"}, "dynamics": {"end_time": 5}}
    else:
        share = 1 if kind == "wave" else math.sqrt(0.5)
        groups["waviness"] = _wave(chance, share * rq, is_line=is_line)
        if kind == "pair":
            groups["waviness2"] = _wave(chance, share * rq, is_line=is_line)
    return f"{'line' if is_line else 'ball'} {kind}, Rq/film {rq / film:.2f}", groups


def solve(groups: Groups, folder: Path) -> dict[str, Any]:
    """Run a case; its numbers, or the message of the program."""
    write_new_text(folder / "case.nml", programs.namelist(groups))
    outcome = programs.run("case", "case.nml", "--json", "--quiet", folder=folder)
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
    entry = {
        "number": number,
        "finer": is_finer,
        "kind": kind,
        "slip": groups["conditions"]["slip_parameter"],
    }
    return entry | {"wall_s": time.monotonic() - start} | {key: found.get(key) for key in _VALUES}


def summary(entries: list[dict[str, Any]]) -> str:
    """Return how many marches reached the end, and those whose share half the mesh contradicts."""
    coarse = {entry["number"]: entry for entry in entries if not entry["finer"]}
    ended = [entry for entry in coarse.values() if entry["touching_share"] is not None]
    text = f"{len(ended)} of {len(coarse)} marches reached the end"
    pairs = [
        (coarse[one["number"]], one)
        for one in entries
        if one["finer"] and one["touching_share"] is not None
    ]
    pairs = [(one, finer) for one, finer in pairs if one["touching_share"] is not None]
    off = [
        one["number"]
        for one, finer in pairs
        if not one["touching_is_artefact"]
        and abs(one["touching_share"] - finer["touching_share"])
        > one["touching_share_error"] + 1e-4
    ]
    return text + f"; of {len(pairs)} on half the mesh, shares off by more than the error: {off}"


def main() -> int:
    """Run the marches that the record lacks."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=40, help="marches (default 40)")
    parser.add_argument("--finer", type=int, default=0, help="of them also on twice the cells")
    parser.add_argument("--first", type=int, default=1, help="number of the first (default 1)")
    parser.add_argument(
        "--record", type=Path, required=True, help="lines of JSON; goes on where it ends"
    )
    options = parser.parse_args()
    entries = read_rows(options.record)
    known = {(entry["number"], entry["finer"]) for entry in entries}
    numbers = range(options.first, options.first + options.count)
    wanted = [(number, False) for number in numbers] + [
        (number, True) for number in numbers[: options.finer]
    ]
    for number, is_finer in wanted:
        if (number, is_finer) in known:
            continue
        entries.append(run_one(number, is_finer=is_finer))
        lines = [json.dumps(entry) + "\n" for entry in entries]
        Writer(overwrite=True).text(options.record, "".join(lines))
    sys.stdout.write(summary(entries) + "\n")
    ended = [entry["touching_share"] is not None for entry in entries if not entry["finer"]]
    return int(sum(ended) < _REACHED * len(ended))


if __name__ == "__main__":
    sys.exit(main())
