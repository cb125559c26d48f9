"""Studies of the program itself: errors, costs, where it works, where linear ends."""

import argparse
import os

from studies.command import steps
from studies.command.options import COUNT, Option, at_once, flag, given, option, output, study


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
    figures. The coefficients in models.csv are those of src/case/accuracy_model.f90.

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


@study(
    "speed",
    output("speed-table"),
    option("--repeats", "N", "runs of each, of which the fastest counts (default 3)", 3),
    option("--program", "FILE", "an ehlwave-case to use; otherwise it is built"),
)
def speed(options: argparse.Namespace) -> int:
    """Measure what a steady state, a time step and a fine grid cost.

    Runs M = 100, L = 12.05, D = 1 on one core with the methods newton and fas, one run after
    another: the smooth steady state on 257 x 257 and 1025 x 1025 nodes and transverse waviness of
    lambda = 0.5 a on 257 x 257, marched, small and periodic, with what is left of algebraic error.
    Both steady states once more with the default, auto. Writes speed.csv.

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
    """Compare one contact on several threads with as many runs side by side.

    Runs M = 100, L = 12.05, D = 1, smooth and with the first 32 time steps of transverse waviness
    of lambda = 0.5 a, by the method auto. Printed is the share of the throughput of the separate
    runs that the threads reach. The first line is that of square roots, which need nothing of each
    other: more than that the machine does not have. Writes threads.csv.

    Exit status: 0 done, 1 failed, 2 bad usage.
    """
    steps.prepare(options.program)
    return steps.report("threads", *given(options, "output", "cells", "threads", "repeats"))


@study(
    "heavy",
    output("heavy"),
    option(
        "--largest", "N", "cells along X and Y, at most; 2048 takes minutes (default 1024)", 1024
    ),
    option("--method", "METHOD", "the key method of the cases (default auto)", "auto"),
    flag("--responses", "with the linear response to transverse waves of 0.5 a"),
    flag(
        "--schemes", "error against work of both schemes of the Reynolds equation in place of those"
    ),
    flag("--refinement", "the best that local refinement could save, in place of those"),
    option("--draw", "N", "so many random heavy contacts with accuracy = 0.01 in place of those"),
    option("--program", "FILE", "an ehlwave-case to use; otherwise it is built"),
)
def heavy(options: argparse.Namespace) -> int:
    """Measure what heavy loads and large grids cost.

    Runs smooth contacts of M = 100, 1000 and 10,000, and the case of Venner and Lubrecht's book, on
    256 x 256 cells and more, on one core. Prints method, tolerance, steps, counted work units and
    memory. Writes heavy.csv.

    --draw takes random contacts, M = 2000 to 10,000, L = 2.5 to 20, D = 0.04 to 1, every fourth
    with D = 0.07, every third with the response to transverse waves of 0.5 to 2 a. Each is compared
    with itself on twice the cells. Writes draw.csv.

    --schemes takes M = 100 to 10,000, D = 1 and 0.07, smooth and with the response to transverse
    waves of 0.5 and 2 a, on finer and finer grids of the schemes averaged and fitted, and says the
    least work for 1 % of film and Ad/Ai. Ten minutes with --largest 2048. Writes schemes.csv and
    work.csv.

    --refinement takes M = 1000, 3000 and 10,000 on 512 x 512 cells, and says where the error of the
    averaged scheme comes from and what composite grids could save. Writes refinement.csv.

    Exit status: 0 done, of random contacts 95 % within 1 %; 1 failed; 2 bad usage.
    """
    steps.prepare(options.program)
    given_words = given(options, "output", "method", "largest", "draw")
    flags = ("responses", "schemes", "refinement")
    flag_words = (f"--{name}" for name in flags if getattr(options, name))
    return steps.report("heavy", *given_words, *flag_words)


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
    """Compare with public solvers: one contact, error against processor time.

    Runs the smooth contact of Mourier and others (2006) by this program, by EHL-FBNS in GNU Octave
    and by slippy, each on 32 x 32 cells and finer ones, on one core. A solver whose folder is not
    given is skipped, which is said. Errors are those of the central film against the value of this
    program for mesh size 0. Writes peers.csv and a figure. The column times is the time of another
    solver over that of the cheapest run of this program on the whole domain with no larger error.

    --book names a program that solves M = 20, L = 10, D = 1 with Barus' law and an incompressible
    oil in (-4.5, 1.5) x (-3, 3) on as many cells along each side as its first argument says, with
    as many relaxations on its coarsest grid as its second says (40 as printed, and 4), and prints
    a line "film" with H(0,0) behind it.

    Exit status: 0 done, 1 failed, 2 bad usage.
    """
    steps.prepare(options.program)
    words = given(options, "output", "fbns", "slippy", "book", "largest", "limit")
    return steps.report("peers", *words)


@study("stress", output("stress"))
def stress(options: argparse.Namespace) -> int:
    """Compare stresses below rough surfaces: dry, lubricated and smooth.

    Writes waves.csv, roughness.csv and their figures; nothing is simulated: a minute on one core.
    """
    steps.find_python()
    return steps.report("stress", "--output", options.output)


@study("stress-speed", ("points", {"nargs": "?", "type": COUNT, "default": 1024}))
def stress_speed(options: argparse.Namespace) -> int:
    """Measure how long stresses below a surface take, on one core.

    A map of POINTS x POINTS (default 1024) at 8 and at 32 depths, with friction, and a measured
    trace; wall and processor time, and the largest memory of the process.
    """
    steps.find_python()
    os.environ |= {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    return steps.report("stress_speed", options.points)


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

    Computes films of contacts over M, L and D with 0.2 to 5 times the oil that they pass flooded,
    and linear responses of half as many. Fits R(r) and Ad/Ai(x, R), each contact held out in turn,
    with intervals by drawing contacts again. Then rows of contacts on one track, each with the oil
    that the one before left, against closed forms of overrollings and side flow. Writes films.h5,
    waves.h5, laws.csv, overrollings.csv, tracks.csv and two figures. The coefficients in laws.csv
    are those of ehlwave.starvation.

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
    steps.python("starvation", "overrollings", folder, *given(options, "cells"))
    return steps.report("starvation", "report", folder)


@study(
    "heat",
    output("heat"),
    at_once(),
    option("--lines", "COUNT", "line contacts that are computed (default 400)", 400),
    option("--points", "COUNT", "elliptical ones (default 160)", 160),
    option(
        "--cells", "N", "cells along each side of these (default 128), a quarter of lines'", 128
    ),
)
def heat(options: argparse.Namespace) -> int:
    """Fit laws of film and friction of contacts with heat.

    Computes contacts drawn over pressure, speed, oil, bodies and slide-to-roll ratio, with and
    without heat. Fits by how much the warm inlet thins the film, and friction over that of an even
    film under Hertz pressure, contacts held out. Ten minutes on one core. Writes lines.h5,
    points.h5, contacts.csv, laws.csv and a figure. The coefficients in laws.csv are those of
    ehlwave.heat_laws.

    Exit status: 0 done, 1 failed, 2 bad usage.
    """
    steps.prepare()
    folder = options.output
    steps.python("heat", "cases", folder, *given(options, "lines", "points", "cells"))
    for name in ("lines", "points"):
        steps.sweep(folder / f"{name}.nml")
    return steps.report("heat", "report", folder)


@study(
    "thinning",
    output("thinning"),
    option("--contacts", "N", "how many are drawn (default 64)", 64),
    option("--cells", "N", "along each side; lines have 8 times (default 128)", 128),
    option("--program", "FILE", "an ehlwave-case to use; otherwise it is built"),
)
def thinning(options: argparse.Namespace) -> int:
    """Compare films of oils that thin in the inlet with the bound of their loss.

    Draws smooth contacts and lines that roll or slide in Ree-Eyring and Carreau oils, of a stress
    that makes the bound of ehlwave.contact.thinning 1 to 15 %. Each is computed with its oil and
    with a Newtonian one, one after another on one core. Writes thinning.csv.

    Exit status: 0 no contact that is answered by the bound loses more; 1 otherwise; 2 bad usage.
    """
    steps.prepare(options.program)
    return steps.report("thinning", *given(options, "output", "contacts", "cells"))


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
