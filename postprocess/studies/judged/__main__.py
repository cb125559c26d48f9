"""The command behind ``scripts/study judged``: laws of the package against computed contacts."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from studies.command import laws
from studies.command.options import step_parser
from studies.judged import answers, heavy_films, isothermal, sheared_waves, warm_waves
from studies.sweeps import Row, run_command, write_rows

FITTED = {"heavy-films": heavy_films, "sheared-waves": sheared_waves, "warm-waves": warm_waves}
COUNTS = {
    "answers": 400,
    "heavy-films": 490,
    "sheared-waves": 400,
    "warm-waves": 220,
    "isothermal": 240,
}
"""Numbers of contacts, by the parts of the study."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Compute, fit, write the records; return 1 if an error of the package does not hold."""
    return run_command(step_parser(laws.judged, __doc__), _run, arguments)


def _run(options: argparse.Namespace) -> int:
    rows: list[Row] = []
    for part, count in COUNTS.items():
        if options.part is None or options.part.name == part:
            rows += _part(part, options.contacts or count, options.output, options.write)
    for row in rows:
        print(", ".join(f"{k} {v:.4g}" if isinstance(v, float) else str(v) for k, v in row.items()))
    write_rows(options.output / "coverage.csv", rows, digits=4)
    return int(any(row["within"] < 0.95 or row["beyond_1.5"] > 0.01 for row in _ours(rows)))


def _ours(rows: Sequence[Row]) -> list[Row]:
    """Return rows of present laws; the others show their predecessors."""
    return [row for row in rows if row["law"] not in ("before", "ridges, rolling", "isothermal")]


def _part(part: str, count: int, folder: Path, write: bool) -> list[Row]:
    path = folder / f"{part.replace('-', '_')}.jsonl"
    if part == "answers":
        return answers.study(path, count)
    module = FITTED.get(part, isothermal)
    rows = module.computed(path, count, 1)
    write_rows(path.with_suffix(".csv"), rows, digits=5)
    if module is isothermal:
        names = ("central", "smallest", "response", "friction")
        return [
            answers.judged([isothermal.times(row, name) for row in rows], name, part)
            for name in names
        ]
    if part == "heavy-films":
        found, table = heavy_films.fit(heavy_films.usable(rows))
    else:
        module = sheared_waves if part == "sheared-waves" else warm_waves
        found, table = module.fit(module.compared(rows))
    if write:
        FITTED[part].write(found)
    return [{"part": part, **row} for row in table]


if __name__ == "__main__":
    sys.exit(main())
