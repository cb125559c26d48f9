"""``scripts/study``: options are checked first, steps follow each other, statuses are passed on."""

import csv
import inspect
import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import studies
from studies.command import steps
from studies.command.__main__ import main, parser
from studies.command.options import COUNT, KINDS, STUDIES

Calls = list[list[str]]
Started = Callable[..., tuple[int, Calls]]


def short(word: object) -> str:
    return str(word).removeprefix(f"{steps.ROOT}/")


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Started]:
    """Return a runner of a study; its steps end with the statuses ``fails`` and print ``says``."""

    def start(
        *words: str, fails: dict[str, int] | None = None, says: str = ""
    ) -> tuple[int, Calls]:
        calls: Calls = []

        def call(*command: object, accepted: object = (0,), **rest: object) -> tuple[int, str]:
            calls.append([short(word) for word in command if word not in ("python", "-m")])
            if "python-environment" in str(command):
                return 0, "python\npath\n"
            line = " ".join(calls[-1])
            status = next((code for key, code in (fails or {}).items() if key in line), 0)
            if status not in accepted:  # type: ignore[operator]
                raise steps.StoppedError(status)
            return status, says if rest.get("stdout") == subprocess.PIPE else ""

        monkeypatch.setattr(steps, "call", call)
        monkeypatch.setattr(sys, "argv", ["study", *words, "--output", str(tmp_path / "out")])
        return main(), calls

    handlers = {
        one: signal.getsignal(one) for one in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1)
    }
    monkeypatch.setattr(os, "environ", {**os.environ, "EHLWAVE_RANKS": "3"})
    monkeypatch.chdir(tmp_path)
    yield start
    for number, handler in handlers.items():
        signal.signal(number, handler)


def options_with_values() -> Iterator[tuple[str, str, bool, bool]]:
    """Yield study, option, whether it takes a number, and whether it must exceed 0."""
    for name, study in STUDIES.items():
        for option, keywords in study.options:
            if "type" in keywords and option.startswith("--"):
                kind = keywords["type"]
                yield name, option, kind in KINDS.values(), kind is COUNT


def test_every_study_says_what_it_does(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        parser().parse_args(["--help"])
    said = capsys.readouterr().out
    for name, study in STUDIES.items():
        about = (inspect.getdoc(study.run) or "").split("\n")[0]
        assert len(about) < 79
        assert re.search(f"^  {name} +{re.escape(about)}$", said, re.MULTILINE)


def test_texts_name_every_study() -> None:
    readme = (Path(studies.__file__).parent / "README.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `([a-z-]+)` \|", readme, re.MULTILINE)
    assert rows == sorted(STUDIES)
    there = {path.stem for path in Path(studies.__file__).parent.glob("[a-z]*")}
    assert there == set(re.findall(r"``([a-z_]+)``", studies.__doc__ or ""))


def test_values_that_make_no_sense(capsys: pytest.CaptureFixture[str]) -> None:
    tried = 0
    for study, option, is_number, is_count in options_with_values():
        bad = [[], [""]]
        if is_number:
            bad += [["abc"], ["-1"], ["1x"], ["1 2"], *([["0"]] if is_count else [])]
        for words in bad:
            with pytest.raises(SystemExit) as ended:
                parser().parse_args([study, option, *words])
            assert ended.value.code == 2
            assert option in capsys.readouterr().err, (study, option, words)
            tried += 1
    assert tried > 130


@pytest.mark.parametrize("ranks", ["0", "many", ""])
def test_ranks_of_the_environment_are_looked_at(ranks: str) -> None:
    command = [sys.executable, "-m", "studies.command", "starvation"]
    environment = {**os.environ, "EHLWAVE_RANKS": ranks, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "--ranks" in done.stderr


def test_help_needs_the_standard_library_alone() -> None:
    code = (
        "import sys; import studies.command.__main__\n"
        "print(sorted({'numpy', 'pandas', 'xarray', 'matplotlib'} & set(sys.modules)))"
    )
    paths = [steps.ROOT / "postprocess", steps.ROOT / "postprocess" / "src"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, paths))}
    command = [sys.executable, "-S", "-c", code]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("[]\n", "")


def test_steps_follow_each_other(started: Started, tmp_path: Path) -> None:
    out = tmp_path / "out"
    status, calls = started("stability", "--quick", "--at-once", "2", "--limit", "7")
    assert status == 0
    assert os.environ["EHLWAVE_RANKS"] == "2"
    assert os.environ["EHLWAVE_SWEEP"].endswith("ehlwave-sweep")
    assert calls[0] == ["scripts/install-requirements"]
    assert calls[1] == ["scripts/build", "release"]
    cases = ["--cases", "quick"]
    assert calls[3:] == [
        ["studies.stability", "cases", str(out), *cases, "--limit", "7"],
        ["scripts/run-sweep", str(out / "cases.nml")],
        ["studies.stability", "report", str(out), *cases],
    ]


