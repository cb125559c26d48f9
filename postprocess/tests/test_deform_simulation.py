from pathlib import Path

import h5py
import numpy as np
import pytest
from contact import experiment

from ehlwave.cli import main
from ehlwave.errors import SurfaceError
from ehlwave.surface import (
    deform_surface,
    map_surface,
    read_surface,
    simulation_surface,
    trace_surface,
    write_simulation_surface,
)


def test_ends_are_faded_and_the_middle_is_kept() -> None:
    heights = 1e-8 * (3 + np.cos(np.arange(201.0)))
    ready = simulation_surface(trace_surface(heights, 2e-6), "none").height[:, 0]
    assert abs(ready[[0, -1]]).max() < 1e-20
    np.testing.assert_array_equal(ready[20:181], heights[20:181])
    ready = simulation_surface(map_surface(np.outer(heights, heights) * 1e8, 2e-6, 3e-6), "none")
    edges = (ready.height[0], ready.height[-1], ready.height[:, 0], ready.height[:, -1])
    assert max(abs(edge).max() for edge in edges) < 1e-20


def test_periods_are_repeated() -> None:
    wave = 1e-8 * np.cos(2 * np.pi * np.arange(16) / 16)
    ready = simulation_surface(trace_surface(wave, 4e-6), "none", repeat=10)
    assert ready.height.shape == (160, 1)
    np.testing.assert_allclose(ready.height[64:80, 0], wave, rtol=1e-12)


def test_file_holds_y_rows_in_metres_and_is_read_again(tmp_path: Path) -> None:
    heights = 1e-8 * np.random.default_rng(2).standard_normal((30, 21))
    surface = map_surface(heights, 2e-6, 3e-6)
    write_simulation_surface(surface, tmp_path / "s.h5")
    with h5py.File(tmp_path / "s.h5") as file:
        np.testing.assert_array_equal(file["height"][()], heights.T)
        np.testing.assert_allclose(file["x"][()], np.arange(30) * 2e-6)
        np.testing.assert_allclose(file["y"][()], (np.arange(21) - 10) * 3e-6)
    again = read_surface(tmp_path / "s.h5")
    np.testing.assert_array_equal(again.height, heights)
    assert (again.step_x_m, again.step_y_m) == pytest.approx((2e-6, 3e-6))


def test_command_writes_what_deform_reads(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    heights = 20 * np.cos(2 * np.pi * np.arange(20) / 20)
    np.save(tmp_path / "t.npy", heights)
    arguments = ["surface", str(tmp_path / "t.npy"), "--length-unit", "um", "--height-unit", "nm"]
    arguments += [
        "--step",
        "3",
        "--form",
        "none",
        "--repeat",
        "8",
        "--output",
        str(tmp_path / "s.h5"),
    ]
    assert main(arguments) == 0
    assert "160 x 1 points, 477 um long" in capsys.readouterr().out
    surface = read_surface(tmp_path / "s.h5")
    assert surface.height.shape == (160, 1)
    assert deform_surface(surface, experiment(), window="none").statistics.rq_before_m > 1e-8


def test_what_cannot_move_through_a_contact_is_refused() -> None:
    heights = 1e-8 * np.cos(np.arange(100.0))
    with pytest.raises(SurfaceError, match="nothing that moves"):
        simulation_surface(trace_surface(heights, 1e-6, "y"))
    with pytest.raises(SurfaceError, match="repeat=0"):
        simulation_surface(trace_surface(heights, 1e-6), "none", 0)


def test_a_transfer_predicts_the_film_of_that_wave() -> None:
    """Phases of tables and predictions agree: x on the surface, along its motion."""
    contact = experiment()
    transfer, wave, a = 0.6 * np.exp(0.4j), 0.8, contact.semi_axis_a_m

    class OneWave:
        name, covers_all, outside_reason = "one wave", True, ""

        def ratio(self, qx, qy):  # noqa: ANN001, ANN202
            value = np.where(qx > 0, transfer, np.conj(transfer))
            return np.where((qx == 0) & (qy == 0), 0, value)

        def error(self, qx, qy):  # noqa: ANN001, ANN202
            return None

        def rise(self, qx, qy):  # noqa: ANN001, ANN202
            return None

        def is_covered(self, qx, qy):  # noqa: ANN001, ANN202
            return np.ones(np.broadcast_shapes(qx.shape, qy.shape), dtype=bool)

    points = 64
    x = np.arange(points) * wave * a / points
    surface = trace_surface(1e-8 * np.cos(2 * np.pi * x / (wave * a)), x[1])
    found = deform_surface(surface, contact, OneWave(), "none", "none").height[:, 0]
    expected = 1e-8 * np.real(transfer * np.exp(2j * np.pi * x / (wave * a)))
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-21)
