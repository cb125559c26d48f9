"""Sections, tables and the page of the report on a full study."""

import csv
import re
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from synthetic import Columns, make_columns, taken, write_results

from ehlwave.contact.formula import amplitude_ratio_formula
from ehlwave.errors import ResultsError
from ehlwave.results.points import select_points
from ehlwave.results.read import read_results
from ehlwave.results.refit import RefitSettings
from studies import html
from studies.paper import line_contact, paper_points, refitted
from studies.paper.report import write_report
from studies.section import Picture, Section, comparison, comparison_row
from studies.stages import by_point, read_stage, read_stages

ERROR = 0.004


def _paper_grid(offset: float = 0.01) -> Columns:
    """Marched cases, off by ``offset`` and with too few points for the shortest wave."""
    columns = make_columns()
    for name in ("amplitude_ratio", "amplitude_ratio_fit"):
        columns[name] = columns[name] + offset
    columns["points_per_wave_x"] = 64 * columns["wavelength_x_over_a"]
    columns["points_per_wave_y"] = 20 * columns["wavelength_y_over_a"]
    per_wave = (
        np.where(columns["orientation"] == "transverse", 64, 20) * columns["wavelength_over_a"]
    )
    bad = per_wave < 8
    columns["status"] = np.where(bad, "unresolved", "converged")
    columns["is_resolved"] = np.where(bad, 0, 1)
    return columns


def _linear(c1: float = 0.2, c2: float = 0.03) -> Columns:
    columns = make_columns(c1, c2)
    columns["harmonic_extrapolated"] = columns["amplitude_ratio_fit"]
    columns["harmonic_ratio"] = columns["harmonic_extrapolated"]
    columns["harmonic_error"] = np.full(len(columns["status"]), ERROR)
    for name in ("amplitude_ratio", "amplitude_ratio_fit"):
        columns[name] = np.full(len(columns["status"]), np.nan)
    return columns


@pytest.fixture
def study(tmp_path: Path) -> Path:
    write_results(tmp_path / "paper_grid.h5", _paper_grid())
    write_results(tmp_path / "resolved.h5", _linear())
    return tmp_path


def test_points_of_both_grids_are_laid_side_by_side(study: Path) -> None:
    section = paper_points.section(study)
    table = next(table for table in section.tables if table.name == "points")
    assert len(table.data) == 60
    np.testing.assert_allclose(table.data["grid error"], 0.01, atol=1e-12)
    np.testing.assert_allclose(table.data["error bar"], ERROR * table.data["resolved"])


def test_what_the_grid_cannot_resolve_is_counted(study: Path) -> None:
    section = paper_points.section(study)
    table = next(table for table in section.tables if table.name == "unresolved_on_paper_grid")
    by_group = table.data.set_index(["orientation", "D"])
    # 20 points per a across: waves of 0.15 and 0.25 a have fewer than 8 points.
    assert by_group.loc[("longitudinal", 1.0)].iloc[1:4].to_list() == pytest.approx([2, 0.25, 3.0])
    none = by_group.loc[("transverse", 1.0)]
    assert none["not resolved"] == 0
    assert none.iloc[2:].isna().all()


def test_matching_is_by_point_and_not_by_place(study: Path) -> None:
    coarse = select_points(read_results([study / "paper_grid.h5"]), include_unresolved=True)
    columns = taken(_linear(), np.arange(59, 9, -1))
    write_results(study / "part.h5", columns)
    fine = select_points(read_results([study / "part.h5"]))
    both = by_point(coarse).join(by_point(fine).add_suffix("_fine"), how="inner")
    assert len(both) == 50
    for name in ("f_v", "wavelength_y_over_a", "radius_ratio_d"):
        np.testing.assert_allclose(both[name], both[f"{name}_fine"])
    left = paper_points.side_by_side(coarse, fine)
    assert left["resolved_ratio"].isna().sum() == 10
    np.testing.assert_allclose(left["f_v"], coarse["f_v"])


def test_a_missing_or_unfinished_stage_is_named(study: Path) -> None:
    with pytest.raises(ResultsError, match=r"dense\.h5: no such file"):
        read_stage(study, "dense")
    columns = _linear()
    columns["status"][3] = "pending"
    write_results(study / "dense.h5", columns)
    with pytest.raises(ResultsError, match="1 case"):
        read_stage(study, "dense")


