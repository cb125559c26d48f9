import csv
import json
import sys
from pathlib import Path
from typing import Any

import pytest

from studies.programs import namelist
from studies.stability import corner_cases, full_cases, judge, parameter_map, quick_cases
from studies.stability.__main__ import main
from studies.stability.cases import Case
from studies.stability.outcome import (
    CONVERGED,
    FAILED,
    REFUSED,
    UNRESOLVED,
    UNSOLVED,
    film_formula,
)
from studies.stability.run import run_case
from studies.stability.table import summary

CASE = Case("steady", "smooth", {"conditions": {"load_parameter_m": 100.0}})
GOOD = {
    "status": "converged",
    "message": "",
    "is_resolved": True,
    "load_parameter_m": 100.0,
    "lubricant_parameter_l": 12.05,
    "radius_ratio_d": 1.0,
    "central_film": 0.15,
    "minimum_film": 0.08,
    "central_film_moes": 4.1,
    "max_pressure": 1.02,
    "amplitude_ratio": None,
    "amplitude_ratio_fit": None,
    "mean_film": None,
    "residual": 1e-7,
    "load_error": 1e-8,
    "rung": "direct",
    "nonlinear_steps": 6,
    "time_steps": 0,
}
LOST = {
    **GOOD,
    "status": "stalled",
    "message": "steady state of smooth surfaces stalled",
    **dict.fromkeys(("central_film", "minimum_film", "central_film_moes", "max_pressure")),
}
FLAGGED = {**GOOD, "status": "unresolved", "is_resolved": False, "message": "too coarse"}


@pytest.mark.parametrize(
    ("result", "code", "outcome"),
    [
        (GOOD, 0, CONVERGED),
        (FLAGGED, 0, UNRESOLVED),
        (LOST, 1, FAILED),
        ({**LOST, "is_resolved": False}, 1, UNSOLVED),
    ],
)
def test_honest_results_have_no_faults(result: dict[str, Any], code: int, outcome: str) -> None:
    row = judge(CASE, code, result, "", 1.0)
    assert (row.outcome, row.faults) == (outcome, [])
    assert row.is_bad == (outcome == FAILED)


@pytest.mark.parametrize(
    ("changes", "code", "fault"),
    [
        ({"is_resolved": False}, 0, "is_resolved False"),
        ({"status": "unresolved", "message": "x"}, 0, "is_resolved True"),
        ({"central_film": -0.1}, 0, "central_film = -0.1"),
        ({"minimum_film": None}, 0, "minimum_film = None"),
        ({"residual": None}, 0, "residual"),
        ({"load_error": 0.1}, 0, "load_error"),
        ({"central_film_moes": 1.0}, 0, "of the formula's"),
        ({}, 1, "exit status 1"),
        ({**LOST, "central_film": 0.15}, 1, "central_film given"),
        (
            {**LOST, "message": "time step 3 stalled", "amplitude_ratio": 0.8},
            1,
            "amplitude_ratio given",
        ),
        ({**LOST, "message": ""}, 1, "no message"),
        (LOST, 0, "exit status 0"),
    ],
)
def test_dishonest_results_are_found(changes: dict[str, Any], code: int, fault: str) -> None:
    row = judge(CASE, code, {**GOOD, **changes}, "", 1.0)
    assert row.is_bad
    assert any(fault in text for text in row.faults), row.faults


def test_other_ends_of_a_program() -> None:
    assert judge(CASE, 2, None, "M must be above 0", 0.1).outcome == REFUSED
    assert judge(CASE, 2, None, "", 0.1).faults == ["refused without a message"]
    assert judge(CASE, -8, None, "SIGFPE", 0.1).outcome == FAILED
    assert judge(CASE, 0, None, "", 0.1).outcome == FAILED
    assert judge(CASE, None, None, "", 9.0).outcome == FAILED


def test_film_formula_has_the_right_asymptotes() -> None:
    shape = 1 + 0.63
    elastic = 3.18 * shape ** (-14 / 25) * 1e6 ** (-2 / 15)
    assert film_formula(1e6, 0.0, 1.0) == pytest.approx(elastic, rel=1e-3)
    rigid = 145 * 1.796 ** (-15 / 7) / 0.01**2
    assert film_formula(0.01, 0.0, 1.0) == pytest.approx(rigid, rel=1e-2)
    piezoviscous = 1.48 * shape ** (-7 / 20) * 1e5 ** (-1 / 12) * 30**0.75
    assert film_formula(1e5, 30.0, 1.0) == pytest.approx(piezoviscous, rel=0.03)


def test_cases_cover_the_range_and_have_inputs_of_their_own() -> None:
    everything = [*full_cases(), *corner_cases()]
    assert {case.family for case in quick_cases()} <= {case.family for case in everything}
    for cases in (everything, quick_cases()):
        assert len({namelist(case.groups) for case in cases}) == len(cases)
    reached = [
        ("load_parameter_m", 3.0, 10000.0),
        ("lubricant_parameter_l", 0.0, 30.0),
        ("radius_ratio_d", 0.005, 1.0),
        ("wavelength_over_a", 0.05, 4.0),
        ("time_step_over_cell", 0.25, 4.0),
        ("slip_parameter", 0.0, 2.0),
        ("amplitude_over_film", 0.01, 0.9),
    ]
    allowed = [case for case in everything if case.family != "outside"]
    for key, low, high in reached:
        values = [case.value(key) for case in allowed if case.value(key) != ""]
        assert (min(values), max(values)) == (low, high)


PROGRAM = """#!{python}
import json, sys, time
text = open(sys.argv[1]).read()
if "load_parameter_m = 0.0" in text:
    print("M must be above 0", file=sys.stderr)
    sys.exit(2)
if "load_parameter_m = 10.0" in text:
    time.sleep(60)
print("chatter")
print({good})
"""


@pytest.fixture
def program(tmp_path: Path) -> Path:
    path = tmp_path / "program"
    path.write_text(PROGRAM.format(python=sys.executable, good=repr(json.dumps(GOOD))))
    path.chmod(0o755)
    return path


def test_a_case_is_run_under_a_time_limit(program: Path, tmp_path: Path) -> None:
    for load, outcome in ((100.0, CONVERGED), (0.0, REFUSED), (10.0, FAILED)):
        case = Case("steady", "smooth", {"conditions": {"load_parameter_m": load}})
        row = run_case(program, case, 2.0, tmp_path / "case.nml")
        assert row.outcome == outcome, row.message
        assert row.seconds < 20


def test_table_maps_and_exit_status(program: Path, tmp_path: Path) -> None:
    arguments = [str(program), "--cases", "corner", "--output"]
    assert main([*arguments, str(tmp_path)]) == 0
    with (tmp_path / "stability.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["load_parameter_m"] for row in rows] == ["2000.0", "2000.0"]
    assert {row["rung"] for row in rows} == {"direct"}
    assert (tmp_path / "parameters.png").stat().st_size > 1000
    lying = program.read_text().replace('"minimum_film": 0.08', '"minimum_film": -1')
    program.write_text(lying)
    assert main([*arguments, str(tmp_path)]) == 1


def test_summary_counts_resolved_cases_and_names_bad_ones() -> None:
    case = corner_cases()[0]
    rows = [judge(case, 0, GOOD, "", 1.0), judge(case, 1, LOST, "", 1.0)]
    text = summary(rows)
    assert "1 of 2 resolved cases converged" in text
    assert "BAD corner, 512 cells, M = 2000, L = 12.05, D = 1: steady state" in text
    assert parameter_map(rows).axes
