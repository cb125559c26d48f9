import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from synthetic import write_results

from ehlwave.results.schema import REQUIRED_COLUMNS
from studies.error_time import errors, figures, model
from studies.error_time.runs import FULL, QUICK, SMOOTH, WAVY, Contact, Run, all_runs
from studies.error_time.table import KEYS, OUTCOMES, read_table, write_cases

LIMIT = 0.5


def row(contact: Contact, cells: int, **changes: float | str) -> dict[str, Any]:
    """Return a row with an error of 2 gamma M hX^2 / 100 and a cost of 100 (cells/128)^0.5."""
    run = Run(*contact, cells)
    error = 0.02 * contact.m * (4 / cells) ** 2
    value = LIMIT * (1 + error)
    outcome: dict[str, Any] = dict.fromkeys(OUTCOMES, value)
    outcome |= {"status": "converged", "gamma": 1.0, "formula_ratio": 0.0, "points_per_wave_x": 8.0}
    outcome |= {"time_steps": 10.0 if contact.wavelength else 0.0, "seconds": 1.0}
    outcome |= {"counted_work_units": 1000 * (cells / 128) ** 0.5}
    keys = {name: getattr(run, name) for name in Run.__dataclass_fields__}
    return {**keys, **outcome, **changes}


@pytest.fixture
def table() -> pd.DataFrame:
    contacts = (SMOOTH[0], SMOOTH[2], WAVY[0], WAVY[5])
    return pd.DataFrame(
        row(contact, cells) for contact in contacts for cells in (64, 128, 256, 512)
    )


def test_runs_are_unique() -> None:
    for extent in (FULL, QUICK):
        runs = all_runs(extent)
        assert len(runs) == len(set(runs))
        assert {run.method for run in all_runs(extent, ("newton",))} == {"newton"}
    assert len(all_runs(QUICK)) < len(all_runs(FULL))


def test_every_case_names_its_run_and_finds_its_result(tmp_path: Path) -> None:
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\nif grep -q petsc $1; then echo no PETSc >&2; exit 2; fi\n")
    program.chmod(0o755)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("EHLWAVE_CASE", str(program))
        write_cases(tmp_path, QUICK)
    with (tmp_path / "cases.csv").open(encoding="utf-8") as file:
        cases = list(csv.DictReader(file))
    runs = all_runs(QUICK, ("newton", "fas"))
    assert len(cases) == len(runs)
    case = cases[runs.index(Run(*WAVY[0], 64, method="fas"))]
    assert (case["method"], case["cells_y"], case["wavelength_over_a"]) == ("fas", "64", "0.5")
    assert cases[runs.index(Run(*SMOOTH[0], 64))]["wavelength_over_a"] == ""

    columns = {name: np.full(len(cases), 0.5) for name in (*REQUIRED_COLUMNS, *OUTCOMES)}
    columns |= {
        name: np.full(len(cases), "text, or so") for name in ("case_id", "orientation", "status")
    }
    columns["seconds"] = np.arange(len(cases), dtype=float)
    columns["status"][5] = "pending"
    write_results(tmp_path / "cases.h5", columns)
    table = read_table(tmp_path, QUICK)
    assert len(table) == len(runs) - 1
    found = table[table["seconds"] == 7].iloc[0]
    assert [found[name] for name in KEYS] == [getattr(runs[7], name) for name in KEYS]


def test_second_order_is_extrapolated_exactly(table: pd.DataFrame) -> None:
    found = errors.error_rows(table)
    assert len(found) == 8 * 2 + 8
    for one in found.to_dict("records"):
        expected = 0.02 * one["m"] * (4 / one["cells"]) ** 2
        assert one["reference"] == pytest.approx(LIMIT, rel=1e-12)
        assert one["error"] == pytest.approx(expected, rel=1e-9)
    orders = errors.order_rows(table)
    assert orders["observed_order"].to_list() == pytest.approx([2.0] * len(orders))
    estimates = errors.estimate_rows(table)
    ratios = estimates["estimate"][estimates["quantity"] == errors.RATIO]
    assert ratios.notna().sum() == 6  # none on the coarsest grids


def test_algebraic_error_is_against_the_same_grid() -> None:
    loose = row(WAVY[0], 64, step_tolerance=0.1, amplitude_ratio_fit=0.66)
    tight = row(WAVY[0], 64, step_tolerance=1e-6, amplitude_ratio_fit=0.60)
    rows = [loose, tight, row(WAVY[0], 64), row(WAVY[0], 128)]
    table = errors.error_rows(pd.DataFrame(rows)).to_dict("records")
    found = {(r["cells"], r["step_tolerance"]): r for r in table}
    assert found[64, 0.1]["algebraic_error"] == pytest.approx(0.1)
    assert math.isnan(found[64, 1e-6]["algebraic_error"])
    assert math.isnan(found[128, 1e-4]["algebraic_error"])


def test_richardson_does_not_trust_odd_orders() -> None:
    assert errors.richardson([1.1, 1.4, 2.6]) == pytest.approx(0.1 / 1.1)
    assert errors.richardson([1.1, 1.4, math.nan]) == pytest.approx(0.1 / 1.1)
    assert errors.richardson([1.1, 1.4, 1.2]) == pytest.approx(0.3 / 1.1)
    assert math.isnan(errors.richardson([1.1, math.nan, 1.2]))


def test_models_are_found_again(table: pd.DataFrame) -> None:
    fits = model.fit_models(table).set_index("model")
    assert fits.loc["film", "coefficient_1"] == pytest.approx(0.02, rel=1e-6)
    assert fits.loc["moving_ratio", "coefficient_1"] == pytest.approx(0.02, rel=1e-6)
    cost = fits.loc["step_cost", ["coefficient_1", "coefficient_2", "coefficient_3"]]
    assert cost.to_list() == pytest.approx([100.0, 0.5, 0.0], abs=1e-5)
    assert fits.loc["film", "largest_factor"] == pytest.approx(1.0)


def test_figures_show_every_panel(table: pd.DataFrame) -> None:
    found = errors.error_rows(table)
    for panels in figures.all_panels().values():
        figure = figures.error_figure(found, "seconds", panels)
        titles = [axes.get_title() for axes in figure.axes]
        assert titles[: len(panels)] == [contact.title for contact, _ in panels]
        assert len(figure.axes[0].lines) == 1
