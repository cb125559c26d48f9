"""Studies that pass or fail: other routes to the same numbers, and numbers of others."""

import argparse
import os
import sys

from studies.command import steps
from studies.command.options import at_once, choices, flag, given, option, output, study

PARTS = ("dimple", "line", "films", "printed")


@study(
    "accuracy",
    flag("--all-keys", "draw inputs over every key in place of those contacts"),
    option("--output", "DIR", "default build/accuracy, with --all-keys build/accuracy-all-keys"),
    at_once(),
    option("--smooth", "COUNT", "contacts without waves (default 60)", 60),
    option("--wavy", "COUNT", "linear responses (default 60)", 60),
    option("--marches", "COUNT", "waves in time (default 12)", 12),
    option("--cells", "N", "contacts that need more are drawn again (default 512)", 512),
    option("--count", "N", "with --all-keys: inputs (default 300)", 300),
    option("--seed", "COUNT", "of the random numbers (default 14, with --all-keys 33)"),
)
def accuracy(options: argparse.Namespace) -> int:
    """Check that errors are what was asked for.

    Draws random contacts with accuracy = 0.01, smooth, with small waves and marched in time, and
    compares them with half the mesh on twice the domain. A run that is there goes on. Writes
    asked.h5, finer.h5 and accuracy.csv. Exit status: 0 if nothing is off by more than 2 % silently
    and 95 % are within 1 %.

    --all-keys draws legal inputs over every key, and compares each that converges with the same on
    twice the cells and half the time step: H(0,0), smallest H, Ad/Ai, complex response, friction.
    What is off is in offenders.csv; about 20 minutes on two cores. Exit status: 0 if no number is
    further off than 1.5 times its error plus 0.2 %, no film is negative, and no case takes more
    than ten times its planned work.
    """
    name = "accuracy-all-keys" if options.all_keys else "accuracy"
    folder = options.output or steps.ROOT / "build" / name
    drawn = given(options, "smooth", "wavy", "marches", "cells", "count", "seed")
    steps.prepare()
    if options.all_keys:
        return steps.report("all_keys", folder, "--ranks", os.environ["EHLWAVE_RANKS"], *drawn)
    steps.python("accuracy", "asked", folder, *drawn)
    steps.sweep(folder / "asked.nml")
    steps.python("accuracy", "finer", folder)
    steps.sweep(folder / "finer.nml")
    return steps.report("accuracy", "report", folder)


@study(
    "jacobian", ("preset", {"nargs": "?", "choices": ("release", "debug"), "default": "release"})
)
def jacobian(options: argparse.Namespace) -> int:
    """Test the Jacobian of every law of viscosity and flow (Taylor test).

    What the product with the Jacobian leaves of a change of the residual must shrink with the
    square of the step: order 2.

    Exit status: 0 it does everywhere; otherwise it does not, or the build failed.
    """
    folder = steps.build(options.preset, stdout=sys.stderr)
    return steps.call(folder / "tests" / "test_reynolds", accepted=steps.ANY)[0]


@study(
    "periodic",
    output("check-periodic"),
    option("--cells", "N", "along each side (default 64)", 64),
    option("--first", "N", "so many cases only (default 24, which is all)", 24),
    option("--program", "FILE", "an ehlwave-case to use; otherwise it is built"),
)
def periodic(options: argparse.Namespace) -> int:
    """Compare periodic states with long marches from rest.

    24 cases: three orientations, M 50 to 1000, D 1 to 0.04, Ai 5 to 40 % of the film, S = 0.5, 1
    and 1.5, both laws of flow. They hold when Ad/Ai is within 1e-3 of the march and the rise of the
    mean film within 2 %; where the march took over the table says so. Writes periodic.csv.

    Exit status: 0 all hold, 1 some do not, 2 bad usage.
    """
    steps.prepare(options.program)
    return steps.report("periodic", *given(options, "output", "cells", "first"))


