"""The command behind ``scripts/study periodic``: periodic states against long marches from rest."""

import argparse
import itertools
import math
import sys
from collections.abc import Iterator, Sequence
from typing import Any

from ehlwave.errors import ResultsError
from studies.command import checks
from studies.command.options import step_parser
from studies.programs import Groups, solve
from studies.sweeps import run_command, write_rows

LARGEST_DEVIATION = 1e-3
"""Of Ad/Ai."""
LARGEST_MEAN_DEVIATION = 0.02
"""Of the rise of the mean film, relative."""
SETTLING_LENGTH = 3
"""Of waves that pass before a march has settled, over a: half of it leaves 8 % of a small rise."""
MARCH_TOLERANCE = 1e-5
"""Of its time steps: the usual one leaves up to 2 % of a small rise."""

# Of each of the 24: M, D and Ai over the film in turn.
CONTACTS = ((100, 1), (50, 0.35), (200, 0.12), (1000, 0.35), (100, 0.04), (500, 1))
AMPLITUDES = (0.2, 0.05, 0.4, 0.1, 0.3)
WAVES = (("transverse", 0.5), ("isotropic", 1.0), ("transverse", 1.0), ("oblique", 1.0))
SLIPS = (1.0, 0.5, 1.5)
EYRING = {"flow_law": "eyring", "eyring_stress_pa": 5e6}

_FORM = "{:>5} {:>5} {:10} {:>5} {:>5} {:>4} {:10} {:>9} {:>9} {:>8} {:>7} {:>7} {:6} {}"


def cases(cells: int) -> Iterator[tuple[dict[str, Any], Groups]]:
    """Yield what each of 24 cases is, and its input without ``response``."""
    turns = itertools.product(WAVES, SLIPS, ("newtonian", "eyring"))
    for k, ((orientation, wave), slip, law) in enumerate(turns):
        m, d = CONTACTS[k % len(CONTACTS)]
        amplitude = AMPLITUDES[k % len(AMPLITUDES)]
        waviness: dict[str, object] = {"orientation": orientation, "wavelength_over_a": wave}
        if orientation == "oblique":
            waviness = {
                "orientation": "custom",
                "wavelength_x_over_a": wave,
                "wavelength_y_over_a": wave,
                "oblique": True,
            }
        contact = {"load_parameter_m": m, "lubricant_parameter_l": 12.05, "radius_ratio_d": d}
        yield (
            {"m": m, "d": d, "waves": orientation, "wave": wave, "ai": amplitude, "s": slip}
            | {"law": law},
            {
                "conditions": contact | {"slip_parameter": slip, "reduced_modulus_pa": 226e9},
                "lubricant": EYRING if law == "eyring" else {},
                "grid": {"cells_x": cells, "cells_y": cells},
                "waviness": waviness | {"amplitude_over_film": amplitude},
                "solver": {
                    "error_estimate": "model",
                    "settling_periods": math.ceil(SETTLING_LENGTH / wave),
                },
            },
        )


def compare(case: dict[str, Any], groups: Groups) -> dict[str, Any]:
    """Run a case both ways; return what both came to."""
    answers = [
        solve(
            **groups
            | {"waviness": groups["waviness"] | {"response": response}}
            | {"solver": groups["solver"] | steps}
        )
        for response, steps in (
            ("transient", {"step_tolerance": MARCH_TOLERANCE}),
            ("periodic", {}),
        )
    ]
    march, state = answers
    rises = [a["mean_film"] - a["central_film"] for a in answers]
    return case | {
        "march_ratio": march["amplitude_ratio_fit"],
        "ratio": state["amplitude_ratio_fit"],
        "rise_deviation": abs(rises[1] / rises[0] - 1),
        "march_work": march["counted_work_units"],
        "work": state["counted_work_units"],
        "from": state["march_from"],
    }


def is_good(row: dict[str, Any]) -> bool:
    """Return whether both agree; a march in place of the periodic state is no failure."""
    return (
        abs(row["ratio"] - row["march_ratio"]) <= LARGEST_DEVIATION
        and row["rise_deviation"] <= LARGEST_MEAN_DEVIATION
    )


def line(row: dict[str, Any]) -> str:
    """Return one line of the table."""
    return _FORM.format(
        *(row[name] for name in ("m", "d", "waves", "wave", "ai", "s", "law")),
        f"{row['march_ratio']:.5f}",
        f"{row['ratio']:.5f}",
        f"{100 * row['rise_deviation']:.2f} %",
        f"{row['march_work']:.0f}",
        f"{row['work']:.0f}",
        row["from"],
        "" if is_good(row) else "BAD",
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Print and write the table; return 0 if every case is good, else 1."""
    parser = step_parser(checks.periodic, __doc__)
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> int:
    print(
        _FORM.format(
            *("M", "D", "waves", "over a", "Ai/H", "S", "oil"),
            *("march", "periodic", "rise", "WU", "WU", "from", ""),
        )
    )
    rows = []
    bad = 0
    for case, groups in itertools.islice(cases(options.cells), options.first):
        try:
            rows.append(compare(case, groups))
        except AssertionError as error:
            bad += 1
            print(" ".join(map(str, case.values())), "FAILED", str(error).strip()[-200:])
            continue
        bad += not is_good(rows[-1])
        print(line(rows[-1]), flush=True)
    if not rows:
        raise ResultsError("no case has converged")
    write_rows(options.output / "periodic.csv", rows, digits=6)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
