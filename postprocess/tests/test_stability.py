import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from synthetic import write_results

from ehlwave.results.schema import REQUIRED_COLUMNS
from studies.stability.__main__ import main
from studies.stability.cases import (
    OUTSIDE,
    Case,
    corner_cases,
    full_cases,
    quick_cases,
    sliding_cases,
    starved_cases,
)
from studies.stability.figures import parameter_map
from studies.stability.outcome import (
    CONVERGED,
    FAILED,
    REFUSED,
    UNRESOLVED,
    UNSOLVED,
    compare,
    judge,
    judge_refusal,
)
from studies.stability.run import plan
from studies.stability.table import summary
from studies.sweeps import flat

NAN = float("nan")
CASE = Case("steady", "smooth", {"conditions": {"load_parameter_m": 100.0}})
GOOD = {
    "status": "converged",
    "message": "",
    "is_resolved": 1,
    "load_parameter_m": 100.0,
    "lubricant_parameter_l": 12.05,
    "radius_ratio_d": 1.0,
    "central_film": 0.15,
    "minimum_film": 0.08,
    "central_film_moes": 4.1,
    "max_pressure": 1.02,
    "amplitude_ratio": NAN,
    "amplitude_ratio_fit": NAN,
    "mean_film": NAN,
    "harmonic_ratio": NAN,
    "residual": 1e-7,
    "load_error": 1e-8,
    "rung": "direct",
    "nonlinear_steps": 6,
    "time_steps": 0,
    "seconds": 1.0,
}
LOST = {
    **GOOD,
    "status": "stalled",
    "message": "steady state of smooth surfaces stalled",
    **dict.fromkeys(("central_film", "minimum_film", "central_film_moes", "max_pressure"), NAN),
}
FLAGGED = {**GOOD, "status": "unresolved", "is_resolved": 0, "message": "too coarse"}


@pytest.mark.parametrize(
    ("result", "outcome"),
    [
        (GOOD, CONVERGED),
        (FLAGGED, UNRESOLVED),
        (LOST, FAILED),
        ({**LOST, "is_resolved": 0}, UNSOLVED),
        ({**LOST, "status": "over_budget", "is_resolved": 0}, FAILED),
        ({**LOST, "status": "crashed", "message": ""}, FAILED),
    ],
)
def test_honest_results_have_no_faults(result: dict[str, Any], outcome: str) -> None:
    row = judge(CASE, result)
    assert (row.outcome, row.faults) == (outcome, [])
    assert row.is_bad == (outcome == FAILED)
    assert bool(row.message) == (outcome != CONVERGED)


@pytest.mark.parametrize(
    ("changes", "fault"),
    [
        ({"is_resolved": 0}, "is_resolved 0"),
        ({"status": "unresolved", "message": "x"}, "is_resolved 1"),
        ({"central_film": -0.1}, "central_film = -0.1"),
        ({"minimum_film": NAN}, "minimum_film = nan"),
        ({"residual": NAN}, "residual"),
        ({"load_error": 0.1}, "load_error"),
        ({"central_film_moes": 1.0}, "of the formula's"),
        ({"central_film_moes": 12.0, "eyring_stress_pa": 5e6}, "of the formula's"),
        ({"response": "harmonic"}, "harmonic_ratio = nan"),
        ({**LOST, "harmonic_ratio": 0.5}, "harmonic_ratio given"),
        ({**LOST, "central_film": 0.15}, "central_film given"),
        (
            {**LOST, "message": "time step 3 stalled", "amplitude_ratio": 0.8},
            "amplitude_ratio given",
        ),
        ({**LOST, "message": ""}, "no message"),
    ],
)
def test_dishonest_results_are_found(changes: dict[str, Any], fault: str) -> None:
    row = judge(CASE, {**GOOD, **changes})
    assert row.is_bad
    assert any(fault in text for text in row.faults), row.faults


def test_a_sliding_oil_may_thin_by_any_factor_on_a_line_too() -> None:
    thin = {**GOOD, "central_film_moes": 1.0, "eyring_stress_pa": 5e5, "radius_ratio_d": 0.0}
    assert not judge(CASE, thin).faults


def test_starved_contacts_are_thinner_by_what_they_say() -> None:
    cases = starved_cases()
    assert len(cases) == 3 * 16 * 5
    thin = {**GOOD, "central_film_moes": 1.2, "film_over_flooded": 0.3, "harmonic_ratio": 0.1}
    assert not judge(cases[0], thin).faults
    assert judge(cases[0], {**thin, "film_over_flooded": 1.0}).faults
    assert (
        parameter_map([judge(case, thin) for case in cases]).axes[0].get_title() == "starved, D 1"
    )