@study("transients", output("check-transients", "results that are there are replaced"), at_once())
def transients(options: argparse.Namespace) -> int:
    """Compare marches of waves under slip with responses of first and second order.

    Amplitudes are compared with linear responses, the mean film with its rise of second order, both
    oils. S = 0.5, 1.1, 1.5; transverse, isotropic, oblique; 128 x 128 cells, five settling periods:
    18 cases of 1 % waves and 18 of 10 to 30 %, a quarter of an hour on one core. Writes
    transients.h5 and transients.txt.

    Exit status: 1 some case does not hold.
    """
    results = options.output / "transients.h5"
    status = steps.sweep_anew("inputs/sliding_transients.nml", results)
    return max(status, steps.report("transients", results, kept=results.with_suffix(".txt")))


@study("validation", output("validation"), choices("--part", PARTS, "this part only"))
def validation(options: argparse.Namespace) -> int:
    """Lay published data beside this program, on one page.

    Builds, then runs on one core a dimple through a ball-on-disc contact (Mourier and others 2006),
    waves through a line contact (Venner and others 1997), smooth contacts beside film formulas, and
    the one printed Ad/Ai of a circular contact. Writes validation.html, tables/*.csv and figures/*;
    what is finished in DIR/runs is not run again.

    Exit status: 0 done; 1 a case failed; 2 bad usage.
    """
    steps.prepare()
    parts = [word for part in options.part or () for word in ("--part", part)]
    return steps.report("validation", "--output", options.output, *parts)


@study(
    "microgeometry",
    output("microgeometry"),
    option("--cells", "N", "cells of the whole domain in each direction, default 128", 128),
    option("--tables", "DIR", "harmonic tables of an earlier run, which save a few minutes"),
)
def microgeometry(options: argparse.Namespace) -> int:
    """Compare predicted with simulated roughness.

    Builds, then for a ground-like surface, a dent, a ridge and the sputtered pattern of the paper's
    experiment, at two speeds: the film at the contact centre by the full transient, and by ehlwave
    deform with default settings (the atlas), with the formula and with harmonic tables; and the
    lambda ratios of four traces in two contacts by one call of Contact. Writes table.csv,
    table.txt, profiles.png and lambda_ratios.csv.

    Exit status: 0 within 10 per cent of Rq with tables and by default where the amplitude is below
    0.3 of the film, and lambda ratios within 3 per cent; 1 not; 2 bad usage.
    """
    folder, tables = options.output, given(options, "tables")
    steps.prepare()
    cells = ("--cells", options.cells)
    for name in steps.written("microgeometry", "cases", folder, *cells, *tables):
        steps.sweep(folder / f"{name}.nml")
    return steps.report("microgeometry", "report", folder, *tables)


@study(
    "lambda",
    output("lambda"),
    option("--cells", "N", "cells of the whole domain in each direction, default 96", 96),
    choices("--contact", ("ball", "experiment", "ellipse"), "this contact only"),
    at_once(),
)
def lambda_ratio(options: argparse.Namespace) -> int:
    """Compare lambda ratios of thin films with marches of rough maps.

    Builds, then marches isotropic, longitudinal and transverse maps through three contacts, rolling
    and sliding (S = 0.9 and 1.1, Newtonian and Ree-Eyring oils), Rq 5 to 150 % of the film unless
    the surfaces are sure to touch, and predicts them by Contact.deform. Writes marches.csv,
    trusted.csv (errors by roughness and motion), factors.csv (their growth), lowest.csv (lowest
    films, linear and corrected, one contact held out), touching.csv and lambda.png. What is
    finished is not run again. About 15 minutes of one core.

    Exit status: 0 95 per cent of the lambda ratios within their stated error; 1 not; 2 bad usage.
    """
    chosen = [word for one in options.contact or () for word in ("--contact", one)]
    words = ("--cells", options.cells, *chosen)
    steps.prepare()
    for name in steps.written("lambda_ratio", "cases", options.output, *words):
        steps.sweep(options.output / f"{name}.nml")
    return steps.report("lambda_ratio", "report", options.output, *words)