def test_programs_that_are_named_are_not_built(started: Started, tmp_path: Path) -> None:
    (tmp_path / "ehlwave-sweep").touch()
    status, calls = started(
        "error-vs-time", "--program", str(tmp_path / "ehlwave-sweep"), "--minutes", "1.5"
    )
    assert status == 0
    assert os.environ["EHLWAVE_CASE"] == str(tmp_path / "ehlwave-case")
    assert os.environ["EHLWAVE_SWEEP"] == str(tmp_path / "ehlwave-sweep")
    assert "build" not in {Path(one[0]).name for one in calls}
    assert calls[2][1:2] + calls[2][3:] == ["--ranks=1", "--time-limit", "90"]


@pytest.mark.parametrize("name", ["ehlwave", "missing/ehlwave-case"])
def test_a_program_that_is_none(
    started: Started, tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "ehlwave").touch()
    assert started("speed", "--program", str(tmp_path / name))[0] == 2
    assert "no file whose name ends in -case or -sweep" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "fails", "expected"),
    [
        (["error-vs-time"], {"run-sweep": 85}, 0),
        (["error-vs-time"], {"run-sweep": 1}, 0),
        (["error-vs-time"], {"run-sweep": 4}, 1),
        (["error-vs-time"], {"build": 3}, 3),
        (["stability"], {"run-sweep": 85}, 85),
        (["stability"], {"run-sweep": 1}, 0),
        (["stability"], {"report": 1}, 1),
        (["accuracy"], {"finer.nml": 2}, 2),
        (["accuracy"], {"report": 1}, 1),
        (["accuracy", "--all-keys", "--count", "3"], {"studies.all_keys": 1}, 1),
        (["speed", "--repeats", "1"], {"studies.speed": 1}, 1),
        (["threads", "--threads", "3"], {"studies.threads": 1}, 1),
        (["atlas", "--batches", "1"], {"run-sweep": 85}, 85),
        (["atlas", "--validate", "--line"], {"run-sweep": 1}, 0),
        (["full", "--stage", "two_waves"], {"two_waves.nml": 1}, 1),
        (["full", "--stage", "rheology"], {"barus": 85}, 85),
        (["full", "--stage", "experiment"], {"trace.nml": 3}, 3),
    ],
)
def test_exit_statuses(
    started: Started, tmp_path: Path, words: list[str], fails: dict[str, int], expected: int
) -> None:
    if words[0] == "full":
        (tmp_path / "ehlwave-sweep").touch(0o755)
        os.environ["EHLWAVE_PROGRAMS"] = str(tmp_path)
    status, _ = started(*words, fails=fails, says="name\n")
    assert status == expected


WITH_FOLDER = [
    name for name, study in STUDIES.items() if "--output" in {one for one, _ in study.options}
]


@pytest.mark.parametrize("name", WITH_FOLDER)
def test_every_study_starts(started: Started, tmp_path: Path, name: str) -> None:
    (tmp_path / "ehlwave-sweep").touch(0o755)
    os.environ["EHLWAVE_PROGRAMS"] = str(tmp_path)
    assert started(name, says="name\n")[0] in (0, 1)


def test_a_batch_of_the_atlas_that_was_chosen_stays(started: Started, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "sliding-00.nml").touch()
    _, calls = started("atlas", "--sliding", "--batches", "2", says="rises.nml\n")
    batches = [call for call in calls if call[:2] == ["studies.atlas", "batch"]]
    assert [call[call.index("--batch") + 1] for call in batches] == ["1"]
    swept = [Path(call[1]).name for call in calls if call[0] == "scripts/run-sweep"]
    assert swept == ["sliding-00.nml", "sliding-01.nml", "rises.nml"]


def test_stages_are_noted(started: Started, tmp_path: Path) -> None:
    (tmp_path / "ehlwave-sweep").touch(0o755)
    os.environ["EHLWAVE_PROGRAMS"] = str(tmp_path)
    words = ("full", "--stage", "fresh", "--stage", "sliding")
    started(*words, says="sliding_smooth sliding_shapes\n", fails={"shapes.nml": 1})
    started(*words, says="sliding_smooth sliding_shapes\n", fails={"fresh.nml": 85})
    with (tmp_path / "out" / "stages.csv").open(newline="") as file:
        rows = [(row["stage"], row["exit_status"]) for row in csv.DictReader(file)]
    assert rows == [("sliding", "1"), ("fresh", "0"), ("sliding", "0"), ("fresh", "85")]
    assert "fresh.csv" in (tmp_path / "out" / "fresh.nml").read_text()


def test_a_signal_is_for_the_step_that_runs() -> None:
    step = 'trap "exit 85" USR1; echo ready; while :; do sleep 0.02; done'
    code = (
        "import sys; from studies.command import steps; steps.pass_signals_on()\n"
        f"try: steps.call('bash', '-c', {step!r})\n"
        "except steps.StoppedError as stopped: sys.exit(stopped.status)"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen(
        [sys.executable, "-c", code], env=environment, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        process.send_signal(signal.SIGUSR1)
        assert process.wait(20) == 85


def test_a_signal_between_steps_stops_the_next(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(steps, "_waiting", [signal.SIGTERM])
    with pytest.raises(steps.StoppedError) as stopped:
        steps.call("sleep", "20")
    assert stopped.value.status == 128 + signal.SIGTERM
