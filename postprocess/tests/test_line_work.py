"""Counted work of steady line contacts against plans and the record."""

import csv
from pathlib import Path

import pytest

from studies import programs
from studies.line_work import GRIDS, PLANNED, rows_of

RECORD = Path(__file__).parents[1] / "record" / "error-vs-time" / "line-work.csv"


@pytest.mark.skipif(not programs.program("case").is_file(), reason="the programs are not built")
def test_light_contacts_take_the_planned_work_within_a_factor_of_two() -> None:
    with RECORD.open(newline="") as file:
        record = {tuple(row.values())[:5]: float(row["work_units"]) for row in csv.DictReader(file)}
    rows = rows_of([(1.0, 12.0, "barus"), (0.7, 8.0, "mcewen")])
    assert len(rows) == 2 * len(GRIDS)
    for row in rows:
        assert row["status"] in ("converged", "unresolved")
        assert 0.5 < row["work_units"] / row[PLANNED] < 2
        key = tuple(f"{cell:g}" if isinstance(cell, float) else str(cell) for cell in row.values())
        assert row["work_units"] == pytest.approx(record[key[:5]], rel=0.3)
