import json
import os
import stat
import sys
from dataclasses import replace
from pathlib import Path

import f90nml
import h5py
import numpy as np
import pytest

from ehlwave_post.deform import conditions_from_keys
from ehlwave_post.errors import ResultsError
from studies.experiment import FOLDER, TRACE_FILE, section
from studies.experiment.cases import (
    COSINE,
    GRIDS,
    PAPER_ML,
    PRINTED_L,
    PRINTED_M,
    SMOOTH,
    SPEEDS,
    TRACE,
    Run,
    all_runs,
    groups_of,
    read_input,
)
from studies.experiment.discussion import outcome
from studies.experiment.maps import RED_UM, REFRACTIVE_INDEX, fringes, whole
from studies.experiment.measure import (
    extrapolated,
    half_range_um,
    line_amplitude_um,
    line_mean_um,
    line_transfer,
    read_solved,
    richardson,
    smooth_film_um,
    time_amplitude_um,
    time_mean_um,
)
from studies.experiment.stage import SURFACE_FILE, Stage
from studies.programs import namelist
from studies.section import COMPARISON

INPUTS = Path(__file__).parents[2] / "inputs" / "full"
A_UM, C_UM = 184.6, 2.722
SMOOTH_UM = {0.024: 0.24, 0.048: 0.38, 0.096: 0.60}


