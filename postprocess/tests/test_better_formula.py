from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from synthetic import write_results

from ehlwave.contact.formula import (
    amplitude_ratio_formula,
    f_of_r,
    recommended_parameter,
    recommended_ratio,
    v,
    wave_and_direction,
)
from studies.folds import grouped_folds
from studies.paper import better_formula_figures, better_formula_tables
from studies.paper.better_formula import is_better, section
from studies.paper.candidates import (
    LADDER,
    ONE_PARAMETER,
    PAPER,
    RECOMMENDED,
    REFITTED,
    ROUNDED,
    Candidate,
)
from studies.paper.cases import DIRECTIONS
from studies.paper.crossvalidation import (
    bootstrapped,
    fitted,
    hard_splits,
    held_out,
    monotone_limit,
    one_standard_error_choice,
    rms,
    rms_standard_error,
    scored,
)
from studies.paper.fit_points import Points

GAMMA = {1.0: 1.0, 0.12: 0.168}
TRUTH = np.array([0.25, 0.3, 1.4, 9.0])


def made(
    ratio: Callable[[Points], np.ndarray] = lambda p: RECOMMENDED.curve(TRUTH, p),
    noise: float = 0.0,
) -> Points:
    """Return points at 24 conditions whose Ad/Ai is known."""
    rows = [
        (m, l, d, number, wave, condition)
        for condition, (m, l, d) in enumerate(  # noqa: E741
            (m, l, d)
            for m in (50.0, 200.0, 800.0, 2000.0)
            for l in (2.5, 8.0, 20.0)  # noqa: E741
            for d in GAMMA
        )
        for number in (0, 3, 4, 6, 8)
        for wave in (0.15, 0.4, 1.0, 2.5)
    ]
    m, l, d, number, wave, condition = (np.array(column) for column in zip(*rows, strict=True))  # noqa: E741
    r = np.array(DIRECTIONS)[number]
    with np.errstate(divide="ignore"):
        wave_x = np.where(np.isinf(r), 0.0, wave * np.maximum(r, 1.0))
        wave_y = np.where(r == 0, 0.0, wave * np.maximum(1 / r, 1.0))
    gamma = np.array([GAMMA[value] for value in d])
    along_wave, along = wave_and_direction(wave_x, wave_y)
    fields = {
        "load_m": m,
        "lubricant": l,
        "radius_ratio": d,
        "gamma": gamma,
        "kappa": d**0.6,
        "lambdabar": m ** (-4 / 3),
        "load": gamma * m,
        "wave_x": wave_x,
        "wave_y": wave_y,
        "wave": along_wave,
        "shorter": wave,
        "along": along,
        "direction": number,
        "f_v": f_of_r(r) * v(wave, m, l, gamma),
        "ratio": np.zeros(m.size),
        "error": 0.002,
        "condition": condition,
    }
    points = pd.DataFrame(fields).to_records(index=False)
    shift = noise * np.random.default_rng(1).standard_normal(m.size)
    points.ratio = ratio(points) + shift
    return points


def test_wave_and_direction_of_the_three_orientations() -> None:
    wave, along = wave_and_direction([0.5, 0.5, 0.0, 0.0], [0.0, 0.5, 0.5, 0.0])
    np.testing.assert_allclose(wave, [0.5, 0.5 / np.sqrt(2), 0.5, np.nan], rtol=1e-15)
    np.testing.assert_allclose(along, [1, 0.5, 0, np.nan], rtol=1e-15)


def test_recommended_formula_by_hand() -> None:
    x = 0.263 * 0.5 * np.sqrt(0.4 * 200) / 10 ** (1 / 3)
    assert recommended_parameter(200, 10, 0.4, 0.5, 0) == pytest.approx(x, rel=1e-14)
    expected = (1 + x**2.5) ** (-1 / 2.5)
    assert recommended_ratio(200, 10, 0.4, 0.5, 0) == pytest.approx(expected, rel=1e-14)
    longitudinal = recommended_parameter(200, [2.5, 20], 0.4, 0, 0.5)
    np.testing.assert_allclose(longitudinal, 0.263 * 0.5 * np.sqrt(80), rtol=1e-14)


