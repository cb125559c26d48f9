import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

import ehlwave
from ehlwave.cases.keys import key_table
from ehlwave.inputs.namelist import scan_namelist
from ehlwave.inputs.namelist_values import plain
from ehlwave.programs.programs import find_program, namelist
from ehlwave.programs.progress import counted, following, run_following
from ehlwave.results.case_figures import case_figure, units_of
from ehlwave.results.undeformed import undeformed_history

MOES = {"load_parameter_m": 60, "lubricant_parameter_l": 6, "radius_ratio_d": 1}
COARSE = {"cells_x": 32, "cells_y": 32}


def has_programs() -> bool:
    try:
        return bool(find_program("ehlwave-case")) and bool(find_program("ehlwave-sweep"))
    except ehlwave.ProgramError:
        return False


needs_programs = pytest.mark.skipif(not has_programs(), reason="the programs are not built")


def test_a_program_that_is_not_there_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("EHLWAVE_PROGRAMS", str(tmp_path))
    with pytest.raises(ehlwave.ProgramError, match="has no program ehlwave-case"):
        find_program("ehlwave-case")
    program = tmp_path / "ehlwave-case"
    program.write_text("#!/bin/sh\n")
    program.chmod(0o755)
    assert find_program("ehlwave-case") == program


def test_input_files_have_fortran_values() -> None:
    text = namelist({"a": {"word": "x", "truth": True, "many": [1, 2.5]}})
    assert text == "&a\n  word = 'x'\n  truth = .true.\n  many = 1, 2.5\n/\n"


@pytest.mark.parametrize("name", ["O'Brien/trace.h5", "trail\\", "\\'x", "a\tb", "'", '&x / ! "y"'])
def test_texts_are_read_as_they_were_given(name: str) -> None:
    groups = {"surface": {"file": name}, "sweep": {"names": [name, "b"], "count": np.int64(3)}}
    read = scan_namelist("texts", namelist(groups).encode())
    entries = {key: entry.values for key, entry in read.entries.items()}
    found = {key: [plain(value) for value in values] for key, values in entries.items()}
    expected = {
        ("surface", "file"): [name],
        ("sweep", "names"): [name, "b"],
        ("sweep", "count"): [3],
    }
    assert found == expected


@needs_programs
@pytest.mark.parametrize("name", ["O'Brien/trace.h5", "it''s.h5", "a,b/c.h5"])
def test_the_program_reads_file_names_as_they_were_given(name: str) -> None:
    lengths = {"radius_x_m": 0.01, "radius_y_m": 0.01, "reduced_modulus_pa": 2e11, "load_n": 20}
    oil = {"mean_speed_m_per_s": 0.1, "viscosity_pa_s": 0.1}
    case = ehlwave.Case(**lengths, **oil, **COARSE, file=name)
    with pytest.raises(ehlwave.ProgramError, match=re.escape(f"file = '{name}': cannot be read")):
        case.plan()


def test_a_text_with_a_line_break_is_refused() -> None:
    with pytest.raises(ehlwave.ProgramError, match=r"file = 'a.nb': has a line break"):
        namelist({"surface": {"file": "a\nb"}})


@needs_programs
def test_keys_are_known_with_their_kinds_and_bounds() -> None:
    table = key_table().set_index("name")
    slip = table.loc["slip_parameter"]
    assert (slip["group"], slip["kind"], slip["default"], slip["maximum"]) == (
        "conditions",
        "number",
        1,
        2,
    )
    assert "harmonic" in table.loc["response", "choices"]
    assert all(table["help"] != "")


def test_a_program_that_lists_no_keys_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "ehlwave-case"
    program.write_text("#!/bin/sh\necho '&conditions'\n")
    program.chmod(0o755)
    monkeypatch.setenv("EHLWAVE_PROGRAMS", str(tmp_path))
    with pytest.raises(ehlwave.ProgramError, match="lists no keys as JSON"):
        key_table.__wrapped__()


@needs_programs
def test_a_case_is_planned_run_and_drawn() -> None:
    case = ehlwave.Case(**MOES, **COARSE, orientation="transverse", wavelength_over_a=1.5)
    assert case.plan()["cells_x"] == 32
    assert "&waviness" in repr(case)
    result = case.run()
    assert result.attrs["status"] in ("converged", "unresolved")
    assert {"x", "y"} == set(result["film"].dims)
    assert result["central_film"].attrs["units"] == "1"
    assert units_of(result).names[0] == "$x/a$"
    rigid = undeformed_history(result)
    assert rigid is not None
    central = float(result["central_film"])
    assert rigid.max() == pytest.approx(1.2 * central, rel=0.02)
    assert len(case_figure(result).axes) >= 6


