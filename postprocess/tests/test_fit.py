import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from scipy.stats import f as f_distribution

from ehlwave import (
    FitError,
    amplitude_ratio_formula,
    bootstrap_coefficients,
    fit_formula,
    percentile_intervals,
    point_weights,
    rms_residual,
)

X = np.geomspace(0.2, 30, 24)


@pytest.mark.parametrize("truth", [(0.15, 0.015), (0.0744, 0.0236), (-0.012, 0.051), (2.0, 0.5)])
def test_exact_recovery(truth: tuple[float, float]) -> None:
    fit = fit_formula(X, amplitude_ratio_formula(X, *truth))
    assert (fit.c1, fit.c2) == pytest.approx(truth, rel=1e-8)
    assert fit.rms < 1e-10


def test_rms_is_root_mean_square() -> None:
    offset = amplitude_ratio_formula(X) + np.where(np.arange(X.size) % 2, 0.03, -0.01)
    assert rms_residual(X, offset) == pytest.approx(np.sqrt(0.0005))
    assert np.isnan(rms_residual([], []))


def test_too_few_points_are_refused() -> None:
    fit_formula(X[:4], amplitude_ratio_formula(X[:4]))
    with pytest.raises(FitError, match=r"too few points \(3; at least 4"):
        fit_formula(X[:3], amplitude_ratio_formula(X[:3]))
    with pytest.raises(FitError, match="too few points"):
        fit_formula([1, 1, 2, 2, 2], [0.9, 0.9, 0.8, 0.8, 0.8])


def test_profile_interval_raises_the_sum_of_squares_as_f_says() -> None:
    noise = 0.01 * np.random.default_rng(3).standard_normal(X.size)
    ratio = amplitude_ratio_formula(X, 0.1, 0.02) + noise
    fit = fit_formula(X, ratio)
    best = X.size * fit.rms**2
    threshold = best * (1 + f_distribution.ppf(0.95, 1, X.size - 2) / (X.size - 2))
    for c1 in fit.c1_interval:
        profile = minimize_scalar(
            lambda c2, c1=c1: np.sum((amplitude_ratio_formula(X, c1, c2) - ratio) ** 2),
            bounds=(0.001, 0.1),
            method="bounded",
            options={"xatol": 1e-9},
        )
        assert profile.fun == pytest.approx(threshold, rel=1e-2)
    assert fit.c1_interval[0] < fit.c1 < fit.c1_interval[1]
    assert fit.c2_interval[0] < fit.c2 < fit.c2_interval[1]


def _clustered(seed: int, conditions: int = 24) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return x, Ad/Ai and condition; the error of a condition is common to its eight points."""
    random = np.random.default_rng(seed)
    condition = np.repeat(np.arange(conditions), 8)
    x = np.exp(random.uniform(np.log(0.3), np.log(20), condition.size))
    error = 0.02 * random.standard_normal(conditions)[condition]
    error += 0.004 * random.standard_normal(condition.size)
    return x, amplitude_ratio_formula(x, 0.1, 0.02) + error, condition


def test_bootstrap_is_repeatable_and_seeded() -> None:
    data = _clustered(1)
    first = bootstrap_coefficients(*data, replicates=20, seed=5)
    np.testing.assert_array_equal(first, bootstrap_coefficients(*data, replicates=20, seed=5))
    assert not np.array_equal(first, bootstrap_coefficients(*data, replicates=20, seed=6))


def test_bootstrap_coverage() -> None:
    """Half of the 50 % intervals hold the truth; intervals too wide or too narrow both fail."""
    trials = 80
    inside = np.zeros(2)
    for seed in range(trials):
        samples = bootstrap_coefficients(*_clustered(seed), replicates=100, seed=seed)
        for index, (low, high) in enumerate(percentile_intervals(samples, 0.5)):
            inside[index] += low < (0.1, 0.02)[index] < high
    # Four standard deviations of a binomial count of 80 at 1/2 are 18.
    np.testing.assert_allclose(inside / trials, 0.5, atol=0.22)


def test_bootstrap_draws_conditions_not_points() -> None:
    x, ratio, condition = _clustered(2)
    by_condition, by_point = (
        percentile_intervals(bootstrap_coefficients(x, ratio, labels, replicates=200, seed=1))[0]
        for labels in (condition, np.arange(x.size))
    )
    assert np.diff(by_condition) > 1.5 * np.diff(by_point)


def test_bootstrap_needs_three_conditions() -> None:
    x, ratio, condition = _clustered(1, conditions=2)
    with pytest.raises(FitError, match="2 operating condition"):
        bootstrap_coefficients(x, ratio, condition, replicates=10, seed=1)


def test_no_replicates_give_no_interval() -> None:
    samples = bootstrap_coefficients(*_clustered(1), replicates=0, seed=1)
    assert samples.shape == (0, 2)
    assert np.isnan(percentile_intervals(samples)).all()


def test_weights_follow_errors_down_to_the_scatter() -> None:
    scatter = 0.01 * np.where(np.arange(X.size) % 2, 1, -1)
    ratio = amplitude_ratio_formula(X, 0.1, 0.02) + scatter
    s = fit_formula(X, ratio).rms
    error = np.zeros(X.size)
    error[3], error[5] = s, np.nan
    weight = point_weights(X, ratio, error)
    assert weight[3] == pytest.approx(np.sqrt(0.5))
    assert np.delete(weight, 3) == pytest.approx(1)


def test_a_point_of_large_error_does_not_spoil_the_fit() -> None:
    scatter = 0.002 * np.where(np.arange(X.size) % 2, 1, -1)
    ratio = amplitude_ratio_formula(X, 0.1, 0.02) + scatter
    ratio[10] += 0.2
    error = np.full(X.size, 1e-4)
    error[10] = 1.0
    plain = fit_formula(X, ratio)
    weighted = fit_formula(X, ratio, weight=point_weights(X, ratio, error))
    assert abs(weighted.c1 - 0.1) < 0.1 * abs(plain.c1 - 0.1)
    assert weighted.c1 == pytest.approx(0.1, abs=0.01)
