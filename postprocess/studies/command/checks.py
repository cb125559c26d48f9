"""Studies that pass or fail: errors against finer solutions, and the Jacobian."""

import argparse
import os
import sys

from ehlwave.writing import Writer
from studies.command import steps
from studies.command.options import at_once, choices, flag, given, option, study


@study(
    "accuracy",
    flag("--all-keys", "draw inputs over every key in place of those contacts"),
    option("--output", "DIR", "default build/accuracy, with --all-keys build/accuracy-all-keys"),
    at_once(),
    option("--smooth", "COUNT", "contacts without waves (default 60)", 60),
    option("--wavy", "COUNT", "linear responses (default 60)", 60),
    option("--marches", "COUNT", "waves in time (default 12)", 12),
    option("--cells", "N", "contacts that need more are drawn again (default 512)", 512),
    option("--seconds", "N", "so do contacts that take longer by their plan (default 3600)", 3600),
    option("--count", "N", "with --all-keys: inputs (default 300)", 300),
    option("--seed", "COUNT", "of the random numbers (default 14, with --all-keys 33)"),
    flag("--calibrate", "extend the sample of declared errors, and write their factors"),
    option("--contacts", "N", "with --calibrate: contacts of the sample (default 1500)", 1500),
    option("--part", "I/N", "with --calibrate: compute this part only (default: the rank's)"),
)
def accuracy(options: argparse.Namespace) -> int:
    """Check that errors are within the requested accuracy.

    Draws random contacts with an accuracy of 0.01 and 0.005 in turn, smooth, with small waves and
    marched in time, and compares them with half the mesh on twice the domain. A run that is there
    goes on. Writes asked.h5, finer.h5 and accuracy.csv. Exit status: 0 if nothing is off by more
    than twice the accuracy silently and 95 % are within it.

    --all-keys draws legal inputs over every key, and compares each that converges with the same
    input on twice the cells and half the time step: H(0,0), smallest H, Ad/Ai, complex response,
    friction. Offenders are in offenders.csv; about 20 minutes on two cores. Exit status: 0 if no
    number is further off than 1.5 times its error plus 0.2 %, no film is negative, and no case
    takes more than ten times its planned work (30 times with an accuracy).

    --calibrate draws contacts over every key in classes, computes each on twice and four times the
    cells and on twice the domain, and goes on where it was stopped; with --part or in a
    batch job a part of them. Without a part it judges the declared errors of all: it writes
    postprocess/record/accuracy and the factors in src/case/error_factors.f90. Exit status: 0 if
    held-out errors are within the declared errors in 97.5 % for each quantity.
    """
    if options.calibrate:
        return _calibrate(options)
    name = "accuracy-all-keys" if options.all_keys else "accuracy"
    folder = options.output or steps.ROOT / "build" / name
    drawn = given(options, "smooth", "wavy", "marches", "cells", "seconds", "count", "seed")
    steps.prepare()
    if options.all_keys:
        return steps.report("all_keys", folder, "--ranks", os.environ["EHLWAVE_RANKS"], *drawn)
    steps.python("accuracy", "asked", folder, *drawn)
    steps.sweep(folder / "asked.nml")
    steps.python("accuracy", "finer", folder)
    steps.sweep(folder / "finer.nml")
    return steps.report("accuracy", "report", folder)


def _calibrate(options: argparse.Namespace) -> int:
    folder = options.output or steps.ROOT / "build" / "accuracy-sample"
    steps.prepare()
    steps.python("calibrate", "extend", folder, *given(options, "contacts", "part"))
    if options.part or os.environ.get("SLURM_NTASKS", "1") != "1":
        return 0
    return steps.report("calibrate", "judge", folder)


