import numpy as np
import pytest

from ehlwave.errors import SurfaceError
from ehlwave.surface import gaussian_filtered, map_surface, roughness_parameters, trace_surface

STEP = 1e-6
HEIGHT = 1e-8


def wave(length: float, count: int = 4000) -> np.ndarray:
    return HEIGHT * np.cos(2 * np.pi * (np.arange(count) + 0.5) * STEP / length)


def test_half_of_a_wave_as_long_as_the_cutoff_is_transmitted() -> None:
    for length, share in ((80e-6, 0.5), (8e-6, 0.0), (800e-6, np.exp(-np.log(2) / 100))):
        surface = trace_surface(wave(length), STEP)
        short = gaussian_filtered(surface, None, 80e-6).height[:, 0]
        long = gaussian_filtered(surface, 80e-6).height[:, 0]
        np.testing.assert_allclose(short, share * surface.height[:, 0], atol=1e-9 * HEIGHT)
        np.testing.assert_allclose(long, (1 - share) * surface.height[:, 0], atol=1e-9 * HEIGHT)


def test_the_weights_are_those_of_the_standard() -> None:
    # ISO 16610-21: s(x) = exp(-pi (x/(alpha c))^2)/(alpha c)
    point = np.zeros(801)
    point[400] = HEIGHT
    found = gaussian_filtered(trace_surface(point, STEP), None, 100e-6).height[:, 0]
    width = np.sqrt(np.log(2) / np.pi) * 100
    expected = np.exp(-np.pi * ((np.arange(801) - 400) / width) ** 2) / width
    np.testing.assert_allclose(found, HEIGHT * expected, atol=1e-9 * HEIGHT)


def test_a_map_is_filtered_in_all_directions() -> None:
    heights = np.outer(wave(50e-6, 500), wave(50e-6, 500)) / HEIGHT
    surface = map_surface(heights, STEP, STEP)
    found = gaussian_filtered(surface, None, 50e-6).height
    np.testing.assert_allclose(found, 0.25 * heights, atol=1e-9 * HEIGHT)


def test_parameters_of_a_cosine_and_of_a_pit() -> None:
    of = roughness_parameters(wave(100e-6, 1000), is_trace=True)
    assert of["Ra"] == pytest.approx(2 * HEIGHT / np.pi, rel=1e-3)
    assert of["Rq"] == pytest.approx(HEIGHT / 2**0.5)
    assert of["Rsk"] == pytest.approx(0, abs=1e-9)
    assert of["Rku"] == pytest.approx(1.5)
    assert of["Rz"] == pytest.approx(2 * HEIGHT, rel=1e-3)
    flat = np.zeros(1000)
    flat[500] = -5e-6
    pit = roughness_parameters(flat, is_trace=True)
    assert pit["Rt"] == pytest.approx(5e-6)
    assert pit["Rz"] == pytest.approx(1e-6)  # in one of the five sections
    assert roughness_parameters(flat, True, section=1000)["Rz"] == pytest.approx(5e-6)
    assert pit["Rsk"] < -10
    areal = roughness_parameters(flat.reshape(20, 50), is_trace=False)
    assert areal["Sz"] == pytest.approx(5e-6)
    assert areal["Sv"] > areal["Sp"]


def test_equal_heights_have_no_roughness() -> None:
    for level in (0.0, 3e-6, 0.1e-3 / 3):
        found = roughness_parameters(np.full(1000, level), is_trace=True)
        assert [found[name] for name in ("Ra", "Rq", "Rp", "Rv", "Rz", "Rt")] == [0] * 6, level
        assert np.isnan([found["Rsk"], found["Rku"]]).all()


@pytest.mark.parametrize(
    ("cutoffs", "said"), [((1.0,), "length"), ((5e-5, 6e-5), "must lie below")]
)
def test_cutoffs_that_make_no_sense_are_refused(cutoffs: tuple, said: str) -> None:
    with pytest.raises(SurfaceError, match=said):
        gaussian_filtered(trace_surface(wave(100e-6, 200), STEP), *cutoffs)
