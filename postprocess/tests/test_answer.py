"""The answer comes first: lambda ratio, film, error, and its meaning."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from contact import BALL

import ehlwave
from ehlwave.cli import main
from ehlwave.surface.answer import REGIMES, answer_of, regimes_of

Capture = pytest.CaptureFixture[str]


def trace_file(folder: Path, amplitude_um: float, name: str = "t.csv") -> str:
    x = np.arange(0, 2, 0.002)
    height = amplitude_um * np.cos(2 * np.pi * x / 0.1)
    np.savetxt(folder / name, np.column_stack([x, height]), delimiter=",")
    return str(folder / name)


def words(**more: float) -> list[str]:
    keys = [f"{key}={value}" for key, value in (BALL | more).items()]
    return ["--length-unit", "mm", "--height-unit", "um", "--conditions", *keys]


@pytest.mark.parametrize(
    ("ratio", "error", "regimes"),
    [
        (0.5, 0.1, REGIMES[:1]),
        (0.95, 0.1, REGIMES[:2]),
        (1.0, 0.0, REGIMES[1:2]),
        (2.0, 0.2, REGIMES[1:2]),
        (2.9, 0.1, REGIMES[1:]),
        (3.0, 0.0, REGIMES[2:]),
        (3.0, None, ()),
        (24.0, 0.02, REGIMES[2:]),
        (4.0, 2.0, REGIMES),
        (math.inf, math.inf, REGIMES[2:]),
    ],
)
def test_what_a_ratio_means_is_all_that_its_error_leaves_open(
    ratio: float, error: float | None, regimes: tuple[str, ...]
) -> None:
    assert regimes_of(ratio, error) == regimes


def test_no_regime_is_named_where_the_error_is_not_known(tmp_path: Path, capsys: Capture) -> None:
    """At S = 2 the law of the two waves has no error."""
    file = trace_file(tmp_path, 0.05)
    assert main(["lambda", file, *words(slip_parameter=2.0), "--by", "two-waves"]) == 0
    first = capsys.readouterr().out.splitlines()[0]
    assert "error not known. Mean film" in first
    assert not any(name in first for name in REGIMES)


@pytest.mark.parametrize("command", ["lambda", "deform"])
def test_the_first_line_is_the_answer_and_json_says_the_same(
    command: str, tmp_path: Path, capsys: Capture
) -> None:
    file = trace_file(tmp_path, 0.05)
    assert main([command, file, *words()]) == 0
    first = capsys.readouterr().out.splitlines()[0]
    assert main([command, file, *words(), "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)["answer"]
    assert first == f"Answer       {answer['text']}"
    found = ehlwave.Contact(**BALL).deform(file, length_unit="mm", height_unit="um")
    s = found.statistics
    assert answer["lambda_ratio"] == s.lambda_ratio_after
    assert answer["lambda_error"] == s.lambda_error
    assert answer["regimes"] == ["full film"]
    assert f"lambda = {s.lambda_ratio_after:.3g}, within" in first
    assert answer["text"] == answer_of(s).text()


def test_lambda_names_the_limits_and_their_source_and_is_shorter(
    tmp_path: Path, capsys: Capture
) -> None:
    file = trace_file(tmp_path, 0.3)
    assert main(["lambda", file, *words(viscosity_pa_s=0.002)]) == 0
    said = capsys.readouterr().out
    assert "mixed" in said.splitlines()[0]
    assert "(extrapolated, the surfaces touch)" in said.splitlines()[0]
    assert "Hamrock" in said
    assert main(["deform", file, *words(viscosity_pa_s=0.02)]) == 0
    assert len(capsys.readouterr().out) > len(said)


def test_the_answer_of_two_surfaces_is_that_of_both(tmp_path: Path, capsys: Capture) -> None:
    files = trace_file(tmp_path, 0.05), trace_file(tmp_path, 0.1, "u.csv")
    options = words(slip_parameter=1.1)
    assert main(["lambda", files[0], "--second", files[1], *options, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    both, parts = document["answer"], [document[name]["answer"] for name in ("first", "second")]
    assert both["of_both"]
    assert both["rq_m"] == pytest.approx(math.hypot(*(part["rq_m"] for part in parts)))
    assert both["lambda_ratio"] < min(part["lambda_ratio"] for part in parts)
    assert both["lambda_error"] > min(part["lambda_error"] for part in parts)
    assert main(["lambda", files[0], "--second", files[1], *options]) == 0
    said = capsys.readouterr().out
    assert said.startswith(f"Answer       both surfaces: {both['text']}\n")
    for number, part in enumerate(parts, 1):
        assert f"Answer       surface {number} alone: {part['text']}\n" in said
    # Parts not judged are counted under their heading; only deform names components.
    assert "Not judged" in said
    assert "lambda_x = " not in said


def test_a_film_that_is_not_known_and_a_smooth_surface_are_said(tmp_path: Path) -> None:
    moes = {"load_parameter_m": 100, "lubricant_parameter_l": 10, "radius_ratio_d": 1}
    trace = ehlwave.surface.trace_surface(np.zeros(400) + 1e-30, 2e-6)
    contact = ehlwave.Contact(**moes, semi_axis_a_m=2e-4)
    assert "lambda is not known" in answer_of(contact.deform(trace).statistics).text()
    contact = ehlwave.Contact(**BALL)
    assert "infinite" in answer_of(contact.deform(trace).statistics).text()
