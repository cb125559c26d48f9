from pathlib import Path

import numpy as np
import pytest
from synthetic import Columns, make_columns, taken, write_results
from xarray import Dataset

from ehlwave import (
    amplitude_ratio_formula,
    collapse_figure,
    fit_formula,
    read_results,
    select_points,
    write_figure,
)
from ehlwave.results.figures import outside_axes
from ehlwave.results.points import Variable, of_orientation

ORIENTATIONS = ("transverse", "isotropic", "longitudinal")
GREY = "0.6"


def _points(tmp_path: Path, columns: Columns) -> Dataset:
    results = read_results([write_results(tmp_path / "r.h5", columns)])
    return select_points(results, include_unresolved=True)


@pytest.mark.parametrize("variable", ["f_v", "f_v2"])
def test_three_panels_with_all_points(tmp_path: Path, variable: Variable) -> None:
    points = _points(tmp_path, make_columns())
    figure = collapse_figure(points, variable)
    assert [axes.texts[0].get_text() for axes in figure.axes] == list(ORIENTATIONS)
    for axes, orientation in zip(figure.axes, ORIENTATIONS, strict=True):
        assert axes.get_xscale() == "log"
        assert axes.get_xlim() == (0.1, 100)
        assert axes.get_ylim()[0] == 0
        assert 1 < axes.get_ylim()[1] < 1.2
        drawn = [line for line in axes.lines if line.get_linestyle() == "None"]
        expected = of_orientation(points, orientation)
        assert len(drawn) == 4
        x, y = (np.concatenate([getattr(line, f"get_{k}data")() for line in drawn]) for k in "xy")
        np.testing.assert_array_equal(np.sort(x), np.sort(expected[variable].values))
        np.testing.assert_array_equal(np.sort(y), np.sort(expected["deformed_ratio"].values))


def test_curves_are_the_formula_and_the_refit(tmp_path: Path) -> None:
    points = _points(tmp_path, make_columns())
    fit = fit_formula(points["f_v2"].values, points["deformed_ratio"].values)
    figure = collapse_figure(points, "f_v2")
    for axes in figure.axes:
        dashed, solid = (
            next(line for line in axes.lines if line.get_linestyle() == kind)
            for kind in ("--", "-")
        )
        x = dashed.get_xdata()
        np.testing.assert_allclose(dashed.get_ydata(), amplitude_ratio_formula(x, 0.15, 0.015))
        x = solid.get_xdata()
        np.testing.assert_allclose(solid.get_ydata(), amplitude_ratio_formula(x, fit.c1, fit.c2))
        fitted = points["f_v2"].values
        assert (x[0], x[-1]) == pytest.approx((fitted.min(), fitted.max()))
    labels = [text.get_text() for text in figure.axes[1].get_legend().get_texts()]
    assert f"{fit.c1:.3g}" in labels[1]
    assert f"{fit.c2:.3g}" in labels[1]


def test_markers_of_the_paper_and_of_another_d(tmp_path: Path) -> None:
    columns = make_columns()
    columns["radius_ratio_d"][columns["radius_ratio_d"] == 0.35] = 0.5
    figure = collapse_figure(_points(tmp_path, columns), "f_v")
    handles = figure.axes[0].get_legend().legend_handles
    found = {handle.get_label(): handle.get_marker() for handle in handles}
    expected = {"$D = 1$": "o", "$D = 0.5$": "s", "$D = 0.12$": r"$\odot$", "$D = 0.04$": "x"}
    assert found == expected


def test_unresolved_points_are_grey_and_not_fitted(tmp_path: Path) -> None:
    columns = make_columns()
    columns["is_resolved"][:2] = 0
    columns["amplitude_ratio_fit"][:2] = 0.1
    figure = collapse_figure(_points(tmp_path, columns), "f_v")
    grey = [line for line in figure.axes[0].lines if line.get_markeredgecolor() == GREY]
    assert [line.get_ydata().tolist() for line in grey] == [[0.1, 0.1]]
    names = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert "grey: unresolved" in names
    label = figure.axes[1].get_legend().get_texts()[1].get_text()
    assert label == "refitted\n$c_1=0.2$\n$c_2=0.03$"


def test_no_refitted_curve_without_resolved_points(tmp_path: Path) -> None:
    columns = make_columns()
    columns["is_resolved"][:] = 0
    figure = collapse_figure(_points(tmp_path, columns), "f_v")
    assert len(figure.axes[1].get_legend().get_texts()) == 1
    assert [line.get_linestyle() for line in figure.axes[2].lines].count("-") == 0


def test_error_bars_lie_inside_the_axes(tmp_path: Path) -> None:
    points = _points(tmp_path, make_columns())
    assert collapse_figure(points, "f_v").axes[0].get_ylim() == (0, 1.08)
    points["deformed_error"][:] = 0.2
    tops = (points["deformed_ratio"] + points["deformed_error"]).max()
    figure = collapse_figure(points, "f_v", color_by="load_parameter_m")
    assert all(axes.get_ylim()[1] > tops for axes in figure.axes)
    assert figure.axes[2].get_legend().get_title().get_text() == "M"


def test_points_outside_the_axes_are_counted(tmp_path: Path) -> None:
    columns = make_columns()
    columns["v"][0] = 200
    columns["amplitude_ratio_fit"][1] = 1.5
    points = _points(tmp_path, columns)
    assert outside_axes(points, "f_v") == 2
    assert outside_axes(points, "f_v2") == 1


def test_files_are_written_and_repeatable(tmp_path: Path) -> None:
    points = _points(tmp_path, make_columns())
    contents = []
    for name in ("a", "b"):
        paths = write_figure(collapse_figure(points, "f_v"), tmp_path, name)
        assert [path.suffix for path in paths] == [".png", ".pdf"]
        contents.append([path.read_bytes() for path in paths])
    assert contents[0][0].startswith(b"\x89PNG")
    assert contents[0][1].startswith(b"%PDF")
    assert contents[0] == contents[1]


def test_one_orientation_has_one_curve_below_one(tmp_path: Path) -> None:
    columns = make_columns(c1=-0.02, c2=0.03)
    only = taken(columns, columns["orientation"] == "transverse")
    figure = collapse_figure(_points(tmp_path, only), "f_v")
    solid = [[line for line in axes.lines if line.get_linestyle() == "-"] for axes in figure.axes]
    assert [len(lines) for lines in solid] == [1, 0, 0]
    assert solid[0][0].get_ydata().max() <= 1
