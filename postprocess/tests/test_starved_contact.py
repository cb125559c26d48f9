"""Starved contacts by their laws: film, responses, surfaces, and refusals."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from contact import LOADED_BALL

import ehlwave
from ehlwave.cli import main
from ehlwave.contact.conditions_read import read_conditions
from ehlwave.contact.file_keys import OTHER_INLET_KEYS
from ehlwave.contact.starvation import (
    FILM_BAR,
    WAVE_BAR,
    film_over_flooded,
    is_fitted,
    ratio_error,
    starved_ratio,
)
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.laws.starved_transfer import StarvedTransfer
from ehlwave.laws.table_matching import matching_rows

MOES = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
COMPUTED = {2: 0.944, 1: 0.797, 0.7: 0.642, 0.5: 0.484}
"""R of MOES at 64 cells per a, tests/verification/test_starvation.py."""


def wave(amplitude_m: float = 50e-9, length_m: float = 2e-4) -> ehlwave.surface.Surface:
    x = np.arange(1000) * 2e-6
    height = amplitude_m * np.cos(2 * np.pi * x / length_m)
    return ehlwave.surface.trace_surface(height, step_m=2e-6, axis="x", name="waves")


def test_film_is_that_of_the_atlas_times_the_law() -> None:
    flooded = ehlwave.Contact(**LOADED_BALL)
    starved = ehlwave.Contact(**LOADED_BALL, oil_over_flooded=0.5)
    c = flooded.conditions
    ratio = float(film_over_flooded(0.5, c.m, c.l, c.d))
    film, full = starved.film(), flooded.film()
    assert film.central_m == pytest.approx(ratio * full.central_m)
    assert film.central_error == pytest.approx(full.central_error + FILM_BAR / ratio)
    assert film.minimum_m is None
    assert math.isnan(film.minimum_moes)
    assert "nan" not in film._repr_html_() + starved._repr_html_()
    assert "law of starved contacts" in film.source


def test_error_bars_cover_films_of_finer_grids() -> None:
    law = film_over_flooded(list(COMPUTED), *MOES.values())
    off = np.abs(law - list(COMPUTED.values()))
    assert off.max() < FILM_BAR
    assert off.max() > 0.5 * FILM_BAR  # a bar of the held-out error alone would be too short


def test_error_bars_cover_responses_of_an_independent_solver() -> None:
    # Newton's method in 80 lines, R of COMPUTED: transverse 0.25, 0.5, 1, 2 a, longitudinal 0.5, 1.
    solved = {
        2: ([0.971, 0.913, 0.679, 0.369], [0.625, 0.383]),
        1: ([0.960, 0.906, 0.564, 0.261], [0.579, 0.359]),
        0.7: ([1.001, 0.756, 0.383, 0.150], [0.523, 0.259]),
        0.5: ([0.904, 0.506, 0.201, 0.047], [0.383, 0.120]),
    }
    for r, (transverse, longitudinal) in solved.items():
        contact = ehlwave.Contact(**MOES, oil_over_flooded=r)
        for length, value in zip((0.25, 0.5, 1, 2), transverse, strict=True):
            found = contact.response(length)
            assert abs(abs(found.film) - value) < found.error
        for length, value in zip((0.5, 1), longitudinal, strict=True):
            found = contact.response(length, angle_deg=90)
            assert abs(abs(found.film) - value) < found.error


def test_response_is_the_law_without_phase_and_pressure() -> None:
    contact = ehlwave.Contact(**MOES, oil_over_flooded=0.5)
    found, ratio = contact.response(0.5), contact.conditions.film_ratio
    assert found.film == pytest.approx(float(starved_ratio(ratio, 100, 12.05, 1, 0.5, 0)))
    assert found.error == pytest.approx(float(ratio_error(ratio, 100, 12.05, 1, 0.5, 0)))
    assert found.error > WAVE_BAR
    assert not found.has_phase
    assert math.isnan(found.pressure.real)
    assert "not known" in found._repr_html_()
    oblique = contact.response(0.5, angle_deg=45).film.real
    sides = 0.5 * math.sqrt(2), 0.5 * math.sqrt(2)
    assert oblique == pytest.approx(float(starved_ratio(ratio, 100, 12.05, 1, *sides)))


def test_responses_are_nan_outside_the_law() -> None:
    found = ehlwave.Contact(**MOES, oil_over_flooded=0.5).responses([0.3, 0.5, 3])
    inside = is_fitted([[0.3], [0.5], [3]], [[0, 45, 90]])
    assert (found["is_inside"].values == inside).all()
    assert inside.sum() == 4
    assert (np.isfinite(found["film_amplitude"].values) == inside).all()
    assert np.isnan(found["film_phase"].values).all()
    assert np.isnan(found["film_real"].values).all()


def test_from_bodies() -> None:
    ball, disc = ehlwave.Body.ball(19.05e-3, material="steel"), ehlwave.Body(material="glass")
    given: dict[str, Any] = {"load_n": 20, "speeds_m_per_s": (0.2, 0.2), "viscosity_pa_s": 0.1}
    starved = ehlwave.Contact.from_bodies(ball, disc, **given, oil_over_flooded=0.5)
    flooded = ehlwave.Contact.from_bodies(ball, disc, **given)
    assert starved.film().central_m < 0.51 * flooded.film().central_m


def test_lambda_ratio_falls_and_its_error_has_that_of_the_law() -> None:
    flooded = ehlwave.Contact(**LOADED_BALL).deform(wave(20e-9)).statistics
    starved = ehlwave.Contact(**LOADED_BALL, oil_over_flooded=0.5).deform(wave(20e-9)).statistics
    assert starved.rq_after_m < flooded.rq_after_m
    assert starved.mean_film_m < 0.51 * flooded.mean_film_m
    assert starved.lambda_errors["film"] > FILM_BAR
    assert starved.lambda_errors["responses"] > WAVE_BAR


def test_components_outside_the_law_are_not_judged_and_count_in_the_error() -> None:
    contact = ehlwave.Contact(**LOADED_BALL, oil_over_flooded=0.5)
    short = contact.deform(wave(length_m=1e-5))
    assert any("law of starved contacts" in group.reason for group in short.unjudged)
    inside = contact.deform(wave(), ends="none", form="none")
    assert not inside.unjudged
    transfer, a = contact.transfer(), contact.conditions.semi_axis_a_m
    q = np.array([0.0, 1 / (0.1 * a), 1 / (3 * a)])
    ratio, error = transfer.ratio(q, 0 * q), transfer.error(q, 0 * q)
    assert ratio[0] == error[0] == 0
    assert error[1] >= WAVE_BAR + 1 - ratio[1]
    assert error[2] >= WAVE_BAR + ratio[2]
    assert transfer.rise(q, q) is None


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"oil_over_flooded": 0.1}, "r = 0.1 is outside 0.2 to 5"),
        ({"oil_over_flooded": 9}, "outside 0.2 to 5"),
        ({"load_parameter_m": 10}, "M = 10 is outside 20 to 1000"),
        ({"radius_ratio_d": 0.05}, "D = 0.05 is outside 0.1 to 1"),
        ({"radius_ratio_d": 0}, "line contact"),
        ({"slip_parameter": 1.2}, "pure rolling"),
        ({"slide_to_roll_ratio": 0.1}, "pure rolling"),
        ({"central_film_m": 1e-7}, "remove one"),
        ({"oil_over_flooded": 0}, "above 0"),
        ({"oil_over_floded": 0.5}, "did you mean oil_over_flooded"),
    ],
)
def test_what_is_refused(keys: dict[str, float], said: str) -> None:
    with pytest.raises((SurfaceError, RangeError), match=said):
        ehlwave.Contact(**({**MOES, "oil_over_flooded": 0.5} | keys)).film(by="laws")


def test_waves_and_laws_that_are_refused() -> None:
    contact = ehlwave.Contact(**MOES, oil_over_flooded=0.5)
    with pytest.raises(RangeError, match=r"0\.25 to 2 a below"):
        contact.response(3)
    with pytest.raises(RangeError, match=r"0\.35 to 1 a"):
        contact.response(2, angle_deg=90)
    with pytest.raises(RangeError, match="pure rolling"):
        contact.response(0.5, slip_parameter=1.2)
    with pytest.raises(RangeError, match="flooded contacts"):
        contact.transfer("recommended")
    thin = ehlwave.Contact(**MOES, oil_over_flooded=0.3)
    assert thin.film().central_moes > 0
    with pytest.raises(RangeError, match=r"R = 0\.29.* is outside 0\.39 to 1"):
        thin.response(0.5)


def input_file(folder: Path, inlet: str) -> Path:
    keys = ", ".join(f"{key} = {value}" for key, value in LOADED_BALL.items())
    file = folder / "case.nml"
    file.write_text(f"&conditions {keys} /\n&inlet {inlet} /\n")
    return file


def test_command_takes_the_inlet_of_a_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    trace = tmp_path / "trace.csv"
    x = np.arange(0, 2000, 2.0)
    pd.DataFrame({"x": x, "z": 0.02 * np.cos(2 * np.pi * x / 200)}).to_csv(trace, index=False)
    file = input_file(tmp_path, "oil_over_flooded = 0.5")
    words = [str(trace), "--conditions", str(file), "--length-unit", "um", "--height-unit", "um"]
    assert main(["lambda", *words, "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    contact = ehlwave.Contact(**LOADED_BALL, oil_over_flooded=0.5)
    assert said["transfer"] == contact.transfer().name
    assert said["conditions"]["central_film_m"] == pytest.approx(contact.film().central_m)
    assert main(["deform", *words]) == 0
    assert "law of starved contacts" in capsys.readouterr().out
    assert main(["deform", *words, "--formula", "paper"]) == 2
    assert "for flooded contacts" in capsys.readouterr().err
    assert main(["deform", *words, "--slide-to-roll-ratio", "0.2"]) == 2
    assert "pure rolling" in capsys.readouterr().err


@pytest.mark.parametrize("key", [*OTHER_INLET_KEYS, "oil_unknown"])
def test_other_keys_of_the_inlet_are_refused_with_a_reason(tmp_path: Path, key: str) -> None:
    value = "'1'" if key == "oil_profile" else "1"
    file = input_file(tmp_path, f"{key} = {value}")
    reason = f"unknown key {key} in" if key == "oil_unknown" else f"&inlet {key}: .*ehlwave-case"
    with pytest.raises(SurfaceError, match=reason):
        read_conditions([str(file)])


def test_film_by_the_formula_has_the_law_too() -> None:
    flooded, starved = (
        read_conditions([f"{key}={value}" for key, value in (LOADED_BALL | more).items()])
        for more in ({}, {"oil_over_flooded": 0.5})
    )
    ratio = starved.film_ratio
    assert starved.central_film_m == pytest.approx(flooded.central_film_m * ratio)
    more = starved.central_film_error - flooded.central_film_error
    assert more == pytest.approx(FILM_BAR / ratio)


def test_other_laws_of_viscosity_are_refused() -> None:
    conditions = ehlwave.Contact(**LOADED_BALL, oil_over_flooded=0.5).conditions
    oil = conditions.oil
    object.__setattr__(oil, "other_laws", ("viscosity_law = 'mcewen'",))
    with pytest.raises(RangeError, match="Roelands"):
        StarvedTransfer(conditions)


def test_tables_are_matched_by_the_oil_offered() -> None:
    flooded, starved = (
        ehlwave.Contact(**MOES, **more).conditions for more in ({}, {"oil_over_flooded": 0.5})
    )
    rows = pd.DataFrame({"M": [1.0, 2.0, 3.0], "oil_over_flooded": [np.nan, 0.5, 0.8]})
    assert matching_rows(rows, flooded, "t")["M"].tolist() == [1]
    assert matching_rows(rows, starved, "t")["M"].tolist() == [2]
    with pytest.raises(SurfaceError, match="flooded contact"):
        matching_rows(rows[1:], flooded, "t")
    with pytest.raises(SurfaceError, match=r"oil_over_flooded = 0\.5"):
        matching_rows(rows[["M"]], starved, "t")
    profile = rows[1:2].assign(oil_profile="track.csv")
    with pytest.raises(SurfaceError, match="this much oil"):
        matching_rows(profile, starved, "t")
