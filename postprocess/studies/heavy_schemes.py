"""Error against work of both schemes of the Reynolds equation, light loads to heavy ones."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ehlwave.contact.scales import ellipticity, pressure_factor
from studies.programs import Groups, solve
from studies.work_unit import convolutions

Solve = Callable[..., Mapping[str, Any]]

CONTACTS = tuple((m, d) for d in (1, 0.07) for m in (100, 1000, 3000, 10000))
"""M and D; L = 12.05."""

WAVES = 0.0, 0.5, 2.0
"""Wavelengths over a of transverse waves, 0: the smooth film."""

SCHEMES = "averaged", "fitted"
LADDER = 64, 96, 128, 192, 256, 384, 512, 768, 1024, 1536, 2048
"""Cells along X; half as many along Y."""

ACCURACY = 0.01
WELL_BELOW = 0.004
"""Error from which on no finer grid is run."""

ORDER = 2
"""Of the scheme."""


@dataclass(frozen=True)
class Point:
    """One run: the error of the film, or of Ad/Ai, and its work in convolutions on 257 x 257."""

    load_parameter_m: float
    radius_ratio_d: float
    wavelength_over_a: float
    scheme: str
    cells_x: int
    status: str
    value: float
    error: float
    work: float


def groups_of(m: float, d: float, wave: float, scheme: str, cells: int) -> Groups:
    """Return the input of one run."""
    groups: dict[str, Mapping[str, object]] = {
        "conditions": {"load_parameter_m": m, "lubricant_parameter_l": 12.05, "radius_ratio_d": d},
        "grid": {"edges": "flooded", "cells_x": cells, "cells_y": cells // 2},
        "solver": {"scheme": scheme, "threads": 1},
    }
    if wave > 0:
        groups["waviness"] = {
            "orientation": "transverse",
            "wavelength_over_a": wave,
            "response": "harmonic",
        }
    return groups


def reference_cells(m: float, d: float) -> int:
    """Return cells of the finer reference grid: about 0.1 inlet lengths of the heaviest load."""
    steepness = m * pressure_factor(ellipticity(d))
    return next((n for n in (256, 512) if n * n > 200 * steepness), 1024)


def limit(run: Solve, m: float, d: float, wave: float) -> float:
    """Return the value for mesh size 0, from two grids of the fitted scheme."""
    cells = reference_cells(m, d)
    coarse, fine = (
        value_of(run(**groups_of(m, d, wave, "fitted", n)), wave) for n in (cells // 2, cells)
    )
    return fine + (fine - coarse) / (2**ORDER - 1)


def value_of(result: Mapping[str, Any], wave: float) -> float:
    """Return the film, or with waves Ad/Ai."""
    return float(result["harmonic_ratio" if wave > 0 else "central_film"])


def work_of(result: Mapping[str, Any]) -> float:
    """Return all the work of a run, in convolutions on 257 x 257 nodes."""
    cells = math.sqrt(result["cells_x"] * result["cells_y"])
    return float(result["total_work_units"] * convolutions(cells))


def measure(
    run: Solve = solve, contacts: Sequence[tuple[float, float]] = CONTACTS, largest: int = 2048
) -> Iterator[Point]:
    """Run each contact on finer and finer grids until its error is well below what is asked for."""
    for m, d in contacts:
        for wave in WAVES:
            truth = limit(run, m, d, wave)
            for scheme in SCHEMES:
                for cells in [n for n in LADDER if n <= largest]:
                    if wave > 0 and cells * wave / 4 < 8:
                        continue
                    try:
                        result = run(**groups_of(m, d, wave, scheme, cells))
                    except AssertionError:
                        continue  # too coarse for any solution
                    value = value_of(result, wave)
                    error = abs(value / truth - 1)
                    status, work = result["status"], work_of(result)
                    yield Point(m, d, wave, scheme, cells, status, value, error, work)
                    if error < WELL_BELOW and status == "converged":
                        break


def least_work(points: Sequence[Point]) -> float:
    """Return the work of the coarsest grid that is within 1 %, as all finer ones; NaN: none is."""
    least = math.nan
    for point in sorted(points, key=lambda point: -point.cells_x):
        if point.error > ACCURACY or point.status != "converged":
            break
        least = point.work
    return least


def table(points: Sequence[Point]) -> list[dict[str, float]]:
    """Return the least work for 1 % of both schemes, each contact and wavelength a row."""
    rows = []
    keys = [(p.load_parameter_m, p.radius_ratio_d, p.wavelength_over_a) for p in points]
    for key in dict.fromkeys(keys):
        works = [
            least_work([p for p, k in zip(points, keys, strict=True) if (k, p.scheme) == (key, s)])
            for s in SCHEMES
        ]
        names = ("load_parameter_m", "radius_ratio_d", "wavelength_over_a", *SCHEMES)
        rows.append(dict(zip(names, (*key, *works), strict=True)))
    return rows
