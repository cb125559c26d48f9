"""Factors of declared errors: the table is the record's, and half of a sample covers the other."""

from pathlib import Path

import numpy as np
import pytest

from studies.calibrate import coverage, factors, judged, sample
from studies.calibrate.contacts import classes_of, scaled, widened
from studies.programs import ROOT

RECORD = ROOT / "postprocess" / "record" / "accuracy" / "sample.csv.xz"


def errors(kind: str, scale: float, count: int) -> list[factors.Row]:
    """Return errors whose ratios are a scale times numbers up to 1."""
    rng = np.random.default_rng(3)
    return [
        {
            **{"contact": number, "classes": "line", "quantity": "response", "kind": kind},
            **{"basis": "coarse_grid", "off": 0.02 * scale * rng.random(), "rule": 0.02},
            **{"film": 0.0, "before": 0.03, "is_large": ".false.", "resolved": ".true."},
        }
        for number in range(count)
    ]


def test_the_table_is_made_from_the_record() -> None:
    table = factors.read_table()
    found = factors.factors(factors.read_errors(RECORD), table)
    assert {name: float(f"{value:.3g}") for name, value in found.items()} == table


def test_a_written_table_is_read(tmp_path: Path) -> None:
    table = {name: number + 0.5 for number, name in enumerate(factors.read_table())}
    assert len(table) == sum(len(names) for names in factors.TABLES.values())
    factors.write_table(table, 100, tmp_path / "table.f90")
    assert factors.read_table(tmp_path / "table.f90") == table


def test_quantiles_stand_in_for_kinds_without_a_sample() -> None:
    present = dict.fromkeys(factors.read_table(), 0.1)
    found = factors.factors(errors("averaged line", 4.0, 400), present)
    averaged = found[factors.key("response", "averaged line", "coarse_grid")]
    assert averaged == pytest.approx(3.96, rel=0.02)
    for quantity in ("response", "amplitude_ratio"):
        assert found[factors.key(quantity, "fitted line", "coarse_grid")] == averaged
    by_model = found[factors.key("response", "averaged line", "model")]
    assert by_model == pytest.approx(factors.MODEL_SHARE * averaged)
    films = factors.key("central_film", "fitted line", "coarse_grid")
    assert found[films] == present[films]


def test_few_contacts_have_a_factor_by_their_spread() -> None:
    many, few = errors("averaged line", 1.0, 400), errors("fitted line", 0.1, factors.FEWEST - 1)
    found = factors.factors(many + few, factors.read_table())
    name = factors.key("response", "fitted line", "coarse_grid")
    assert found[name] == pytest.approx(0.099, rel=0.04)
    few = errors("fitted line", 5.0, factors.FEWEST - 1)
    largest = max(factors.ratio(row, found) for row in few)
    bound = factors.factors(many + few, found)[name]
    assert largest <= bound == pytest.approx(5 * 0.99, rel=0.02)  # alike, five times as far spread


def test_fewest_contacts_have_the_bound_of_all() -> None:
    many, few = errors("averaged line", 1.0, 400), errors("fitted line", 0.1, factors.FEW - 1)
    found = factors.factors(many + few, factors.read_table())
    every = found[factors.key("response", "averaged line", "coarse_grid")]
    name = factors.key("response", "fitted line", "coarse_grid")
    assert found[name] == pytest.approx(every, rel=0.02)


def test_a_tail_continues_a_small_sample() -> None:
    rng = np.random.default_rng(5)
    samples = np.exp(rng.exponential(0.2, (400, 60)))
    bounds = np.array([factors._bound(one) for one in samples])
    beyond = np.mean(np.exp(rng.exponential(0.2, 400)) > bounds)
    assert beyond < 0.02
    assert np.median(bounds) == pytest.approx(100**0.2, rel=0.1)
    assert factors._bound(np.ones(2)) == 1


def test_shares_of_oil_outside_count_beside_the_film() -> None:
    contact = {
        **{"number": 3, "classes": ["ellipse"], "before": {}, "truth": {}},
        "wide": {"rolling_resistance": 0.93},
    }
    found = {
        **{"scheme": "averaged", "film_error_basis": "model", "is_resolved": True},
        **{"rolling_resistance": 1.0, "rolling_resistance_error": 0.1},
        **{"rolling_resistance_error_domain": 0.06, "film_error_domain": 0.02},
    }
    table = dict.fromkeys(factors.read_table(), 2.0)
    (domain,) = judged._errors(contact, found, table)
    own = factors.key("rolling", factors.DOMAIN, factors.DOMAIN)
    for film in (2.0, 1.0):  # the part of the film follows its own factor
        other = table | {factors.FILM: film, own: 3.0}
        assert factors.ratio(domain, other) == pytest.approx((0.07 - 0.01 * film) / 0.02, rel=1e-3)
        assert factors.declared(domain, other) == pytest.approx(0.01 * film + 3 * 0.02)
    (starved,) = judged._errors(contact | {"classes": ["starved"]}, found, table)
    assert factors.ratio(starved, table) == pytest.approx(0.07 / 0.06, rel=1e-3)
    assert factors.factors([starved], table) == table


