from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from synthetic import Columns, make_columns, write_results

from ehlwave import Case
from ehlwave.cases.keys import key_groups
from ehlwave.cli import main
from ehlwave.errors import ProgramError, SurfaceError
from ehlwave.inputs.effective_input import keys_of_input
from ehlwave.inputs.namelist import scan_namelist
from ehlwave.laws import table_keys
from ehlwave.surface import TableTransfer, conditions_from_keys, read_table

Capture = pytest.CaptureFixture[str]

INPUT = """&conditions
  reduced_modulus_pa = 226000000000
  load_parameter_m = 100
/
&lubricant
  pressure_viscosity_per_pa = 2.2e-8
  roelands_index = 0.68
  viscosity_law = 'roelands'
  density_law = 'dowson_higginson'
  flow_law = 'eyring'
  eyring_stress_pa = {stress:g}
/
&waviness
  amplitude_over_film = 0.2
  response = 'harmonic'
/
&grid
  cells_x = {cells}
  edges = 'flooded'
/
"""
MOES = {"load_parameter_m": 100.0, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1.0}
SLIDING = MOES | {"slip_parameter": 1.5, "semi_axis_a_m": 2e-4, "reduced_modulus_pa": 2.26e11}


def sweep(*stresses: float, cells: int = 128, shift: float = 0.0) -> Columns:
    """Return a sweep over the Eyring stress, whose responses identify the stress."""
    parts = []
    for stress in stresses:
        columns = make_columns(conditions={(100.0, 1.0): 1.0})
        count = len(columns["case_id"])
        columns["slip_parameter"] = np.full(count, 1.5)
        columns["effective_input"] = np.full(count, INPUT.format(stress=stress, cells=cells))
        columns["harmonic_real"] = np.full(count, stress / 1e7 + shift)
        columns["harmonic_imaginary"] = np.zeros(count)
        columns["edges"] = np.full(count, "flooded")
        parts.append(columns)
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}


def table(folder: Path, columns: Columns) -> pd.DataFrame:
    source = write_results(folder / "r.h5", columns)
    assert main(["harmonics", str(source), "--csv", str(folder / "h.csv")]) == 0
    return read_table(folder / "h.csv")


def response(rows: pd.DataFrame, **keys: float) -> float:
    transfer = TableTransfer(conditions_from_keys(SLIDING | keys), rows, "h.csv")
    wave = 0.5 * SLIDING["semi_axis_a_m"]
    return float(transfer.ratio(np.array([1 / wave]), np.zeros(1)).real[0])


def test_a_table_of_two_stresses_serves_each_contact_its_own(tmp_path: Path) -> None:
    rows = table(tmp_path, sweep(2e6, 8e6))
    assert {"eyring_stress_pa", "flow_law", "reduced_modulus_pa"} <= set(rows)
    assert response(rows, eyring_stress_pa=2e6) == pytest.approx(0.2)
    assert response(rows, eyring_stress_pa=8e6) == pytest.approx(0.8)
    # films depend on the stress times the modulus
    assert response(rows, eyring_stress_pa=4e6, reduced_modulus_pa=1.13e11) == pytest.approx(0.2)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"eyring_stress_pa": 8e6}, r"eyring_stress_pa = 2e\+06 .* the contact has 8e\+06"),
        ({}, "flow_law = eyring, the contact has newtonian"),
        (
            {"carreau_modulus_pa": 2e6, "carreau_exponent": 0.5},
            "flow_law = eyring, the contact has carreau",
        ),
        ({"eyring_stress_pa": 2e6, "roelands_index": 0.5}, "roelands_index = 0.68, .* has 0.5"),
        (
            {"eyring_stress_pa": 2e6, "pressure_viscosity_per_pa": 1e-8},
            "pressure_viscosity_per_pa = 2.2e-08, .* has 1e-08",
        ),
    ],
)
def test_a_table_of_another_oil_is_refused(
    tmp_path: Path, keys: dict[str, float], message: str
) -> None:
    rows = table(tmp_path, sweep(2e6))
    assert response(rows, eyring_stress_pa=2e6) == pytest.approx(0.2)
    with pytest.raises(SurfaceError, match=message):
        response(rows, **keys)


def test_a_table_that_does_not_say_its_oil_serves_none_that_slides(tmp_path: Path) -> None:
    rows = table(tmp_path, sweep(2e6))
    bare = rows.drop(columns=[key for key in table_keys.CARRIED if key in rows])
    with pytest.raises(SurfaceError, match="no column flow_law"):
        response(bare, eyring_stress_pa=2e6)


