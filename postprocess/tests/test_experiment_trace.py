from pathlib import Path

import numpy as np
import pytest

from ehlwave.surface import cut_period, read_surface
from studies.experiment.trace import (
    fit_sinusoid,
    fits_of_trace,
    harmonic,
    read_trace,
    synthetic_trace,
)

COMMITTED = Path(__file__).parents[2] / "inputs" / "full" / "sputtered_profile.csv"


def test_committed_trace_has_what_the_paper_says_of_its_own() -> None:
    assert "SYNTHETIC" in COMMITTED.read_text().splitlines()[0]
    whole, *parts = (fit for _, fit in fits_of_trace(*read_trace(COMMITTED)))
    assert whole.wavelength == pytest.approx(60, abs=0.05)
    assert whole.amplitude == pytest.approx(0.14, abs=5e-4)
    amplitudes = [part.amplitude for part in parts]
    # as printed, to two digits
    assert (round(min(amplitudes), 2), round(max(amplitudes), 2)) == (0.13, 0.16)
    assert max(abs(part.wavelength / 60 - 1) for part in parts) < 0.02
    # nearly harmonic, but not quite
    assert 0.03 < whole.rms_left / whole.amplitude < 0.1


def test_the_function_that_its_heading_names_makes_it() -> None:
    np.testing.assert_array_equal(read_trace(COMMITTED), synthetic_trace())


def test_readers_agree_and_a_wave_can_be_cut() -> None:
    x, height = read_trace(COMMITTED)
    surface = read_surface(COMMITTED)
    np.testing.assert_allclose(surface.height[:, 0], height * 1e-6, rtol=1e-12)
    assert surface.step_x_m == pytest.approx((x[1] - x[0]) * 1e-6, rel=1e-12)
    wave = cut_period(surface, 60e-6).height[:, 0] * 1e6
    assert abs(harmonic(np.arange(60.0), wave, 60)) == pytest.approx(0.14, abs=0.005)


def test_fit_finds_a_sinusoid_and_not_its_starting_point() -> None:
    x = np.arange(0, 300.0, 0.7)
    height = 3 + 0.2 * np.cos(2 * np.pi * x / 57.3 - 1.1) + 0.01 * np.cos(2 * np.pi * x / 9)
    found = fit_sinusoid(x, height, 60)
    assert found.wavelength == pytest.approx(57.3, abs=0.02)
    assert found.amplitude == pytest.approx(0.2, rel=2e-3)
    assert found.level == pytest.approx(3, abs=1e-3)
    assert found.rms_left == pytest.approx(0.01 / np.sqrt(2), rel=0.02)
    assert harmonic(x, 0.3 * np.cos(2 * np.pi * x / 50 + 0.4), 50) == pytest.approx(
        0.3 * np.exp(0.4j), abs=1e-12
    )