def write_run(folder: Path, run: Run, film_um: float, amplitude_um: float) -> None:
    """Write what a run leaves: a wave of 60 um on a level, both with an error of second order."""
    error = (64 / run.cells_x) ** 2
    level, height = film_um * (1 - 0.2 * error), amplitude_um * (1 + 0.5 * error)
    x, y = np.linspace(-2.5, 1.5, run.cells_x + 1), np.linspace(0, 2, 9)
    line = level + height * np.cos(2 * np.pi * x * A_UM / 60 + 0.7)
    film = np.broadcast_to(line, (y.size, x.size)) + 0.01 * y[:, None] ** 2
    time = np.arange(0, 4.5, 4 / run.cells_x)
    history = level + height * np.cos(2 * np.pi * time * A_UM / 60 + 0.3)
    base = read_input(INPUTS / "experiment.nml")
    text = namelist(groups_of(run, base, 0.24e-6, SURFACE_FILE))
    (folder / f"{run.name}.nml").write_text(text)
    values = f90nml.reads(text)
    keys = dict(values["conditions"]) | {"pressure_viscosity_per_pa": 2.25e-8}
    moes = conditions_from_keys(keys)
    with h5py.File(folder / f"{run.name}.h5", "w") as file:
        file["length_a_m"], file["length_c_m"] = A_UM * 1e-6, C_UM * 1e-6
        file["hertz_pressure_pa"] = 0.549e9
        file["x"], file["y"] = x, y
        file["film"], file["pressure"] = film / C_UM, np.ones(film.shape)
        if run.surface != SMOOTH:
            file["time"], file["film_at_centre"] = time, history / C_UM
    result = {
        "status": "converged",
        "central_film": level / C_UM,
        "load_parameter_m": moes.m,
        "lubricant_parameter_l": moes.l,
        "alphabar": 12.36,
        "lambdabar": 0.0159,
        "time_steps": 0,
        "residual": 1e-5,
        "points_per_wave_x": 0,
        "inlet_resolution": 0.07,
        "seconds": 1.0,
    }
    record = {"input": "synthetic", "result": result}
    (folder / f"{run.name}.json").write_text(json.dumps(record))


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a study whose films are known: waves raise them by 10 nm."""
    folder = tmp_path_factory.mktemp("study")
    files = folder / FOLDER
    files.mkdir()
    (files / TRACE_FILE).write_text((INPUTS / TRACE_FILE).read_text())
    Stage(Path("none"), files, {}).prepare_surface(files / TRACE_FILE)
    for run in all_runs():
        smooth = SMOOTH_UM[run.speed]
        film, amplitude = (smooth, 0) if run.surface == SMOOTH else (smooth + 0.01, 0.13)
        write_run(files, run, film, amplitude)
    return folder


def test_measures_find_the_wave_and_the_level_on_both_grids(study: Path) -> None:
    for kind in (TRACE, COSINE):
        for measure, expected in (
            (line_mean_um, 0.25),
            (time_mean_um, 0.25),
            (line_amplitude_um, 0.13),
            (time_amplitude_um, 0.13),
        ):
            found = extrapolated(study / FOLDER, kind, 0.024, measure)
            assert found.value == pytest.approx(expected, rel=2e-4)
            assert 0.5 * abs(found.coarse - found.fine) < found.error < abs(found.value - 0.2)
    solved = read_solved(study / FOLDER, Run(TRACE, 0.024, *GRIDS[1]))
    assert np.angle(line_transfer(solved)) == pytest.approx(0.7, abs=1e-3)
    assert half_range_um(solved) == pytest.approx(0.13, rel=0.03)
    smooth = extrapolated(study / FOLDER, SMOOTH, 0.096, smooth_film_um)
    assert smooth.value == pytest.approx(0.60, rel=1e-10)


def test_richardson_is_exact_for_errors_of_second_order() -> None:
    found = richardson(3 + 0.9, 3 + 0.4, 1.5)
    assert (found.value, found.error) == pytest.approx((3, 0.4))


def test_section_compares_every_number_and_says_what_misses(study: Path) -> None:
    found = section(study)
    tables = {table.name: table for table in found.tables}
    for table in found.tables:
        assert all(len(row) == len(table.columns) for row in table.rows)
    films = {row[0]: row for row in tables["experiment-comparison"].rows}
    assert tables["experiment-comparison"].columns == COMPARISON
    row = films["mean film, computed at 0.096 m/s"]
    assert row[2:5] == pytest.approx((0.62, 0.61, -0.01), abs=1e-4)
    assert films["smooth central film at 0.024 m/s"][3] == pytest.approx(0.24)
    assert films["rise of the mean film by the waves at 0.024 m/s"][3] == pytest.approx(
        0.01, abs=2e-4
    )
    assert films["Ad/Ai, cosine at 0.048 m/s"][3] == pytest.approx(0.13 / 0.14, rel=1e-3)
    printed = {row[0]: row for row in tables["experiment-conditions"].rows}
    assert printed["V at 0.048 m/s"][3] == pytest.approx(1.035, abs=0.01)
    assert printed["W"][3] == pytest.approx(2.1374e-6, rel=1e-4)
    assert "0.2400 um beside 0.24 um (+0.0 %, within the target of 3 %)" in found.text[1]
    assert len(found.pictures) == 5


def test_a_run_that_did_not_converge_is_named(study: Path, tmp_path: Path) -> None:
    run = Run(SMOOTH, 0.024, *GRIDS[0])
    write_run(tmp_path, run, 0.24, 0)
    record = json.loads((tmp_path / f"{run.name}.json").read_text())
    record["result"]["status"] = "unresolved"
    (tmp_path / f"{run.name}.json").write_text(json.dumps(record))
    with pytest.raises(ResultsError, match=r"smooth-0.024-256.json: status unresolved"):
        read_solved(tmp_path, run)
    with pytest.raises(ResultsError, match="run the stage first"):
        section(tmp_path)


def test_outcome_says_when_a_target_is_missed() -> None:
    assert outcome(-0.02, 0.03) == "-2.0 %, within the target of 3 %"
    assert outcome(0.081, 0.08) == "+8.1 %, MISSES the target of 8 %"
    assert "MISSES" in outcome(float("nan"), 0.08)


def test_inputs_say_what_is_meant() -> None:
    base = read_input(INPUTS / "experiment.nml")
    run = Run(COSINE, 0.048, 128, 64)
    groups = groups_of(run, base, 0.28e-6, "s.h5")
    assert groups["waviness"]["amplitude_over_film"] == pytest.approx(0.5)
    assert groups["waviness"]["wavelength_over_a"] == pytest.approx(60 / 184.614, rel=1e-4)
    assert "surface" not in groups
    assert groups["grid"] == {"cells_x": 128, "cells_y": 64}
    assert set(groups_of(run.smooth, base, None, "s.h5")) & {"surface", "waviness"} == set()
    assert groups_of(replace(run, surface=TRACE), base, None, "s.h5")["surface"]["file"] == "s.h5"
    assert f90nml.reads(namelist(groups))["conditions"]["mean_speed_m_per_s"] == 0.048
    for speed in SPEEDS:
        keys = groups_of(Run(TRACE, speed, 128, 64, PAPER_ML), base, None, "s.h5")["conditions"]
        moes = conditions_from_keys(keys | {"pressure_viscosity_per_pa": 2.25e-8})
        assert (moes.m, moes.l) == pytest.approx((PRINTED_M[speed], PRINTED_L[speed]))
    with pytest.raises(ResultsError, match="no such file"):
        read_input(INPUTS / "none.nml")


def program(folder: Path, ending: str = "") -> Path:
    """Return a program that stands for ehlwave-case; it notes each input it was given."""
    path = folder / "case"
    path.write_text(
        f"#!{sys.executable} -S\n"
        "import sys, pathlib\n"
        "open('calls', 'a').write(sys.argv[1] + '\\n')\n"
        "pathlib.Path(sys.argv[sys.argv.index('--output') + 1]).write_text('fields')\n"
        f"{ending}\n"
        "print('text')\n"
        'print(\'{"status": "converged", "central_film_um": 0.28}\')\n'
    )
    os.chmod(path, path.stat().st_mode | stat.S_IXUSR)  # noqa: PTH101
    return path


def test_stage_runs_each_case_once_and_again_when_its_input_changed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    runs = [Run(surface, 0.024, 32, 16) for surface in (SMOOTH, TRACE, COSINE)]
    base = read_input(INPUTS / "experiment.nml")
    stage = Stage(program(tmp_path), tmp_path, base)
    stage.prepare_surface(INPUTS / TRACE_FILE)
    stage.run_all(runs, 2)
    calls = (tmp_path / "calls").read_text().split()
    assert (calls[0], sorted(calls)) == (
        "smooth-0.024-32.nml",
        ["cosine-0.024-32.nml", "smooth-0.024-32.nml", "trace-0.024-32.nml"],
    )
    assert "amplitude_over_film = 0.5" in (tmp_path / "cosine-0.024-32.nml").read_text()
    assert "0 to go" in capsys.readouterr().out
    Stage(program(tmp_path), tmp_path, base).run_all(runs, 1)
    assert len((tmp_path / "calls").read_text().split()) == 3
    # killed: fields but no record, or a record that was cut off
    (tmp_path / "trace-0.024-32.json").write_text('{"input": "')
    (tmp_path / "cosine-0.024-32.h5").unlink()
    Stage(program(tmp_path), tmp_path, base).run_all(runs, 1)
    assert sorted((tmp_path / "calls").read_text().split()[3:]) == [
        "cosine-0.024-32.nml",
        "trace-0.024-32.nml",
    ]
    # another surface: what depends on it, and nothing else
    shifted = tmp_path / "shifted.csv"
    rows = (INPUTS / TRACE_FILE).read_text().splitlines()
    shifted.write_text("\n".join(rows[:5] + rows[25:]) + "\n")
    stage = Stage(program(tmp_path), tmp_path, base)
    stage.prepare_surface(shifted)
    stage.run_all(runs, 1)
    assert (tmp_path / "calls").read_text().split()[5:] == ["trace-0.024-32.nml"]


def test_stage_leaves_no_record_of_a_run_that_failed(tmp_path: Path) -> None:
    runs = [Run(surface, 0.024, 32, 16) for surface in (SMOOTH, COSINE)]
    base = read_input(INPUTS / "experiment.nml")
    stage = Stage(program(tmp_path, "sys.exit('no film')"), tmp_path, base)
    with pytest.raises(ResultsError, match="exit status 1: no film") as failure:
        stage.run_all(runs, 1)
    assert "no result of smooth-0.024-32, which it needs" in str(failure.value)
    assert not (tmp_path / "smooth-0.024-32.json").exists()


def test_fringes_are_dark_where_the_reflections_cancel(study: Path) -> None:
    quarter = RED_UM / (4 * REFRACTIVE_INDEX)
    colours = fringes(np.array([0, quarter, 2 * quarter]))
    np.testing.assert_allclose(colours[:, 0], [0, 1, 0], atol=1e-12)
    assert colours[:, 2].max() == 0
    solved = read_solved(study / FOLDER, Run(TRACE, 0.024, *GRIDS[0]))
    y, pressure, film = whole(solved)
    np.testing.assert_array_equal(y, -y[::-1])
    np.testing.assert_array_equal(film, film[::-1])
    assert pressure.shape == film.shape == (17, solved.x.size)