def test_two_responses_to_one_wave_are_refused(tmp_path: Path, capsys: Capture) -> None:
    coarse, fine = sweep(2e6, cells=32, shift=0.05), sweep(2e6, cells=64)
    both = {name: np.concatenate([coarse[name], fine[name]]) for name in coarse}
    source = write_results(tmp_path / "r.h5", both)
    assert main(["harmonics", str(source), "--csv", str(tmp_path / "h.csv")]) == 2
    said = capsys.readouterr().err
    assert "transfer_real = 0.2 and 0.25" in said
    assert not (tmp_path / "h.csv").exists()
    rows = pd.concat(
        [pd.DataFrame({"M": [100.0], "L": [10.0], "D": [1.0], "r": [0.0]})] * 2
    ).assign(lambda_over_a=0.5, amplitude_ratio=[0.786, 0.663])
    rows.to_csv(tmp_path / "t.csv", index=False)
    with pytest.raises(SurfaceError, match=r"transfer_real = 0.663 and 0.786"):
        read_table(tmp_path / "t.csv")


def test_rows_that_differ_in_what_a_contact_does_not_say_are_refused(tmp_path: Path) -> None:
    rows = table(tmp_path, sweep(2e6))
    mixed = pd.concat([rows, rows.assign(edges="truncated")])
    with pytest.raises(SurfaceError, match="edges = flooded and of truncated"):
        response(mixed, eyring_stress_pa=2e6)


def test_a_key_of_a_newer_program_must_not_vary(tmp_path: Path, capsys: Capture) -> None:
    columns = sweep(2e6, 8e6)
    new = [f"  heat = {k % 2}\n" for k in range(len(columns["case_id"]))]
    texts = columns["effective_input"]
    columns["effective_input"] = np.array([a + b for a, b in zip(texts, new, strict=True)])
    source = write_results(tmp_path / "r.h5", columns)
    assert main(["harmonics", str(source), "--csv", str(tmp_path / "h.csv")]) == 2
    assert "differ in heat (0.0, 1.0)" in capsys.readouterr().err


def test_effective_inputs_are_read_as_input_files_are() -> None:
    try:
        case = Case(**MOES, cells_x=32, cells_y=32, slip_parameter=1.5)
    except ProgramError:
        pytest.skip("no program")
    text = str(case.run().attrs["effective_input"])
    groups = scan_namelist("effective input", text.encode()).values()
    expected = {key: value for keys in groups.values() for key, value in keys.items()}
    found = keys_of_input(text)
    assert len(found) > 20
    logical = {True: ".true.", False: ".false."}
    assert found == {k: logical[v] if isinstance(v, bool) else v for k, v in expected.items()}


def test_every_key_of_the_programs_is_classified() -> None:
    try:
        known = set(key_groups())
    except ProgramError:
        pytest.skip("no program")
    assert known == table_keys.CLASSIFIED, known ^ table_keys.CLASSIFIED


@pytest.mark.parametrize("column", ["M", "L", "D", "lambda_over_a", "slip_parameter"])
@pytest.mark.parametrize("value", [-1.0, np.nan, np.inf, "x", 7.0])
def test_tables_with_impossible_numbers_are_refused(
    tmp_path: Path, column: str, value: object
) -> None:
    rows = pd.DataFrame(
        {"M": [100.0] * 3, "L": 10.0, "D": 1.0, "slip_parameter": 1.0, "r": 0.0}
    ).assign(lambda_over_a=[0.5, 1.0, 2.0], amplitude_ratio=[0.9, 0.8, 0.5])
    rows[column] = rows[column].astype(object)
    rows.loc[1, column] = value
    rows.to_csv(tmp_path / "t.csv", index=False)
    is_possible = value == 7.0 and column in ("M", "L", "lambda_over_a")
    if is_possible or (column == "lambda_over_a" and value not in ("x", -1.0)):
        assert len(read_table(tmp_path / "t.csv")) == 3 - (not is_possible)
        return
    with pytest.raises(SurfaceError, match=column):
        read_table(tmp_path / "t.csv")


def test_responses_with_heat_make_no_table(tmp_path: Path, capsys: Capture) -> None:
    columns = sweep(2e6)
    texts = [f"{text}&heat\n  levels = 12\n/\n" for text in columns["effective_input"]]
    columns["effective_input"] = np.array(texts)
    source = write_results(tmp_path / "r.h5", columns)
    assert main(["harmonics", str(source), "--csv", str(tmp_path / "h.csv")]) != 0
    assert "the cases have heat" in capsys.readouterr().err
