"""The passage of two rough maps through a ball contact whose surfaces touch: share and time."""

import argparse
import random
import resource
import sys
import tempfile
from pathlib import Path
from typing import Any

from ehlwave.writing import write_new_text
from studies import programs, touching
from studies.judged.runs import kept

HERTZ_PA = 0.6e9
SPEED_M_PER_S = 0.1
SLIP = 1.1
RQ_M = 1.5e-7
"""Roughness of both surfaces together."""
END_TIME = 5.0
"""Both maps fill the contact until then."""
_VALUES = (
    *("status", "message", "touching_share", "touching_share_error", "residual"),
    *("time_steps", "nonlinear_steps", "linear_steps", "peak_memory_mib"),
)


def groups_of(cells: int, folder: Path) -> touching.Groups:
    """Return the groups of the pair on a square mesh; its maps are written to the folder."""
    conditions, width, _ = touching.contact_of(HERTZ_PA, SPEED_M_PER_S, SLIP, is_line=False)
    for number in (1, 2):
        path = folder / f"map{number}.h5"
        touching.write_map(path, random.Random(number), RQ_M / 2**0.5, width, is_line=False)
    return touching.smooth_case(conditions, cells, is_line=False) | {
        "surface": {"file": "map1.h5"},
        "surface2": {"file_2": "map2.h5"},
        "dynamics": {"end_time": END_TIME},
    }


def solve(cells: int, _folder: Path) -> dict[str, Any]:
    """Compute the passage."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_new_text(folder / "case.nml", programs.namelist(groups_of(cells, folder)))
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        outcome = programs.run("case", "case.nml", "--json", "--quiet", folder=folder)
    after = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    found = programs.last_line(outcome)
    return {key: found.get(key) for key in _VALUES} | {"processor_s": round(after - before, 1)}


def main() -> int:
    """Compute the pair if the record lacks it, and print its values."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cells", type=int, default=64, help="cells along X and Y (default 64)")
    parser.add_argument("--record", type=Path, required=True, help="lines of JSON; goes on")
    options = parser.parse_args()
    (found,) = kept(options.record, [options.cells], solve, 1)
    sys.stdout.write(
        f"{options.cells} x {options.cells} cells: {found['status']} {found['message']}\n"
        f"share of the solids {found['touching_share']}, error {found['touching_share_error']}, "
        f"mass within {found['residual']:.1e}\n{found['time_steps']} time steps; with wider meshes "
        f"{found['nonlinear_steps']} Newton steps, {found['linear_steps']} GMRES steps, "
        f"{found['processor_s']} s of a processor\n"
    )
    return int(found["touching_share"] is None)


if __name__ == "__main__":
    sys.exit(main())
