"""The scripts of the manual: from catalogue data to a lambda ratio with its error, in ten lines."""

import re
import runpy
import subprocess
import sys
import warnings
from pathlib import Path

import pytest

import ehlwave

FOLDER = Path(__file__).parents[1] / "examples" / "catalogue"
SCRIPTS = sorted(FOLDER.glob("*.py"))
RATIOS = {
    "ball_bearing": (8.89, 44),
    "ball_on_disc": (10.31, 29),
    "ball_on_disc_sliding": (10.32, 32),
    "cam": (5.92, 21),
    "gear": (14.50, 32),
    "roller_on_race": (8.92, 33),
}
"""Lambda ratios and their errors, per cent, of the atlas of this version."""


def test_the_manual_names_them_all() -> None:
    page = (FOLDER.parents[1] / "manual" / "howto.md").read_text(encoding="utf-8")
    assert set(re.findall(r"`(\w+)\.py` \|", page)) == {path.stem for path in SCRIPTS}
    assert {path.stem for path in SCRIPTS} == set(RATIOS)


def test_the_python_of_the_page_runs() -> None:
    """Its indented blocks from the first on, without input files, formulas and commands."""
    pint = pytest.importorskip("pint")
    page = (FOLDER.parents[1] / "manual" / "howto.md").read_text(encoding="utf-8")
    page = page.split("## Enter a slide-to-roll ratio")[0]
    code = "\n".join(
        line[4:]
        for line in page.splitlines()
        if line.startswith("    ") and not line.startswith("    ehlwave ")
    )
    names: dict[str, object] = {"pint": pint}
    exec(compile(code, "howto.md", "exec"), names)  # the page of this repository
    assert isinstance(names["contact"], ehlwave.Contact)
    assert names["contact"].film().central_m


def said_by_a_process(path: Path) -> str:
    command = [sys.executable, "-W", "error", path.name]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=FOLDER)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.stem)
def test_ten_lines_say_a_lambda_ratio_and_its_error(
    path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """One runs in a process of its own, which takes as long as all others."""
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line.strip()]
    assert len(lines[1:]) <= 10  # the first describes it
    if path == SCRIPTS[0]:
        said = said_by_a_process(path)
    else:
        monkeypatch.chdir(FOLDER)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            runpy.run_path(path.name, run_name="__main__")
        said, warned = capsys.readouterr()
        assert warned == ""
    found = re.fullmatch(r"lambda ratio (\S+) within (\d+) %\n", said)
    assert found is not None
    ratio, error = RATIOS[path.stem]
    assert float(found[1]) == pytest.approx(ratio, rel=0.02)
    assert int(found[2]) == pytest.approx(error, abs=2)
