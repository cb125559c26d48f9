"""Studies of where the program works, where linear ends, and what stress and heat do."""

import argparse

from studies.command import steps
from studies.command.options import Option, at_once, flag, given, option, output, study


def _only(name: str, about: str) -> Option:
    return flag(f"--{name}", about, dest="cases", const=name)


@study(
    "stability",
    _only("quick", "fewer cases on coarser grids: minutes"),
    _only("steady", "only the smooth steady states"),
    _only("wavy", "all but the smooth steady states"),
    _only("corner", "only the stiff corner of the paper, M = 2000, on 512 x 512 cells"),
    _only("sliding", "only a Ree-Eyring oil, S 0 to 2, tau0 0.5 to 50 MPa, and its responses"),
    _only("starved", "only contacts with 0.3 to 3 times the oil that they pass flooded"),
    output("stability"),
    at_once("--at-once", "cases that run at the same time; default: the cores you may use"),
    option("--limit", "SECONDS", "a case that takes longer counts as failed; default 900", 900),
)
def stability(options: argparse.Namespace) -> int:
    """Map where the solver works.

    Builds, runs steady and short wavy cases from mild to extreme as a sweep, and writes a table and
    two maps of what became of them: converged, converged but unresolved, refused, failed.

    Exit status: 0 all resolved cases converged and no result claims what it should not; 85 stopped,
    to be continued; 1 otherwise.
    """
    folder, cases = options.output, ("--cases", options.cases or "full")
    steps.call(steps.SCRIPTS / "install-requirements")
    steps.prepare()
    steps.python("stability", "cases", folder, *cases, "--limit", options.limit)
    steps.sweep(folder / "cases.nml")
    status = steps.report("stability", "report", folder, *cases)
    if status == 0:
        print(f"In {folder}: table stability.csv, summary.txt, maps steady.png and parameters.png")
    return status


@study(
    "linearity",
    flag("--slip", "surfaces that slide, both oils, for pure rolling: src/case/linear_range"),
    output("linearity", "results that are there are replaced"),
    at_once(),
)
def linearity(options: argparse.Namespace) -> int:
    """Find where linear ends: marches against linear responses, Ai 1 to 90 % of Hc.

    Writes linearity.h5, linearity.csv, linearity.png and .pdf, and linearity.txt with the largest
    deviations.
    """
    name = "linearity_slip" if options.slip else "linearity"
    results = options.output / f"{name}.h5"
    status = steps.sweep_anew(f"inputs/{name}.nml", results)
    words = (results, "--output", options.output)
    return max(status, steps.report("linearity", *words, kept=results.with_suffix(".txt")))


@study("stress", output("stress"))
def stress(options: argparse.Namespace) -> int:
    """Compare stresses below rough surfaces: dry, lubricated and smooth.

    Writes waves.csv, roughness.csv and their figures; nothing is simulated: a minute on one core.
    """
    steps.find_python()
    return steps.report("stress", "--output", options.output)


@study(
    "heat-map",
    output("heat-map"),
    option("--contacts", "N", "how many are drawn (default 40)", 40),
    option("--first", "COUNT", "number of the first (default 0)", 0),
    option("--cells", "N", "the largest grid along each side; lines have 8 times (default 64)", 64),
    option("--repeats", "N", "runs of each, of which the fastest counts (default 3)", 3),
    flag("--finer", "each again with twice the levels and with half the mesh"),
    flag("--waves", "each again with waves, whose temperatures follow in time or not"),
    option("--program", "FILE", "an ehlwave-case to use; otherwise it is built"),
)
def heat_map(options: argparse.Namespace) -> int:
    """Map where steady states with heat are found, and what they cost.

    Draws lines, circles and ellipses of 0.3 to 2 GPa, 0.1 to 30 m/s and slide-to-roll ratios 0 to
    2, with oils of three flow laws. Runs each with and without heat, one after another on one core.
    Writes heat_map.csv: status, rises, friction, heat balance, processor times and their ratio.

    Exit status: 0 all settled or say why; 1 otherwise; 2 bad usage.
    """
    steps.prepare(options.program)
    words = ("--output", options.output, *given(options, "contacts", "first", "cells", "repeats"))
    more = [word for word in ("finer", "waves") if getattr(options, word)]
    return steps.report("heat_map", *words, *(f"--{word}" for word in more))
