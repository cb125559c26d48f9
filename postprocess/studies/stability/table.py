"""The table of the stability map, and its summary."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from studies import sweeps
from studies.stability.cases import STARVED
from studies.stability.outcome import CONVERGED, FAILED, OUTCOMES, UNRESOLVED, Row

_INPUTS = {
    "load_parameter_m": "",
    "lubricant_parameter_l": "",
    "radius_ratio_d": "",
    "slip_parameter": 1.0,
    "viscosity_law": "roelands",
    "density_law": "dowson_higginson",
    "eyring_stress_pa": 0.0,
    "method": "newton",
    "orientation": "none",
    "wavelength_over_a": 0.0,
    "amplitude_over_film": 0.0,
    "time_step_over_cell": 1.0,
    "load_balance": "force_balance",
    "load_factor": 1.0,
    "end_time": 0.0,
    "oil_over_flooded": "",
}
_RESULTS = (
    "cells_x",
    "cells_y",
    "status",
    "rung",
    "rescued_solutions",
    "time_steps",
    "nonlinear_steps",
    "linear_steps",
    "work_units",
    "residual",
    "load_error",
    "inlet_resolution",
    "inlet_gap_over_film",
    "central_film_moes",
    "amplitude_ratio_fit",
    "harmonic_ratio",
)
_STARVED = ("film_over_flooded", "meniscus_x", "starved_over_flooded_work")
"""Columns of starved contacts."""


def write_table(path: Path, rows: Sequence[Row]) -> None:
    """Write a line per case: inputs, outcome, effort and faults.

    Default inputs are left empty, and so are messages of converged cases; other messages are cut
    before the advice.
    """
    lines = (
        {
            "family": row.case.family,
            "variant": row.case.variant,
            **{key: _unusual(row.case.value(key, usual), usual) for key, usual in _INPUTS.items()},
            "outcome": row.outcome,
            **{name: row.result.get(name, "") for name in _RESULTS},
            **{name: row.result[name] for name in _STARVED if row.case.family.startswith(STARVED)},
            "seconds": row.seconds,
            "message": "" if row.outcome in (CONVERGED, UNRESOLVED) else row.message.split(": ")[0],
            "faults": "; ".join(row.faults),
        }
        for row in rows
    )
    sweeps.write_rows(path, lines, digits=6)


def _unusual(value: float | str, usual: float | str) -> float | str:
    return "" if value == usual else value


def summary(rows: Sequence[Row]) -> str:
    """Return counts by family and outcome, the rungs used, and every bad case."""
    families = list(dict.fromkeys(row.case.family for row in rows))
    lines = [f"{'family':<12}" + "".join(f"{name:>27}" for name in OUTCOMES)]
    for family in (*families, "all"):
        members = [row for row in rows if family in (row.case.family, "all")]
        counts = Counter(row.outcome for row in members)
        lines.append(f"{family:<12}" + "".join(f"{counts[name]:>27}" for name in OUTCOMES))
    resolved = [row for row in rows if row.outcome in (CONVERGED, FAILED)]
    good = sum(row.outcome == CONVERGED for row in resolved)
    rungs = Counter(row.result.get("rung") for row in resolved if row.outcome == CONVERGED)
    lines += [
        "",
        f"{good} of {len(resolved)} resolved cases converged; highest rung used: "
        + ", ".join(f"{name} {count}" for name, count in rungs.most_common()),
        f"{sum(bool(row.faults) for row in rows)} results that claim what they should not",
    ]
    lines += [bad_line(row) for row in rows if row.is_bad]
    return "\n".join(lines)


def bad_line(row: Row) -> str:
    """Return the case and its faults."""
    case = row.case
    keys = ("load_parameter_m", "lubricant_parameter_l", "radius_ratio_d")
    m, l, d = (case.value(key) for key in keys)
    why = "; ".join([row.message, *row.faults]).strip("; ")
    return f"BAD {case.family}, {case.variant}, M = {m:g}, L = {l:g}, D = {d:g}: {why}"
