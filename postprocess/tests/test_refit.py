import math
from pathlib import Path

import numpy as np
import pytest
from synthetic import CONDITIONS, Columns, make_columns, taken, write_results

from ehlwave import RefitRow, RefitSettings, read_results, refit_groups, select_points
from ehlwave.results.refit import refit_warnings

SETTINGS = RefitSettings(replicates=50)


def _rows(tmp_path: Path, columns: Columns) -> dict[tuple[str, str], RefitRow]:
    points = select_points(read_results([write_results(tmp_path / "r.h5", columns)]))
    return {(row.group, row.variable): row for row in refit_groups(points, SETTINGS)}


def test_every_group_on_both_variables(tmp_path: Path) -> None:
    rows = _rows(tmp_path, make_columns())
    groups = ("all", "transverse", "isotropic", "longitudinal")
    assert list(rows) == [(group, x) for group in groups for x in ("f_v", "f_v2")]
    for (group, _), row in rows.items():
        assert row.points == (60 if group == "all" else 20)
        assert (row.conditions, row.note, row.samples) == (4, "", 50)


def test_coefficients_and_rms_on_v(tmp_path: Path) -> None:
    rows = _rows(tmp_path, make_columns(c1=0.2, c2=0.03))
    for group in ("all", "transverse", "isotropic", "longitudinal"):
        row = rows[group, "f_v"]
        assert (row.c1, row.c2) == pytest.approx((0.2, 0.03), rel=1e-7)
        assert row.rms_refit < 1e-9 < 0.01 < row.rms_paper
        assert row.c1_bootstrap == pytest.approx((0.2, 0.2), rel=1e-5)


def test_tightness_is_the_quotient_of_the_refitted_rms(tmp_path: Path) -> None:
    columns = make_columns()
    noise = np.random.default_rng(1).standard_normal(60)
    columns["amplitude_ratio_fit"] = columns["amplitude_ratio_fit"] + 0.01 * noise
    rows = _rows(tmp_path, columns)
    on_v, on_v2 = rows["all", "f_v"], rows["all", "f_v2"]
    assert on_v.tightness == on_v2.tightness == on_v2.rms_refit / on_v.rms_refit > 2
    for low, high in (on_v.c1_bootstrap, on_v.c1_profile):
        assert low < on_v.c1 < high
        assert high - low < 0.1


def test_points_of_one_shape_are_equally_tight_on_both(tmp_path: Path) -> None:
    columns = make_columns(conditions={(load, 1.0): 1.0 for load in (50.0, 100.0, 200.0)})
    noise = np.random.default_rng(1).standard_normal(45)
    columns["amplitude_ratio_fit"] = columns["amplitude_ratio_fit"] + 0.01 * noise
    assert _rows(tmp_path, columns)["all", "f_v"].tightness == 1


def test_small_groups_get_a_note(tmp_path: Path) -> None:
    columns = make_columns()
    is_few = np.flatnonzero(columns["orientation"] == "isotropic")[:3]
    chosen = np.union1d(np.flatnonzero(columns["orientation"] == "transverse"), is_few)
    rows = _rows(tmp_path, taken(columns, chosen))
    few, none = rows["isotropic", "f_v"], rows["longitudinal", "f_v"]
    assert few.note == "too few points (3; at least 4 needed)"
    assert none.note == "too few points (0; at least 4 needed)"
    assert math.isnan(few.c1)
    assert few.rms_paper > 0
    assert math.isnan(none.rms_paper)
    assert rows["transverse", "f_v"].note == ""


def test_few_conditions_have_coefficients_but_no_bootstrap(tmp_path: Path) -> None:
    two = dict(list(CONDITIONS.items())[:2])
    row = _rows(tmp_path, make_columns(conditions=two))["all", "f_v"]
    assert row.c1 == pytest.approx(0.2)
    assert math.isnan(row.c1_bootstrap[0])
    assert "2 operating condition" in row.note


def test_other_orientations_have_a_row(tmp_path: Path) -> None:
    columns = make_columns()
    columns["orientation"][columns["orientation"] == "isotropic"] = "custom"
    rows = _rows(tmp_path, columns)
    assert rows["custom", "f_v"].points == 20
    assert rows["isotropic", "f_v"].points == 0


def test_three_conditions_have_no_intervals_and_a_warning(tmp_path: Path) -> None:
    three = dict(list(CONDITIONS.items())[:3])
    rows = _rows(tmp_path, make_columns(conditions=three))
    row = rows["all", "f_v"]
    assert row.c1 == pytest.approx(0.2)
    assert math.isnan(row.c2_bootstrap[0])
    assert math.isnan(row.c2_profile[1])
    assert row.note == "no intervals (3 operating condition(s); 4 needed)"
    assert "3 operating condition(s)" in refit_warnings(list(rows.values()))[0]


def test_one_orientation_above_one_is_named(tmp_path: Path) -> None:
    columns = make_columns(c1=-0.02, c2=0.03)
    rows = _rows(tmp_path, taken(columns, columns["orientation"] == "transverse"))
    row = rows["all", "f_v"]
    assert row.c1 == pytest.approx(-0.02)
    assert math.isnan(row.c1_bootstrap[0])
    said = " / ".join(refit_warnings(list(rows.values())))
    assert "transverse waves only" in said
    assert "above 1 for f V below 0.667" in said
