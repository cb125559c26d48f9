"""Pictures can be read: slender contacts, differences, colours by a column; cases have labels."""

from pathlib import Path

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.text import Text
from synthetic import concatenated, make_columns, write_results
from test_export import write_case

import ehlwave
from ehlwave.cli import main
from ehlwave.results.case_figures import RISES, case_figure
from ehlwave.results.scales_of_figures import DRAWN, SLENDER, aspect_note, readable_aspect
from ehlwave.surface.figures import deformed_figure

Capture = pytest.CaptureFixture[str]


@pytest.mark.parametrize("ratio", [0.01, 0.3, 0.5, 1, 1.9, 2.5, 7, 100])
def test_no_map_is_a_sliver_and_a_changed_scale_is_said(ratio: float) -> None:
    drawn = ratio * readable_aspect(1, ratio)
    assert 1 / SLENDER <= drawn <= SLENDER
    is_equal = 1 / SLENDER <= ratio <= SLENDER
    assert (readable_aspect(1, ratio) == 1) == is_equal == (aspect_note(1, ratio) == "")


def test_a_slender_contact_is_drawn_wide_enough(tmp_path: Path) -> None:
    case = ehlwave.read_case(write_case(tmp_path / "c.h5"))  # b = 4.5 a
    figure = case_figure(case)
    axes = figure.axes[0]
    width, height = np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim())
    assert height / width > 4
    assert axes.get_aspect() * height / width == pytest.approx(DRAWN)
    assert "compressed 3 times" in axes.get_ylabel()


def test_temperatures_are_drawn_where_there_are_any(tmp_path: Path) -> None:
    cold = ehlwave.read_case(write_case(tmp_path / "c.h5"))
    rises = {
        name: cold["pressure"] * factor for name, factor in zip(RISES, (50, 20, 30), strict=True)
    }
    figure = case_figure(cold.assign(rises))
    titles = [axes.get_title() for axes in figure.axes]
    assert "rise half-way across the film [K]" in titles
    lines = figure.axes[titles.index("temperature, $y = 0$")].lines
    largest = [float(np.max(line.get_ydata())) for line in lines]
    assert largest == pytest.approx([factor * largest[0] / 50 for factor in (50, 20, 30)])
    without = [axes.get_title() for axes in case_figure(cold).axes]
    assert not any("temperature" in title or "rise" in title for title in without)
    line = cold.assign(rises).isel(y=[cold.sizes["y"] // 2])
    assert "temperature, $y = 0$" in [axes.get_title() for axes in case_figure(line).axes]


def test_a_map_of_the_difference_is_drawn() -> None:
    x, y = np.meshgrid(np.arange(90), np.arange(60), indexing="ij")
    height = 3e-8 * np.cos(0.2 * x) * np.cos(0.15 * y)
    contact = ehlwave.Contact(
        load_parameter_m=100,
        lubricant_parameter_l=10,
        radius_ratio_d=1,
        semi_axis_a_m=1e-4,
        radius_x_m=0.01,
    )
    found = contact.deform(ehlwave.surface.map_surface(height, 4e-6, 4e-6))
    panels = {axes.get_title(): axes for axes in deformed_figure(found).axes}
    made, left = (panels[name].images[0].get_array() for name in ("as made", "in the contact"))
    difference = panels["difference"].images[0]
    np.testing.assert_allclose(difference.get_array(), made - left, atol=1e-12)
    low, high = difference.get_clim()
    assert low == -high < 0


def test_points_are_coloured_by_a_column(results_file: Path) -> None:
    points = ehlwave.select_points(ehlwave.read_results(results_file))
    values = np.unique(points["load_parameter_m"].values)
    figure = ehlwave.collapse_figure(points, "f_v", "load_parameter_m")
    shades = {to_hex(line.get_color()) for axes in figure.axes[:3] for line in _markers(axes)}
    assert len(shades) == values.size
    many = points.assign(column=("case", np.linspace(1, 100, points.sizes["case"])))
    figure = ehlwave.collapse_figure(many, "f_v", "column")
    assert len(figure.axes) == 4
    assert figure.axes[3].get_ylabel() == "column"
    with pytest.raises(ehlwave.ResultsError, match="--color-by nothing: no such column"):
        ehlwave.collapse_figure(points, "f_v", "nothing")


def _markers(axes):  # noqa: ANN001, ANN202
    return [line for line in axes.lines if line.get_linestyle() == "None"]


def test_the_command_takes_the_column(results_file: Path, tmp_path: Path, capsys: Capture) -> None:
    words = ["collapse", str(results_file), "--output", str(tmp_path / "f"), "--color-by"]
    assert main([*words, "radius_ratio_d"]) == 0
    assert main([*words, "no_such"]) == 2
    assert "no_such" in capsys.readouterr().err


def test_labels_say_what_varies_and_cases_count_from_one(tmp_path: Path, capsys: Capture) -> None:
    columns = make_columns()
    columns["status"][4] = "stalled"
    first = write_results(tmp_path / "a.h5", columns)
    results = ehlwave.read_results([first, write_results(tmp_path / "b.h5", make_columns())])
    labels, size = results["label"].values, results.sizes["case"]
    assert results["case"].values.tolist() == list(range(1, size + 1))
    one = results.isel(case=3)
    assert f"M = {float(one['load_parameter_m']):g}" in labels[3]
    assert str(one["orientation"].values) in labels[3]
    assert len(set(labels[: size // 2])) == size // 2
    assert "L =" not in labels[0] or len(set(results["lubricant_parameter_l"].values)) > 1
    assert main(["table", str(first)]) == 0
    failed = capsys.readouterr().out.splitlines()[-1].split()
    assert failed[0] == "5"
    assert failed[1] == str(results["case_id"].values[4])
    same = {key: np.array(values)[:1] for key, values in columns.items()}
    alone = ehlwave.read_results(write_results(tmp_path / "c.h5", concatenated(same)))
    assert alone["label"].values.tolist() == [""]


COLUMN_MM = 87
SMALLEST_PT = 4.8


def printed_sizes(figure: Figure) -> list[float]:
    """Return the sizes of all texts of a figure in a printed column, pt."""
    scale = COLUMN_MM / 25.4 / figure.get_figwidth()
    texts = figure.findobj(lambda one: isinstance(one, Text) and bool(one.get_text().strip()))
    return [scale * one.get_fontsize() for one in texts]


def test_text_can_be_read_in_a_printed_column_and_does_not_overlap(tmp_path: Path) -> None:
    figure = case_figure(ehlwave.read_case(write_case(tmp_path / "c.h5")))
    FigureCanvasAgg(figure).draw()
    assert min(printed_sizes(figure)) >= SMALLEST_PT
    width = figure.bbox.width
    for axes in figure.axes:
        legend = axes.get_legend()
        for part in filter(None, (axes.title, axes.xaxis.label, legend)):
            box = part.get_window_extent()
            assert 0 <= box.x0 <= box.x1 <= width
        if legend:
            assert legend.get_window_extent().x1 <= axes.bbox.x1 + 1
