"""Two rough surfaces: combined roughness, film and error."""

import json
import math
import warnings
from pathlib import Path

import numpy as np
import pytest
from contact import BALL

import ehlwave
from ehlwave.cli import main
from ehlwave.errors import ExtrapolationWarning, SurfaceError
from ehlwave.surface.amplitude import VALIDATED_SLIDING
from ehlwave.surface.surface import Heights

STEP = 2e-6


def waves(rq: float, length: float = 1e-4) -> Heights:
    return math.sqrt(2) * rq * np.cos(2 * np.pi * np.arange(1000) * STEP / length)


def test_a_smooth_second_surface_changes_nothing() -> None:
    contact = ehlwave.Contact(**BALL)
    alone = contact.deform(waves(3e-8), step=STEP).statistics
    pair = contact.deform_pair(waves(3e-8), np.zeros(1000) + 1e-30, step=STEP).statistics
    for name in ("rq_after_m", "mean_film_m", "minimum_film_m", "lambda_ratio_after"):
        assert getattr(pair, name) == pytest.approx(getattr(alone, name), rel=1e-9), name
    assert pair.lambda_error == pytest.approx(alone.lambda_error, rel=1e-6)


def test_mean_squares_add_and_each_surface_has_its_own_slip() -> None:
    contact = ehlwave.Contact(**BALL, slip_parameter=1.2, eyring_stress_pa=5e6)
    other = ehlwave.Contact(**BALL, slip_parameter=0.8, eyring_stress_pa=5e6)
    pair = contact.deform_pair(waves(2e-8), waves(4e-8, 6e-5), step=STEP)
    parts = (
        contact.deform(waves(2e-8), step=STEP).statistics,
        other.deform(waves(4e-8, 6e-5), step=STEP).statistics,
    )
    s = pair.statistics
    assert s.rq_after_m == pytest.approx(math.hypot(*(one.rq_after_m for one in parts)), rel=1e-9)
    assert s.rq_before_m == pytest.approx(math.hypot(2e-8, 4e-8), rel=1e-3)
    assert s.lambda_ratio_after == pytest.approx(s.mean_film_m / s.rq_after_m)
    assert s.lambda_ratio_after < min(one.lambda_ratio_after or 0 for one in parts)
    # Both pass over lengths of many waves: the film between them has the Rq of free phases.
    assert pair.film.rq_m == pytest.approx(s.rq_after_m, rel=0.05)
    assert pair.film.mean_film_m == pytest.approx(s.mean_film_m, rel=1e-3)
    ratio = contact.lambda_ratio(waves(2e-8), second=waves(4e-8, 6e-5), step=STEP)
    assert ratio == s.lambda_ratio_after


def test_the_film_counts_once_in_the_error() -> None:
    contact = ehlwave.Contact(**BALL)
    alone = contact.deform(waves(3e-8), step=STEP).statistics
    pair = contact.deform_pair(waves(3e-8), waves(3e-8), step=STEP).statistics
    assert alone.lambda_errors is not None
    assert pair.lambda_errors is not None
    assert pair.lambda_errors["film"] == alone.lambda_errors["film"]
    assert pair.lambda_errors["responses"] == pytest.approx(alone.lambda_errors["responses"])
    assert pair.lambda_errors["rise"] == pytest.approx(2 * alone.lambda_errors["rise"])
    assert pair.lambda_errors["amplitude"] == pytest.approx(2 * alone.lambda_errors["amplitude"])


def test_two_that_are_each_validated_can_be_extrapolated_together() -> None:
    contact = ehlwave.Contact(**BALL, slip_parameter=1.05, eyring_stress_pa=5e6)
    film = contact.film().central_m
    assert film is not None
    rq = 0.8 * VALIDATED_SLIDING * film / math.sqrt(2)
    with pytest.warns(ExtrapolationWarning, match="both surfaces"):
        s = contact.deform_pair(waves(rq), waves(rq), step=STEP).statistics
    assert s.extrapolated
    assert s.mean_film_m == pytest.approx(film)  # no rise
    with warnings.catch_warnings():
        warnings.simplefilter("error", ExtrapolationWarning)
        one = contact.deform(waves(rq), step=STEP).statistics
    assert not one.extrapolated
    assert one.mean_rise_m
    assert s.lambda_errors is not None
    assert one.lambda_errors is not None
    assert s.lambda_errors["rise"] > 2 * abs(one.mean_rise_m) / film


def test_highest_points_of_both_touch() -> None:
    contact = ehlwave.Contact(**BALL)
    film = contact.film().central_m
    assert film is not None
    high = waves(0.6 * film)
    with pytest.warns(ExtrapolationWarning) as said:
        s = contact.deform_pair(high, high, step=STEP).statistics
    assert any("where the highest points of both meet" in str(one.message) for one in said)
    assert s.surfaces_touch
    assert s.minimum_film_m is None


def test_a_film_that_is_not_known_is_an_error() -> None:
    moes = {"load_parameter_m": 100, "lubricant_parameter_l": 10, "radius_ratio_d": 1}
    contact = ehlwave.Contact(**moes, semi_axis_a_m=2e-4)
    with pytest.raises(SurfaceError, match="radius_x_m"):
        contact.lambda_ratio(waves(3e-8), second=waves(3e-8), step=STEP)


def test_the_command_says_the_same(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = []
    for name, rq in (("ball", 3e-8), ("disc", 5e-8)):
        files.append(str(tmp_path / f"{name}.csv"))
        np.savetxt(files[-1], waves(rq) * 1e9)
    words = [f"{key}={value}" for key, value in BALL.items()]
    reading = ["--step", "2", "--length-unit", "um", "--height-unit", "nm"]
    command = ["lambda", files[0], "--second", files[1], *reading, "--conditions", *words]
    assert main([*command, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    reading_keys = {"length_unit": "um", "height_unit": "nm", "step": 2}
    contact = ehlwave.Contact(**BALL)
    s = contact.deform_pair(*files, **reading_keys).statistics
    assert document["both"]["lambda_ratio_after"] == s.lambda_ratio_after
    assert document["both"]["lambda_errors"] == s.lambda_errors
    assert document["answer"]["lambda_ratio"] == s.lambda_ratio_after
    assert main(command) == 0
    said = capsys.readouterr().out
    assert f"{s.lambda_ratio_after:.4g} with the deformed one\n" in said
    assert "phases are free" in said
