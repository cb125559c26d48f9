"""The study that makes the atlas of the package, or judges it."""

import argparse
import os
import sys

from studies.command import steps
from studies.command.options import at_once, flag, given, option, output, study

BATCHES = {
    "rolling": 24,
    "rolling_wide": 17,
    "sliding": 80,
    "sliding_wide": 30,
    "line": 24,
    "line_sliding": 36,
    "line_newtonian": 32,
}


@study(
    "atlas",
    flag("--wide", "rolling contacts beyond the usual ranges", dest="kind", const="rolling_wide"),
    flag("--sliding", "contacts that slide in a Ree-Eyring oil", dest="kind", const="sliding"),
    flag("--sliding-wide", "the same beyond its ranges", dest="kind", const="sliding_wide"),
    flag("--line", "line contacts in pure rolling", dest="kind", const="line"),
    flag(
        "--line-sliding",
        "line contacts that slide in a Ree-Eyring oil",
        dest="kind",
        const="line_sliding",
    ),
    flag(
        "--line-newtonian",
        "line contacts that slide in a Newtonian oil",
        dest="kind",
        const="line_newtonian",
    ),
    output("atlas"),
    option(
        "--batches",
        "N",
        "default 24; --wide: 17, --sliding: 80, --sliding-wide: 30, --line-sliding: 36, "
        "--line-newtonian: 32",
    ),
    option("--atlas", "FILE", "the atlas to be judged, default the one of the package"),
    flag("--validate", "judge in place of computing"),
    flag("--bearings", "judge contacts of bearings that roll, of gears and of cams"),
    at_once(),
)
def atlas(options: argparse.Namespace) -> int:
    """Compute anew, or judge, the atlas that the package ehlwave answers from.

    Computes smooth contacts and nine small waves in each, batch by batch of 32 contacts: 24 batches
    fill the ranges of M, L, D and the oil; later batches go where the error bars of the earlier
    batches are largest. Then the rise of the mean film under oblique waves is computed, and
    networks are fitted to all that. A batch takes a minute of two cores, a fit ten. --wide is for M
    to 100,000, L to 42 and D from 0.01, by the fitted scheme: ten of its 17 batches lie within M of
    10,000 and L of 20, the others beyond. The atlas is DIR/rolling.nc, rolling_wide.nc, sliding.nc,
    sliding_wide.nc, line.nc, line_sliding.nc or line_newtonian.nc.

    Contacts that slide have eight waves each; 64 batches fill the ranges, of S and of the Eyring
    stress, too; the atlas begins with the responses of contacts that roll, of the package.
    --sliding-wide is for M to 10,000, S of 0 to 2 and D from 0.01, with four waves each; more
    --batches narrow its bars: DIR/sliding_wide-00.nml and so on are sweeps for a cluster, too
    (scripts/batch). Line
    contacts come in batches of 32, with five transverse waves each, all of which fill the ranges;
    12 seconds a batch. Those that slide begin with the responses of line contacts that roll; their
    last batches lie where machines are, at slight slip and at light loads.

    To judge, 300 random waves in 150 random contacts that no atlas is fitted to are computed
    (sliding: 200 in 100). Printed are how many of them lie within the error bars, the median error
    and the 95th percentile. Bearings are 300 contacts of balls and 300 of cylindrical
    rollers with inner and outer rings, by boundary dimensions of ISO 15. Of spur gears along the
    line of action and of cams there are 300 each in a Ree-Eyring and in a Newtonian oil. Printed
    is how many the atlas answers, and 30 of each are computed.
    """
    folder, kind = options.output, options.kind or "rolling"
    flag_of = options.kind and options.kind.removeprefix("rolling_").replace("_", "-")
    of_kind = (f"--{flag_of}",) if options.kind else ()
    processes = ("--ranks", os.environ["EHLWAVE_RANKS"])
    steps.prepare()
    os.environ["OMP_NUM_THREADS"] = "1"  # networks are fitted by processes

    def sweep_of(step: str) -> None:
        (file,) = steps.written("atlas", step, folder, *of_kind)
        steps.sweep(file, stdout=sys.stderr)

    if options.bearings:
        for file in steps.written("atlas", "catalogue", folder, *given(options, "atlas")):
            steps.sweep(file, stdout=sys.stderr)
        return steps.report("atlas", "bearings", folder, *given(options, "atlas"))
    if options.validate:
        sweep_of("unseen")
        return steps.report("atlas", "validate", folder, *given(options, "atlas"), *of_kind)
    for batch in range(options.batches or BATCHES[kind]):
        file = folder / f"{kind}-{batch:02d}.nml"
        # A chosen batch is kept: its choice depends on the atlas at that time.
        if not file.is_file():
            steps.python("atlas", "batch", folder, "--batch", batch, *processes, *of_kind)
        steps.sweep(file, stdout=sys.stderr)
    # The transverse waves of line contacts have their rise of the mean film already.
    if not kind.startswith("line"):
        sweep_of("rises")
    made = ("--atlas", folder / f"{kind}.nc")
    return steps.report("atlas", "fit", folder, *made, *processes, *of_kind)
