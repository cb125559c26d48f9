"""The study of threads from given seconds: no program runs."""

import threading
from pathlib import Path

import pytest

from ehlwave.errors import ResultsError
from studies import threads
from studies.programs import Groups
from studies.speed import Answer


def seconds(groups: Groups) -> Answer:
    """Return the seconds of a run: more with waves, fewer on four threads."""
    of_case = 20.0 if "waviness" in groups else 4.0
    return {"seconds": of_case / {1: 1, 4: 2.5}[groups["solver"]["threads"]]}


def test_share() -> None:
    """The share is the throughput of one run on the threads over the throughput of as many runs."""
    steady, march = threads.measure(seconds, 512, 4, 2)
    assert (steady.one_run_s, steady.runs_side_by_side_s) == (1.6, 4.0)
    assert (march.one_run_s, march.runs_side_by_side_s) == (8.0, 20.0)
    assert [row.share for row in (steady, march)] == pytest.approx([2.5 / 4] * 2)


def test_square_roots_are_shared(monkeypatch: pytest.MonkeyPatch) -> None:
    """All threads wait for each other, and share the roots that each process takes alone."""
    counts = []

    def roots(count: int, barrier: threading.Barrier | None = None) -> float:
        counts.append((count, barrier.parties if barrier else 0))
        if barrier:
            barrier.wait()
        return 3.0 if barrier else 4.5

    class Here:
        """Processes that are none, so that `roots` can be seen."""

        def __init__(self, processes: int) -> None:
            assert processes == 3

        def __enter__(self) -> type:
            return type("Pool", (), {"map": staticmethod(map)})

        def __exit__(self, *_: object) -> None:
            pass

    monkeypatch.setattr(threads, "_roots", roots)
    monkeypatch.setattr(threads, "ProcessPoolExecutor", Here)
    row = threads.machine(3, 1)
    assert counts == [(threads.ROOTS // 3, 3)] * 3 + [(threads.ROOTS, 0)] * 3
    assert row.share == pytest.approx(0.5)


def test_fastest_counts_and_runs_side_by_side_are_averaged() -> None:
    """Repeated runs count by the fastest, simultaneous runs by the mean."""
    waits = {1: iter([8.0, 4.0, 2.0, 6.0] * 2), 2: iter([3.0, 5.0] * 2)}
    rows = threads.measure(
        lambda groups: {"seconds": next(waits[groups["solver"]["threads"]])}, 64, 2, 2
    )
    assert rows[0].one_run_s == 3.0
    assert rows[0].runs_side_by_side_s == 4.0
    assert rows[0].share == pytest.approx(4.0 / 3.0 / 2)


def test_failure(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A run that fails ends the study with its message."""

    def fail(groups: Groups) -> Answer:
        raise ResultsError("stalled")

    monkeypatch.setattr(threads, "solved", fail)
    monkeypatch.setattr(threads, "ROUNDS", 1)
    assert threads.main(["--output", str(tmp_path), "--repeats", "1"]) == 1
    assert "stalled" in capsys.readouterr().err
