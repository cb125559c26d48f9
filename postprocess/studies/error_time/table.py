"""The table of runs: a sweep of them, and its results."""

import sys
from pathlib import Path

import pandas as pd

from ehlwave.errors import ResultsError
from studies import programs, sweeps
from studies.error_time.runs import METHODS, WAVY, Extent, Run, all_runs

NAME = "cases"
"""Name of the sweep's files."""

KEYS = {
    "m": "load_parameter_m",
    "d": "radius_ratio_d",
    "wavelength": "wavelength_over_a",
    "orientation": "orientation",
    "lubricant_l": "lubricant_parameter_l",
    "slip": "slip_parameter",
    "law": "flow_law",
    "cells": "cells_x",
    "method": "method",
    "deformation": "deformation",
    "tolerance": "tolerance",
    "step_tolerance": "step_tolerance",
    "time_step_over_cell": "time_step_over_cell",
}
"""The fields of a run, by which rows of the table are known, as keys of the sweep."""

SHARED = {"grid": {"edges": "flooded"}, "solver": {"error_estimate": "model"}}
"""Keys of all runs."""

SLIDING = {"reduced_modulus_pa": 2.28e11, "eyring_stress_pa": 5e6}
"""Keys of the runs with a Ree-Eyring oil."""

OUTCOMES = (
    "status",
    "is_resolved",
    "central_film",
    "minimum_film",
    "amplitude_ratio_fit",
    "amplitude_ratio",
    "formula_ratio",
    "central_film_error",
    "minimum_film_error",
    "inlet_resolution",
    "points_per_wave_x",
    "points_per_wave_y",
    "kappa",
    "gamma",
    "time_steps",
    "nonlinear_steps",
    "linear_steps",
    "seconds",
    "counted_work_units",
)
"""Taken from the results of a run."""


def available_methods() -> tuple[str, ...]:
    """Return the methods of the build; report missing methods on standard error."""
    taken = []
    for method in METHODS:
        outcome = _plan(Run(*WAVY[0], 32, method=method))
        if outcome.returncode == 0:
            taken.append(method)
        else:
            said = outcome.stderr.strip() or "(no output)"
            print(f"error-vs-time: method '{method}' is left out: {said}", file=sys.stderr)
    return tuple(taken)


def write_cases(folder: Path, extent: Extent) -> Path:
    """Write the sweep of the runs whose methods the build takes; return the path of its file.

    Raises ResultsError if the program cannot be run.
    """
    try:
        runs = all_runs(extent, available_methods())
    except OSError as error:
        raise ResultsError(f"{error.filename}: {error.strerror}; build it first") from error
    rows = [
        {
            **{key: getattr(run, name) for name, key in KEYS.items()},
            "wavelength_over_a": run.wavelength or "",
            "cells_y": run.cells,
            **(SLIDING if run.law == "eyring" else dict.fromkeys(SLIDING, "")),
        }
        for run in runs
    ]
    return sweeps.write_sweep(folder, NAME, rows, SHARED)


def read_table(folder: Path, extent: Extent) -> pd.DataFrame:
    """Return the runs that are finished, with their outcome.

    Raises
    ------
    ResultsError
        If the sweep has not been run, or none of its cases is finished.
    """
    methods = pd.read_csv(folder / f"{NAME}.csv")["method"].unique()
    runs = pd.DataFrame(all_runs(extent, tuple(methods)))
    outcomes = pd.DataFrame(sweeps.read_sweep(folder, NAME, len(runs)))[list(OUTCOMES)]
    table = pd.concat([runs[list(KEYS)], outcomes], axis=1)
    finished = table[table["status"] != "pending"]
    if finished.empty:
        raise ResultsError(f"{folder}: no run is finished yet; start again to go on")
    if left := len(table) - len(finished):
        print(f"error-vs-time: {left} runs are left; start again to go on", file=sys.stderr)
    return finished


def _plan(run: Run) -> programs.Outcome:
    groups = {
        "conditions": {KEYS[name]: getattr(run, name) for name in ("m", "d", "lubricant_l")},
        "solver": {"method": run.method},
    }
    return programs.run_case(groups, "--plan")