def test_two_solutions_of_one_sliding_problem_must_agree() -> None:
    cases = sliding_cases()[:6]
    assert [case.value("slip_parameter") for case in cases] == [0.0, 0.5, 1.0, 1.5, 2.0, 1.5]
    films = (0.10, 0.12, 0.13, 0.12, 0.10, 0.12)
    ratios = (0.9, 0.8, 0.7, 0.6, 0.5, 0.6)
    rows = [
        judge(case, {**GOOD, "central_film": film, "harmonic_ratio": ratio})
        for case, film, ratio in zip(cases, films, ratios, strict=True)
    ]
    compare(rows)
    assert not any(row.faults for row in rows)
    rows[4].result["central_film"] *= 1.001
    rows[5].result["harmonic_ratio"] = NAN
    compare(rows)
    assert rows[4].faults == ["central_film = 0.1001, yet 0.1 with S 0"]
    assert rows[5].faults == ["harmonic_ratio = nan, yet 0.6 with S 1.5"]
    assert not any(row.faults for row in rows[:4])


def test_cases_cover_the_range_and_have_inputs_of_their_own() -> None:
    everything = [*full_cases(), *corner_cases()]
    assert {case.family for case in quick_cases()} <= {case.family for case in everything}
    for cases in (everything, quick_cases(), sliding_cases()):
        assert len({str(flat(case.groups)) for case in cases}) == len(cases)
    reached = [
        ("load_parameter_m", 3.0, 10000.0),
        ("lubricant_parameter_l", 0.0, 30.0),
        ("radius_ratio_d", 0.005, 1.0),
        ("wavelength_over_a", 0.05, 4.0),
        ("time_step_over_cell", 0.25, 4.0),
        ("slip_parameter", 0.0, 2.0),
        ("amplitude_over_film", 0.01, 0.9),
    ]
    allowed = [case for case in everything if case.family != OUTSIDE]
    for key, low, high in reached:
        values = [case.value(key) for case in allowed if case.value(key) != ""]
        assert (min(values), max(values)) == (low, high)


@pytest.mark.parametrize(
    ("line", "outcome", "is_bad"),
    [
        ("echo M must be above 0 >&2; exit 2", REFUSED, False),
        ("exit 2", REFUSED, True),
        ("exit 0", FAILED, True),
    ],
)
def test_what_must_be_refused_is_planned(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, line: str, outcome: str, is_bad: bool
) -> None:
    program = tmp_path / "program"
    program.write_text(f"#!/bin/sh\ngrep -q 'load_parameter_m = 100.0' $1 || exit 9\n{line}\n")
    program.chmod(0o755)
    monkeypatch.setenv("EHLWAVE_CASE", str(program))
    row = judge_refusal(CASE, plan(CASE))
    assert (row.outcome, row.is_bad) == (outcome, is_bad)


def test_table_maps_and_exit_status(tmp_path: Path) -> None:
    options = [str(tmp_path), "--cases", "corner"]
    assert main(["cases", *options, "--limit", "60"]) == 0
    assert "largest_case_seconds = 60" in (tmp_path / "cases.nml").read_text()
    columns = {name: np.full(2, 0.0) for name in REQUIRED_COLUMNS}
    columns |= {name: np.full(2, value) for name, value in GOOD.items()}
    columns |= {name: np.full(2, "none") for name in ("case_id", "orientation")}
    write_results(tmp_path / "cases.h5", columns)
    assert main(["report", *options]) == 0
    with (tmp_path / "stability.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["load_parameter_m"] for row in rows] == ["2000", "2000"]
    assert {row["rung"] for row in rows} == {"direct"}
    assert (tmp_path / "parameters.png").stat().st_size > 1000
    columns["minimum_film"][1] = -1
    write_results(tmp_path / "cases.h5", columns)
    assert main(["report", *options]) == 1
    assert main(["report", str(tmp_path), "--cases", "steady"]) == 1


def test_summary_counts_resolved_cases_and_names_bad_ones() -> None:
    case = corner_cases()[0]
    rows = [judge(case, GOOD), judge(case, LOST)]
    text = summary(rows)
    assert "1 of 2 resolved cases converged" in text
    assert "BAD corner, 512 cells, M = 2000, L = 12.05, D = 1: steady state" in text
    assert parameter_map(rows).axes
    sliding = parameter_map([judge(case, GOOD) for case in sliding_cases()])
    assert [axes.get_title() for axes in sliding.axes] == [
        f"sliding, {stress} MPa" for stress in ("0.5", "5", "50")
    ]
    labels = [label.get_text() for label in sliding.axes[0].get_xticklabels()]
    assert labels[0] == "M 30\nL 6\nD 1"
    assert labels[-1] == "M 300\nL 12.05\nline"
