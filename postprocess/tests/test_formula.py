import importlib

import numpy as np
import pytest

from ehlwave import amplitude_ratio_formula, f_of_r, v, v2, wavelength_ratio


def test_wavelength_zero_means_no_variation() -> None:
    ratio = wavelength_ratio([0.5, 0.5, 0.0, 0.6, 0.0], [0.0, 0.5, 0.5, 0.2, 0.0])
    np.testing.assert_allclose(ratio, [0, 1, np.inf, 3, np.nan])


def test_orientation_factor() -> None:
    expected = [1, 1, 1, np.exp(0.5), np.e, np.nan]
    np.testing.assert_allclose(f_of_r([0, 0.3, 1, 2, np.inf, np.nan]), expected)


@pytest.mark.parametrize(
    ("wave", "load", "gamma", "expected"),
    [
        (0.25, 100, 1, 0.720189),
        (0.7, 200, 0.38264526, 1.7640776),
        (0.3, 1000, 0.080165487, 0.77378704),
    ],
)
def test_v_of_an_independent_solver(
    wave: float, load: float, gamma: float, expected: float
) -> None:
    assert v(wave, load, 12.05, gamma) == pytest.approx(expected, rel=1e-6)


def test_two_forms_of_v_agree() -> None:
    alphabar = 18.641308  # M = 200, L = 12.05, D = 0.35
    second = np.sqrt(2 * np.pi**3 / 3) * 0.7 * alphabar**1.5 / 12.05**2
    assert v(0.7, 200, 12.05, 0.38264526) == pytest.approx(second, rel=1e-6)


def test_v2_is_v_without_gamma() -> None:
    assert v2(0.3, 1000, 12.05) == pytest.approx(2.7329251, rel=1e-7)


def test_experiment_of_the_paper() -> None:
    found = v(60 / 185, 130.77, 6.61, 1.0)
    assert found == pytest.approx(1.42, abs=0.03)
    assert amplitude_ratio_formula(1.42) == pytest.approx(0.80, abs=0.005)


def test_formula_with_other_coefficients() -> None:
    np.testing.assert_allclose(amplitude_ratio_formula([0, 2], 0.5, 0.25), [1, 1 / 3])


def test_negative_arguments_are_refused() -> None:
    with pytest.raises(ValueError, match="r is negative"):
        f_of_r(-1)
    with pytest.raises(ValueError, match="x is negative"):
        amplitude_ratio_formula([1, -1])
    with pytest.raises(ValueError, match="load_m is negative"):
        v2(1, -1, 1)
    with pytest.raises(ValueError, match="wavelength_y is negative"):
        wavelength_ratio(1, -1)
    with pytest.raises(ValueError, match="lubricant_l is zero"):
        v(1, 1, 0, 1)


def test_former_name_of_the_package_is_the_same_module() -> None:
    assert importlib.import_module("ehlwave_post.errors") is importlib.import_module(
        "ehlwave.errors"
    )
    with pytest.raises(ModuleNotFoundError):
        importlib.import_module("ehlwave_post.nothing")
