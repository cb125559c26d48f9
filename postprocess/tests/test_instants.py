"""Instants of a march: drawn by plot --time, and in motion."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from PIL import Image

from ehlwave.cli import main
from ehlwave.errors import ResultsError
from ehlwave.results.case_figures import case_figure
from ehlwave.results.case_file import read_contact
from ehlwave.results.instants import at_instant

TIMES = np.array([0.0, 1.0, 2.0, 3.0])


def _march(path: Path, y: np.ndarray, *, over_time: bool = True) -> Path:
    """Write a march whose film at stored instant k is 1 + k at all points."""
    x = np.linspace(-2.5, 1.5, 9)
    shape = np.ones((y.size, x.size))
    columns = {
        "film": (("y", "x"), 4 * shape),
        "pressure": (("y", "x"), shape),
        "film_at_centre": ("time", 1 + TIMES),
        "central_film": 1.5,
        "load_parameter_m": 100.0,
        "lubricant_parameter_l": 12.05,
        "radius_ratio_d": 1.0,
        "slip_parameter": 1.0,
    }
    if over_time:
        rising = (1 + np.arange(4.0))[:, None, None] * shape
        columns["film_over_time"] = (("field_time", "y", "x"), rising)
        columns["pressure_over_time"] = (("field_time", "y", "x"), 0 * rising + 1)
    case = xr.Dataset(columns, {"x": x, "y": y, "time": TIMES})
    if over_time:
        case = case.assign_coords(field_time=TIMES)
    case.attrs = {"format": "ehlwave-case", "status": "converged"}
    case.to_netcdf(path, engine="h5netcdf")
    return path


@pytest.mark.parametrize("y", [np.linspace(0, 2, 5), np.zeros(1)])
def test_the_nearest_instant_is_drawn(tmp_path: Path, y: np.ndarray) -> None:
    case = read_contact(_march(tmp_path / "m.h5", y))
    shown = at_instant(case, 1.9)
    assert float(shown["instant"]) == 2
    assert (shown["film"].values == 3).all()
    assert shown["film"].sizes == case["film"].sizes
    figure = case_figure(case, 0.1)
    assert "$T$ = 0" in figure.get_suptitle()
    assert "$M$ = 100, $L$ = 12.05, $D$ = 1" in figure.get_suptitle()


def test_instants_that_are_not_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case = read_contact(_march(tmp_path / "m.h5", np.linspace(0, 2, 5)))
    with pytest.raises(ResultsError, match="outside the stored fields, 0 to 3"):
        at_instant(case, 7)
    alone = _march(tmp_path / "alone.h5", np.linspace(0, 2, 5), over_time=False)
    for command in (["plot", str(alone), "--time", "1"], ["animate", str(alone)]):
        assert main([*command, "--output", str(tmp_path)]) == 2
        assert "fields_every" in capsys.readouterr().err


@pytest.mark.parametrize("y", [np.linspace(0, 2, 5), np.zeros(1)])
def test_an_animation_has_a_frame_each_instant(tmp_path: Path, y: np.ndarray) -> None:
    file = _march(tmp_path / "m.h5", y)
    assert main(["animate", str(file), "--output", str(tmp_path / "out")]) == 0
    with Image.open(tmp_path / "out" / "m.gif") as film:
        assert film.n_frames >= 2
        first = np.asarray(film.convert("RGB")).astype(int)
        film.seek(film.n_frames - 1)
        assert np.abs(np.asarray(film.convert("RGB")).astype(int) - first).max() > 100
