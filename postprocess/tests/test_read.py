import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray as xr
from synthetic import make_columns, write_results

from ehlwave import ResultsError, read_results


@pytest.mark.parametrize("pad", ["null", "space"])
def test_text_and_numbers_come_back(tmp_path: Path, pad: str) -> None:
    columns = make_columns()
    results = read_results([write_results(tmp_path / "r.h5", columns, pad=pad)])
    assert dict(results.sizes) == {"case": 60}
    for name, values in columns.items():
        np.testing.assert_array_equal(results[name].values, values, err_msg=name)
    assert results["seconds"].attrs == {"units": "seconds", "long_name": "seconds"}


def test_the_file_opens_in_plain_xarray(results_file: Path) -> None:
    with xr.open_dataset(results_file, engine="h5netcdf") as opened:
        assert opened["v"].dims == ("case",)


def test_files_are_joined_and_origin_is_kept(tmp_path: Path) -> None:
    columns = make_columns()
    first = write_results(tmp_path / "a.h5", columns, git_revision="one")
    del columns["cells_x"]
    second = write_results(tmp_path / "b.h5", columns, git_revision="two")
    results = read_results([first, second])
    assert results["case"].values.tolist() == list(range(1, 121))
    assert results["case_in_file"].values[[0, 59, 60, 119]].tolist() == [1, 60, 1, 60]
    assert results["git_revision"].values[[0, 119]].tolist() == ["one", "two"]
    assert results["source_file"].values[[0, 119]].tolist() == [str(first), str(second)]
    assert results["cells_x"].values[0] == 256
    assert np.isnan(results["cells_x"].values[119])


def test_a_case_tells_its_own_version(tmp_path: Path) -> None:
    columns = make_columns()
    versions = np.full(len(columns["case_id"]), "0.2.0")
    versions[:3] = ["0.1.0", "", "0.1.0"]
    path = write_results(
        tmp_path / "r.h5", {**columns, "program_version": versions}, program_version="0.2.0"
    )
    found = read_results([path])["program_version"]
    assert found.dims == ("case",)
    assert found.values.tolist()[:4] == ["0.1.0", "0.2.0", "0.1.0", "0.2.0"]


def test_scalars_are_repeated_and_other_shapes_left_out(results_file: Path) -> None:
    with h5py.File(results_file, "a") as file:
        file["batch"] = np.bytes_("night ")
        trace = file.create_dataset("trace", data=np.zeros((60, 7)))
        file["sample"] = np.arange(7)
        file["sample"].make_scale("sample")
        trace.dims[0].attach_scale(file["case"])
        trace.dims[1].attach_scale(file["sample"])
    results = read_results([results_file])
    assert results["batch"].values.tolist() == ["night"] * 60
    assert "trace" not in results


@pytest.mark.filterwarnings("error")
def test_an_unattached_dataset_of_other_length_is_no_obstacle(results_file: Path) -> None:
    with h5py.File(results_file, "a") as file:
        file["levels"] = np.arange(5)
    results = read_results([results_file])
    assert results.sizes["case"] == 60
    assert "levels" not in results


def test_smallest_films_of_old_stores_that_are_none_are_flagged(tmp_path: Path) -> None:
    columns = make_columns()
    films = np.full(len(columns["case_id"]), 0.02)
    films[[3, 5]] = [-0.005, 0]
    path = write_results(tmp_path / "r.h5", {**columns, "smallest_film": films})
    results = read_results(path)
    assert np.isnan(results["smallest_film"].values[[3, 5]]).all()
    assert np.flatnonzero(results["surfaces_touch"].values).tolist() == [3, 5]
    assert results["smallest_film"].values[4] == films[4]


def test_a_file_without_cases_is_read(tmp_path: Path) -> None:
    empty = {name: values[:0] for name, values in make_columns().items()}
    assert read_results([write_results(tmp_path / "r.h5", empty)]).sizes["case"] == 0


def _write_text(path: Path) -> None:
    path.write_text("not HDF5")


def _write_other_hdf5(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file["x"] = 1


def _write_without_v2(path: Path) -> None:
    columns = make_columns()
    del columns["v2"]
    write_results(path, columns)


def _write_short_column(path: Path) -> None:
    write_results(path, make_columns())
    with h5py.File(path, "a") as file:
        del file["v"]
        file["v"] = np.zeros(3)


def _write_without_scale(path: Path) -> None:
    write_results(path, make_columns())
    with h5py.File(path, "a") as file:
        del file["case"]
        file["case"] = np.arange(60)


def test_a_file_that_another_program_writes_names_the_lock(results_file: Path) -> None:
    hold = f"import h5py, sys; f = h5py.File({str(results_file)!r}, 'r+'); print(); input()"
    command = [sys.executable, "-c", hold]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as holder:
        assert holder.stdout is not None
        holder.stdout.readline()
        with pytest.raises(
            ResultsError, match=r"another program holds it .* HDF5_USE_FILE_LOCKING"
        ):
            read_results([results_file])
        holder.communicate(b"\n")
    assert read_results([results_file]).sizes["case"] > 0


def _write_truncated(path: Path) -> None:
    write_results(path, make_columns())
    path.write_bytes(path.read_bytes()[:3000])


@pytest.mark.parametrize(
    ("write", "message"),
    [
        (lambda path: None, "no such file"),
        (lambda path: path.mkdir(), "is a directory"),
        (_write_text, "cannot be read as HDF5"),
        (_write_truncated, "cannot be read as HDF5"),
        (_write_other_hdf5, "not a results file of ehlwave-sweep .it has no attribute 'format'"),
        (
            lambda path: write_results(path, make_columns(), format="other"),
            "not a results file of ehlwave-sweep .its format is 'other'",
        ),
        (
            lambda path: write_results(path, make_columns(), format_version=2),
            "format version 2 is newer .* update ehlwave",
        ),
        (
            lambda path: write_results(path, make_columns(), format_version=0),
            "unknown format version 0",
        ),
        (
            lambda path: write_results(path, make_columns(), format_version=None),
            "'format_version' is not a number",
        ),
        (_write_without_v2, "missing dataset v2$"),
        (_write_short_column, "dataset v does not have one value per case"),
        (_write_without_scale, "dataset case is not a dimension scale"),
    ],
)
def test_bad_files_are_refused(
    tmp_path: Path, write: Callable[[Path], object], message: str
) -> None:
    path = tmp_path / "bad.h5"
    write(path)
    with pytest.raises(ResultsError, match=message) as caught:
        read_results([path])
    assert str(caught.value).startswith(f"{path}: ")


def test_a_file_given_twice_is_refused(results_file: Path) -> None:
    with pytest.raises(ResultsError, match="given twice"):
        read_results([results_file, Path(os.path.relpath(results_file))])
