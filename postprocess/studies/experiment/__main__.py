"""``python -m studies.experiment``: the experiment of the paper, section 4."""

import argparse
import shutil
import signal
import sys
from pathlib import Path

from ehlwave_post.errors import ResultsError
from studies.experiment import FOLDER, TRACE_FILE, section
from studies.experiment.cases import all_runs, read_input
from studies.experiment.stage import Stage
from studies.programs import ROOT
from studies.section import write_picture, write_table

INPUTS = ROOT / "inputs" / "full"


def main() -> int:
    """Run the stage; return 0, or 1 with a message on standard error."""
    parser = argparse.ArgumentParser(
        prog="python -m studies.experiment",
        description="Run the experiment of Venner, Kaneta and Lubrecht (2000), section 4, and "
        f"write its tables and figures, all in FOLDER/{FOLDER}. What is done is not run again.",
    )
    parser.add_argument("--case-program", type=Path, required=True, metavar="PATH")
    parser.add_argument("--output", type=Path, required=True, metavar="FOLDER")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="cases at a time")
    parser.add_argument(
        "--inputs",
        type=Path,
        default=INPUTS,
        metavar="FOLDER",
        help="of experiment.nml and sputtered_profile.csv; default: the source's inputs/full",
    )
    options = parser.parse_args()
    if options.jobs < 1:
        parser.error(f"--jobs {options.jobs}: give 1 or more")
    # A time limit's signal ends the programs that run, too.
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))
    folder = options.output.resolve() / FOLDER
    try:
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(options.inputs / TRACE_FILE, folder / TRACE_FILE)
        base = read_input(options.inputs / "experiment.nml")
        stage = Stage(options.case_program.resolve(), folder, base)
        stage.prepare_surface(folder / TRACE_FILE)
        stage.run_all(all_runs(), options.jobs)
        found = section(options.output)
        for table in found.tables:
            write_table(table, folder)
        for picture in found.pictures:
            write_picture(picture, folder)
    except (ResultsError, OSError) as error:
        print(f"experiment: error: {error}", file=sys.stderr)
        return 1
    print("\n\n".join(found.text))
    return 0


if __name__ == "__main__":
    sys.exit(main())
