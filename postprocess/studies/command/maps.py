"""The study of where the solver works."""

import argparse

from studies.command import steps
from studies.command.options import Option, at_once, flag, option, output, study


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
    two maps of their outcomes: converged, converged but unresolved, refused, failed.

    Exit status: 0 all resolved cases converged and no result makes a false claim; 85 stopped, to be
    continued; 1 otherwise.
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
