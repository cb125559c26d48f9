"""Random heavy loads with an accuracy, each against itself on twice the cells."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from studies.programs import Groups, last_line, processor_seconds

ACCURACY = 0.01
LOADS = 2000.0, 10000.0
LUBRICANTS = 2.5, 20.0
NARROWEST = 0.04
BEARING = 0.07
"""D of every fourth contact: that of a deep groove ball bearing."""

Run = Callable[[Groups], tuple[Mapping[str, Any], float]]
"""Runs a case; returns its result and its processor time in seconds."""


@dataclass(frozen=True)
class Drawn:
    """One contact; errors are those of the film and, with waves, of Ad/Ai."""

    number: int
    load_parameter_m: float
    lubricant_parameter_l: float
    radius_ratio_d: float
    wavelength_over_a: float
    status: str
    scheme: str
    cells_x: float
    cells_y: float
    refinements: float
    error_estimate: float
    film_error: float
    ratio_error: float
    total_work_units: float
    expected_work_units: float
    seconds: float
    message: str

    @property
    def is_within(self) -> bool:
        """Whether the contact has the accuracy that it asked for."""
        errors = (self.film_error, self.ratio_error)
        return self.status == "converged" and all(not error > ACCURACY for error in errors)


def draw(number: int) -> Groups:
    """Return a contact; every third has waves, of which the response is asked for."""
    rng = np.random.default_rng([10, number])
    low, high = LOADS
    share, lubricant, narrow, wave = rng.random(4)
    groups: dict[str, Mapping[str, object]] = {
        "conditions": {
            "load_parameter_m": float(f"{low * (high / low) ** share:.4g}"),
            "lubricant_parameter_l": round(float(np.interp(lubricant, (0, 1), LUBRICANTS)), 2),
            "radius_ratio_d": BEARING if number % 4 == 3 else float(f"{NARROWEST**narrow:.3g}"),
        },
        "grid": {"edges": "flooded"},
        "solver": {"accuracy": ACCURACY, "threads": 1},
    }
    if number % 3 == 2:
        groups["waviness"] = {
            "orientation": "transverse",
            "wavelength_over_a": round(float(0.5 * 4**wave), 3),
            "response": "harmonic",
        }
    return groups


def finer(groups: Groups, result: Mapping[str, Any]) -> Groups:
    """Return the contact on twice the cells by the same scheme, to a tighter tolerance."""
    cells = {name: 2 * int(result[name]) for name in ("cells_x", "cells_y")}
    solver = {"scheme": result["scheme"], "tolerance": 1e-7, "threads": 1}
    return {**groups, "grid": {**groups["grid"], **cells}, "solver": solver}


def run(groups: Groups) -> tuple[Mapping[str, Any], float]:
    """Run a case, whatever becomes of it."""
    outcome, seconds = processor_seconds(groups, 1, "--json", "--quiet")
    return last_line(outcome), seconds


def check(numbers: Sequence[int], run: Run = run) -> Iterator[Drawn]:
    """Run contacts and their finer selves."""
    for number in numbers:
        groups = draw(number)
        result, seconds = run(groups)
        truth, _ = run(finer(groups, result))
        names = ("central_film", "harmonic_ratio")
        film, ratio = (_error(result.get(name), truth.get(name)) for name in names)
        yield Drawn(
            number=number,
            **groups["conditions"],
            wavelength_over_a=groups.get("waviness", {}).get("wavelength_over_a", math.nan),
            **{
                name: result[name]
                for name in (
                    *("status", "scheme", "cells_x", "cells_y", "refinements", "error_estimate"),
                    *("total_work_units", "expected_work_units", "message"),
                )
            },
            film_error=film if "waviness" not in groups else math.nan,
            ratio_error=ratio,
            seconds=seconds,
        )


def summary(rows: Sequence[Drawn]) -> str:
    """Return how many contacts have their accuracy, and the longest run."""
    silent = [row.number for row in rows if row.status == "converged" and not row.is_within]
    told = [f"{row.number} {row.status}" for row in rows if row.status != "converged"]
    return (
        f"{sum(row.is_within for row in rows)} of {len(rows)} contacts within {ACCURACY:.0%}; "
        f"off without a word: {silent or 'none'}; other status: {', '.join(told) or 'none'}; "
        f"longest run {max(row.seconds for row in rows):.1f} s of processor time"
    )


def _error(value: float | None, truth: float | None) -> float:
    return abs(value / truth - 1) if value and truth else math.nan
