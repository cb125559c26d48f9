"""Arrays and objects of SurfaceTopography in and out, wherever the name of a file is taken."""

from pathlib import Path

import numpy as np
import pytest
from contact import BALL

import ehlwave
from ehlwave.surface import ReadOptions, read_surface

STEP = 2e-6


def heights() -> np.ndarray:
    x = np.arange(0, 1e-3, STEP)
    return 5e-8 * np.cos(2 * np.pi * x / 1e-4) + 1e-8 * np.sin(2 * np.pi * x / 3.7e-5)


def rows() -> np.ndarray:
    """Return a map as in files: rows of constant y, 40 rows of 64 points."""
    y, x = np.meshgrid(np.arange(40), np.arange(64), indexing="ij")
    return 1e-8 * np.cos(0.3 * x) + 2e-9 * np.sin(0.5 * y + 0.2 * x)


def test_an_array_is_what_the_same_array_is_in_a_file(tmp_path: Path) -> None:
    contact = ehlwave.Contact(**BALL)
    for values in (heights(), rows()):
        np.save(tmp_path / "a.npy", values)
        of_file = contact.deform(tmp_path / "a.npy", step=STEP, length_unit="m", height_unit="m")
        of_array = contact.deform(values, step=STEP)
        np.testing.assert_array_equal(of_array.height, of_file.height)
        assert of_array.statistics == of_file.statistics
        by_units = contact.deform(values * 1e9, step=2, length_unit="um", height_unit="nm")
        np.testing.assert_allclose(by_units.height, of_file.height, rtol=1e-9, atol=1e-17)
    assert (
        contact.lambda_ratio(heights(), step=STEP)
        == contact.deform(heights(), step=STEP).statistics.lambda_ratio_after
    )
    assert contact.stress(heights(), step=STEP).hertz_pa > 0


def test_an_array_without_a_step_says_so() -> None:
    with pytest.raises(ehlwave.SurfaceError, match="step"):
        ehlwave.Contact(**BALL).deform(heights())
    with pytest.raises(ehlwave.SurfaceError, match="real numbers"):
        read_surface(np.array(["a"] * 9), ReadOptions(step=STEP))


def test_masked_heights_are_missing() -> None:
    values = np.ma.masked_array(heights(), mask=np.arange(heights().size) == 7)
    with pytest.raises(ehlwave.SurfaceError, match="1 of 501 heights are missing"):
        read_surface(values, ReadOptions(step=STEP))
    assert read_surface(values, ReadOptions(step=STEP, fill_missing=True)).height.size == 501


def test_topographies_go_in_and_out() -> None:
    package = pytest.importorskip("SurfaceTopography")
    contact = ehlwave.Contact(**BALL)
    line = package.UniformLineScan(heights() * 1e9, heights().size * STEP * 1e9, unit="nm")
    plane = package.Topography(rows().T, (64 * STEP, 40 * STEP), unit="m")
    for given, values in ((line, heights()), (plane, rows())):
        own = contact.deform(values, step=STEP)
        found = contact.deform(given)
        np.testing.assert_allclose(found.height, own.height, rtol=1e-9, atol=1e-16)
        out = found.to_topography()
        assert out.unit == "m"
        np.testing.assert_allclose(out.pixel_size, STEP, rtol=1e-9)
        np.testing.assert_array_equal(out.heights().ravel(), found.height.ravel())
        again = read_surface(own.surface.to_topography())
        np.testing.assert_allclose(again.height, own.surface.height)
        assert again.step_x_m == pytest.approx(STEP)
    without = package.UniformLineScan(heights(), heights().size * STEP)
    with pytest.raises(ehlwave.SurfaceError, match="unit"):
        contact.deform(without)
