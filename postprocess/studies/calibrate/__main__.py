"""Calibration of declared errors: draw and compute contacts, judge them, write the factors."""

import argparse
import sys
from pathlib import Path

from ehlwave.writing import Writer
from studies.all_keys.table import key_groups
from studies.calibrate import coverage, factors, judged, sample
from studies.command import checks
from studies.command.options import step_parser
from studies.programs import ROOT
from studies.sweeps import Row, write_rows

RECORD = ROOT / "postprocess" / "record" / "accuracy"
CONTACTS, SAMPLE = RECORD / "contacts.jsonl.xz", "sample.csv.xz"


def main() -> int:
    """Extend the sample by a part of the contacts, or judge all of it."""
    parser = step_parser(checks.accuracy, __doc__)
    parser.add_argument("what", choices=["extend", "judge"])
    parser.add_argument("folder", type=Path)
    options = parser.parse_args()
    Writer().folder(options.folder)
    known = key_groups()
    if options.what == "extend":
        recorded = {one["number"] for one in judged.read_contacts(CONTACTS)}
        part = sample.part_of(options.part)
        sample.extend(options.folder, part, options.contacts, known, recorded)
        return 0
    return _judge(options, known)


def _judge(options: argparse.Namespace, known: dict[str, str]) -> int:
    """Write contacts, errors, factors and coverage; return 1 where a class is not covered."""
    contacts = {one["number"]: one for one in judged.read_contacts(CONTACTS)}
    fresh = (judged.distilled(one) for one in sample.kept(options.folder))
    contacts |= {one["number"]: one for one in fresh if one is not None}
    judged.write_contacts(CONTACTS, contacts.values())
    table = factors.read_table()
    rows: list[Row] = []
    for contact in contacts.values():
        rows += judged.errors_of(contact, table, known, options.folder)
    return conclude(rows, table, options.folder)


def conclude(rows: list[Row], table: dict[str, float], folder: Path) -> int:
    """Write errors, factors and coverage; return 1 where a class is not covered."""
    _record(rows, SAMPLE, folder)
    rows = factors.read_errors(RECORD / SAMPLE)
    found = factors.factors(rows, table)
    held_out = coverage.coverage(rows, found)
    _record(held_out, "coverage.csv", folder)
    factors.write_table(found, len({row["contact"] for row in rows}))
    outside = coverage.deviating(held_out)
    for row in held_out:
        mark = "* " if row in outside else ""
        cells = (f"{k} {v:.4g}" if isinstance(v, float) else str(v) for k, v in row.items())
        print(mark + ", ".join(cells))
    return int(any(row["covered"] < coverage.LEAST for row in outside))


def _record(rows: list[Row], name: str, folder: Path) -> None:
    """Write a table to the folder of the run, and to the record in place of the former."""
    write_rows(folder / name, rows, digits=4)
    Writer(overwrite=True).data(RECORD / name, (folder / name).read_bytes())


if __name__ == "__main__":
    sys.exit(main())
