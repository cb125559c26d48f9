"""The command behind ``scripts/study thinning``: what thinning in the inlet takes of the film."""

import argparse
import math
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq

from ehlwave.contact import conditions_from_keys
from ehlwave.contact.conditions import Conditions
from ehlwave.contact.thinning import LEAST_EXPONENT, MOST_LOSS, loss_bound
from studies.command import laws
from studies.command.options import step_parser
from studies.programs import Groups, last_line, run_case
from studies.sweeps import run_command, write_rows

LOADS, LINE_LOADS, LUBRICANTS = (20.0, 1000.0), (5.0, 100.0), (2.5, 20.0)
NARROWEST, MOST_SLIP = 0.1, 2.0
LEAST_BOUND = 0.01
"""Losses below are not told from errors of the grid."""
STRESSES = 1e4, 1e9
"""Pa, between which the stress of the oil is looked for."""
LINE_CELLS = 8
"""Cells of a line contact over those of a point contact."""

Keys = dict[str, float]
Run = Callable[[Groups], Mapping[str, Any]]


@dataclass(frozen=True)
class Row:
    """One contact: N and T of ``ehlwave.contact.thinning``, bound of the loss and computed loss."""

    number: int
    load_parameter_m: float
    lubricant_parameter_l: float
    radius_ratio_d: float
    slip_parameter: float
    flow_law: str
    by_pressure: float
    by_slip: float
    bound: float
    loss: float
    """NaN where the contact is not resolved on this grid."""

    @property
    def has_atlas(self) -> bool:
        """Whether the atlas has the film, so that nothing is answered by the bound."""
        return self.flow_law == "Ree-Eyring" and self.slip_parameter != 1


def bound_of(contact: Conditions) -> float:
    """Return the bound of the loss."""
    return loss_bound(contact.l, *contact.stresses_in_inlet)


def draw(number: int) -> Keys:
    """Return keys of a contact, of which a quarter are lines, half slide, half have a Carreau oil.

    The stress of the oil is that by which the bound is one that is drawn, too.
    """
    rng = np.random.default_rng([41, number])

    def between(low: float, high: float) -> float:
        return float(f"{low * (high / low) ** rng.random():.4g}")

    is_line = number // 4 % 4 == 3
    keys = {
        "load_parameter_m": between(*(LINE_LOADS if is_line else LOADS)),
        "lubricant_parameter_l": between(*LUBRICANTS),
        "radius_ratio_d": 0.0 if is_line else between(NARROWEST, 1.0),
        "slip_parameter": between(1.0, MOST_SLIP) if number % 2 else 1.0,
        "reduced_modulus_pa": 2.26e11,
        "pressure_viscosity_per_pa": between(1.2e-8, 2.4e-8),
        "roelands_index": between(0.45, 0.7),
    }
    stress = "eyring_stress_pa"
    if number % 4 >= 2:
        stress = "carreau_modulus_pa"
        keys["carreau_exponent"] = between(LEAST_EXPONENT, 0.9)
    bound = between(LEAST_BOUND, MOST_LOSS)

    def excess(log_stress: float) -> float:
        tried = {**keys, stress: float(np.exp(log_stress))}
        return bound_of(conditions_from_keys(tried, needs_lengths=False)) - bound

    found = float(np.exp(brentq(excess, *np.log(STRESSES))))
    return {**keys, stress: float(f"{found:.4g}")}


def input_of(keys: Keys, cells: int) -> tuple[Groups, Groups]:
    """Return the groups of a contact with its oil, and with a Newtonian one."""
    names = ("load_parameter_m", "lubricant_parameter_l", "radius_ratio_d", "slip_parameter")
    names = (*names, "reduced_modulus_pa")
    law = "carreau" if "carreau_exponent" in keys else "eyring"
    lubricant = {name: value for name, value in keys.items() if name not in names}
    plain = {name: lubricant[name] for name in ("pressure_viscosity_per_pa", "roelands_index")}
    is_line = keys["radius_ratio_d"] == 0
    grid = {"cells_x": LINE_CELLS * cells} if is_line else {"cells_x": cells, "cells_y": cells}
    groups = {
        "conditions": {name: keys[name] for name in names},
        "grid": {"edges": "flooded", **grid},
        "solver": {"threads": 1},
    }
    return {**groups, "lubricant": {**lubricant, "flow_law": law}}, {**groups, "lubricant": plain}


def solved(groups: Groups) -> Mapping[str, Any]:
    """Return the result of a case, whatever became of it."""
    result: Mapping[str, Any] = last_line(run_case(groups, "--json", "--quiet"))
    return result


def study(number: int, cells: int, run: Run = solved) -> Row:
    """Compute one contact with its oil and with a Newtonian one."""
    keys = draw(number)
    contact = conditions_from_keys(keys, needs_lengths=False)
    own, newtonian = map(run, input_of(keys, cells))
    is_known = own["status"] == newtonian["status"] == "converged"
    loss = 1 - own["central_film"] / newtonian["central_film"] if is_known else math.nan
    return Row(
        number,
        contact.m,
        contact.l,
        contact.d,
        contact.slip_parameter,
        contact.oil.name,
        *contact.stresses_in_inlet,
        bound_of(contact),
        loss,
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the contacts, print and write the table; return 1 if one loses more than the bound."""
    return run_command(step_parser(laws.thinning, __doc__), _run, arguments)


def _run(options: argparse.Namespace) -> int:
    rows = []
    for number in range(options.contacts):
        row = study(number, options.cells)
        rows.append(row)
        print(
            f"{row.number:3} M = {row.load_parameter_m:6.1f}, L = {row.lubricant_parameter_l:5.2f},"
            f" D = {row.radius_ratio_d:5.3f}, S = {row.slip_parameter:5.3f}, {row.flow_law:10},"
            f" N = {row.by_pressure:5.2f}, T = {row.by_slip:6.2f}, bound {row.bound:.4f}, loss"
            f" {row.loss:.4f}, share {row.loss / row.bound:.2f}",
            flush=True,
        )
    write_rows(options.output / "thinning.csv", map(asdict, rows), digits=4)
    solved_rows = [row for row in rows if math.isfinite(row.loss)]
    print(f"{len(solved_rows)} of {len(rows)} resolved; largest loss over the bound:")
    most = largest_share(row for row in solved_rows if not row.has_atlas)
    others = largest_share(row for row in solved_rows if row.has_atlas)
    print(f"in pure rolling, and of Carreau oils {most:.2f}; of Ree-Eyring oils that slide, whose")
    print(f"film the atlas has, {others:.2f}")
    print(options.output / "thinning.csv")
    return int(most > 1)


def largest_share(rows: Iterable[Row]) -> float:
    """Return the largest loss over its bound, 0 of no contacts."""
    return max((row.loss / row.bound for row in rows), default=0.0)


if __name__ == "__main__":
    sys.exit(main())