@pytest.mark.parametrize(("column", "value"), [("is_large", ".true."), ("resolved", ".false.")])
def test_results_with_a_warning_count_apart(column: str, value: str) -> None:
    large = [row | {column: value} for row in errors("averaged line", 90.0, 400)]
    rows = errors("averaged line", 4.0, 400) + large
    present = factors.read_table()
    assert factors.factors(rows, present) == factors.factors(rows[:400], present)
    names = {row["class"] for row in coverage.coverage(rows, present)}
    apart = "large" if column == "is_large" else "unresolved"
    assert names == {"all", "averaged line", "line", apart}


def test_coverage_of_contacts_left_out() -> None:
    (line,) = (
        row
        for row in coverage.coverage(errors("averaged line", 4.0, 400), factors.read_table())
        if row["class"] == "line"
    )
    assert 0.97 <= line["covered"] < 1
    assert line["contacts"] == 400
    table = factors.read_table()
    bar = 0.02 * table[factors.key("response", "averaged line", "coarse_grid")]
    assert (line["mean_bar"], line["over_before"]) == pytest.approx((bar, bar / 0.03))


def test_few_contacts_cannot_be_outside_by_chance() -> None:
    row = {"class": "line", "covered": 0.96, "probability": 0.2, "probability_above": 1.0}
    assert coverage.deviating([row]) == []
    low, high = row | {"probability": 1e-4}, row | {"probability_above": 1e-4}
    assert coverage.deviating([row, low, high]) == [low, high]
    assert coverage.deviating([low | {"class": factors.APART[0]}]) == []


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


def test_errors_by_mesh_and_domain() -> None:
    contact = {
        "number": 3,
        "classes": ["line"],
        "truth": {"central_film": 1.1, "friction_coefficient": 2e-6},
        "wide": {"central_film": 0.98},
        "before": {"central_film": 0.3},
    }
    found = {
        "scheme": "averaged",
        **{"central_film": 1.0, "friction_coefficient": 1e-6, "friction_error": 0.1},
        **{"film_error_mesh": 0.2, "film_error_domain": 0.04, "friction_error_domain": 0.0},
        **{"film_error_basis": "model", "is_resolved": True},
    }
    table = dict.fromkeys(factors.read_table(), 2.0)
    mesh, domain = judged._errors(contact, found, table)
    assert (mesh["kind"], domain["kind"]) == ("averaged line", factors.DOMAIN)
    assert (mesh["off"], domain["off"]) == pytest.approx((0.1, 0.02))
    over = [factors.ratio(row, table) for row in (mesh, domain)]
    assert over == pytest.approx([1.0, 1.0], rel=1e-3)
    assert [factors.declared(row, table) for row in (mesh, domain)] == pytest.approx([0.2, 0.04])
    assert not mesh["is_large"]
    (large, _) = judged._errors(contact, found | {"film_error_mesh": 0.7}, table)
    assert large["is_large"]


def test_recorded_contacts_have_the_text_of_their_files(tmp_path: Path) -> None:
    rows = [{"row": {"viscosity_table": "pressure_pa\n1\n"}}, {"row": {"load_n": 3}}]
    judged.write_contacts(tmp_path / "contacts.jsonl.xz", rows)
    assert judged.read_contacts(tmp_path / "contacts.jsonl.xz") == rows


def test_finer_runs_are_limited_by_counted_work(monkeypatch: pytest.MonkeyPatch) -> None:
    row = {"radius_ratio_d": 0.5, "cells_x": 32, "cells_y": 48}
    base = {"central_film": 0.1, "cells_x": 32, "cells_y": 48, "total_work_units": 1000.0}
    monkeypatch.setattr(sample, "drawn", lambda *_: row)
    monkeypatch.setattr(sample, "solved", lambda *_: base)
    counted = 1000 * 32 * 48 * 4
    for most, names in (
        (counted - 1, []),
        (counted, ["double", "wide"]),
        (4 * counted, ["fourfold"]),
    ):
        monkeypatch.setattr(sample, "LARGEST_COST", most)
        runs = sample.computed(1, {}, Path())["runs"]
        assert set(names) <= set(runs)
        assert ("fourfold" in runs) == (most >= 4 * counted)
        assert ("double" in runs) == (most >= counted)


def test_contacts_of_all_parts_are_kept(tmp_path: Path) -> None:
    for part, number in ((1, 5), (2, 3)):
        folder = tmp_path / f"part-{part}-of-2"
        folder.mkdir()
        (folder / f"{number}.json").write_text(f'{{"number": {number}}}')
    assert sample.kept(tmp_path) == [{"number": 3}, {"number": 5}]
