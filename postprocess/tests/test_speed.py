"""The table of costs from given answers, and from a program that fails."""

from pathlib import Path

import pytest

from ehlwave.errors import ResultsError
from studies import speed
from studies.programs import Groups


def answer(groups: Groups) -> speed.Answer:
    """Return costs that distinguish the runs."""
    fine = groups["grid"]["cells_x"] == 1024
    response = "response" in groups.get("waviness", {})
    waves = "waviness" in groups and not response
    tight = {"tolerance", "step_tolerance"} & groups["solver"].keys()
    auto = groups["solver"]["method"] == "auto"
    return {
        "seconds": 5.0 if fine and auto else 10.0 if fine else 4.0 if waves else 0.5,
        "work_units": 3000.0 if waves else 100.0,
        "counted_work_units": 2990.0 if waves else 90.0,
        "own_units": 9000.0 if waves else 300.0,
        "harmonic_work_units": 70.0 if response else None,
        "harmonic_counted_work_units": 60.0 if response else None,
        "time_steps": 290,
        "central_film": 0.1 if tight else 0.1003 if auto else 0.1001,
        "central_film_error": 4e-3,
        "amplitude_ratio_fit": 0.5 if tight else 0.499,
        "amplitude_ratio_error": None,
        "peak_memory_mib": 400.0,
    }


def test_figures() -> None:
    """Differences and ratios are taken between the right runs."""
    found = speed.measure(answer, 2)
    rows = {(row.method, row.work): row for row in found if row.unit != "own units"}
    assert len(rows) == 5 * len(speed.METHODS) + 3
    own = [row.figure for row in found if (row.method, row.unit) == ("newton", "own units")]
    assert own == pytest.approx([300.0, 300.0, 30.0])
    step = rows["newton", "one time step, 257 x 257"]
    assert step.figure == pytest.approx(10.0)
    assert step.counted == pytest.approx(10.0)
    assert step.algebraic_error == pytest.approx(2e-3)
    assert rows["fas", "steady state, 257 x 257"].algebraic_error == pytest.approx(1e-3)
    growth = rows["fas", "steady state, 1025 x 1025 over 257 x 257"]
    assert growth.figure == pytest.approx(20.0)
    assert growth.counted == pytest.approx(16 * 22 / 18)
    chosen = rows["auto", "steady state, 1025 x 1025 over 257 x 257"]
    assert chosen.figure == pytest.approx(10.0)
    assert chosen.algebraic_error == pytest.approx(0.1003 / 0.1001 - 1)
    assert rows["newton", "periodic state"].algebraic_error == pytest.approx(2e-3)
    response = rows["newton", "linear response, 257 x 257"]
    assert (response.figure, response.counted) == (pytest.approx(70.0), 60.0)
    assert rows["newton", "memory, 1025 x 1025"].figure == pytest.approx(400.0)


def test_fastest_counts() -> None:
    """The fastest of repeated runs counts."""
    seconds = iter([9.0, 2.0, 5.0] * 100)

    def run(groups: Groups) -> speed.Answer:
        return answer(groups) | {"seconds": next(seconds)}

    assert speed.measure(run, 3)[2].figure == pytest.approx(2.0)


def test_program_that_fails(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A run that does not converge ends the command with its message."""
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\necho stalled >&2\nexit 1\n")
    program.chmod(0o755)
    monkeypatch.setenv("EHLWAVE_CASE", str(program))
    with pytest.raises(ResultsError, match="stalled"):
        speed.solved({})
    assert speed.main(["--output", str(tmp_path)]) == 1
    assert "stalled" in capsys.readouterr().err