def test_the_undeformed_film_has_the_waves_of_both_surfaces() -> None:
    """The sum of both pressures alone, the second with 2 - S."""
    time = np.linspace(0, 6, 50)
    keys = {"central_film": 0.3, "slip_parameter": 1.2, "domain_x_min": -2.5}
    waves = {"wavelength_x_over_a": 0.5, "wavelength_x_over_a_2": 0.7}
    given = "&waviness\n amplitude_over_film = 0.1\n/\n"
    given += "&waviness2\n amplitude_over_film_2 = 0.2\n/\n"
    places = {"time": time, "x": [0.0, 1.0], "y": [0.0]}
    case = xr.Dataset({k: ((), v) for k, v in (keys | waves).items()}, coords=places)
    case["film"] = case["pressure"] = (("y", "x"), np.ones((1, 2)))
    case.attrs = {"effective_input": given}
    both = undeformed_history(case)
    first, second = (undeformed_history(case.drop_vars(name)) for name in reversed(waves))
    np.testing.assert_allclose(both, first + second - 0.3, atol=1e-14)
    moved = (2.5 - 0.8 * time[-1]) / 0.7
    assert second[-1] == pytest.approx(0.3 * (1 + 0.2 * np.cos(2 * np.pi * moved)), rel=1e-9)


@needs_programs
def test_unknown_keys_are_refused_with_a_hint() -> None:
    with pytest.raises(ehlwave.ProgramError, match="load_parameter_m"):
        ehlwave.Case(load_parameter=100)
    with pytest.raises(ehlwave.ProgramError, match=r"exit status 2: ehlwave-case: .*cells_x"):
        ehlwave.Case(**MOES, cells_x=-5).plan()


@needs_programs
def test_a_study_returns_text_as_text_and_goes_on(tmp_path: Path) -> None:
    output = tmp_path / "results.h5"
    shared = {**MOES, **COARSE, "orientation": "transverse", "response": "harmonic"}
    study = ehlwave.Study({"wavelength_over_a": [1.0, 2.0], **shared})
    results = study.run(output)
    assert results.sizes["case"] == 2
    assert set(results["status"].values) <= {"converged", "unresolved"}
    with xr.open_dataset(output) as opened:
        assert opened["status"].values[0] in ("converged", "unresolved")
        assert opened["orientation"].values[0] == "transverse"
    rows = [{"wavelength_over_a": wave} for wave in (1.0, 2.0, 3.0)]
    again = ehlwave.Study(rows, **shared).run(output)
    assert again.sizes["case"] == 3
    kept = dict(zip(results["case_id"].values, results["seconds"].values, strict=True))
    found = dict(zip(again["case_id"].values, again["seconds"].values, strict=True))
    assert all(found[name] == seconds for name, seconds in kept.items())
    assert "32 x 32" in study.plan()
    with pytest.warns(UserWarning, match="the store also holds 2 "):
        ehlwave.Study(rows[:1], **shared).run(output)


@needs_programs
def test_a_case_says_how_far_it_is_and_stops_where_its_follower_fails() -> None:
    waves = {"orientation": "transverse", "wavelength_over_a": 1, "amplitude_over_film": 0.1}
    case = ehlwave.Case(**MOES, **COARSE, **waves)
    said: list[tuple[int, int, str]] = []
    result = case.run(progress=lambda *line: said.append(line))
    assert result.attrs["status"] in ("converged", "unresolved")
    assert "time step" in {text for _, _, text in said}
    assert "steady state" in said[0][2]
    done, whole, _ = [line for line in said if line[2] == "time step"][-1]
    assert done == whole > 1

    def fails(*_: object) -> None:
        raise KeyError("a fault of the caller")

    with pytest.raises(KeyError, match="a fault"):
        case.run(progress=fails)


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("2026-11-23T21:00:31+0000 time step 3/88\n", (3, 88, "time step")),
        (
            "2026-11-23T21:00:31+0000 coarser grid: time step 1/44",
            (1, 44, "coarser grid: time step"),
        ),
        ("2026-11-23T20:58:06+0000 6/9 cases, 0 failed, 0:01 elapsed", (6, 9, "cases")),
        ("results in a/1/2.h5", None),
        ("      6 converged", None),
    ],
)
def test_lines_of_progress_are_known(line: str, found: tuple[int, int, str] | None) -> None:
    assert counted(line) == found


