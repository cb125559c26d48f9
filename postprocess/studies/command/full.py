"""The stages of the study of the paper. All run in the folder of the study."""

import argparse
import os
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from ehlwave.writing import Writer
from studies.command import steps
from studies.command.options import at_once, choices, output, study

INPUTS = steps.ROOT / "inputs" / "full"
OILS = {
    "default": "",
    "barus": "viscosity_law = 'barus'",
    "incompressible": "density_law = 'incompressible'",
    "index": "roelands_index = 0.4",
    "alpha": "pressure_viscosity_per_pa = 1.1e-8",
}
"""The content of ``&lubricant`` in each sweep of the stage rheology."""


def _sweep(name: str, file: Path | None = None) -> int:
    """Run a sweep file, by default the file of its name in inputs/full."""
    return steps.sweep(file or INPUTS / f"{name}.nml", "--output", Path.cwd() / f"{name}.h5")


def _sweep_of_text(name: str, text: str) -> int:
    return _sweep(name, Writer(overwrite=True).text(Path.cwd() / f"{name}.nml", text))


def _input(name: str) -> str:
    return (INPUTS / f"{name}.nml").read_text(encoding="utf-8")


def _sweep_of_rows(name: str, like: str = "") -> int:
    """Run a sweep with computed rows, or a similar sweep with rows of its own."""
    steps.python("paper.cases", name, f"{name}.csv")
    return _sweep_of_text(name, _input(like).replace(like, name)) if like else _sweep(name)


def _rheology(oil: str) -> int:
    return _sweep_of_text(f"rheology-{oil}", f"{_input('rheology')}&lubricant {OILS[oil]} /\n")


def _two_waves() -> int:
    """Run the fit cases of the law, and other conditions as a test."""
    status = 0
    for name in ("two_waves", "two_waves_fresh"):
        steps.python("two_waves.cases", name, f"{name}.csv")
        status |= _sweep_of_text(name, _input("two_waves").replace("two_waves.", f"{name}."))
    return status


def _sliding() -> int:
    """Run ridges and dimples that slide, and the cases to predict them from."""
    (names,) = steps.written("two_waves.shapes", Path.cwd())
    return max([_sweep(name, Path.cwd() / f"{name}.nml") for name in names.split()])


def _experiment() -> int:
    for surface in ("smooth", "trace", "cosine"):  # its amplitude is counted in the smooth film
        steps.python("experiment", surface, Path.cwd())
        name = f"experiment/{surface}"
        if status := _sweep(name, Path.cwd() / f"{name}.nml"):
            return status
    return steps.report("experiment", "report", Path.cwd())


# Short stages first: they show early whether all is well.
STAGES: dict[str, Callable[[], int]] = {
    "companion": partial(_sweep, "companion"),
    "line": partial(_sweep_of_rows, "line"),
    **{f"rheology-{oil}": partial(_rheology, oil) for oil in OILS},
    "sliding": _sliding,
    "fresh": partial(_sweep_of_rows, "fresh", like="dense"),
    "dense": partial(_sweep_of_rows, "dense"),
    "two_waves": _two_waves,
    "resolved": partial(_sweep, "resolved"),
    "experiment": _experiment,
    "paper_grid": partial(_sweep, "paper_grid"),
    "report": lambda: steps.report("paper", Path.cwd(), "--output", Path.cwd() / "report"),
}
NAMES = tuple(dict.fromkeys(name.split("-")[0] for name in STAGES))


@study("full", output("full"), at_once(), choices("--stage", NAMES, "this stage only"))
def run(options: argparse.Namespace) -> int:
    """Compute and report the results of the paper: scripts/reproduce --full.

    Runs every stage that is not finished, then writes DIR/report. Needs a build, which
    scripts/reproduce makes. Finished cases are kept, and long transients go on from their
    checkpoints. EHLWAVE_PROGRAMS names another folder of programs.

    Exit status: 0 done; 1 done, but some cases did not converge; 85 stopped, to be continued;
    otherwise the status of the failed stage.
    """
    programs = Path(os.environ.get("EHLWAVE_PROGRAMS") or steps.DRIVERS)
    os.environ["EHLWAVE_SWEEP"] = str(programs / "ehlwave-sweep")
    if not os.access(os.environ["EHLWAVE_SWEEP"], os.X_OK):
        raise steps.refuse(f"no ehlwave-sweep in {programs}: run scripts/build")
    steps.find_python()
    # A relative case_file in a sweep file counts from the current folder.
    os.chdir(Writer().folder(options.output))
    names = [name for name in STAGES if name.split("-")[0] in (options.stage or NAMES)]
    return max([_timed(name) for name in names])


def _timed(name: str) -> int:
    """Run a stage and note its time, also if stopped; return 0, or 1."""
    started = time.time()
    print(f"\n== Stage {name}  [{time.strftime('%H:%M:%S')}]", flush=True)
    try:
        status = STAGES[name]()
    except steps.StoppedError as stopped:
        status = stopped.status
    _note(name, started, status)
    if status > 1:
        said = f"stage {name} ended with exit status {status}; the same command goes on."
        print(f"\nscripts/study full: {said}", file=sys.stderr)
        raise steps.StoppedError(status)
    return status


def _note(name: str, started: float, status: int) -> None:
    """Add a row to stages.csv."""
    describe = ("git", "-C", steps.ROOT, "describe", "--always", "--dirty", "--abbrev=12")
    found = subprocess.run(describe, capture_output=True, text=True, check=False)
    row = {
        "stage": name,
        "started": time.strftime("%FT%T%z", time.localtime(started)),
        "seconds": int(time.time()) - int(started),
        "ranks": os.environ["EHLWAVE_RANKS"],
        "git_revision": found.stdout.strip() or "unknown",
        "exit_status": status,
    }
    path = Path("stages.csv")
    before = path.read_text(encoding="utf-8") if path.is_file() else ",".join(row) + "\n"
    line = ",".join(map(str, row.values()))
    Writer(overwrite=True).text(path, f"{before}{line}\n")
