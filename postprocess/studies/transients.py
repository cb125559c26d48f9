"""Marches of waves under slip against their linear response and the mean film of second order.

``python -m studies.transients RESULTS`` is what ``scripts/study transients`` ends with.
"""

import argparse
import cmath
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ehlwave.errors import ResultsError
from ehlwave.results.read import read_results
from studies.command import checks
from studies.command.options import step_parser
from studies.sweeps import run_command

SMALL = 0.01
"""Largest Ai over the film whose march is held to the linear response."""
LARGEST_DEVIATION = 0.003
"""Of the complex film at the centre, over Ai."""
LARGEST_MEAN_DEVIATION = 0.1
"""Of the rise of the mean film, relative."""

_FORM = "{:>5} {:10} {:12} {:>6} {:>6}  {:>9} {:>10}  {}"


def deviation(row: Mapping[str, Any]) -> float:
    """Return |film of the march - linear response|/Ai at the contact centre, both complex."""
    march = cmath.rect(row["amplitude_ratio_fit"], row["phase_fit"])
    return abs(march - complex(row["harmonic_real"], row["harmonic_imaginary"]))


def mean_deviation(row: Mapping[str, Any]) -> float:
    """Return how far the rise of second order is from that of the march, relative to the latter."""
    amplitude = row["amplitude_over_film"] * row["central_film"]
    rise = (row["mean_film"] - row["central_film"]) / amplitude
    return abs(row["mean_film_rise"] / rise - 1)


def is_good(row: Mapping[str, Any]) -> bool:
    """Return whether a case converged and holds what is asked of waves of its amplitude."""
    if row["status"] != "converged":
        return False
    if row["amplitude_over_film"] > SMALL:
        return mean_deviation(row) <= LARGEST_MEAN_DEVIATION
    return deviation(row) <= LARGEST_DEVIATION


def line(row: Mapping[str, Any]) -> str:
    """Return one line of the table."""
    wave = row["wavelength_x_over_a"]
    is_small = row["amplitude_over_film"] <= SMALL
    return _FORM.format(
        f"{row['slip_parameter']:g}",
        row["flow_law"],
        "oblique" if row["orientation"] == "custom" else row["orientation"],
        f"{wave:g}",
        f"{row['amplitude_over_film']:g}",
        f"{100 * deviation(row):.3f} %",
        "" if is_small else f"{100 * mean_deviation(row):.1f} %",
        "" if is_good(row) else "BAD " + row["status"],
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; return 0 if every case is good, else 1."""
    parser = step_parser(checks.transients, __doc__)
    parser.add_argument("results", type=Path, metavar="RESULTS", help="HDF5 file of the sweep")
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> int:
    results = read_results([options.results])
    missing = {"harmonic_real", "flow_law", "amplitude_over_film"} - set(results)
    if missing:
        raise ResultsError(f"{options.results}: no {', '.join(sorted(missing))}: another sweep's")
    rows = results.to_dataframe().to_dict("records")
    print(_FORM.format("S", "oil", "waves", "over a", "Ai/Hc", "film", "mean rise", ""))
    print("\n".join(line(row) for row in rows))
    bad = sum(not is_good(row) for row in rows)
    print(
        f"{len(rows) - bad} of {len(rows)} cases hold: film within {100 * LARGEST_DEVIATION:g} % of"
        f" Ai up to Ai = {100 * SMALL:g} % of the film, else mean rise within "
        f"{100 * LARGEST_MEAN_DEVIATION:g} %"
    )
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
