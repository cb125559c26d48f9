from pathlib import Path

import numpy as np
import pytest

from ehlwave.cli import main
from ehlwave.errors import SurfaceError
from ehlwave.surface import cut_period, read_surface, trace_surface

WAVE = 60e-6


def drifting(step: float = 1e-6, count: int = 401) -> tuple[np.ndarray, np.ndarray]:
    """Return a wave of 0.1 um whose level and amplitude drift: its ends do not match."""
    x = np.arange(count) * step
    return x, (1e-7 + 1e-4 * x) * np.cos(2 * np.pi * x / WAVE) + 5e-4 * x


def test_a_period_of_a_cosine_is_that_cosine_without_its_level() -> None:
    x = np.arange(301) * 0.7e-6
    surface = trace_surface(2e-7 + 1e-7 * np.cos(2 * np.pi * x / WAVE), 0.7e-6)
    cut = cut_period(surface, WAVE, 80e-6)
    assert cut.height.shape == (86, 1)
    assert cut.step_x_m == pytest.approx(WAVE / 86, rel=1e-12)
    position = 80e-6 + np.arange(86) * cut.step_x_m
    expected = 1e-7 * np.cos(2 * np.pi * position / WAVE)
    np.testing.assert_allclose(cut.height[:, 0], expected, rtol=0, atol=1e-12)


def test_copies_join_without_a_jump_in_height_or_slope() -> None:
    _, height = drifting()
    plain = height[100:160]
    cut = cut_period(trace_surface(height, 1e-6), WAVE, 100e-6).height[:, 0]
    for values, joins in ((plain, False), (cut, True)):
        around = np.concatenate((values[-3:], values[:3]))
        inside = np.abs(np.diff(values, 2)).max()
        assert (np.abs(np.diff(around, 2)).max() < 1.5 * inside) == joins
    # outside the quarter that fades over nothing but the level is changed
    np.testing.assert_allclose(cut[:45] - cut[0], plain[:45] - plain[0], rtol=0, atol=1e-14)


def test_the_middle_is_the_default() -> None:
    _, height = drifting()
    surface = trace_surface(height, 1e-6)
    expected = cut_period(surface, WAVE, 170e-6).height
    np.testing.assert_allclose(cut_period(surface, WAVE).height, expected, rtol=0, atol=1e-18)


def test_what_cannot_be_cut_is_refused() -> None:
    _, height = drifting()
    surface = trace_surface(height, 1e-6)
    with pytest.raises(SurfaceError, match="from -5 to 70 um; it reaches from 0 to 400"):
        cut_period(surface, WAVE, 10e-6)
    with pytest.raises(SurfaceError, match="from 335 to 410 um"):
        cut_period(surface, WAVE, 350e-6)
    with pytest.raises(SurfaceError, match="shorter than 8 steps"):
        cut_period(surface, 7e-6)
    with pytest.raises(SurfaceError, match="trace along rolling only"):
        cut_period(trace_surface(height, 1e-6, "y"), WAVE)


def test_command_cuts_after_removing_the_form_of_the_whole(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    x, height = drifting()
    lines = [f"{1e6 * a:.3f},{1e6 * b:.9f}" for a, b in zip(x, height, strict=True)]
    (tmp_path / "t.csv").write_text("x [um],height [um]\n" + "\n".join(lines) + "\n")
    arguments = ["surface", str(tmp_path / "t.csv"), "--output", str(tmp_path / "s.h5")]
    assert main([*arguments, "--period", "60", "--period-start", "100", "--repeat", "12"]) == 0
    assert "720 x 1 points" in capsys.readouterr().out
    written = read_surface(tmp_path / "s.h5").height[:, 0]
    np.testing.assert_array_equal(written[300:360], written[360:420])
    slope, level = np.polyfit(x, height, 1)
    cut = cut_period(trace_surface(height - slope * x - level, 1e-6), WAVE, 100e-6).height[:, 0]
    np.testing.assert_allclose(written[300:360], cut, rtol=0, atol=1e-14)
    assert main([*arguments, "--period-start", "100"]) == 2
    assert "without --period" in capsys.readouterr().err
