"""Friction over slip: regimes, the maximum by heat, the limit from below, the command."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import ehlwave
from ehlwave.cli import main
from ehlwave.cli.traction import summary, text_of
from ehlwave.errors import ArgumentError
from ehlwave.traction import Traction, read_keys, regimes, traction, traction_figure

ROLLERS = Path(__file__).resolve().parents[2] / "inputs/rollers.nml"
MEASURED = ROLLERS.with_name("measured_oil.nml")
LIMIT = 0.03


def test_regimes_are_named_by_what_lowers_friction() -> None:
    table = pd.DataFrame({"slide_to_roll_ratio": [0.01, 0.1, 0.3, 1.0, 1.5]})
    table["isothermal"] = [0.01, 0.05, 0.07, 0.09, 0.1]
    table["limited"] = [0.01, 0.049, 0.055, 0.058, 0.06]
    table["limited_thermal"] = [0.01, 0.048, 0.054, 0.02, np.nan]
    assert regimes(table, 1.05) == ["linear", "nonlinear", "limited", "thermal", ""]
    assert regimes(table.drop(columns="limited_thermal"), 1.05)[3] == "limited"


def test_where_friction_is_largest() -> None:
    table = pd.DataFrame({"slide_to_roll_ratio": [0.1, 0.2, 0.4], "isothermal": [0.1, 0.2, 0.3]})
    assert Traction(table, None).largest == (0.3, 0.4, False)
    table["thermal"] = [0.1, 0.15, 0.12]
    assert Traction(table, None).largest == (0.15, 0.2, True)


def test_heat_makes_a_maximum_and_the_limit_is_neared_from_below() -> None:
    keys = read_keys(ROLLERS) | {"cells_x": 128, "mean_speed_m_per_s": 2}
    found = traction(keys, ratios=[0.01, 0.1, 0.4, 1.0], progress=False)
    assert found.curve == "thermal"
    assert found.largest[2]
    assert found.table["isothermal"].is_monotonic_increasing
    assert (found.table["thermal"] < found.table["isothermal"]).all()
    assert found.table["regime"].tolist()[::3] == ["nonlinear", "thermal"]
    cold = {k: v for k, v in keys.items() if "body" not in k and "oil_" not in k}
    cold = {k: v for k, v in cold.items() if not k.endswith(("temperature_k", "temperature_per_k"))}
    limited = traction(
        cold | {"shear_limit_over_pressure": LIMIT}, [0.01, 0.1, 1.0, 2.0], progress=False
    )
    friction = limited.table["limited"].to_numpy()
    assert np.all(np.diff(friction) > 0)
    assert friction[-1] < LIMIT
    assert friction[-1] > 0.8 * LIMIT < limited.table["isothermal"].iloc[-1]
    assert limited.table["regime"].iloc[-1] == "limited"


def test_friction_is_linear_where_slip_is_small_and_of_a_newtonian_oil() -> None:
    keys = read_keys(ROLLERS) | {"cells_x": 128}
    cold = {k: v for k, v in keys.items() if "body" not in k and "oil_" not in k}
    cold = {k: v for k, v in cold.items() if not k.endswith(("temperature_k", "temperature_per_k"))}
    assert traction(cold, [1e-4, 0.1], progress=False).table["regime"].tolist() == [
        *("linear", "nonlinear")
    ]
    newtonian = {k: v for k, v in cold.items() if k not in ("flow_law", "eyring_stress_pa")}
    found = traction(newtonian, [0.01, 0.1, 1.0], progress=False)
    assert found.table["regime"].tolist() == ["linear", "linear", ""]
    assert found.table["isothermal"].isna().tolist() == [False, False, True]
    assert any("no friction coefficient is given" in text for text in found.warnings)
    beyond = [text for text in found.warnings if "of the load is borne" in text]
    assert len(beyond) == 1
    assert beyond[0].startswith("slide_to_roll_ratio = 0.1: the shear stress is above")
    assert f"Warning      {beyond[0]}" in text_of(found)
    assert summary(found)["warnings"] == found.warnings


def test_an_oil_that_was_measured_at_several_temperatures(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROLLERS.parents[1])
    keys = read_keys(MEASURED) | {"cells_x": 64, "cells_y": 64}
    assert traction(keys, [0.01, 0.1], progress=False).table["regime"].tolist() == 2 * ["linear"]


def test_moes_parameters_are_refused_before_anything_is_computed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "moes.nml"
    case.write_text(
        "&conditions load_parameter_m=99, lubricant_parameter_l=9, radius_ratio_d=1 /\n"
    )
    assert main(["traction", str(case)]) == 2
    said = capsys.readouterr().err
    assert "give radius_x_m" in said
    assert said.count("\n") == 1


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case = tmp_path / "rollers.nml"
    case.write_text(ROLLERS.read_text().replace("cells_x = 512", "cells_x = 128"))
    words = ["traction", str(case), "--ratios", "0.02", "0.3", "--output", str(tmp_path)]
    assert main([*words, "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert [row["slide_to_roll_ratio"] for row in said["rows"]] == [0.02, 0.3]
    assert said["rows"][1]["thermal"] < said["rows"][1]["isothermal"]
    assert sorted(path.name for path in tmp_path.glob("traction.*")) == [
        *("traction.csv", "traction.pdf", "traction.png")
    ]
    said = text_of(Traction(pd.DataFrame(said["rows"]), None))
    assert said.splitlines()[0].split()[:3] == ["slide-to-roll", "isothermal", "thermal"]
    assert "Largest friction" in said


def test_friction_that_is_not_known_is_an_error_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "newtonian.nml"
    case.write_text(
        "&conditions radius_x_m=0.0127, radius_y_m=0.0127, reduced_modulus_pa=2.26e11, load_n=40, "
        "mean_speed_m_per_s=4, viscosity_pa_s=0.05 /\n"
    )
    assert main(["traction", str(case), "--ratios", "0.01", "0.1"]) == 2
    error = capsys.readouterr().err
    assert error.startswith("ehlwave: error: friction is not known at any ratio (")
    assert "give more cells, or a flow law" in error
    assert error.count("\n") == 1


def test_regimes_are_on_the_figure() -> None:
    table = pd.DataFrame(
        {"slide_to_roll_ratio": [0.01, 0.1, 1.0], "isothermal": [0.01, 0.05, 0.06]}
    )
    table["thermal"] = [0.01, 0.048, 0.03]
    for name in ("rise_mid_film_k", "rise_wall_1_k", "rise_wall_2_k"):
        table[name] = [0.1, 2.0, 30.0]
    table["regime"] = regimes(table, 1.0)
    left, right = traction_figure(Traction(table, None)).axes
    assert [text.get_text() for text in left.texts] == ["linear", "nonlinear", "thermal"]
    assert len(right.lines) == 3


def test_what_has_no_friction_over_slip_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ArgumentError, match="no such file"):
        read_keys(tmp_path / "none.nml")
    path = tmp_path / "waves.nml"
    path.write_text("&waviness orientation = 'transverse' /\n")
    with pytest.raises(ArgumentError, match="has &waviness"):
        read_keys(path)
    keys = read_keys(ROLLERS)
    for ratios, said in (
        ([0.1], "two or more"),
        ([0.1, 2.0], "a surface at rest"),
        ([np.nan, 0.1], "two or more"),
        ([0.1, np.nan], "two or more"),
    ):
        with pytest.raises(ArgumentError, match=said):
            traction(keys, ratios)
    empty = tmp_path / "empty.nml"
    empty.write_text("&conditions radius_x_m = 0.01 /\n&heat /\n")
    with pytest.raises(ArgumentError, match="needs oil_conductivity_w_per_m_k"):
        read_keys(empty)
    for key, value in {"load_factor": 1.2, "orientation": "transverse"}.items():
        with pytest.raises(ArgumentError, match=f"{key}: &.* has no effect here: friction"):
            traction(keys | {key: value}, [0.1, 0.2])
    with pytest.raises(ehlwave.ProgramError, match="unknown key"):
        traction({"colour": 1}, [0.1, 0.2])


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["none.nml"], "none.nml: no such file"),
        ([str(ROLLERS), "--ratios", "0.5"], "two or more"),
        ([str(ROLLERS), "--ratios", "1", "10", "50"], "at most 2"),
        ([str(ROLLERS), "--ratios", "-0.1", "0.1"], "above 0"),
        ([str(ROLLERS), "--ratios", "nan", "0.1"], "nan"),
    ],
)
def test_the_command_refuses_in_one_line(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["traction", *words]) == 2
    error = capsys.readouterr().err
    assert error.startswith("ehlwave: error: ")
    assert said in error
    assert error.count("\n") == 1
