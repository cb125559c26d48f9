"""Exports are read by the programs that they are for."""

import shutil
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from synthetic import make_columns, write_results

from ehlwave.cli import main
from ehlwave.hdf5 import read_dataset
from ehlwave.results.cf import with_cf

Capture = pytest.CaptureFixture[str]

LENGTHS = {
    "semi_axis_a_m": 2e-4,
    "semi_axis_b_m": 9e-4,
    "hertz_approach_c_m": 1e-6,
    "hertz_pressure_pa": 1.5e9,
}


def write_case(path: Path, *, in_metres: bool = True) -> Path:
    """Write the file of a case with half a contact: P = 1 - X^2/4 - Y^2, H = 0.5 + X^2."""
    x, y = np.linspace(-2, 1.5, 15), np.linspace(0, 1.5, 7)
    pressure = np.maximum(0, 1 - x[None, :] ** 2 / 4 - y[:, None] ** 2)
    film = 0.5 + np.broadcast_to(x**2, pressure.shape)
    units = {"units": "1"}
    numbers = {"load_parameter_m": 100.0, "lubricant_parameter_l": 10.0, "minimum_film": 0.4}
    numbers |= {"central_film": 0.5}
    case = xr.Dataset(
        {
            "pressure": (("y", "x"), pressure, units),
            "film": (("y", "x"), film, units | {"long_name": "H = h/c"}),
            **{name: ((), value, units) for name, value in numbers.items()},
            "peak_memory_mib": ((), 20.0, {"units": "MiB"}),
        },
        coords={"x": ("x", x, units), "y": ("y", y, units)},
        attrs={"format": "ehlwave-case", "status": "converged"},
    )
    if in_metres:
        case = case.assign({name: ((), value, units) for name, value in LENGTHS.items()})
    case.to_netcdf(path, engine="h5netcdf")
    return path


def test_tables_are_the_same_in_every_format(results_file: Path, tmp_path: Path) -> None:
    csv, nc = tmp_path / "r.csv", tmp_path / "r.nc"
    assert main(["export", str(results_file), "--csv", str(csv), "--netcdf", str(nc)]) == 0
    table = pd.read_csv(csv, float_precision="round_trip")
    assert table["case"].tolist() == list(range(1, 61))
    with xr.open_dataset(nc, engine="h5netcdf") as opened:
        np.testing.assert_array_equal(opened["v"].values, table["v"].values)
        assert opened["label"].values.tolist() == table["label"].tolist()
    pytest.importorskip("pyarrow")
    parquet = tmp_path / "r.parquet"
    assert main(["export", str(results_file), "--parquet", str(parquet)]) == 0
    pd.testing.assert_frame_equal(
        pd.read_parquet(parquet)[["case", "v"]], table[["case", "v"]], check_dtype=False
    )


def test_lengths_of_earlier_versions_have_their_new_names(tmp_path: Path) -> None:
    path = tmp_path / "mixed.h5"
    own = xr.Dataset({"semi_axis_a_m": ("case", [np.nan, 2e-4], {"units": "m"})})
    old = {"length_a_m": ("case", [1e-4, np.nan]), "length_c_m": ("case", [1e-6, 2e-6])}
    own.assign(old).to_netcdf(path, engine="h5netcdf")
    found = read_dataset(path)
    assert set(found.data_vars) == {"semi_axis_a_m", "hertz_approach_c_m"}
    np.testing.assert_array_equal(found["semi_axis_a_m"], [1e-4, 2e-4])
    assert found["semi_axis_a_m"].attrs["units"] == "m"