def test_refits_find_the_coefficients_of_each_set(study: Path) -> None:
    write_results(study / "dense.h5", _linear(0.1, 0.05))
    for stage in refitted.RHEOLOGIES:
        write_results(study / f"{stage}.h5", _linear(0.3, 0.01))
    refits = refitted.study_refits(study, RefitSettings(replicates=5))
    found = refits[refits["group"] == "all"].set_index("name")
    assert found.loc[refitted.MAIN, ["c1", "c2"]].to_list() == pytest.approx([0.2, 0.03], rel=1e-6)
    assert found.loc["L = 12.05", "c2"] == pytest.approx(0.05, rel=1e-6)
    assert found.loc["Barus", "c1"] == pytest.approx(0.3, rel=1e-6)
    assert found.loc["paper's grid, all points", "points"] == 60
    assert found.loc["paper's grid, points it resolves", "points"] < 60
    table = refitted.refit_table(refits).data
    assert table.iloc[0].dropna().to_list() == ["", "the paper", "all", 0.15, 0.015]
    assert table["number"][table["points"] == "Barus"].to_list() == [60, 20, 20, 20]
    rows = refitted.coefficient_table(refits).data
    first = ["c1 of (18), all", "1", 0.15, pytest.approx(0.2, rel=1e-6)]
    assert rows.iloc[0, :4].to_list() == first
    assert rows["difference"][4] == pytest.approx(0.03 - 0.015, rel=1e-5)


def test_the_factor_of_the_line_contact_is_found(tmp_path: Path) -> None:
    rows = []
    for d, factor in ((0.02, 1.0), (0.0, 0.9)):
        for alphabar in (5.0, 15.0):
            for wave in np.geomspace(0.2, 4, 8):
                v = line_contact.ELLIPTIC_FACTOR * wave * alphabar**1.5 / 12.05**2
                rows.append((d, alphabar, wave, amplitude_ratio_formula(v * factor)))
    d, alphabar, wave, ratio = (np.array(column, dtype=float) for column in zip(*rows, strict=True))
    base = _linear()
    columns = {name: np.repeat(values[:1], len(rows)) for name, values in base.items()}
    columns |= {
        "radius_ratio_d": d,
        "alphabar": alphabar,
        "wavelength_over_a": wave,
        "wavelength_x_over_a": wave,
        "wavelength_y_over_a": 0 * wave,
        "harmonic_extrapolated": ratio,
        "case_id": np.array([f"c{index}" for index in range(len(rows))]),
    }
    write_results(tmp_path / "line.h5", columns)
    section = line_contact.section(tmp_path)
    table = next(table for table in section.tables if table.name == "line_factor")
    ((ratio_d, factor, best, with_one, with_paper),) = table.data.to_numpy()
    assert ratio_d == 0.02
    assert factor == pytest.approx(0.9, abs=0.02)
    assert best < with_paper < with_one


def test_seconds_of_several_starts_are_added(tmp_path: Path) -> None:
    (tmp_path / "stages.csv").write_text(
        "stage,started,seconds,ranks,git_revision,exit_status\n"
        "dense,a,100,2,r1,85\nline,b,5,2,r1,0\ndense,c,50,2,r2,0\n"
    )
    stages = read_stages(tmp_path)
    assert stages[["stage", "seconds"]].to_numpy().tolist() == [["dense", 150], ["line", 5]]
    assert stages["revision"][0] == "r2"


def films_section(_: Path) -> Section:
    figure = Figure()
    figure.subplots().plot([0, 1])
    return Section(
        "Films & <waves>",
        ["a < b"],
        [comparison("films", "Films", [comparison_row("h", "um", 0.25, 1 / 3, 0.01)])],
        [Picture("curve", "A curve", figure)],
    )


def test_the_report_stands_alone_and_keeps_all_digits(tmp_path: Path) -> None:
    value = 1 / 3
    notes: list[str] = []
    written = write_report(tmp_path, tmp_path / "out", notes.append, [("films", films_section)])
    page = written[0].read_text(encoding="utf-8")
    assert "Films &amp; &lt;waves&gt;" in page
    assert "a &lt; b" in page
    assert re.findall(r'src="(?!data:image/png;base64,)', page) == []
    assert "http" not in page
    assert "0.3333" in page
    with (tmp_path / "out/tables/films.csv").open(newline="") as file:
        ((_, *row),) = list(csv.reader(file))[1:]
    assert float(row[2]) == value
    assert float(row[3]) == pytest.approx(value - 0.25)
    assert (tmp_path / "out/figures/curve.pdf").stat().st_size > 1000
    # The first part repeats every number beside a number of the paper.
    with (tmp_path / "out/tables/paper_and_this_code.csv").open(newline="") as file:
        assert list(csv.reader(file))[1][:2] == ["Films & <waves>", "h"]


def test_cells_are_short_but_empty_ones_stay_empty() -> None:
    assert html.cell_text(float("nan")) == ""
    assert html.cell_text(None) == ""
    assert html.cell_text(0.123456) == "0.1235"
    assert html.cell_text(1234.5) == "1234"
    assert html.cell_text(672) == "672"
