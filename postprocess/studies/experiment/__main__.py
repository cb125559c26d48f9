"""``python -m studies.experiment``: the experiment of the paper, section 4.

Its steps, between which ``scripts/study full`` runs the sweeps that the first three write: smooth,
trace, cosine, report.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from ehlwave.writing import Writer
from studies.experiment import FOLDER, TRACE_FILE, section
from studies.experiment.cases import COSINE, SMOOTH, TRACE, read_input
from studies.experiment.stage import write_runs
from studies.programs import ROOT
from studies.section import write_parts
from studies.sweeps import run_command

INPUTS = ROOT / "inputs" / "full"


def main(arguments: Sequence[str] | None = None) -> int:
    """Do a step; return 0, or 1 with a message on standard error."""
    parser = argparse.ArgumentParser(prog="experiment", description=__doc__)
    parser.add_argument("step", choices=(SMOOTH, TRACE, COSINE, "report"))
    parser.add_argument(
        "study", type=Path, metavar="STUDY", help=f"folder; the files are in STUDY/{FOLDER}"
    )
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> None:
    folder = options.study / FOLDER
    if options.step == "report":
        found = section(options.study)
        write_parts(found, folder, folder)
        print("\n\n".join(found.text))
        return
    Writer([INPUTS / TRACE_FILE]).text(
        folder / TRACE_FILE, (INPUTS / TRACE_FILE).read_text(encoding="utf-8")
    )
    base = read_input(INPUTS / "experiment.nml")
    print(write_runs(folder, options.step, base, folder / TRACE_FILE))


if __name__ == "__main__":
    sys.exit(main())
