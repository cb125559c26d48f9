"""Studies of errors and costs, of this program and of others."""

import argparse

from studies.command import steps
from studies.command.options import flag, given, option, output, study


@study(
    "error-vs-time",
    flag("--quick", "grids up to 96 x 96 cells with waves: minutes; otherwise up to 512 x 512"),
    output("error-vs-time"),
    option("--minutes", "MINUTES", "stop after so many minutes (default 45)", 45),
    option("--program", "FILE", "an ehlwave-sweep to use, ehlwave-case beside it; default: built"),
)
def error_vs_time(options: argparse.Namespace) -> int:
    """Draw errors against run times of methods, grids, time steps and tolerances.

    Runs a table of contacts with them as a sweep on one core, and compares each with a finer
    solution. Writes cases.h5, runs.csv, errors.csv, orders.csv, estimates.csv, models.csv and
    figures. src/case/accuracy_model.f90 has the coefficients of models.csv.

    Exit status: 0 done, 1 failed, 2 bad usage.
    """
    quick = ("--quick",) if options.quick else ()
    steps.prepare(options.program)
    steps.python("error_time", "cases", options.output, *quick)
    words = ("--time-limit", int(60 * options.minutes))
    status = steps.sweep("--ranks=1", options.output / "cases.nml", *words, accepted=steps.ANY)
    if status not in (*steps.CONVERGED_OR_NOT, steps.TO_BE_CONTINUED):
        return 1
    return steps.report("error_time", "report", options.output, *quick)


@study(
    "line-work",
    output("line-work"),
    option("--program", "FILE", "an ehlwave-case to use; otherwise it is built"),
)
def line_work(options: argparse.Namespace) -> int:
    """Count the work of steady states of line contacts without a cap.

    Runs M = 0.2 to 1000, L = 0 to 25, laws by Roelands, Barus and McEwen, inlets at -2.5 and -20,
    256 to 4096 cells. Writes line-work.csv, which `line_steady_work` of
    src/case/accuracy_model.f90 was fitted to, and prints how many states take the planned work
    within a factor of 2. Takes about 20 minutes on one core.

    Exit status: 0 done, 1 failed, 2 bad usage.
    """
    steps.prepare(options.program)
    return steps.report("line_work", "--output", options.output)


@study(
    "speed",
    output("speed-table"),
    option("--repeats", "N", "runs of each, of which the fastest counts (default 3)", 3),
    option("--program", "FILE", "an ehlwave-case to use; otherwise it is built"),
)
def speed(options: argparse.Namespace) -> int:
    """Measure the cost of a steady state, a time step and a fine grid.

    Runs M = 100, L = 12.05, D = 1 on one core with the methods newton and fas, in successive runs:
    the smooth steady state on 257 x 257 and 1025 x 1025 nodes and transverse waviness of lambda =
    0.5 a on 257 x 257, marched, small and periodic, with the remaining algebraic error. Both steady
    states once more with the default, auto. Writes speed.csv.

    Exit status: 0 done, 1 failed, 2 bad usage.
    """
    steps.prepare(options.program)
    return steps.report("speed", "--output", options.output, "--repeats", options.repeats)


@study(
    "threads",
    output("threads"),
    option("--cells", "N", "along each side (default 1024)", 1024),
    option("--threads", "N", "threads, and runs side by side (default: the cores)"),
    option("--repeats", "N", "runs of each, of which the fastest counts (default 3)", 3),
    option("--program", "FILE", "an ehlwave-case to use; otherwise it is built"),
)
def threads(options: argparse.Namespace) -> int:
    """Compare a contact on several threads with as many runs side by side.

    Runs M = 100, L = 12.05, D = 1, smooth and with the first 32 time steps of transverse waviness
    of lambda = 0.5 a, by the method auto. Printed is the share of the throughput of the separate
    runs that the threads reach. The first line is for independent square roots: the upper limit of
    the machine. Writes threads.csv.

    Exit status: 0 done, 1 failed, 2 bad usage.
    """
    steps.prepare(options.program)
    return steps.report("threads", *given(options, "output", "cells", "threads", "repeats"))


@study(
    "peers",
    output("peers"),
    option("--fbns", "DIR", "a clone of github.com/ErikHansenGit/EHL; needs octave-cli"),
    option("--slippy", "DIR", "an environment of Python, with bin/python, in which slippy runs"),
    option("--book", "FILE", "Venner and Lubrecht's program, typed in: see above"),
    option("--largest", "N", "cells along X and Y, at most (default 128)", 128),
    option(
        "--limit", "SECONDS", "a run of another solver is stopped after these; default 600", 600
    ),
    option("--program", "FILE", "an ehlwave-case to use; otherwise it is built"),
)
def peers(options: argparse.Namespace) -> int:
    """Compare with public solvers: a contact, error against processor time.

    Runs the smooth contact of Mourier and others (2006) by this program, by EHL-FBNS in GNU Octave
    and by slippy, each on 32 x 32 cells and finer grids, on one core. A solver whose folder is not
    given is skipped, with a message. Errors are errors of the central film against the value of
    this program for mesh size 0. Writes peers.csv and a figure. The column times is the time of
    another solver over that of the cheapest run of this program on the whole domain with no larger
    error.

    --book names a program that solves M = 20, L = 10, D = 1 with Barus' law and an incompressible
    oil in (-4.5, 1.5) x (-3, 3) on as many cells along each side as its first argument, with as
    many relaxations on its coarsest grid as its second argument (40 as printed, and 4), and prints
    a line "film" with H(0,0) behind it.

    Exit status: 0 done, 1 failed, 2 bad usage.
    """
    steps.prepare(options.program)
    words = given(options, "output", "fbns", "slippy", "book", "largest", "limit")
    return steps.report("peers", *words)