def test_recommended_formula_between_its_limits() -> None:
    wave = np.array([1e-12, 1e-3, 1.0, 1e3, 1e12])
    ratio = recommended_ratio(1000, 2.5, 1, wave, wave)
    assert ratio[0] == 1
    assert np.all(np.diff(ratio) <= 0)
    assert ratio[-1] == pytest.approx(1 / recommended_parameter(1000, 2.5, 1, 1e12, 1e12))
    assert np.isnan(recommended_ratio(1000, 2.5, 1, 0, 0))
    with pytest.raises(ValueError, match="lubricant_l"):
        recommended_ratio(100, 0, 1, 1, 1)
    with pytest.raises(ValueError, match="wavelength_y"):
        recommended_ratio(100, 10, 1, 1, -1)


def test_known_parameters_are_recovered() -> None:
    points = made()
    np.testing.assert_allclose(fitted(RECOMMENDED, points), TRUTH, rtol=1e-4)


def test_c1_and_c2_are_recovered() -> None:
    points = made(lambda p: amplitude_ratio_formula(p.f_v, 0.07, 0.03))
    found = fitted(REFITTED, points)
    np.testing.assert_allclose(found, [0.07, 0.03], rtol=1e-5)


def test_the_intervals_hold_the_truth() -> None:
    points = made(noise=0.01)
    low, high = np.quantile(bootstrapped(RECOMMENDED, points, 40), [0.0, 1.0], axis=0)
    assert np.all((low < TRUTH) & (high > TRUTH))
    assert np.all(high - low < 0.3 * TRUTH)


def test_folds_hold_out_whole_conditions() -> None:
    condition = made().condition
    folds = grouped_folds(condition, 5)
    np.testing.assert_array_equal(np.sum(folds, axis=0), 1)
    for fold in folds:
        assert not set(condition[fold]) & set(condition[~fold])
    with pytest.raises(ValueError, match="24 operating conditions for 25 folds"):
        grouped_folds(condition, 25)


def test_held_out_points_have_no_part_in_their_fit() -> None:
    points = made()
    folds = grouped_folds(points.condition, 4)
    spoiled = points.copy()
    spoiled.ratio[folds[0]] = 5.0
    residual = held_out(RECOMMENDED, spoiled, folds[:1])
    curve = residual[folds[0]] + 5.0
    np.testing.assert_allclose(curve, points.ratio[folds[0]], atol=1e-5)
    assert np.all(np.isnan(residual[~folds[0]]))


def test_hard_splits_cover_what_they_say() -> None:
    points = made()
    splits = hard_splits(points)
    for name in ("each D", "each L"):
        np.testing.assert_array_equal(np.sum(splits[name], axis=0), 1)
    assert set(points.lubricant[splits["L = 2.5"][0]]) == {2.5}
    assert points.load_m[splits["M >= 1000"][0]].min() == 2000


def test_the_criterion_tells_good_from_bad() -> None:
    points = made(noise=0.01)
    paper, refitted, good = (scored(form, points) for form in (PAPER, REFITTED, RECOMMENDED))
    assert is_better(good, paper)
    assert not is_better(refitted, paper)
    followed = made(lambda p: amplitude_ratio_formula(p.f_v), noise=0.01)
    paper, other = (scored(form, followed) for form in (PAPER, ONE_PARAMETER))
    assert not is_better(other, paper)


def test_the_smallest_sufficient_formula_is_chosen() -> None:
    points = made(noise=0.01)
    names = ("refitted", "one parameter", "n of L", "+ kappa", "+ slope")
    scores = [scored(form, points) for form in LADDER if form.name in names]
    chosen = one_standard_error_choice(scores, [s.cv for s in scores], points.condition)
    assert chosen.candidate is RECOMMENDED


def test_standard_error_of_an_rms() -> None:
    residual = np.array([1.0, 1.0, 3.0, 3.0])
    group = np.array([0, 0, 1, 1])
    # mean squares 1 and 9: their standard error is 4, the rms sqrt(5)
    assert rms_standard_error(residual, group) == pytest.approx(4 / (2 * np.sqrt(5)))


