"""The commands behind ``scripts/study error-vs-time``: write the sweep, then tables and figures."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from ehlwave.writing import Writer
from studies.command import costs
from studies.command.options import step_parser
from studies.error_time import errors, figures, model
from studies.error_time.runs import FULL, QUICK
from studies.error_time.table import read_table, write_cases
from studies.sweeps import run_command


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the sweep, or tables and figures; return 0, or 1 with a message."""
    parser = step_parser(costs.error_vs_time, __doc__)
    parser.add_argument("step", choices=("cases", "report"))
    parser.add_argument("folder", type=Path, help="of all files; made when absent")
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> None:
    extent = QUICK if options.quick else FULL
    if options.step == "cases":
        print(write_cases(options.folder, extent))
    else:
        table = read_table(options.folder, extent)
        print("\n".join(str(path) for path in write_all(table, options.folder)))


def write_all(table: pd.DataFrame, folder: Path) -> list[Path]:
    """Write runs, errors, orders, estimates, models and figures of a table; return the paths."""
    found = errors.error_rows(table)
    tables = {
        "runs": table,
        "errors": found,
        "orders": errors.order_rows(table),
        "estimates": errors.estimate_rows(table),
        "models": model.fit_models(table),
    }
    paths, writer = [], Writer()
    for name, rows in tables.items():
        if len(rows):
            paths.append(folder / f"{name}.csv")
            digits = None if name == "runs" else "%.6g"
            options = {"float_format": digits, "na_rep": "nan", "lineterminator": "\n"}
            writer.table(paths[-1], rows, **options)
    drawn = {"tolerance": figures.tolerance_figure(found)}
    for cost in figures.COSTS:
        for name, panels in figures.all_panels().items():
            drawn[f"{name}-{cost.replace('_', '-')}"] = figures.error_figure(found, cost, panels)
    drawn["summary"] = figures.error_figure(found, "work", figures.short_panels())
    for name, figure in drawn.items():
        paths.append(folder / f"{name}.png")
        writer.figure(paths[-1], figure, dpi=150)
    return paths


if __name__ == "__main__":
    sys.exit(main())
