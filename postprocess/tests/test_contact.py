from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from synthetic import written_names

from ehlwave.cli import main
from ehlwave.errors import ResultsError
from ehlwave.results.case_file import contact_figure, read_contact


def _write(path: Path, y: np.ndarray, **attributes: str) -> Path:
    """Write a film of 1 + X + 10 |Y|, distinct at each point, over a central film of 0.5."""
    x = np.linspace(-2.5, 1.5, 9)
    film = 1 + x[None, :] + 10 * np.abs(y)[:, None]
    fields = {"film": (("y", "x"), film), "pressure": (("y", "x"), 0 * film + 1)}
    contact = xr.Dataset({**fields, "central_film": 0.5}, {"x": x, "y": y})
    contact.attrs = {"format": "ehlwave-case", "status": "converged"} | attributes
    contact.to_netcdf(path, engine="h5netcdf")
    return path


def test_a_half_is_completed_by_its_mirror_image(tmp_path: Path) -> None:
    half = read_contact(_write(tmp_path / "half.h5", np.linspace(0, 2, 5)))
    whole = read_contact(_write(tmp_path / "whole.h5", np.linspace(-2, 2, 9)))
    assert half["y"].values.tolist() == whole["y"].values.tolist()
    xr.testing.assert_identical(half["film"], whole["film"])
    assert half["central_film"].shape == ()


def test_maps_and_the_centre_line_show_the_fields(tmp_path: Path) -> None:
    figure = contact_figure(read_contact(_write(tmp_path / "c.h5", np.linspace(0, 2, 5))))
    titles = [axes.get_title() for axes in figure.axes]
    assert titles[:3] == ["pressure $P$", "film $H/H_c$", "$Y=0$"]
    line = figure.axes[2].lines[0]
    np.testing.assert_allclose(line.get_ydata(), np.minimum((1 + line.get_xdata()) / 0.5, 2))


def test_a_line_contact_has_one_panel(tmp_path: Path) -> None:
    figure = contact_figure(read_contact(_write(tmp_path / "line.h5", np.zeros(1))))
    assert [axes.get_title() for axes in figure.axes] == ["$Y=0$", ""]


def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = _write(tmp_path / "c.h5", np.linspace(0, 2, 5))
    assert main(["contact", str(file), "--output", str(tmp_path / "out")]) == 0
    assert written_names(tmp_path / "out") == {"c.png", "c.pdf"}
    other = _write(tmp_path / "r.h5", np.zeros(1), format="ehlwave-results")
    assert main(["contact", str(other)]) == 2
    assert "not a file of ehlwave-case" in capsys.readouterr().err


def test_what_cannot_be_read_is_named(tmp_path: Path) -> None:
    (tmp_path / "text.h5").write_text("no HDF5")
    for name, said in (("text.h5", "cannot be read"), ("absent.h5", "no such file")):
        with pytest.raises(ResultsError, match=f"{name}: {said}"):
            read_contact(tmp_path / name)
    path = tmp_path / "empty.h5"
    attributes = {"format": "ehlwave-case", "status": "stalled"}
    xr.Dataset(attrs=attributes).to_netcdf(path, engine="h5netcdf")
    with pytest.raises(ResultsError, match="status stalled"):
        read_contact(path)
