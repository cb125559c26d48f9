"""Gradient of Dang Van's factor by the spectrum, against surfaces with other amplitudes."""

from dataclasses import replace

import numpy as np
import pytest
from long_tests import IS_LONG
from numpy.typing import NDArray

from ehlwave import Contact
from ehlwave.stress import RoughStress
from ehlwave.stress.figures import risk_figure
from ehlwave.stress.removal import OCTAVE, RiskBand
from ehlwave.stress.report import stress_summary, stress_text
from ehlwave.surface import Surface, trace_surface

POINTS, STEP_M, CHANGE = 256, 3e-6, 1e-3
CONTACT = Contact(
    radius_x_m=12.5e-3,
    radius_y_m=12.5e-3,
    reduced_modulus_pa=2.26e11,
    load_n=60,
    mean_speed_m_per_s=0.5,
    viscosity_pa_s=0.05,
    eyring_stress_pa=5e6,
    slip_parameter=1.2,
)


def surface(seed: int, factors: NDArray[np.float64] | float = 1.0) -> Surface:
    """Return a trace of 20 waves, their amplitudes times factors of the spectrum."""
    spectrum = np.zeros(POINTS // 2 + 1, complex)
    random = np.random.default_rng(seed)
    spectrum[4:24] = np.exp(2j * np.pi * random.uniform(size=20))
    heights = 4e-8 / np.fft.irfft(spectrum).std() * np.fft.irfft(factors * spectrum)
    return trace_surface(heights, STEP_M, name=f"rough {seed}")


def stress(first: Surface, second: Surface) -> RoughStress:
    depths_m = np.array([0.0, 2e-6, 5e-6, 10e-6, 20e-6, 50e-6])  # else they follow the waves
    options = {"by": "laws", "form": "none", "ends": "none"}
    return CONTACT.stress(first, second, friction=0.05, depths_m=depths_m, **options)


def within(band: RiskBand) -> NDArray[np.bool_]:
    """Return which waves of a trace belong to a band."""
    number = np.arange(POINTS // 2 + 1) / (POINTS * STEP_M)
    return (number * band.longest_m > 1) & (number * band.shortest_m <= 1)


def test_gradient_is_the_change_of_the_factor() -> None:
    """Each band of either surface, or every third, in the factor of either body."""
    seeds = (3, 5)
    found = stress(*map(surface, seeds))
    assert found.bodies[0].dang_van_near > found.bodies[0].dang_van_near_smooth
    assert {band.surface for band in found.bodies[0].bands} == {1, 2}
    assert found.bodies[0].bands[0].gradient > 0.02
    every = sorted(found.bodies[0].bands, key=lambda band: (band.surface, band.shortest_m))
    for band in every[:: 1 if IS_LONG else 3]:
        logs = []
        for side in (1, -1):
            factors = 1 + side * CHANGE * within(band)
            both = [
                surface(seed, factors if number == band.surface else 1.0)
                for number, seed in enumerate(seeds, 1)
            ]
            logs.append([np.log(body.dang_van_near) for body in stress(*both).bodies])
        expected = np.subtract(*logs) / (2 * CHANGE)
        for change, body in zip(expected, found.bodies, strict=True):
            (same,) = (one for one in body.bands if replace(one, gradient=band.gradient) == band)
            assert same.gradient == pytest.approx(change, rel=2e-3, abs=1e-5)


def test_report_names_the_waves() -> None:
    found = stress(*map(surface, (3, 5)))
    first = found.bodies[0].bands[0]
    assert first.longest_m == OCTAVE * first.shortest_m
    assert f"{first.text}, surface {first.surface}: 1 % less" in stress_text(found)
    summary = stress_summary(found)["bodies"][0]["bands"][0]
    assert summary["gradient"] == first.gradient
    assert len(risk_figure(found).axes) == 2
    faint = [replace(band, gradient=0.001) for band in found.bodies[0].bands]
    bodies = tuple(replace(body, bands=faint) for body in found.bodies)
    assert "remove first" not in stress_text(replace(found, bodies=bodies))
