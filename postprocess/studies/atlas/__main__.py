"""The commands behind ``scripts/study atlas``: write sweeps, fit the atlas to results, judge it.

All but the last print the path of their output.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from ehlwave.laws.atlas import Atlas, load_atlas
from ehlwave.laws.atlas.atlas import shipped
from ehlwave.laws.atlas.kinds import KINDS, LINE, LINE_NEWTONIAN, LINE_SLIDING, SLIDING_WIDE, Kind
from studies.atlas import line_design, line_sliding_design, sliding_wide_design
from studies.atlas.anchors import with_anchors
from studies.atlas.batches import write_batch, write_rises, write_validation
from studies.atlas.catalogue import DRAWS
from studies.atlas.design import DESIGNS
from studies.atlas.fit import finished
from studies.atlas.points import read_points
from studies.atlas.store import write_atlas
from studies.atlas.validate import judge
from studies.command import atlas as command
from studies.command.options import step_parser
from studies.sweeps import run_command, write_rows

ALL_DESIGNS = DESIGNS | {"sliding_wide": sliding_wide_design.SLIDING_WIDE_DESIGN}

FILLING = {
    "rolling": 24,
    "rolling_wide": 24,
    "sliding": 64,
    "sliding_wide": 64,
    "line": 24,
    "line_sliding": 36,
    "line_newtonian": 32,
}
"""Batches that fill the ranges; later batches go where the earlier errors are largest."""

STEPS = ("batch", "rises", "fit", "unseen", "validate", "catalogue", "bearings")

BLOCK = 16
"""Later batches that follow from the same fit, which takes as long as ten of them."""

RISE_BATCHES = {
    "rolling": range(24),
    "rolling_wide": (0, 1, 10),
    "sliding": range(24),
    "sliding_wide": (0, 1),
}
"""Batches of which the rise of the mean film under oblique waves is computed: that costs more."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Do a step; return 0, or 1 with a message."""
    parser = step_parser(command.atlas, __doc__)
    parser.add_argument("step", choices=STEPS)
    parser.add_argument("folder", type=Path, help="of sweeps and their results; made when absent")
    parser.add_argument("--batch", type=int, default=0, metavar="N", help="counted from 0")
    parser.set_defaults(kind="rolling", at_once=1)
    return run_command(parser, _do, arguments)


def _do(options: argparse.Namespace) -> None:
    folder, step, kind = options.folder, options.step, KINDS[options.kind]
    atlas = options.atlas or shipped(kind)
    batches = sorted(folder.glob(f"{kind.name}-[0-9][0-9].h5"))
    if step == "batch":
        known = _known_before(options.batch, folder, kind, options.at_once)
        if kind is LINE:
            print(line_design.write_batch(folder, options.batch, known))
        elif kind in (LINE_SLIDING, LINE_NEWTONIAN):
            print(line_sliding_design.write_batch(folder, options.batch, known, kind))
        elif kind is SLIDING_WIDE:
            print(sliding_wide_design.write_batch(folder, options.batch, known))
        else:
            print(write_batch(folder, options.batch, DESIGNS[kind.name], known))
    elif step == "rises":
        rising = [batches[one] for one in RISE_BATCHES[kind.name] if one < len(batches)]
        with_rises = read_points(rising, kind=kind)
        print(write_rises(folder, ALL_DESIGNS[kind.name], with_rises))
    elif step == "fit":
        rises = folder / f"{kind.name}-rises.h5"
        data = read_points(batches, rises if rises.is_file() else None, kind)
        if kind is SLIDING_WIDE:
            data = with_anchors(data, kind)
        write_atlas(finished(data, options.at_once), atlas)
        print(atlas)
    elif step == "unseen":
        if kind is LINE:
            print(line_design.write_validation(folder))
        elif kind in (LINE_SLIDING, LINE_NEWTONIAN):
            print(line_sliding_design.write_validation(folder, kind))
        else:
            print(write_validation(folder, ALL_DESIGNS[kind.name]))
    elif step == "catalogue":
        for draw in DRAWS:
            print(draw.write(folder, options.atlas and load_atlas(atlas)))
    elif step == "bearings":
        rows = []
        for draw in DRAWS:
            known = options.atlas and load_atlas(atlas)
            print(draw.text(known))
            computed = read_points([folder / f"{draw.name}.h5"], kind=draw.kind)
            own = known if known and known.kind is draw.kind else load_atlas(shipped(draw.kind))
            judged = judge(own, computed)
            print(judged.text())
            answered = len(draw.answered(known)[0])
            rows += [{**row, "answered": answered} for row in judged.rows(draw.elements)]
        write_rows(folder / "catalogue-judged.csv", rows, digits=4)
    else:
        computed = read_points([folder / f"{kind.name}-validation.h5"], kind=kind)
        judged = judge(load_atlas(atlas), computed)
        print(judged.text())
        write_rows(folder / f"{kind.name}-judged.csv", judged.rows(kind.name), digits=4)


def _known_before(batch: int, folder: Path, kind: Kind, ranks: int) -> Atlas | None:
    """Return the atlas of the batches before the block of a dependent batch."""
    later = batch - FILLING[kind.name]
    if later < 0:
        return None
    count = batch - later % BLOCK
    path = folder / f"{kind.name}-before-{count}.nc"
    if not path.is_file():
        before = [folder / f"{kind.name}-{number:02d}.h5" for number in range(count)]
        write_atlas(finished(read_points(before, kind=kind), ranks), path)
    return load_atlas(path)


if __name__ == "__main__":
    sys.exit(main())
