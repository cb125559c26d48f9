import csv
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from synthetic import Columns, make_columns, write_results, written_names

from ehlwave.cli import main

pytestmark = pytest.mark.usefixtures("legible_figures")

Capture = pytest.CaptureFixture[str]
EHLWAVE = [sys.executable, "-m", "ehlwave"]
KEY = ("orientation", "load_parameter_m", "radius_ratio_d", "wavelength_over_a")


def _rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def _by_coordinates(columns: Columns) -> dict[tuple[object, ...], int]:
    keys = zip(*(columns[name].tolist() for name in KEY), strict=True)
    return {key: index for index, key in enumerate(keys)}


def test_collapse_writes_figures_and_the_points_in_them(tmp_path: Path, capsys: Capture) -> None:
    columns = make_columns()
    columns["is_resolved"][7] = 0
    source = write_results(tmp_path / "r.h5", columns)
    output = tmp_path / "new" / "folder"
    assert main(["collapse", str(source), "--output", str(output)]) == 0
    expected = {"collapse.csv", *(f"figure{n}.{kind}" for n in (1, 2) for kind in ("png", "pdf"))}
    assert written_names(output) == expected
    assert "59 resolved and 0 unresolved" in capsys.readouterr().out
    index = _by_coordinates(columns)
    rows = _rows(output / "collapse.csv")
    assert len(rows) == 59
    for row in rows:
        case = index[(row["orientation"], *(float(row[name]) for name in KEY[1:]))]
        assert row["case_id"] == columns["case_id"][case]
        assert float(row["deformed_ratio"]) == columns["amplitude_ratio_fit"][case]
        for x, name in (("f_v", "v"), ("f_v2", "v2")):
            assert float(row[x]) == columns["f_r"][case] * columns[name][case]


def test_collapse_options(tmp_path: Path, capsys: Capture) -> None:
    columns = make_columns()
    columns["is_resolved"][7] = 0
    columns["v"][3] = 150.0
    source = str(write_results(tmp_path / "r.h5", columns))
    options = ["--include-unresolved", "--ratio", "sampled", "--output", str(tmp_path)]
    assert main(["collapse", source, *options]) == 0
    captured = capsys.readouterr()
    assert "59 resolved and 1 unresolved" in captured.out
    assert "1 point(s) lie outside the axes of figure2" in captured.err
    rows = {row["case_id"]: row for row in _rows(tmp_path / "collapse.csv")}
    assert rows["case0007"]["is_resolved"] == "0"
    assert float(rows["case0009"]["deformed_ratio"]) == columns["amplitude_ratio"][9]


