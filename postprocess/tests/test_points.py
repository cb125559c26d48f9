from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from synthetic import Columns, concatenated, make_columns, write_results

from ehlwave import ResultsError, read_results, select_points
from ehlwave.results.points import condition_index, remarks


def _read(tmp_path: Path, columns: Columns) -> xr.Dataset:
    return read_results([write_results(tmp_path / "r.h5", columns)])


def _mixed() -> Columns:
    """Return 60 cases of which 0 to 5 cannot be used for a reason each; 6 and 7 are unresolved."""
    columns = make_columns()
    columns["status"] = columns["status"].astype("U12")
    columns["status"][:3] = ["diverged", "pending", "not_finite"]
    columns["orientation"][3] = "none"
    columns["amplitude_ratio_fit"][4] = np.nan
    columns["v"][5] = 0
    columns["status"][6] = "unresolved"
    columns["is_resolved"][6:8] = 0
    return columns


def test_only_resolved_points_by_default(tmp_path: Path) -> None:
    points = select_points(_read(tmp_path, _mixed()))
    assert points["case"].values.tolist() == list(range(9, 61))
    assert points["is_point_resolved"].all()


def test_unresolved_points_on_demand(tmp_path: Path) -> None:
    points = select_points(_read(tmp_path, _mixed()), include_unresolved=True)
    assert points["case"].values.tolist() == list(range(7, 61))
    assert points["case"].values[~points["is_point_resolved"]].tolist() == [7, 8]


def test_choice_of_ratio(tmp_path: Path) -> None:
    results = _read(tmp_path, make_columns())
    fitted, sampled = (
        select_points(results, ratio)["deformed_ratio"] for ratio in ("fit", "sampled")
    )
    np.testing.assert_array_equal(fitted, results["amplitude_ratio_fit"])
    np.testing.assert_array_equal(sampled, results["amplitude_ratio"])


def test_longitudinal_without_fit_takes_the_sampled_ratio(tmp_path: Path) -> None:
    columns = make_columns()
    columns["amplitude_ratio_fit"][:] = np.nan
    points = select_points(_read(tmp_path, columns))
    assert set(points["orientation"].values.tolist()) == {"longitudinal"}
    np.testing.assert_array_equal(points["deformed_ratio"], points["amplitude_ratio"])


def test_cases_without_transient_have_their_linear_response(tmp_path: Path) -> None:
    columns = make_columns()
    size = columns["v"].size
    columns["harmonic_ratio"] = np.linspace(0.5, 0.9, size)
    columns["harmonic_extrapolated"] = 0.99 * columns["harmonic_ratio"]
    columns["harmonic_extrapolated"][2] = np.nan
    columns["harmonic_error"] = np.full(size, 0.01)
    columns["harmonic_error"][2] = np.nan
    columns["amplitude_ratio"][:30] = np.nan
    columns["amplitude_ratio_fit"][:30] = np.nan
    results = _read(tmp_path, columns)
    points = select_points(results)
    assert points.sizes["case"] == size
    expected = columns["harmonic_extrapolated"].copy()
    expected[2] = columns["harmonic_ratio"][2]
    ratio, error = points["deformed_ratio"].values, points["deformed_error"].values
    np.testing.assert_array_equal(ratio[:30], expected[:30])
    np.testing.assert_array_equal(ratio[30:], columns["amplitude_ratio_fit"][30:])
    np.testing.assert_allclose(error[:2], 0.01 * expected[:2])
    assert np.isnan(error[2])
    assert np.isnan(error[30:]).all()
    linear = select_points(results, "harmonic")
    np.testing.assert_array_equal(linear["deformed_ratio"], expected)


def test_transients_have_the_error_they_estimate(tmp_path: Path) -> None:
    columns = make_columns()
    columns["amplitude_ratio_error"] = np.linspace(0.001, 0.02, columns["v"].size)
    points = select_points(_read(tmp_path, columns))
    expected = columns["amplitude_ratio_error"] * columns["amplitude_ratio_fit"]
    np.testing.assert_allclose(points["deformed_error"], expected)


def test_abscissae_include_the_orientation_factor(tmp_path: Path) -> None:
    points = select_points(_read(tmp_path, make_columns()))
    longitudinal = points["orientation"] == "longitudinal"
    np.testing.assert_allclose((points["f_v"] / points["v"])[longitudinal], np.e)
    np.testing.assert_allclose((points["f_v2"] / points["v2"])[~longitudinal], 1)


def test_nothing_usable_is_counted(tmp_path: Path) -> None:
    columns = make_columns()
    columns["status"] = columns["status"].astype("U12")
    columns["status"][:50], columns["status"][50:] = "pending", "unresolved"
    with pytest.raises(ResultsError, match=r"no usable points: .* 60 cases \(10 unresolved"):
        select_points(_read(tmp_path, columns))


def test_condition_is_m_l_and_d(tmp_path: Path) -> None:
    columns = make_columns()
    columns["lubricant_parameter_l"][:15:2] += 1
    index = condition_index(_read(tmp_path, columns))
    assert np.unique(index).size == 5
    assert np.unique(index[:15:2]).size == 1
    assert index[0] != index[1]


def test_remarks(tmp_path: Path) -> None:
    columns = make_columns()
    assert remarks(select_points(_read(tmp_path, columns))) == []
    columns["slip_parameter"][:2] = 1.5
    columns["orientation"][2] = "custom"
    found = remarks(select_points(_read(tmp_path, concatenated(columns, make_columns()))))
    assert [text.split(" point")[0] for text in found] == ["1", "2", "57"]


def test_edges_are_not_mixed(tmp_path: Path) -> None:
    columns = make_columns()
    columns["edges"] = np.where(np.arange(columns["v"].size) < 20, "flooded", "truncated")
    results = _read(tmp_path, columns)
    with pytest.raises(ResultsError, match="20 cases with flooded edges and 40"):
        select_points(results)
    assert select_points(results, edges="flooded")["case"].values.tolist() == list(range(1, 21))


def test_results_of_before_have_truncated_edges(tmp_path: Path) -> None:
    new = write_results(tmp_path / "new.h5", {**make_columns(), "edges": np.full(60, "flooded")})
    results = read_results([new, write_results(tmp_path / "old.h5", make_columns())])
    assert results["edges"].values.tolist() == ["flooded"] * 60 + ["truncated"] * 60
    assert select_points(results, edges="truncated").sizes["case"] == 60


def test_inaccurate_points_on_demand(tmp_path: Path) -> None:
    columns = make_columns()
    columns["status"] = columns["status"].astype("U12")
    columns["status"][:3] = "inaccurate"
    results = _read(tmp_path, columns)
    assert select_points(results)["case"].values.tolist() == list(range(4, 61))
    assert select_points(results, include_inaccurate=True).sizes["case"] == 60


def test_starved_points_are_remarked(tmp_path: Path) -> None:
    columns = make_columns()
    points = select_points(_read(tmp_path, columns))
    film = np.full(points.sizes["case"], np.nan)
    assert not any(
        "oil" in text for text in remarks(points.assign(film_over_flooded=("case", film)))
    )
    film[:3] = 0.7
    said = remarks(points.assign(film_over_flooded=("case", film)))
    assert any(text.startswith("3 point(s) with too little oil") for text in said)


def test_points_of_other_edges_are_named(tmp_path: Path) -> None:
    results = _read(tmp_path, make_columns())
    found = str(results["edges"].values[0])
    other = next(name for name in ("flooded", "truncated") if name != found)
    with pytest.raises(ResultsError, match=rf"all \d+ have other edges of the domain than {other}"):
        select_points(results, edges=other)
