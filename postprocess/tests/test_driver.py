import re
from pathlib import Path

import f90nml
import numpy as np
import pytest
import xarray as xr

import ehlwave
from ehlwave.case_figures import case_figure, undeformed_history, units_of
from ehlwave.driver import key_table
from ehlwave.programs import find_program, namelist

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
    read = f90nml.reads(namelist(groups)).todict()
    assert read == {"surface": {"file": name}, "sweep": {"names": [name, "b"], "count": 3}}


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


@needs_programs
def test_unknown_keys_are_refused_with_a_hint() -> None:
    with pytest.raises(ehlwave.ProgramError, match="load_parameter_m"):
        ehlwave.Case(load_parameter=100)
    with pytest.raises(ehlwave.ProgramError, match="exit status 2"):
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
