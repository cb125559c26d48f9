"""A contact by several solvers: skipped solvers, runs of others, and the table."""

import argparse
import sys
from pathlib import Path

import pytest

from studies import peer_runs
from studies.peer_runs import FailedError, timed
from studies.peers import Row, compared, figure_of, limit_of, main, measure, solvers
from studies.programs import program


def _options(**given: Path | None) -> argparse.Namespace:
    return argparse.Namespace(**{"fbns": None, "slippy": None, "book": None, "limit": 9, **given})


def test_what_is_absent_is_skipped_with_a_word(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    names = [name for _, name, _ in solvers(_options(slippy=tmp_path / "nowhere"))]
    said = capsys.readouterr().out
    assert all(name.startswith("ehlwave") for name in names)
    assert "EHL-FBNS: skipped, no --fbns was given" in said
    assert f"slippy: skipped, there is no {tmp_path / 'nowhere'}" in said
    assert "book: skipped, no --book was given" in said


def test_book_brings_its_own_contact(tmp_path: Path) -> None:
    contacts = [(contact, name) for contact, name, _ in solvers(_options(book=tmp_path))]
    assert ("book", "book") in contacts
    assert ("book", "ehlwave") in contacts


@pytest.mark.parametrize(
    ("does", "why"),
    [("exit 9", "exit status 9"), ("""echo '{"message": "stalled"}'; exit 1""", "stalled")],
)
def test_this_program_says_why_it_failed(
    does: str, why: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where it was killed before any output."""
    script = tmp_path / "program"
    script.write_text(f"#!/bin/sh\n{does}\n")
    script.chmod(0o755)
    monkeypatch.setenv("EHLWAVE_CASE", str(script))
    with pytest.raises(FailedError, match=why):
        peer_runs.ehlwave(peer_runs.mourier(), 64)


def test_others_print_their_film(tmp_path: Path) -> None:
    film, seconds = timed([sys.executable, "-c", "print('film 1'); print('film 2.5')"], tmp_path, 9)
    assert film == 2.5
    assert 0 < seconds < 9
    for code, why in (
        ("raise SystemExit('no contact')", "no contact"),
        ("print('film nan')", "film nan"),
        ("import time; time.sleep(9)", "stopped after"),
    ):
        with pytest.raises(FailedError, match=why):
            timed([sys.executable, "-c", code], tmp_path, 0.5)


def test_another_setup_is_not_taken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A clone whose setup has changed is refused; none is run on another contact silently."""
    monkeypatch.setattr("shutil.which", lambda name: name)
    (tmp_path / "code").mkdir()
    for name in ("EHL_01_setup_Study_A_gen.m", "EHL_02_mainprocess.m"):
        (tmp_path / "code" / name).write_text("geo.Nx1 = 257;\n")
    with pytest.raises(FailedError, match="not the one that is known"):
        peer_runs.fbns(tmp_path, 64, 9)


def test_one_that_fails_runs_on_no_finer_grid() -> None:
    def fails(cells: int) -> tuple[float, float]:
        raise FailedError(f"cannot do {cells}")

    table = [("mourier", "good", lambda n: (1 + 1 / n, 0.5)), ("mourier", "bad", fails)]
    rows = list(measure(iter(table), (32, 64), lambda contact: 1.0))
    assert [(row.solver, row.cells) for row in rows] == [("good", 32), ("good", 64), ("bad", 32)]
    assert rows[1].error == pytest.approx(1 / 64)
    assert rows[2].message == "cannot do 32"
    figure = figure_of(rows)
    assert len(figure.axes[0].lines) == 2


def test_times_are_at_equal_error_and_equal_domain() -> None:
    rows = [
        Row("book", "ehlwave", 64, 1.0, 0.01, 0.1),
        Row("book", "ehlwave, whole domain", 64, 1.0, 0.01, 0.2),
        Row("book", "ehlwave, whole domain, fitted", 64, 1.0, 0.001, 0.5),
        Row("mourier", "ehlwave, whole domain", 64, 1.0, 0.0, 0.01),
        Row("book", "book", 64, 1.0, 0.01, 2.0),
        Row("book", "book", 128, 1.0, 0.005, 6.0),
        Row("book", "book", 256, 1.0, 0.0005, 9.0),
        Row("book", "book", 512, float("nan"), float("nan"), float("nan"), "stopped"),
    ]
    times = [row.times for row in compared(rows)]
    assert times == [None, None, None, None, 10.0, 12.0, None, None]


@pytest.mark.skipif(not program("case").is_file(), reason="the programs are not built")
def test_this_program() -> None:
    """Both schemes tend to the same film, on the half and the whole domain."""
    names = {name: run for _, name, run in solvers(_options())}
    half, whole = (names[name](64) for name in ("ehlwave", "ehlwave, whole domain"))
    assert half[0] == pytest.approx(whole[0], rel=1e-4)
    fitted = names["ehlwave, whole domain, fitted"](64)
    limit = limit_of("mourier", 256)
    assert fitted[0] == pytest.approx(limit, rel=0.02)
    assert 0.1 < limit < 0.4


def test_table_and_figure(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    row = Row("mourier", "good", 32, 0.2, 0.01, 0.5)
    monkeypatch.setattr("studies.peers.measure", lambda *_: iter([row]))
    assert main(["--output", str(tmp_path / "peers")]) == 0
    written = {path.name for path in (tmp_path / "peers").iterdir()}
    assert {"peers.csv", "peers.png", "peers.pdf"} <= written
    assert "mourier,good,32,0.2,0.01,0.5,," in (tmp_path / "peers" / "peers.csv").read_text()
