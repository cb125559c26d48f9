from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from synthetic import Columns, make_columns, write_results, written_names

from ehlwave import ResultsError, read_results
from studies.linearity import linearity_figure, linearity_points, linearity_text, main


def _columns() -> Columns:
    """Return cases in groups of four amplitudes, the fit 1 + Ai^2 times the linear response."""
    columns = make_columns()
    size = columns["v"].size
    columns["amplitude_over_film"] = np.resize([0.1, 0.2, 0.4, 0.8], size)
    for name in ("load_parameter_m", "radius_ratio_d", "wavelength_over_a"):
        columns[name] = np.repeat(columns[name][::4], 4)
    columns["orientation"] = np.repeat(columns["orientation"][::4], 4)
    columns["harmonic_ratio"] = columns["amplitude_ratio_fit"] / (
        1 + columns["amplitude_over_film"] ** 2
    )
    columns["amplitude_ratio"] = 1.01 * columns["amplitude_ratio_fit"]
    columns["harmonic_phase"] = np.full(size, 3.1)
    columns["phase_fit"] = np.full(size, -3.1)
    return columns


def _points(tmp_path: Path, columns: Columns) -> xr.Dataset:
    return linearity_points(read_results([write_results(tmp_path / "r.h5", columns)]))


def test_ratios_and_phase(tmp_path: Path) -> None:
    points = _points(tmp_path, _columns())
    expected = 1 + points["amplitude_over_film"] ** 2
    np.testing.assert_allclose(points["fit_over_linear"], expected)
    np.testing.assert_allclose(points["range_over_linear"], 1.01 * expected)
    np.testing.assert_allclose(points["phase_difference"], 2 * np.pi - 6.2)


def test_text_holds_the_largest_deviation_of_each_amplitude(tmp_path: Path) -> None:
    lines = linearity_text(_points(tmp_path, _columns())).splitlines()
    assert len(lines) == 5
    assert lines[1].split()[:3] == ["0.1", "15", "1.00"]
    assert lines[4].split()[:3] == ["0.8", "15", "64.00"]


def test_cases_without_both_are_left_out(tmp_path: Path) -> None:
    columns = _columns()
    columns["harmonic_ratio"][3] = np.nan
    columns["amplitude_ratio_fit"][5] = np.nan
    assert _points(tmp_path, columns).sizes["case"] == 58
    columns["harmonic_ratio"][:] = np.nan
    with pytest.raises(ResultsError, match="response = 'both'"):
        _points(tmp_path, columns)
    with pytest.raises(ResultsError, match="no linear responses"):
        _points(tmp_path, make_columns())


def test_figure_has_two_lines_for_each_pattern(tmp_path: Path) -> None:
    axes = linearity_figure(_points(tmp_path, _columns())).axes[0]
    assert len(axes.lines) == 2 * 15 + 1


def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    results = write_results(tmp_path / "r.h5", _columns())
    assert main([str(results), "--output", str(tmp_path / "out")]) == 0
    assert "Ai/Hc" in capsys.readouterr().out
    names = written_names(tmp_path / "out")
    assert names == {"linearity.csv", "linearity.png", "linearity.pdf"}