def test_refit_prints_and_writes(tmp_path: Path, results_file: Path, capsys: Capture) -> None:
    command = ["refit", str(results_file), "--output", str(tmp_path), "--replicates", "20"]
    assert main(command) == 0
    text = capsys.readouterr().out
    assert [line.split()[0] for line in text.splitlines() if " f V " in line] == [
        "paper",
        *["all", "transverse", "isotropic", "longitudinal"] * 2,
    ]
    document = json.loads((tmp_path / "refit.json").read_text())
    assert document["paper"] == {"c1": 0.15, "c2": 0.015}
    assert document["sources"][0]["git_revision"] == "abc1234"
    assert document["settings"]["replicates"] == 20
    for row, written in zip(document["rows"], _rows(tmp_path / "refit.csv"), strict=True):
        assert row["group"] == written["group"]
        assert row["c1"] == float(written["c1"])
        assert row["c1_bootstrap_low"] == float(written["c1_bootstrap_low"])
    assert document["rows"][0]["c1"] == pytest.approx(0.2)
    assert main([*command, "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == document


def test_refit_of_too_few_points_says_so(tmp_path: Path, capsys: Capture) -> None:
    columns = make_columns(conditions={(100.0, 1.0): 1.0}, wavelengths=(0.5,))
    source = write_results(tmp_path / "r.h5", columns)
    assert main(["refit", str(source), "--output", str(tmp_path)]) == 0
    assert "too few points (3; at least 4 needed)" in capsys.readouterr().out
    rows = json.loads((tmp_path / "refit.json").read_text())["rows"]
    assert rows[0]["c1"] is None


def test_table_counts_and_lists_failures(tmp_path: Path, capsys: Capture) -> None:
    columns = make_columns()
    columns["status"] = columns["status"].astype("U12")
    columns["status"][[0, 7, 8, 9]] = ["stalled", "pending", "unresolved", "not_finite"]
    columns["is_resolved"][1] = 0
    assert main(["table", str(write_results(tmp_path / "r.h5", columns))]) == 0
    counts, failed = capsys.readouterr().out.split("\n\n")
    lines = [line.split() for line in counts.splitlines()]
    assert lines[0][:6] == [
        "orientation",
        "cases",
        "converged",
        "unresolved",
        "stalled",
        "not_finite",
    ]
    assert lines[1] == ["all", "60", "56", "1", "1", "1", "1", "55"]
    assert lines[2] == ["transverse", "20", "19", "0", "1", "0", "0", "18"]
    assert [line.split()[:3] for line in failed.splitlines()[2:]] == [
        ["1", "case0000", "stalled"],
        ["10", "case0009", "not_finite"],
    ]


def test_table_without_failures(results_file: Path, capsys: Capture) -> None:
    assert main(["table", str(results_file)]) == 0
    assert "No case failed." in capsys.readouterr().out


def test_export_keeps_every_column_and_digit(tmp_path: Path, results_file: Path) -> None:
    target = tmp_path / "sub" / "all.csv"
    assert main(["export", str(results_file), "--csv", str(target)]) == 0
    columns, rows = make_columns(), _rows(target)
    assert set(columns) < set(rows[0])
    for name, values in columns.items():
        found = np.array([row[name] for row in rows]).astype(values.dtype)
        np.testing.assert_array_equal(found, values, err_msg=name)


@pytest.mark.parametrize("command", ["collapse", "refit"])
def test_no_usable_points(tmp_path: Path, capsys: Capture, command: str) -> None:
    columns = make_columns()
    columns["is_resolved"][:] = 0
    source = write_results(tmp_path / "r.h5", columns)
    assert main([command, str(source), "--output", str(tmp_path / "out")]) == 2
    assert "no usable points" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_output_that_cannot_be_written(results_file: Path, capsys: Capture) -> None:
    assert main(["collapse", str(results_file), "--output", str(results_file)]) == 2
    assert f"error: {results_file}: is not a folder" in capsys.readouterr().err


def test_bad_option_values(results_file: Path, capsys: Capture) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["refit", str(results_file), "--replicates", "-3"])
    assert caught.value.code == 2
    assert "not a whole number" in capsys.readouterr().err


@pytest.mark.parametrize("command", [["collapse"], ["refit"], ["table"], ["export", "--csv", "x"]])
def test_a_newer_format_ends_the_program_with_a_message(
    tmp_path: Path, command: list[str], capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = write_results(tmp_path / "r.h5", make_columns(), format_version=2)
    monkeypatch.chdir(tmp_path)
    assert main([command[0], str(source), *command[1:]]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"ehlwave: error: {source}: format version 2 is newer")
    assert said.count("\n") == 1
    assert written_names(tmp_path) == {"r.h5"}


@pytest.mark.parametrize("command", [["--version"], ["--help"], ["deform", "--help"]])
def test_a_full_disk_and_a_reader_who_has_seen_enough(command: list[str]) -> None:
    with Path("/dev/full").open("w") as full:
        finished = subprocess.run(
            [*EHLWAVE, *command], stdout=full, stderr=subprocess.PIPE, text=True, check=False
        )
    assert finished.returncode == 3
    assert finished.stderr == "ehlwave: error: output: No space left on device\n"
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "w") as closed:
        finished = subprocess.run(
            [*EHLWAVE, *command], stdout=closed, stderr=subprocess.PIPE, text=True, check=False
        )
    assert (finished.returncode, finished.stderr) == (0, "")
