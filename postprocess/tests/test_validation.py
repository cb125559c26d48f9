"""Published data, film formulas, and what is made of runs beside them."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from ehlwave.contact.scales import moes_film
from studies.section import Section
from studies.validation import formulas, page
from studies.validation.dimple import INSTANTS, Dimple, dimple_place
from studies.validation.dimple_runs import DEPTH_NM, RADIUS_UM, Line, dimple_heights
from studies.validation.dimple_section import line_figure, point_table, summary_table
from studies.validation.film_section import figure
from studies.validation.film_section import point_table as point_table_of_films
from studies.validation.film_section import summary_table as film_summary
from studies.validation.line_ratios import marched_ratios
from studies.validation.line_section import deviation_figure, value_table
from studies.validation.published import centre_line, line_ratios, small_line_ratios


def published_lines(factor: float) -> dict[int, Line]:
    """Return the published simulation itself, its films times a factor."""
    lines = {}
    for instant in INSTANTS:
        x, film = (np.array(one) for one in centre_line("simulated", instant, "film"))
        places, pressure = centre_line("simulated", instant, "pressure")
        lines[instant] = Line(x, factor * film, np.interp(x, places, pressure))
    return lines


def test_published_data_is_complete() -> None:
    assert len(line_ratios()) == 18
    assert small_line_ratios() == {
        4: 0.030, 2: 0.073, 1: 0.183, 0.5: 0.394, 0.25: 0.660, 0.125: 0.839
    }  # fmt: skip
    assert [len(centre_line("simulated", instant, "film")[0]) for instant in INSTANTS] == [28, 27]
    assert len(centre_line("measured", 1, "film")[0]) == 48
    with pytest.raises(KeyError, match="pressure, measured"):
        centre_line("measured", 1, "pressure")


def test_place_of_a_dimple() -> None:
    x = np.linspace(-100, 100, 401)
    film = 200 + 150 * np.exp(-(((x - 21.3) / 9) ** 2))
    assert dimple_place(x, film) == pytest.approx(21.3, abs=0.05)


def test_dimple_is_round_and_deep() -> None:
    x = np.array([-RADIUS_UM, 0.0, RADIUS_UM])
    heights = dimple_heights(x, x)
    assert heights[1, 1] == pytest.approx(-1e-9 * DEPTH_NM)
    assert np.abs(heights[[0, 2, 1, 1], [1, 1, 0, 2]]).max() < 1e-22
    np.testing.assert_allclose(heights, heights.T)


def test_deviations_are_judged_inside_and_outside() -> None:
    dimple = Dimple(21.1, published_lines(1.06), published_lines(1.03), 0.003)
    table = summary_table(dimple).data
    assert table["dimple"].to_list() == ["outside", "outside", "inside"]
    assert table["worst, %"].to_list() == pytest.approx([6.0] * 3)
    assert table["aim, %"].to_list() == [5, 5, 8]
    assert table["reached"].to_list() == ["no", "no", "yes"]
    points = point_table(dimple).data
    films = points[points["quantity"] == "film, nm"]
    assert len(films) == 28 + 27
    assert films["grid error, %"].to_list() == pytest.approx([1.0] * len(films))
    assert (films["where"] == "dimple").sum() == 8
    assert len(line_figure(dimple).axes) == 4


def test_power_laws_in_metres() -> None:
    """U = 1e-11, W = 1e-6, G of the module: h/Rx by the formulas as printed."""
    u, w, g = 1e-11, 1e-6, formulas.G
    m, l_ = w * (2 * u) ** -0.75, g * (2 * u) ** 0.25
    scale = math.sqrt(2 * u)
    d = 0.25
    k = 1.03 * 4**0.64
    central = 2.69 * u**0.67 * g**0.53 * w**-0.067 * (1 - 0.61 * math.exp(-0.73 * k))
    smallest = 3.63 * u**0.68 * g**0.49 * w**-0.073 * (1 - math.exp(-0.68 * k))
    assert formulas.hamrock_dowson_central(m, l_, d) * scale == pytest.approx(central)
    assert formulas.hamrock_dowson_smallest(m, l_, d) * scale == pytest.approx(smallest)
    shape = 4 ** (2 / 3)
    central = 4.31 * u**0.68 * g**0.49 * w**-0.073 * (1 - math.exp(-1.23 * shape))
    assert formulas.chittenden_central(m, l_, d) * scale == pytest.approx(central)
    smallest = 3.68 * u**0.68 * g**0.49 * w**-0.073 * (1 - math.exp(-0.67 * shape))
    assert formulas.chittenden_smallest(m, l_, d) * scale == pytest.approx(smallest)


def test_formulas_agree_with_each_other() -> None:
    """Fits of the same quantity: within 15 % of each other in the middle of the map."""
    for d in (1, 0.35, 0.12):
        values = [formula(100, 8, d) for formula in formulas.CENTRAL.values()]
        assert max(values) / min(values) < 1.15
        for name, smallest in formulas.SMALLEST.items():
            assert 0.4 < smallest(100, 8, d) / formulas.CENTRAL[name](100, 8, d) < 1


def test_films_are_summed_up_by_ratio_of_radii() -> None:
    films = pd.DataFrame(
        {"m": m, "l": l_, "d": d, "central": moes_film(m, l_, d) / 1.1, "smallest": 1.0}
        for m in (20, 100)
        for l_ in (2.5, 10)
        for d in (1, 0.35, 0.12)
    ).assign(central_error=0.001, smallest_error=0.001)
    table = film_summary(films).data
    rows = table[table["formula"] == "Nijenbanning, Venner, Moes"]
    assert rows["D"].to_list() == [1, 0.35, 0.12, "all"]
    assert rows["conditions"].to_list() == [4, 4, 4, 12]
    assert rows["mean, %"].to_list() == pytest.approx([10.0] * 4)
    points = point_table_of_films(films).data
    assert points.shape == (12, 7 + 5)
    assert len(figure(films).axes) == 5


def test_marches_take_the_grid_error_of_the_linear_response() -> None:
    """A march 0.01 above the linear response on each grid, whatever the grid adds to both."""
    rows = [(one, cells) for cells in (256, 512) for one in line_ratios()]
    small = pd.Series(small_line_ratios())
    linear = pd.DataFrame({"linear": small, "linear_error": 1e-4})
    domain = 0 * small - 2e-4
    on_grid = np.array([small[one.wavelength_over_a] + 100 / cells**2 for one, cells in rows])
    columns = {
        "wavelength_over_a": [one.wavelength_over_a for one, _ in rows],
        "amplitude_over_film": [one.amplitude_over_film for one, _ in rows],
        "cells_x": [cells for _, cells in rows],
        "harmonic_ratio": on_grid,
        "amplitude_ratio": np.array(on_grid)
        + np.array([0.012 if c == 256 else 0.01 for _, c in rows]),
    }
    results = xr.Dataset({name: ("case", values) for name, values in columns.items()})
    marched = marched_ratios(results, linear, domain)
    assert len(marched) == 18
    wave = marched["wavelength_over_a"]
    np.testing.assert_allclose(marched["march"], small[wave] + 0.01)
    np.testing.assert_allclose(marched["march_error"], 0.002 + 1e-4 + 2e-4)
    np.testing.assert_allclose(marched["linear_error"], 1e-4 + 2e-4)
    assert value_table(marched).data.shape == (18, 9)
    assert len(deviation_figure(marched).axes) == 1


def test_page_has_the_parts_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    parts = [(name, lambda folder, name=name: Section(f"Part {name}")) for name in ("a", "b")]
    monkeypatch.setattr(page, "PARTS", parts)
    written = page.write_validation(tmp_path / "runs", tmp_path, ["b"], lambda text: None)
    text = written[0].read_text(encoding="utf-8")
    assert "Part b" in text
    assert "Part a" not in text
    assert (tmp_path / "runs").is_dir()
