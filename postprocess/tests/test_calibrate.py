"""Factors of declared errors: the table is the record's, and half of a sample covers the other."""

from pathlib import Path

import numpy as np
import pytest

from studies.calibrate import factors, sample
from studies.calibrate.contacts import classes_of, scaled, widened
from studies.programs import ROOT

RECORD = ROOT / "postprocess" / "record" / "accuracy" / "sample.csv"


def errors(kind: str, scale: float, count: int) -> list[factors.Row]:
    """Return errors whose ratios are a scale times numbers up to 1."""
    rng = np.random.default_rng(3)
    return [
        {
            **{"contact": number, "classes": "line", "quantity": "response", "kind": kind},
            **{"basis": "coarse_grid", "ratio": scale * rng.random(), "declared": 0.02},
            "before": 0.03,
        }
        for number in range(count)
    ]


def test_the_table_is_made_from_the_record() -> None:
    table = factors.read_table()
    found = factors.factors(factors.read_errors(RECORD), table)
    assert {name: float(f"{value:.3g}") for name, value in found.items()} == table


def test_a_written_table_is_read(tmp_path: Path) -> None:
    table = {name: number + 0.5 for number, name in enumerate(factors.read_table())}
    factors.write_table(table, 100, tmp_path / "table.f90")
    assert factors.read_table(tmp_path / "table.f90") == table


def test_quantiles_stand_in_for_kinds_without_a_sample() -> None:
    present = factors.read_table()
    found = factors.factors(errors("averaged line", 4.0, 400), present)
    averaged = found[factors.key("response", "averaged line", "coarse_grid")]
    assert averaged == pytest.approx(3.96, rel=0.02)
    assert found[factors.key("response", "fitted line", "coarse_grid")] >= averaged
    assert found[factors.key("response", "averaged line", "model")] >= averaged
    few = factors.factors(errors("averaged line", 0.1, factors.FEWEST - 1), present)
    assert few == present


def test_coverage_of_contacts_left_out() -> None:
    (line,) = (
        row
        for row in factors.coverage(errors("averaged line", 4.0, 400), factors.read_table())
        if row["class"] == "line"
    )
    assert 0.97 <= line["covered"] < 1
    assert line["contacts"] == 400
    assert (line["mean_bar"], line["mean_bar_before"]) == pytest.approx((0.02, 0.03))


def test_parts_have_every_contact_once(monkeypatch: pytest.MonkeyPatch) -> None:
    numbers = [n for part in range(1, 4) for n in sample.numbers_of((part, 3), 20)]
    assert sorted(numbers) == list(range(20))
    assert sample.part_of("2/8") == (2, 8)
    assert sample.part_of(None) == (1, 1)
    monkeypatch.setenv("SLURM_PROCID", "3")
    monkeypatch.setenv("SLURM_NTASKS", "16")
    assert sample.part_of(None) == (4, 16)


def test_grids_of_a_contact() -> None:
    row = {"radius_ratio_d": 0.5, "cells_x": 32, "cells_y": 48, "slip_parameter": 1.2}
    assert classes_of(row) == ["slip", "ellipse"]
    assert (scaled(row, 0.5)["cells_x"], scaled(row, 4)["cells_y"]) == (16, 192)
    wide = widened(row)
    assert (wide["x_max"] - wide["x_min"]) / wide["cells_x"] == 4 / 32
    assert 2 * wide["y_max"] / wide["cells_y"] == 4 / 48


def test_contacts_of_all_parts_are_kept(tmp_path: Path) -> None:
    for part, number in ((1, 5), (2, 3)):
        folder = tmp_path / f"part-{part}-of-2"
        folder.mkdir()
        (folder / f"{number}.json").write_text(f'{{"number": {number}}}')
    assert sample.kept(tmp_path) == [{"number": 3}, {"number": 5}]
