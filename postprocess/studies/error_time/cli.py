"""The command behind ``scripts/error-vs-time``."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from ehlwave_post.errors import ResultsError
from studies.error_time import errors, figures, model
from studies.error_time.runs import FULL, QUICK
from studies.error_time.table import run_table, write_rows


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the table, write tables and figures; return 0, or 1 with a message."""
    parser = argparse.ArgumentParser(prog="error-vs-time", description=__doc__)
    parser.add_argument("--program", type=Path, required=True, help="ehlwave-case")
    parser.add_argument("--output", type=Path, required=True, help="folder; made when absent")
    parser.add_argument("--quick", action="store_true", help="small grids, minutes")
    parser.add_argument("--minutes", type=float, default=45.0, help="start no run after these")
    options = parser.parse_args(arguments)
    try:
        options.output.mkdir(parents=True, exist_ok=True)
        extent = QUICK if options.quick else FULL
        table = run_table(
            options.program.resolve(), options.output / "runs.csv", extent, options.minutes
        )
        print("\n".join(str(path) for path in write_all(table, options.output)))
    except (ResultsError, OSError) as error:
        print(f"error-vs-time: error: {error}", file=sys.stderr)
        return 1
    return 0


def write_all(table: Sequence[errors.Row], folder: Path) -> list[Path]:
    """Write errors, orders, estimates, models and figures of a table; return the paths."""
    found = errors.error_rows(table)
    tables = {
        "errors": found,
        "orders": errors.order_rows(table),
        "estimates": errors.estimate_rows(table),
        "models": [fit.row() for fit in model.fit_models(table)],
    }
    paths = []
    for name, rows in tables.items():
        if rows:
            paths.append(folder / f"{name}.csv")
            write_rows(paths[-1], rows)
    drawn = {"tolerance": figures.tolerance_figure(found)}
    for cost in figures.COSTS:
        for name, panels in figures.all_panels().items():
            drawn[f"{name}-{cost.replace('_', '-')}"] = figures.error_figure(found, cost, panels)
    drawn["summary"] = figures.error_figure(found, "seconds", figures.short_panels())
    for name, figure in drawn.items():
        paths.append(folder / f"{name}.png")
        figure.savefig(paths[-1], dpi=150)
    return paths


if __name__ == "__main__":
    sys.exit(main())