def test_a_program_that_is_followed_ends_in_time_and_keeps_both_streams() -> None:
    code = "import sys; print('now 1/2 cases'); print('e', file=sys.stderr); sys.exit(3)"
    said: list[tuple[int, int, str]] = []
    done = run_following([sys.executable, "-c", code], lambda *line: said.append(line), "stdout")
    assert (done.returncode, done.stdout, done.stderr) == (3, "now 1/2 cases\n", "e\n")
    assert said == [(1, 2, "cases")]
    sleeps = [sys.executable, "-c", "import time; time.sleep(600)"]
    with pytest.raises(subprocess.TimeoutExpired):
        run_following(sleeps, lambda *_: None, "stdout", seconds=0.2)


def test_a_notebook_with_tqdm_shows_a_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[tuple[int, int]] = []

    class Bar:
        total, n = 0, 0

        def __enter__(self) -> "Bar":
            return self

        def __exit__(self, *_: object) -> None:
            pass

        def set_description(self, _: str) -> None:
            shown.append((self.n, self.total))

    class ZMQInteractiveShell:
        pass

    monkeypatch.setitem(sys.modules, "ipywidgets", SimpleNamespace())
    monkeypatch.setitem(sys.modules, "tqdm.auto", SimpleNamespace(tqdm=Bar))
    with following(None) as callback:
        assert callback is None  # this is no notebook
    ipython = SimpleNamespace(get_ipython=ZMQInteractiveShell)
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    with following(None) as callback:
        assert callback is not None
        callback(3, 8, "cases")
    assert shown == [(3, 8)]
    with following(False) as callback:
        assert callback is None


@needs_programs
def test_a_study_has_labels_counts_from_one_and_goes_through_run_sweep(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The launcher takes -n RANKS PROGRAM ...; its rank dies the first time.
    launcher, mark = tmp_path / "launcher", tmp_path / "died"
    text = f'#!/bin/sh\nshift 2\nif [ ! -e {mark} ]; then touch {mark}; kill -9 $$; fi\nexec "$@"\n'
    launcher.write_text(text)
    launcher.chmod(0o755)
    monkeypatch.setenv("EHLWAVE_LAUNCHER", str(launcher))
    rows = [
        {"wavelength_over_a": 1.0, "label": "short"},
        {"wavelength_over_a": 2.0, "label": "long"},
        {"wavelength_over_a": 2.0, "label": "again"},
    ]
    study = ehlwave.Study(rows, **MOES, **COARSE, orientation="transverse", response="harmonic")
    said: list[tuple[int, int, str]] = []
    results = study.run(tmp_path / "r.h5", restarts=1, progress=lambda *line: said.append(line))
    assert mark.exists()
    assert results["case"].values.tolist() == [1, 2]
    assert results["case_in_file"].values.tolist() == [1, 2]
    assert results["label"].values.tolist() == ["short", "long; again"]
    assert said[-1] == (2, 2, "cases")
    again = ehlwave.read_results(tmp_path / "r.h5")
    assert again["label"].values.tolist() == ["lambda/a = 1", "lambda/a = 2"]
    plan = study.plan().splitlines()
    assert [line.split()[0] for line in plan[1:3]] == ["1", "2"]
    mark.unlink()
    with pytest.raises(ehlwave.ProgramError, match="exit status 4"):
        study.run(tmp_path / "s.h5", restarts=0)


@needs_programs
def test_a_case_takes_a_surface_as_an_object(tmp_path: Path) -> None:
    x = np.arange(0, 2e-3, 4e-6)
    waves = ehlwave.surface.trace_surface(2e-8 * np.cos(2 * np.pi * x / 2e-4), 4e-6)
    trace = ehlwave.surface.simulation_surface(waves)
    lengths = {"radius_x_m": 0.01, "radius_y_m": 0.01, "reduced_modulus_pa": 2e11, "load_n": 20}
    keys = lengths | {"mean_speed_m_per_s": 0.5, "viscosity_pa_s": 0.1}
    ehlwave.surface.write_simulation_surface(trace, tmp_path / "t.h5")
    by_file = ehlwave.Case(**keys, **COARSE, file=str(tmp_path / "t.h5")).plan()
    by_object = ehlwave.Case(**keys, **COARSE, file=trace).plan()
    changed = {key for key in by_file if by_file[key] != by_object[key]}
    assert changed <= {"case_id", "effective_input", "surface_file", "expected_seconds"}
    with pytest.raises(ehlwave.ProgramError, match="write_simulation_surface"):
        ehlwave.Study({**keys, "load_n": [20, 30]}, file=trace)
