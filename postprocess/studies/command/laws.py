"""Studies that fit the laws of the package to computed contacts, or judge them."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from studies.command import steps
from studies.command.options import at_once, choices, flag, given, option, output, study

GROUPS = ("lines", "points", "bearings", "thick")
"""Sweeps of the studies of heat."""
ENDS = (
    *("light", "soft", "soft_points", "light_again", "light_fresh", "rigid", "soft_ellipses"),
    *("thick_ellipses", "oily", "oily_rolling"),
)
"""Groups of contacts of the study of their ends."""


def _sweep_warm_and_cold(folder: Path, names: Sequence[str]) -> None:
    """Run the sweeps of contacts with heat and without."""
    for name in (f"{one}{cold}" for one in names for cold in ("", "_cold")):
        steps.sweep(folder / f"{name}.nml")


@study(
    "starvation",
    output("starvation"),
    at_once(),
    flag("--quick", "8 contacts, 192 cells: some minutes on two cores"),
    option("--contacts", "COUNT", "contacts whose films are computed (default 30)"),
    option("--cells", "N", "cells along X for waves; films have two thirds (default 384)"),
)
def starvation(options: argparse.Namespace) -> int:
    """Fit laws of film and waves of contacts with too little oil.

    Computes films of contacts over M, L and D with 0.2 to 5 times the flooded flow of oil, and
    linear responses of half as many. Fits R(r) and Ad/Ai(x, R), each contact held out in turn, with
    intervals by drawing contacts again. Writes films.h5, waves.h5, laws.csv and a figure.
    ehlwave.contact.starvation has the coefficients of laws.csv.

    Exit status: 0 done, 1 failed, 2 bad usage.
    """
    steps.prepare()
    folder = options.output
    if options.quick:
        options.contacts, options.cells = options.contacts or 8, options.cells or 192
    options.contacts, options.cells = options.contacts or 30, options.cells or 384
    steps.python("starvation", "cases", folder, *given(options, "contacts", "cells"))
    for name in ("films", "waves"):
        steps.sweep(folder / f"{name}.nml")
    return steps.report("starvation", "report", folder)


@study(
    "heat",
    output("heat"),
    at_once(),
    option("--lines", "COUNT", "line contacts that are computed (default 1200)", 1200),
    option("--points", "COUNT", "elliptical ones (default 600)", 600),
    option("--more", "COUNT", "contacts of bearings, and as many thick films (default 160)", 160),
    option(
        "--cells", "N", "cells along each side of these (default 128), a twelfth of lines'", 128
    ),
)
def heat(options: argparse.Namespace) -> int:
    """Fit laws of friction and smallest films with heat; judge the inlet law.

    Computes contacts drawn over pressure, speed, oil, bodies and slide-to-roll ratio, with and
    without heat. Fits friction over the friction of an even film under Hertz pressure, contacts
    held out, and smallest over central films; compares films with the law of ``scripts/study
    inlet`` and finds errors that hold. Ten minutes on one core. Writes lines.h5, points.h5,
    contacts.csv, films.csv, laws.csv and a figure. The coefficients in laws.csv are those of
    ehlwave.laws.heat_laws; warm_films.json of the package is written.

    Exit status: 0 done, 1 failed, 2 bad usage.
    """
    steps.prepare()
    folder = options.output
    steps.python("heat", "cases", folder, *given(options, "lines", "points", "more", "cells"))
    _sweep_warm_and_cold(folder, GROUPS)
    return steps.report("heat", "report", folder)


@study(
    "heat-ends",
    output("heat-ends"),
    at_once(),
    choices("--group", ENDS, "group of contacts (default: all)"),
    option("--contacts", "COUNT", "contacts of each group (default: as in the record)"),
)
def heat_ends(options: argparse.Namespace) -> int:
    """Judge laws of heat at ends of their ranges; fit friction of light lines.

    Computes contacts with and without heat: light lines with films up to 7.5 Hertz approaches, also
    drawn again; rolling lines too light to deform; oils with Eyring stresses of 1 to 2 MPa; thick
    films of ellipses; lines with L of 20 to 42. Fits the friction of light lines,
    contacts held out. Other groups judge alone. Half an hour on one core. Groups that have been
    computed are reported. Writes ends.csv.xz, ends_coverage.csv and ends_law.csv, whose
    coefficients are those of ehlwave.laws.light_lines.

    Exit status: 0 done, 1 failed, 2 bad usage.
    """
    steps.prepare()
    folder = options.output
    names = options.group or ENDS
    words = [word for name in names for word in ("--group", name)]
    steps.python("heat_ends", "cases", folder, *words, *given(options, "contacts"))
    _sweep_warm_and_cold(folder, names)
    return steps.report("heat_ends", "report", folder)


@study(
    "inlet",
    output("inlet"),
    at_once(),
    option("--lines", "COUNT", "line contacts that are computed (default 400)", 400),
    option("--points", "COUNT", "elliptical ones (default 500)", 500),
    option("--more", "COUNT", "contacts of bearings, and as many thick films (default 160)", 160),
    option(
        "--cells", "N", "cells along each side of these (default 128), a quarter of lines'", 128
    ),
)
def inlet(options: argparse.Namespace) -> int:
    """Fit the law by how much the shear of its own inlet thins a film.

    Computes contacts drawn as in ``scripts/study heat``, rounder and with thicker films too, with
    and without heat. Fits the loss of film over thermal loading, sliding, bodies, film and shape,
    contacts held out. Ten minutes on one core. Writes lines.h5, points.h5, contacts.csv, law.csv
    and the tables of both languages; copies of these replace src/contact/ inlet_coefficients.f90
    and ehlwave.laws.inlet_coefficients.

    Exit status: 0 done, 1 failed, 2 bad usage.
    """
    steps.prepare()
    folder = options.output
    steps.python("inlet_law", "cases", folder, *given(options, "lines", "points", "more", "cells"))
    for name in GROUPS:
        steps.sweep(folder / f"{name}.nml")
    return steps.report("inlet_law", "report", folder)


@study(
    "judged",
    output("judged"),
    option("--part", "NAME", "answers, heavy-films, sheared-waves, warm-waves or isothermal; all"),
    option("--contacts", "N", "of each part; default: those of the record"),
    flag("--write", "write the coefficients of the laws into the package"),
    option("--program", "FILE", "an ehlwave-case to use; otherwise it is built"),
)
def judged(options: argparse.Namespace) -> int:
    """Judge and fit laws of the package by contacts computed on fine grids.

    Draws contacts, computes each by ehlwave-case, and compares the package. Parts: answers for
    contacts of catalogues and at the ends of the ranges, the smallest films of heavy and slender
    contacts, waves under slip in Carreau oils, waves in warm contacts, and films, friction and
    responses of isothermal contacts of all kinds. Two hours on one core; an interrupted study goes
    on. Writes a table per part and coverage.csv. With --write the coefficients of the three parts
    in the middle go into the package.

    Exit status: 0 all errors hold for 95 % and at most 1 % are beyond 1.5 times; 1 otherwise; 2 bad
    usage.
    """
    steps.prepare(options.program)
    words = given(options, "output", "part", "contacts")
    return steps.report("judged", *words, *(("--write",) if options.write else ()))


@study(
    "answered",
    output("answered"),
    option("--program", "FILE", "an ehlwave-case to use; otherwise it is built"),
)
def answered(options: argparse.Namespace) -> int:
    """Measure how long 24 contacts take, half of them hot or starved.

    Film in at most 10 s and lambda ratio of a trace in at most 60 s of the processors, and at once
    the second time. Writes answered.csv.

    Exit status: 0 all contacts answered in time; 1 otherwise; 2 bad usage.
    """
    steps.prepare(options.program)
    return steps.report("answered", *given(options, "output"))
