"""The command behind ``scripts/study heavy``: what heavy loads and large grids cost."""

import argparse
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, fields

from ehlwave.errors import ResultsError
from studies import heavy_draw, heavy_refinement, heavy_schemes
from studies.command import costs
from studies.command.options import step_parser
from studies.programs import Groups, solve
from studies.sweeps import run_command, write_rows

BOOK: Groups = {
    "conditions": {"load_parameter_m": 20, "lubricant_parameter_l": 10, "radius_ratio_d": 1},
    "lubricant": {"viscosity_law": "barus", "density_law": "incompressible"},
    "grid": {"edges": "truncated", "x_min": -4.5, "x_max": 1.5, "y_max": 3},
}
"""The case of Venner and Lubrecht's book, with its domain."""

CONTACTS: dict[str, Groups] = {
    **{
        f"M = {m}, D = {d}": {
            "conditions": {
                "load_parameter_m": m,
                "lubricant_parameter_l": 12.05,
                "radius_ratio_d": d,
            }
        }
        for m, d in ((100, 1), (1000, 1), (1000, 0.07), (10000, 1))
    },
    "book": BOOK,
}
"""Contacts by their names."""

CELLS = 256, 512, 1024, 2048
"""Cells along X and Y."""

SHARE_WITHIN = 0.95
"""Of random contacts, that have to have the accuracy that they asked for."""

WAVES = {"orientation": "transverse", "wavelength_over_a": 0.5, "response": "harmonic"}


@dataclass(frozen=True)
class Row:
    """One run; the names are those of results."""

    contact: str
    cells_x: float
    method: str
    tolerance: float
    nonlinear_steps: float
    linear_steps: float
    counted_work_units: float
    harmonic_linear_steps: float
    harmonic_counted_work_units: float
    peak_memory_mib: float
    central_film: float
    central_film_error: float
    seconds: float


def cases(cells: Sequence[int], method: str, *, responds: bool) -> Iterator[tuple[str, Groups]]:
    """Yield name and input of each case."""
    for n in cells:
        for name, groups in CONTACTS.items():
            if name.startswith("M = 10000") and n < 1024:
                continue  # not resolved
            grid: Mapping[str, object] = groups.get("grid", {})
            case: Groups = {
                **groups,
                "grid": {**grid, "cells_x": n, "cells_y": n},
                "solver": {"method": method},
            }
            yield name, {**case, "waviness": WAVES} if responds else case


def measure(
    run: Callable[..., Mapping[str, object]], table: Iterator[tuple[str, Groups]]
) -> Iterator[Row]:
    """Run all cases."""
    names = [field.name for field in fields(Row)][1:]
    for contact, groups in table:
        result = run(**groups)
        yield Row(contact, *(result.get(name) for name in names))  # type: ignore[arg-type]


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, print and write the table; return 0, or 1 with a message."""
    return run_command(step_parser(costs.heavy, __doc__), _run, arguments)


def _run(options: argparse.Namespace) -> int | None:
    if options.draw:
        return _check_draw(options)
    if options.schemes:
        return _compare_schemes(options)
    if options.refinement:
        return _bound_refinement(options)
    rows = []
    cells = [n for n in CELLS if n <= options.largest]
    table = cases(cells, options.method, responds=options.responses)
    try:
        for row in measure(solve, table):
            rows.append(row)
            print(
                f"{row.contact:18} {row.cells_x:5.0f} {row.method:7} to {row.tolerance:.0e}: "
                f"{row.nonlinear_steps:3.0f} steps, {row.linear_steps:4.0f} linear ones, "
                f"{row.counted_work_units:5.1f} work units, {row.peak_memory_mib:6.0f} MiB",
                flush=True,
            )
    except AssertionError as error:
        raise ResultsError(str(error).strip()[-500:]) from error
    write_rows(options.output / "heavy.csv", map(asdict, rows), digits=9)
    print(options.output / "heavy.csv")
    return 0


def _compare_schemes(options: argparse.Namespace) -> int:
    points = []
    for point in heavy_schemes.measure(largest=options.largest):
        points.append(point)
        print(
            f"M = {point.load_parameter_m:5}, D = {point.radius_ratio_d}, lambda = "
            f"{point.wavelength_over_a} a, {point.scheme:8}, {point.cells_x:4} cells: "
            f"{point.status}, error {point.error:.5f}, {point.work:.1f} convolutions",
            flush=True,
        )
    write_rows(options.output / "schemes.csv", map(asdict, points), digits=5)
    rows = heavy_schemes.table(points)
    write_rows(options.output / "work.csv", rows, digits=4)
    for row in rows:
        print(", ".join(f"{name} {value:.4g}" for name, value in row.items()))
    return 0


def _bound_refinement(options: argparse.Namespace) -> int:
    bounds = []
    for bound in heavy_refinement.measure():
        bounds.append(asdict(bound))
        print(", ".join(f"{name} {value:.4g}" for name, value in bounds[-1].items()), flush=True)
    write_rows(options.output / "refinement.csv", bounds, digits=4)
    return 0


def _check_draw(options: argparse.Namespace) -> int:
    rows = []
    for row in heavy_draw.check(range(options.draw)):
        rows.append(row)
        print(
            f"{row.number:3} M = {row.load_parameter_m:5.0f}, L = {row.lubricant_parameter_l:5.2f},"
            f" D = {row.radius_ratio_d:5.3f}, lambda = {row.wavelength_over_a:5.3f} a:"
            f" {row.status}, {row.scheme}, {row.cells_x} x {row.cells_y},"
            f" said {row.error_estimate:.4f}, film {row.film_error:.4f},"
            f" Ad/Ai {row.ratio_error:.4f}, {row.seconds:.1f} s",
            flush=True,
        )
    write_rows(options.output / "draw.csv", map(asdict, rows), digits=6)
    print(heavy_draw.summary(rows))
    return int(sum(row.is_within for row in rows) < SHARE_WITHIN * len(rows))


if __name__ == "__main__":
    sys.exit(main())
