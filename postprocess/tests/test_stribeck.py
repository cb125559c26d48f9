"""Stribeck curves: monotone through the transition, friction of both parts, refusals."""

import json
from pathlib import Path

import numpy as np
import pytest

from ehlwave.cli import main
from ehlwave.errors import ArgumentError
from ehlwave.stribeck import stribeck, stribeck_figure

ROLLER = {
    "radius_x_m": 0.01,
    "reduced_modulus_pa": 2.26e11,
    "load_n_per_m": 1.00086e5,
    "mean_speed_m_per_s": 0.05,
    "viscosity_pa_s": 0.04,
    "slip_parameter": 0,
    "pressure_viscosity_per_pa": 2.2e-8,
    "roelands_index": 0.68,
    "flow_law": "eyring",
    "eyring_stress_pa": 1e7,
    "x_min": -4,
    "x_max": 2,
    "cells_x": 192,
    "edges": "truncated",
}


def test_curve_is_monotone() -> None:
    """The share rises as the speed falls; friction is the sum of its parts; films reach H_b."""
    found = stribeck(ROLLER | {"film_m": 2e-8}, [0.05, 0.5, 0.9], [1.5, 3], progress=False)
    table = found.table
    assert len(table) == 5
    assert (np.diff(table["mean_speed_m_per_s"]) < 0).all()
    assert (np.diff(table["touching_share"]) >= -1e-9).all()
    parts = table["oil_friction_coefficient"] + table["solid_friction_coefficient"]
    np.testing.assert_allclose(table["friction_coefficient"], parts, rtol=1e-9)
    np.testing.assert_allclose(
        table["solid_friction_coefficient"].abs(), 0.1 * table["touching_share"], atol=1e-9
    )
    assert table["mean_film_um"].iloc[-1] == pytest.approx(0.02, rel=1e-3)
    assert table["touching_share"].iloc[0] == 0
    low, high = found.transition
    assert low < high < table["mean_speed_m_per_s"].iloc[0]
    assert len(stribeck_figure(found).axes) == 3


def test_input_without_touching_is_refused() -> None:
    """The boundary film has no default; shares and factors have bounds."""
    with pytest.raises(ArgumentError, match="film_m"):
        stribeck(ROLLER, progress=False)
    with pytest.raises(ArgumentError, match="shares"):
        stribeck(ROLLER | {"film_m": 2e-8}, [0.5, 1.2], progress=False)
    with pytest.raises(ArgumentError, match="factors"):
        stribeck(ROLLER | {"film_m": 2e-8}, [0.5], [0.5], progress=False)


def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The command prints rows as JSON and writes table and figure."""
    case = Path(__file__).parents[2] / "inputs/touching_line.nml"
    text = case.read_text(encoding="utf-8").replace("cells_x = 384", "cells_x = 192")
    path = tmp_path / "case.nml"
    path.write_text(text, encoding="utf-8")
    folder = tmp_path / "figures"
    arguments = [
        "stribeck",
        path,
        "--shares",
        "0.3",
        "--factors",
        "2",
        "--output",
        folder,
        "--json",
    ]
    assert main([str(one) for one in arguments]) == 0
    out = json.loads(capsys.readouterr().out)
    assert [row["touching_share"] for row in out["rows"]] == pytest.approx([0, 0.3], abs=1e-6)
    assert (folder / "stribeck.csv").exists()
    assert list(folder.glob("stribeck.*g"))
    path.write_text("&conditions load_parameter_m = 10 /", encoding="utf-8")
    assert main(["stribeck", str(path)]) == 2
