"""The command behind ``scripts/study speed``: the solvers' seconds and work units."""

import argparse
import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass

from ehlwave.errors import ResultsError
from studies.command import costs
from studies.command.options import step_parser
from studies.programs import Groups, solve
from studies.sweeps import run_command, write_rows
from studies.work_unit import convolutions

CONTACT = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
WAVES = {"orientation": "transverse", "wavelength_over_a": 0.5}

Answer = dict[str, float | str | None]


@dataclass(frozen=True)
class Row:
    """A line of the table."""

    work: str
    method: str
    unit: str
    figure: float
    at_most: float
    aim: float
    counted: float = float("nan")
    algebraic_error: float = float("nan")
    discretisation_error: float = float("nan")


METHODS: dict[str, dict[str, str]] = {"newton": {}, "fas": {"cycle": "v"}}
"""Methods that are compared, with the keys of ``&solver`` for a march."""

COARSE, FINE = 256, 1024
"""Cells along X and Y."""

UNITS = "work_units", "counted_work_units"
"""A plain convolution of the case's grid: timed beside the case, and its operations."""


def case_groups(
    cells: int, method: str, waves: Mapping[str, object] | None = None, **solver: object
) -> Groups:
    """Return an input of ``ehlwave-case``; further keys belong to ``&solver``."""
    usual = {"method": method, "deformation": "fft", "error_estimate": "model"}
    return {
        "conditions": CONTACT,
        **({"waviness": waves} if waves else {}),
        "grid": {"cells_x": cells, "cells_y": cells},
        "solver": {**usual, **solver},
    }


def solved(groups: Groups) -> Answer:
    """Run a case; raise ResultsError unless it converged."""
    try:
        return solve(**groups)
    except AssertionError as error:
        raise ResultsError(str(error).strip()[-500:]) from error


def number(answer: Answer, name: str) -> float:
    """Return a number of an answer, NaN where it has none."""
    value = answer.get(name)
    return float("nan") if value is None else float(value)


def measure(run: Callable[[Groups], Answer], repeats: int) -> list[Row]:
    """Run everything by `run`, each case `repeats` times, and take the fastest."""

    def fastest(groups: Groups) -> Answer:
        return min((run(groups) for _ in range(repeats)), key=lambda a: number(a, "seconds"))

    rows = []
    fine_states: dict[str, Answer] = {}
    film, ratio = "central_film", "amplitude_ratio_fit"
    for name, march_keys in METHODS.items():
        steady, fine = both_grids(fastest, name)
        fine_states[name] = fine
        exact = run(case_groups(COARSE, name, tolerance=1e-10))
        march = fastest(case_groups(COARSE, name, WAVES, **march_keys))
        tight = run(case_groups(COARSE, name, WAVES, step_tolerance=1e-6))
        work = [number(steady, unit) for unit in UNITS]
        of_steps = [number(march, unit) - before for unit, before in zip(UNITS, work, strict=True)]
        of_step = [of_all / number(march, "time_steps") for of_all in of_steps]
        film_errors = apart(steady, exact, film), number(steady, "central_film_error")
        ratio_errors = apart(march, tight, ratio), number(march, "amplitude_ratio_error")
        step = "one time step, 257 x 257"
        rows += [
            Row("steady state, 257 x 257", name, "WU", work[0], 90, 60, work[1], *film_errors),
            Row(step, name, "WU", of_step[0], 22, 15, of_step[1], *ratio_errors),
            Row("whole transient", name, "s", number(march, "seconds"), 20, 6),
            growth(name, steady, fine),
            *own_rows(name, steady, fine, march),
            Row("memory, 1025 x 1025", name, "MiB", number(fine, "peak_memory_mib"), 2048, 1024),
        ]
        if name == "newton":
            response = fastest(case_groups(COARSE, name, {**WAVES, "response": "harmonic"}))
            timed = number(response, "harmonic_work_units")
            counted = number(response, "harmonic_counted_work_units")
            rows.append(Row("linear response, 257 x 257", name, "WU", timed, 60, 40, counted))
            state = fastest(case_groups(COARSE, name, {**WAVES, "response": "periodic"}))
            work = [number(state, unit) for unit in UNITS]
            errors = apart(state, tight, ratio), ratio_errors[1]
            rows.append(Row("periodic state", name, "WU", work[0], 2500, 1000, work[1], *errors))
    steady, fine = both_grids(fastest, "auto")
    left = apart(fine, fine_states["fas"], film)
    return [*rows, growth("auto", steady, fine, left, number(fine, "central_film_error"))]


def own_rows(method: str, steady: Answer, fine: Answer, march: Answer) -> list[Row]:
    """Return the counted work in deformations of the program itself."""
    own, own_fine, own_march = (number(answer, "own_units") for answer in (steady, fine, march))
    of_step = (own_march - own) / number(march, "time_steps")
    return [
        Row("steady state, 257 x 257", method, "own units", own, 478, 250, own),
        Row("steady state, 1025 x 1025", method, "own units", own_fine, 200, 120, own_fine),
        Row("one time step, 257 x 257", method, "own units", of_step, 90, 45, of_step),
    ]


def both_grids(run: Callable[[Groups], Answer], method: str) -> tuple[Answer, Answer]:
    """Return the steady states of the coarse and the fine grid."""
    coarse, fine = (run(case_groups(cells, method)) for cells in (COARSE, FINE))
    return coarse, fine


def apart(one: Answer, other: Answer, name: str) -> float:
    """Return the relative difference of a number between two answers."""
    return abs(number(one, name) / number(other, name) - 1)


def growth(method: str, coarse: Answer, fine: Answer, *errors: float) -> Row:
    """Return the relative time of the fine grid; errors as in `Row`."""
    of_units = float(convolutions(FINE) / convolutions(COARSE))
    counted = number(fine, UNITS[1]) / number(coarse, UNITS[1]) * of_units
    timed = number(fine, "seconds") / number(coarse, "seconds")
    over = "steady state, 1025 x 1025 over 257 x 257"
    return Row(over, method, "times", timed, 18, 16, counted, *errors)


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, print and write the table; return 0, or 1 with a message."""
    parser = step_parser(costs.speed, __doc__)
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> None:
    rows = measure(solved, options.repeats)
    path = options.output / "speed.csv"
    write_rows(path, map(asdict, rows), digits=4)
    for row in rows:
        errors = ""
        if math.isfinite(row.counted):
            errors = f", counted {row.counted:.3g}"
        if math.isfinite(row.algebraic_error):
            errors += (
                f", algebraic error {row.algebraic_error:.1e} of {row.discretisation_error:.1e}"
            )
        print(
            f"{row.work:42} {row.method:7} {row.figure:8.3g} {row.unit} "
            f"(at most {row.at_most:g}, aim {row.aim:g}){errors}"
        )
    print(path)


if __name__ == "__main__":
    sys.exit(main())
