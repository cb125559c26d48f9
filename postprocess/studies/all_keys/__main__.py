"""Test of declared errors: random inputs over every key."""

import json
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from ehlwave.writing import Writer
from studies.all_keys.check import draw_planned, offenders, run_both
from studies.all_keys.draw import Row
from studies.all_keys.table import key_groups
from studies.command import checks
from studies.command.options import step_parser
from studies.sweeps import write_rows


def report(cases: list[Row], folder: Path) -> int:
    """Print and write the offenders; return 1 if there is any."""
    rows, summary = offenders(cases)
    write_rows(folder / "offenders.csv", rows)
    print(summary)
    for row in rows:
        print("  " + ", ".join(f"{key} {_short(value)}" for key, value in row.items()))
    return int(bool(rows))


def _short(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def main() -> int:
    """Draw, run, compare."""
    parser = step_parser(checks.accuracy, __doc__)
    parser.add_argument("folder", type=Path)
    parser.set_defaults(seed=33)
    parser.add_argument("--report", action="store_true", help="of what is there, run nothing")
    options = parser.parse_args()
    Writer().folder(options.folder)
    if options.report:
        files = sorted(options.folder.glob("[0-9][0-9][0-9][0-9].json"))
        return report([json.loads(file.read_text()) for file in files], options.folder)
    known = key_groups()
    drawn = draw_planned(options.count, options.seed, options.folder, known)

    def run(number: int) -> Row:
        return run_both(number, *drawn[number], options.folder, known)

    with ThreadPoolExecutor(options.at_once) as pool:
        cases = list(pool.map(run, range(len(drawn))))
    return report(cases, options.folder)


if __name__ == "__main__":
    sys.exit(main())
