"""The commands behind ``scripts/atlas``: write sweeps, fit the atlas to their results, judge it.

All but the last print the path of what they wrote.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from ehlwave.atlas import Atlas, load_atlas
from ehlwave.atlas.atlas import shipped
from ehlwave.atlas.kinds import KINDS, LINE, SLIDING, Kind
from studies.atlas import line_design, sliding_batches
from studies.atlas.design import DESIGNS, write_batch, write_chosen, write_rises, write_validation
from studies.atlas.fit import finished
from studies.atlas.points import read_points
from studies.atlas.store import write_atlas
from studies.atlas.validate import judge
from studies.sweeps import run_command

FIRST_BATCHES = {"rolling": 3, "sliding": 8, "line": 2}
"""Batches that fill the ranges evenly; later ones go where the errors are."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Do one step; return 0, or 1 with a message."""
    parser = argparse.ArgumentParser(prog="atlas", description=__doc__)
    parser.add_argument("step", choices=("batch", "rises", "fit", "unseen", "validate"))
    parser.add_argument("folder", type=Path, help="of sweeps and their results; made when absent")
    parser.add_argument("--batch", type=int, default=0, metavar="N", help="counted from 0")
    parser.add_argument("--kind", choices=tuple(KINDS), default="rolling")
    parser.add_argument("--atlas", type=Path, metavar="FILE.nc", help="default: the package's")
    return run_command(parser, _do, arguments)


def _do(options: argparse.Namespace) -> None:
    folder, step, kind = options.folder, options.step, KINDS[options.kind]
    atlas = options.atlas or shipped(kind)
    batches = sorted(folder.glob(f"{kind.name}-[0-9][0-9].h5"))
    if step == "batch":
        print(_next_batch(folder, options.batch, kind, batches, atlas))
    elif step == "rises":
        print(write_rises(folder, read_points(batches)))
    elif step == "fit":
        rises = folder / "rises.h5"
        data = read_points(batches, rises if rises.is_file() else None, kind)
        write_atlas(finished(data), atlas)
        print(atlas)
    elif step == "unseen":
        if kind is LINE:
            print(line_design.write_validation(folder))
        else:
            print(write_validation(folder, DESIGNS[kind.name]))
    else:
        computed = read_points([folder / f"{kind.name}-validation.h5"], kind=kind)
        print(judge(load_atlas(atlas), computed).text())


def _next_batch(folder: Path, batch: int, kind: Kind, batches: Sequence[Path], atlas: Path) -> Path:
    """Write the sweep of a batch, fitting the atlas to those before where it is chosen by that."""
    known = None
    if kind is SLIDING and batch >= sliding_batches.FIRST:
        if not sliding_batches.fills(batch):
            count = sliding_batches.block_start(batch)
            before = folder / f"sliding-before-{count}.nc"
            known = (
                load_atlas(before) if before.is_file() else _fitted(batches[:count], kind, before)
            )
        chosen = sliding_batches.chosen_contacts(batch, known)
        return write_chosen(folder, batch, DESIGNS[kind.name], chosen)
    if batch >= FIRST_BATCHES[kind.name]:
        known = _fitted(batches, kind, atlas)
    if kind is LINE:
        return line_design.write_batch(folder, batch, known)
    return write_batch(folder, batch, DESIGNS[kind.name], known)


def _fitted(batches: Sequence[Path], kind: Kind, atlas: Path) -> Atlas:
    """Fit the atlas to some batches, and write it."""
    write_atlas(finished(read_points(batches, kind=kind)), atlas)
    return load_atlas(atlas)


if __name__ == "__main__":
    sys.exit(main())