@study(
    "elements",
    option("--output", "DIR", "default build/elements", steps.ROOT / "build" / "elements"),
    option("--elements", "COUNT", "of each kind (default 200)", 200),
    option("--contacts", "COUNT", "of each kind to compare with ehlwave-case (default 10)", 10),
    option("--computed", "COUNT", "most contacts to compute that no law answers (default: all)"),
    flag("--report", "compute nothing more: report what has been computed"),
    option("--program", "FILE", "an ehlwave-case to use; otherwise it is built"),
)
def elements(options: argparse.Namespace) -> int:
    """Ask random machine elements of ten kinds for their films and friction.

    Draws dimensions, loads, speeds and oils over the range of catalogues. The contacts of all
    elements are answered with heat by laws. Of each kind, a sample that a law answers is compared
    with ehlwave-case. Contacts that no law answers are computed, kinds in turn, in at most 60 s of
    a processor a run. Angles at which surfaces of cams move in opposite directions do not count. A
    run that is there goes on. Writes elements.csv, compared.csv, contacts.csv.

    Exit status: 0 each kind is answered for 98 % and 95 % of films and friction are within their
    errors; 1 otherwise; 2 bad usage.
    """
    steps.prepare(options.program)
    words = given(options, "output", "elements", "contacts", "computed")
    return steps.report("elements", *words, *(["--report"] if options.report else []))


@study("jacobian")
def jacobian(_: argparse.Namespace) -> int:
    """Test the Jacobian of every law of viscosity and flow (Taylor test).

    The difference between the product with the Jacobian and a change of the residual must shrink
    with the square of the step: order 2. The debug build has this test.

    Exit status: 0 it does everywhere; otherwise it does not, or the build failed.
    """
    folder = steps.build("debug", stdout=sys.stderr)
    return steps.call(folder / "tests" / "test_reynolds", accepted=steps.ANY)[0]


@study(
    "touching",
    option("--output", "DIR", "default build/touching"),
    option("--count", "N", "random marches (default 200)", 200),
    option("--films", "COUNT", "rolling contacts beside predicted mean films (default 40)", 40),
    option("--cells", "N", "cells along X and Y of the pair of maps (default 64)", 64),
    choices("--only", ("steady", "marches", "map", "films", "pair"), "a part (default: all)"),
    option("--program", "FILE", "an ehlwave-case to use; otherwise it is built"),
)
def touching(options: argparse.Namespace) -> int:
    """Compute touching surfaces: steady states, marches, a map, films, two maps.

    steady: speeds, friction and areas of lines beside an independent solver, steady.csv. marches:
    waves, pairs of waves and maps on lines and balls, Rq over film 0.3 to 3, S 0 to 2, Newtonian
    and Ree-Eyring oils, marches.jsonl; lines and some balls on twice the cells,
    marches_finer.jsonl. map: outcomes over speed, wavelength and S, map.jsonl and map.png. films:
    marches in pure rolling, Rq over film 0.5 to 2, beside the mean films that predictions give
    without a march, films.jsonl, films.csv and films.png. pair: the passage of two rough
    maps through a ball contact, its share and processor time, pair.jsonl. A run that is there goes
    on. An hour for the marches on one core, minutes for the others.

    Exit status: 0 steady values are within their bounds, at least 95 % of the marches reach the
    end, all points of the map converge, and 95 % of the films are within their error; 1 otherwise;
    2 bad usage.
    """
    parts = {
        "steady": ("touching_steady", "--record", "steady.csv"),
        "marches": ("touching", "--count", str(options.count), "--record", "marches.jsonl"),
        "map": ("touching_map", "--record", "map.jsonl"),
        "films": ("touching_films", "--count", str(options.films), "--record", "films.jsonl"),
        "pair": ("touching_pair", "--cells", str(options.cells), "--record", "pair.jsonl"),
    }
    folder = options.output or steps.ROOT / "build" / "touching"
    Writer().folder(folder)
    steps.prepare(options.program)
    commands = [parts[name] for name in options.only or parts]
    return max([steps.report(*words[:-1], folder / words[-1]) for words in commands])