@pytest.mark.parametrize("in_metres", [True, False])
def test_fields_of_a_case_are_read_by_vtk(tmp_path: Path, in_metres: bool) -> None:
    case, grid = write_case(tmp_path / "c.h5", in_metres=in_metres), tmp_path / "c.vtr"
    assert main(["export", str(case), "--vtk", str(grid)]) == 0
    mesh = pytest.importorskip("pyvista").read(grid)
    a, b, c, ph = LENGTHS.values() if in_metres else (1, 1, 1, 1)
    assert mesh.dimensions == (15, 13, 1)  # the half that is not computed is the mirror image
    np.testing.assert_allclose(mesh.bounds[:4], [-2 * a, 1.5 * a, -1.5 * b, 1.5 * b])
    film, pressure = ("film [m]", "pressure [Pa]") if in_metres else ("film", "pressure")
    x, y = mesh.points[:, 0] / a, mesh.points[:, 1] / b
    np.testing.assert_allclose(mesh[film], (0.5 + x**2) * c, rtol=1e-6)
    expected = np.maximum(0, 1 - x**2 / 4 - y**2) * ph
    np.testing.assert_allclose(mesh[pressure], expected, rtol=1e-5, atol=1e-5 * ph)


def test_attributes_are_those_of_cf(results_file: Path, tmp_path: Path) -> None:
    table, fields = tmp_path / "r.nc", tmp_path / "c.nc"
    case = write_case(tmp_path / "c.h5")
    assert main(["export", str(results_file), "--netcdf", str(table)]) == 0
    assert main(["export", str(case), "--netcdf", str(fields)]) == 0
    for path in (table, fields):
        with h5py.File(path) as file:
            assert file.attrs["Conventions"] in ("CF-1.8", b"CF-1.8")
            for name in file:
                assert file[name].dtype != np.int64, name
                assert file[name].attrs["long_name"], name
            assert all("_FillValue" not in file[name].attrs for name in ("x", "y") if name in file)
    with xr.open_dataset(fields, engine="h5netcdf") as opened:
        assert opened["pressure"].attrs["units"] == "Pa"
        assert float(opened["pressure"].max()) == pytest.approx(1.5e9)
        assert opened["peak_memory_mib"].attrs["units"] == "1048576 byte"


def test_a_checker_agrees_with_the_attributes(results_file: Path, tmp_path: Path) -> None:
    checker = shutil.which("compliance-checker")
    if checker is None:
        pytest.skip("there is no compliance-checker: pip install compliance-checker")
    fields, table = tmp_path / "c.nc", tmp_path / "r.nc"
    assert main(["export", str(write_case(tmp_path / "c.h5")), "--netcdf", str(fields)]) == 0
    assert main(["export", str(results_file), "--netcdf", str(table)]) == 0
    for path in (fields, table):
        command = [checker, "--test", "cf:1.8", str(path)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert "All tests passed!" in done.stdout, done.stdout + done.stderr


def test_flags_have_meanings() -> None:
    flags = xr.Dataset({"is_inside": ("x", [True, False])}, attrs={"note": "a", "lost": None})
    found = with_cf(flags, "flags")
    assert found["is_inside"].values.tolist() == [1, 0]
    assert found["is_inside"].attrs["flag_meanings"] == "no yes"
    assert found.attrs["note"] == "a"
    assert "lost" not in found.attrs
    assert flags["is_inside"].dtype == bool


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["r.h5"], "name a file to write"),
        (["r.h5", "--vtk", "a.vtr"], "--vtk takes the file of one case"),
        (["c.h5", "--csv", "a.csv"], "--csv takes results of ehlwave-sweep"),
    ],
)
def test_formats_that_do_not_fit_are_refused(
    words: list[str], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    monkeypatch.chdir(tmp_path)
    write_results(tmp_path / "r.h5", make_columns())
    write_case(tmp_path / "c.h5")
    assert main(["export", *words]) == 2
    assert said in capsys.readouterr().err
    assert not {"a.vtr", "a.csv"} & {path.name for path in tmp_path.iterdir()}


def test_a_text_that_no_file_can_hold_is_said(tmp_path: Path, capsys: Capture) -> None:
    case = write_case(tmp_path / "c.h5")
    with h5py.File(case, "a") as file:
        file.attrs["status"] = np.array("conv\0erged", dtype=h5py.string_dtype(length=12))
    assert main(["export", str(case), "--netcdf", str(tmp_path / "c.nc")]) == 2
    said = capsys.readouterr().err
    assert "cannot hold" in said
    assert said.count("\n") == 1
    assert not (tmp_path / "c.nc").exists()