def test_no_curve_beats_the_monotone_limit() -> None:
    points = made(noise=0.02)
    limit = monotone_limit(points.f_v, points.ratio)
    residual = REFITTED.curve(fitted(REFITTED, points), points) - points.ratio
    assert 0 < limit < rms(residual)
    assert monotone_limit(np.array([1.0, 2, 3]), np.array([3.0, 1, 2])) == pytest.approx(
        np.sqrt(0.5 / 3)
    )


@pytest.mark.parametrize("candidate", LADDER, ids=lambda c: c.name)
def test_every_candidate_is_usable(candidate: Candidate) -> None:
    assert len(candidate.names) == len(candidate.start)
    points = made()
    curve = candidate.curve(np.array(candidate.start), points)
    assert np.all(np.isfinite(curve))
    assert np.all((curve > 0) & (curve <= 1))


def test_free_factors_find_f() -> None:
    points = made(lambda p: ROUNDED.curve(np.empty(0), p))
    value, interval = better_formula_tables.free_factors(points, 8.0)
    chosen = [3, 4, 6, 8]
    implied = better_formula_figures.implied_factor(np.array(DIRECTIONS), 8.0)
    np.testing.assert_allclose(value[chosen], implied[chosen], rtol=1e-4)
    np.testing.assert_allclose(interval[:, 8], implied[8], rtol=1e-3)


def test_small_v_table_is_positive_where_18_is_too_small() -> None:
    points = made(lambda p: amplitude_ratio_formula(p.f_v) + 0.02)
    means = better_formula_tables.small_v_table(points).data["mean"]
    assert len(means)
    assert means.to_list() == pytest.approx([0.02] * len(means), abs=1e-12)


def test_limits_of_formula_18() -> None:
    table = better_formula_tables.limits_table(made(lambda p: 1 / (1 + (0.5 * p.f_v) ** 2))).data
    slopes = table.loc[table["pairs, large V"] > 0, "slope"]
    assert len(slopes)
    assert slopes.between(-2, -1.3, inclusive="left").all()


def written(points: Points, path: Path) -> Path:
    """Write points as a results file of linear responses."""
    size = points.size
    columns = {
        "case_id": np.array([f"case{number:04d}" for number in range(size)]),
        "load_parameter_m": points.load_m,
        "lubricant_parameter_l": points.lubricant,
        "radius_ratio_d": points.radius_ratio,
        "slip_parameter": np.ones(size),
        "orientation": np.full(size, "custom"),
        "wavelength_over_a": points.shorter,
        "wavelength_x_over_a": points.wave_x,
        "wavelength_y_over_a": points.wave_y,
        "gamma": points.gamma,
        "kappa": points.kappa,
        "lambdabar": points.lambdabar,
        "v": v(points.shorter, points.load_m, points.lubricant, points.gamma),
        "v2": v(points.shorter, points.load_m, points.lubricant, 1.0),
        "f_r": f_of_r(np.array(DIRECTIONS)[points.direction]),
        "status": np.full(size, "converged"),
        "is_resolved": np.ones(size, dtype=int),
        "amplitude_ratio": np.full(size, np.nan),
        "amplitude_ratio_fit": np.full(size, np.nan),
        "harmonic_extrapolated": points.ratio,
        "harmonic_ratio": points.ratio,
        "harmonic_error": points.error,
    }
    return write_results(path, columns)


def test_the_section_of_the_report(tmp_path: Path) -> None:
    points = made(lambda p: ROUNDED.curve(np.empty(0), p), noise=0.01)
    for name in ("dense", "resolved"):
        written(points, tmp_path / f"{name}.h5")
    found = section(tmp_path)
    tables = {table.name: table for table in found.tables}
    assert any("is met" in text for text in found.text)
    assert len(tables["formula_ladder"].data) == len(LADDER)
    for name, best, low, high, rounded in tables["formula_parameters"].data.itertuples(index=False):
        assert low < best < high, name
        assert best == pytest.approx(rounded, rel=0.15), name
    assert [picture.name for picture in found.pictures] == [
        "formula_collapse",
        "formula_residuals",
        "formula_directions",
    ]
    row = tables["formula_resolved"].data.set_index("formula").loc["n of L"]
    assert row["points"] == points.size
    assert row["rms"] == pytest.approx(0.01, rel=0.2)
