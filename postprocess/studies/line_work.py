"""The command behind ``scripts/study line-work``: work of steady states of line contacts."""

import argparse
import sys
from collections.abc import Sequence
from itertools import product

from studies.command import costs
from studies.command.options import step_parser
from studies.programs import Groups, last_line, run_case
from studies.sweeps import Row, run_command, write_rows

LAWS = {
    "roelands": {},
    "barus": {},
    "mcewen": {"mcewen_coefficient_per_pa": 2.2e-8, "mcewen_exponent": 8.0},
}
"""Laws of viscosity with their keys."""

GRIDS = ((-2.5, 1.5, 256), (-2.5, 1.5, 1024), (-20.0, 4.5, 1024), (-20.0, 4.5, 4096))
"""Domains along X, and their cells."""

LIGHT = (0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0, 14.0, 20.0)
CONTACTS = (
    *product(LIGHT, (5.0, 8.0, 12.0, 18.0, 25.0), LAWS),
    *product(LIGHT, (0.0, 2.0), ("roelands",)),
    *product((50.0, 100.0, 200.0, 1000.0), (0.0, 2.0, 12.0, 25.0), ("roelands", "barus")),
)
"""M, L and the law of viscosity."""

PLANNED = "planned_work_units"
"""Column that the written table leaves out, since its fit sets the values."""

STEPS = 3000
"""Largest number of Newton steps, which replaces the cap of ten times the planned work."""


def rows_of(contacts: Sequence[tuple[float, float, str]]) -> list[Row]:
    """Return status, counted work and the plan's of each contact on each grid."""
    return [_row(*contact, *grid) for contact, grid in product(contacts, GRIDS)]


def _row(m: float, lubricant_l: float, law: str, x_min: float, x_max: float, cells: int) -> Row:
    groups: Groups = {
        "conditions": {
            "load_parameter_m": m,
            "lubricant_parameter_l": lubricant_l,
            "radius_ratio_d": 0.0,
        },
        "lubricant": {"viscosity_law": law, **LAWS[law]},
        "grid": {"edges": "flooded", "x_min": x_min, "x_max": x_max, "cells_x": cells},
        "solver": {"largest_total_steps": STEPS},
    }
    found = last_line(run_case(groups, "--json", "--quiet"))
    return {
        "load_parameter_m": m,
        "lubricant_parameter_l": lubricant_l,
        "viscosity_law": law,
        "x_min": x_min,
        "cells_x": cells,
        "status": found["status"],
        "work_units": found["total_work_units"],
        PLANNED: found["expected_work_units"],
    }


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the table; return 0, or 1 with a message."""
    parser = step_parser(costs.line_work, __doc__)
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> None:
    rows = rows_of(CONTACTS)
    shares = [row["work_units"] / row.pop(PLANNED) for row in rows]
    good = [share for share, row in zip(shares, rows, strict=True) if row["status"] == "converged"]
    inside = sum(0.5 < share < 2 for share in good)
    print(f"{inside} of {len(good)} converged states take the planned work within a factor of 2")
    path = options.output / "line-work.csv"
    write_rows(path, rows, digits=4)
    print(path)


if __name__ == "__main__":
    sys.exit(main())
