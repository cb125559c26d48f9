"""Wrong inputs: each message names the culprit and a value that works, and the value works."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

import ehlwave
from ehlwave.cli import main
from ehlwave.hints import MANUAL, PAGES
from ehlwave.programs import find_program

REMOVED = object()
Keys = dict[str, Any]

DATA = {"radius_x_m": 0.0127, "radius_y_m": 0.0127, "reduced_modulus_pa": 2.26e11, "load_n": 40}
DATA |= {"mean_speed_m_per_s": 0.5, "viscosity_pa_s": 0.05}
MOES = {"load_parameter_m": 100, "lubricant_parameter_l": 10, "radius_ratio_d": 1}
LINE = {"load_n": 1000, "length_m": 0.01, "speeds_m_per_s": (0.5, 0.5), "viscosity_pa_s": 0.05}
BALLS = {"load_n": 30, "speeds_m_per_s": (0.5, 0.5), "viscosity_pa_s": 0.05}
SHEET = {"iso_vg": 68, "temperature_k": 333.15}
STEEL = {"elastic_modulus_pa": 2.06e11, "poisson_ratio": 0.3}


def film(**keys: object) -> object:
    return ehlwave.Contact(**DATA | keys).film()


def moes(**keys: object) -> object:
    return ehlwave.Contact(**MOES | keys).film()


def sliding(**keys: object) -> object:
    return film(**{"eyring_stress_pa": 5e6, "slide_to_roll_ratio": 0.3} | keys)


def response(**arguments: object) -> object:
    return ehlwave.Contact(**MOES).response(**{"wavelength_over_a": 0.5} | arguments)


def body(**keys: object) -> object:
    return ehlwave.Body(**{"radius_x_m": 0.01} | STEEL | keys)


def lines(**keys: object) -> object:
    roller = ehlwave.Body(0.01, material="steel")
    return ehlwave.Contact.from_bodies(roller, roller, **LINE | keys).film()


def balls(**keys: object) -> object:
    ball = ehlwave.Body.ball(0.02, material="steel")
    return ehlwave.Contact.from_bodies(ball, ball, **BALLS | keys).film()


def barrel(**radii: float) -> object:
    """Return the film of a body with these radii on a flat one."""
    one = ehlwave.Body(**{"radius_x_m": 0.01, "radius_y_m": 0.03} | radii, material="steel")
    return ehlwave.Contact.from_bodies(one, ehlwave.Body(material="steel"), **BALLS).film()


def groove(radius_y_m: float = -0.02) -> object:
    hollow = ehlwave.Body(0.05, radius_y_m, material="steel")
    ball = ehlwave.Body.ball(0.02, material="steel")
    return ehlwave.Contact.from_bodies(ball, hollow, **BALLS).film()


def race(**keys: object) -> object:
    usual = {"element_diameter_m": 8e-3, "pitch_diameter_m": 39e-3, "osculation": 0.53}
    return ehlwave.Body.inner_race(**usual | keys, material="steel")


def sheet(**keys: object) -> object:
    return ehlwave.Oil.from_grade(**SHEET | keys)


def measured(**keys: object) -> object:
    return ehlwave.Oil.named(**{"name": "heavy machine oil 153", "temperature_k": 333.15} | keys)


def law(**keys: object) -> object:
    x = np.arange(0, 2e-3, 2e-6)
    trace = ehlwave.deform.trace_surface(20e-9 * np.cos(2 * np.pi * x / 1e-4), step_m=2e-6)
    return ehlwave.Contact(**DATA | {"load_n": 0.5}).deform(trace, **keys)


def case(**keys: object) -> object:
    return ehlwave.Case(**{**DATA, "cells_x": 64, "cells_y": 64} | keys).plan()


def study(**keys: object) -> object:
    grid = {"load_n": [20, 40], "slide_to_roll_ratio": [0, 0.3]}
    return ehlwave.Study({**grid, **DATA, "cells_x": 64, "cells_y": 64} | grid | keys).plan()


class Wrong(NamedTuple):
    """One wrong input.

    ``right`` replaces the wrong keys; each of its values stands in the message, as `said`.
    """

    call: Callable[..., object]
    wrong: Keys
    culprit: str
    said: str
    right: Keys


WRONG = [
    # a prefix forgotten
    Wrong(
        film,
        {"reduced_modulus_pa": 220},
        "reduced_modulus_pa = 220",
        "220e9",
        {"reduced_modulus_pa": 220e9},
    ),
    Wrong(
        film,
        {"reduced_modulus_pa": 226000},
        "reduced_modulus_pa = 226000",
        "226000e6",
        {"reduced_modulus_pa": 226000e6},
    ),
    Wrong(film, {"radius_x_m": 12.7}, "radius_x_m = 12.7", "0.0127", {"radius_x_m": 0.0127}),
    Wrong(film, {"viscosity_pa_s": 50}, "viscosity_pa_s = 50", "0.05", {"viscosity_pa_s": 0.05}),
    Wrong(
        film,
        {"mean_speed_m_per_s": 500},
        "mean_speed_m_per_s = 500",
        "0.5",
        {"mean_speed_m_per_s": 0.5},
    ),
    Wrong(
        film,
        {"pressure_viscosity_per_pa": 22},
        "pressure_viscosity_per_pa = 22",
        "22e-9",
        {"pressure_viscosity_per_pa": 22e-9},
    ),
    Wrong(
        film, {"central_film_m": 0.3}, "central_film_m = 0.3", "0.3e-6", {"central_film_m": 0.3e-6}
    ),
    Wrong(
        sliding,
        {"slide_to_roll_ratio": 30},
        "slide_to_roll_ratio = 30",
        "0.3",
        {"slide_to_roll_ratio": 0.3},
    ),
    Wrong(
        sliding, {"eyring_stress_pa": 5}, "eyring_stress_pa = 5", "5e6", {"eyring_stress_pa": 5e6}
    ),
    Wrong(
        body,
        {"elastic_modulus_pa": 206},
        "elastic_modulus_pa = 206",
        "206e9",
        {"elastic_modulus_pa": 206e9},
    ),
    Wrong(body, {"poisson_ratio": 30}, "poisson_ratio = 30", "0.3", {"poisson_ratio": 0.3}),
    Wrong(body, {"radius_x_m": 25}, "radius_x_m = 25", "0.025", {"radius_x_m": 0.025}),
    Wrong(sheet, {"temperature_k": 60}, "temperature_k = 60", "333.15", {"temperature_k": 333.15}),
    Wrong(
        sheet,
        {"density_15c_kg_per_m3": 0.88},
        "density_15c_kg_per_m3 = 0.88",
        "880",
        {"density_15c_kg_per_m3": 880},
    ),
    Wrong(
        sheet,
        {"iso_vg": REMOVED, "viscosity_40c_mm2_per_s": 68e-6},
        "viscosity_40c_mm2_per_s = 6.8e-05",
        "68",
        {"iso_vg": REMOVED, "viscosity_40c_mm2_per_s": 68},
    ),
    Wrong(
        case,
        {"reduced_modulus_pa": 220},
        "reduced_modulus_pa = 220",
        "220e9",
        {"reduced_modulus_pa": 220e9},
    ),
    Wrong(study, {"load_n": [20, 4e10]}, "load_n = 4e+10", "40000", {"load_n": [20, 40000]}),
    # outside the atlas, in the user's quantities
    Wrong(film, {"load_n": 0.2}, "load_n = 0.2 gives M = 0.6", "holds {} to", {"load_n": None}),
    Wrong(
        film,
        {"mean_speed_m_per_s": 300, "load_n": 800},
        "mean_speed_m_per_s = 300 gives L = ",
        "holds {} to",
        {"mean_speed_m_per_s": None, "load_n": 800},
    ),
    Wrong(
        film, {"viscosity_pa_s": 0.7, "load_n": 5}, "gives M = ", "holds {} to", {"load_n": None}
    ),
    Wrong(balls, {"load_n": 0.2}, "load_n = 0.2 gives M = ", "holds {} to", {"load_n": None}),
    Wrong(lines, {"load_n": 2}, "load_n = 2 gives M = ", "holds {} to", {"load_n": None}),
    Wrong(
        moes,
        {"load_parameter_m": 3},
        "load_parameter_m = 3",
        "5 to 100000",
        {"load_parameter_m": 20},
    ),
    Wrong(
        sliding,
        {"slide_to_roll_ratio": 1.6},
        "slide_to_roll_ratio = 1.6",
        "-1 to 1",
        {"slide_to_roll_ratio": 1},
    ),
    Wrong(
        response,
        {"wavelength_over_a": 9},
        "wavelength_over_a = 9",
        "0.1 to 4",
        {"wavelength_over_a": 4},
    ),
    Wrong(response, {"angle_deg": 120}, "angle_deg = 120", "0 to 90", {"angle_deg": 90}),
    Wrong(
        response,
        {"slip_parameter": 1.9},
        "slip_parameter = 1.9",
        "0.5 to 1.5",
        {"slip_parameter": 1.5},
    ),
    Wrong(law, {}, "load_n = 0.5 gives M", "by='recommended'", {"by": "recommended"}),
    # misspelt
    Wrong(film, {"load": 40}, "unknown key load", "load_n", {"load_n": 40}),
    Wrong(
        film,
        {"radus_y_m": 0.0127},
        "unknown key radus_y_m",
        "did you mean radius_y_m",
        {"radius_y_m": 0.0127},
    ),
    Wrong(
        balls,
        {"speed_m_per_s": (0.5, 0.5)},
        "unknown key speed_m_per_s",
        "did you mean speeds_m_per_s",
        {"speeds_m_per_s": (0.5, 0.5)},
    ),
    Wrong(
        case,
        {"wavelenght_over_a": 1, "orientation": "transverse"},
        "unknown key wavelenght_over_a",
        "did you mean wavelength_over_a",
        {"wavelength_over_a": 1, "orientation": "transverse"},
    ),
    Wrong(
        case,
        {"orientation": "tranverse", "wavelength_over_a": 1},
        "orientation",
        "'transverse'",
        {"orientation": "transverse", "wavelength_over_a": 1},
    ),
    Wrong(
        body,
        {"elastic_modulus_pa": None, "poisson_ratio": None, "material": "stel"},
        "material = 'stel'",
        "did you mean steel",
        {"elastic_modulus_pa": None, "poisson_ratio": None, "material": "steel"},
    ),
    Wrong(
        sheet, {"kind": "minral"}, "kind = 'minral'", "did you mean mineral", {"kind": "mineral"}
    ),
    Wrong(sheet, {"alpha": "goldd"}, "alpha = 'goldd'", "did you mean gold", {"alpha": "gold"}),
    Wrong(sheet, {"iso_vg": 65}, "iso_vg = 65", "68", {"iso_vg": 68}),
    Wrong(
        measured,
        {"name": "heavy oil 153"},
        "name = 'heavy oil 153'",
        "did you mean heavy machine oil 153",
        {"name": "heavy machine oil 153"},
    ),
    # missing, contradicting, impossible
    Wrong(
        film,
        {"slip_parameter": 1.1, "slide_to_roll_ratio": 0},
        "slip_parameter = 1.1 and slide_to_roll_ratio = 0",
        "remove slip_parameter",
        {"slide_to_roll_ratio": 0},
    ),
    Wrong(film, {"load_n_per_m": 1e5}, "load_n_per_m", "remove one", {}),
    Wrong(lines, {"length_m": None}, "length_m is missing", "length_m=0.01", {"length_m": 0.01}),
    Wrong(balls, {"length_m": 0.01}, "length_m", "give load_n alone", {}),
    Wrong(balls, {"radius_x_m": 0.01}, "radius_x_m follows from the bodies", "remove it", {}),
    Wrong(
        balls,
        {"oil": sheet()},
        "viscosity_pa_s",
        "remove one",
        {"oil": sheet(), "viscosity_pa_s": REMOVED},
    ),
    Wrong(
        balls,
        {"speeds_m_per_s": 0.5},
        "speeds_m_per_s = 0.5",
        "(0.5, 0.5)",
        {"speeds_m_per_s": (0.5, 0.5)},
    ),
    Wrong(
        balls,
        {"speeds_m_per_s": (0.5, -0.5)},
        "speeds_m_per_s = (0.5, -0.5)",
        "(0.5, 0.5)",
        {"speeds_m_per_s": (0.5, 0.5)},
    ),
    Wrong(
        balls,
        {"speeds_m_per_s": (0, 0)},
        "speeds_m_per_s = (0, 0)",
        "(1, 1)",
        {"speeds_m_per_s": (1, 1)},
    ),
    Wrong(
        balls,
        {"speeds_m_per_s": (0.6, -0.3)},
        "speeds_m_per_s = (0.6, -0.3)",
        "(0.6, 0.3)",
        {"speeds_m_per_s": (0.6, 0.3)},
    ),
    Wrong(
        body,
        {"elastic_modulus_pa": None, "poisson_ratio": None},
        "elastic_modulus_pa is missing",
        'material="steel"',
        {"elastic_modulus_pa": None, "poisson_ratio": None, "material": "steel"},
    ),
    Wrong(body, {"radius_x_m": 0}, "radius_x_m = 0", "remove it", {"radius_x_m": REMOVED}),
    Wrong(
        barrel,
        {"radius_x_m": 0.03, "radius_y_m": 0.01},
        "Rx/Ry = 3",
        "exchange radius_x_m and radius_y_m",
        {"radius_x_m": 0.01, "radius_y_m": 0.03},
    ),
    Wrong(
        groove,
        {"radius_y_m": -0.009},
        "radius_y_m = 0.01 and -0.009",
        "radius_y_m=-0.011",
        {"radius_y_m": -0.011},
    ),
    Wrong(race, {"osculation": 0.4}, "osculation = 0.4", "0.52", {"osculation": 0.52}),
    Wrong(
        race,
        {"pitch_diameter_m": 6e-3},
        "pitch_diameter_m = 0.006",
        "0.04",
        {"pitch_diameter_m": 0.04},
    ),
    Wrong(
        sheet,
        {"temperature_k": REMOVED},
        "temperature_k is missing",
        "313.15",
        {"temperature_k": 313.15},
    ),
    Wrong(sheet, {"iso_vg": REMOVED}, "iso_vg is missing", "such as 68", {"iso_vg": 68}),
    Wrong(sheet, {"viscosity_index": 900}, "viscosity_index = 900", "95", {"viscosity_index": 95}),
    Wrong(
        sheet,
        {"viscosity_100c_mm2_per_s": 70},
        "viscosity_100c_mm2_per_s = 70",
        "8.53",
        {"viscosity_100c_mm2_per_s": 8.53},
    ),
    Wrong(
        sheet,
        {"kind": "pao", "alpha": "wooster"},
        "alpha = 'wooster'",
        "alpha='gold'",
        {"kind": "pao", "alpha": "gold"},
    ),
    Wrong(
        measured,
        {"temperature_k": 250},
        "temperature_k = 250",
        "303.15 to 373.15",
        {"temperature_k": 303.15},
    ),
    Wrong(
        case,
        {"slip_parameter": 1.5, "slide_to_roll_ratio": 1},
        "slip_parameter = 1.5 and slide_to_roll_ratio = 1",
        "give one of the two",
        {"slide_to_roll_ratio": 1},
    ),
]


def given(keys: Keys) -> Keys:
    return {key: value for key, value in keys.items() if value is not REMOVED}


def call(wrong: Wrong, keys: Keys) -> object:
    """Call with keys; those removed are left out of what the call gives by itself, too."""
    removed = [key for key, value in keys.items() if value is REMOVED]
    if not removed:
        return wrong.call(**keys)
    defaults = {sheet: SHEET, balls: BALLS}.get(wrong.call, {})
    if wrong.call is body:
        return ehlwave.Body(**STEEL)
    rest = {key: value for key, value in (defaults | keys).items() if key not in removed}
    if wrong.call is sheet:
        return ehlwave.Oil.from_grade(**rest)
    ball = ehlwave.Body.ball(0.02, material="steel")
    return ehlwave.Contact.from_bodies(ball, ball, **rest).film()


@pytest.mark.parametrize("wrong", WRONG, ids=lambda w: f"{w.call.__name__}-{','.join(w.wrong)}")
def test_the_message_names_the_culprit_and_a_value_that_works(wrong: Wrong) -> None:
    if wrong.call in (case, study):
        try:
            find_program("ehlwave-sweep")
        except ehlwave.ProgramError:
            pytest.skip("the programs are not built")
    with pytest.raises((ehlwave.SurfaceError, ehlwave.RangeError, ehlwave.ProgramError)) as caught:
        call(wrong, wrong.wrong)
    message = str(caught.value)
    assert wrong.culprit in message
    assert "\n" not in message or wrong.call in (case, study)
    right = dict(wrong.right)
    if "{}" in wrong.said:
        before, after = map(re.escape, wrong.said.split("{}"))
        found = re.search(rf"{before}(\S+){after}", message)
        assert found is not None, message
        key = next(iter(right))
        right = wrong.wrong | {key: float(found[1])}
    else:
        assert wrong.said in message
    call(wrong, right)


def test_there_are_many() -> None:
    assert len(WRONG) >= 40


@pytest.fixture
def trace(tmp_path: Path) -> str:
    x = np.arange(0, 2000, 2.0)
    path = tmp_path / "trace.csv"
    heights = 0.02 * np.cos(2 * np.pi * x / 100)
    path.write_text("\n".join(f"{a},{b:.6f}" for a, b in zip(x, heights, strict=True)))
    return str(path)


CONDITIONS = [f"{key}={value}" for key, value in DATA.items()]
UNITS = ["--length-unit", "um", "--height-unit", "um"]
LIGHT = [*CONDITIONS[:3], "load_n=0.5", *CONDITIONS[4:]]
COMMANDS = [
    (
        ["deforn"],
        "'deforn'",
        "did you mean deform",
        ["deform", "TRACE", "--conditions", *CONDITIONS, *UNITS],
    ),
    (
        ["deform", "TRACE", "--conditions", *CONDITIONS, "--lenght-unit", "um", *UNITS[2:]],
        "--lenght-unit",
        "did you mean --length-unit",
        ["deform", "TRACE", "--conditions", *CONDITIONS, *UNITS],
    ),
    (
        ["deform", "TRACE", "--conditions", *CONDITIONS],
        "unit",
        "set --height-unit (m, mm, um, nm)",
        ["deform", "TRACE", "--conditions", *CONDITIONS, *UNITS],
    ),
    (
        ["deform", "TRACE", "--conditions", *LIGHT, *UNITS],
        "load_n = 0.5 gives M",
        "--formula recommended",
        ["deform", "TRACE", "--conditions", *LIGHT, *UNITS, "--formula", "recommended"],
    ),
    (
        ["deform", "TRACE", "--conditions", *CONDITIONS, "--slide-to-roll-ratio", "30", *UNITS],
        "slide_to_roll_ratio = 30",
        "did you mean 0.3?",
        [
            "deform",
            "TRACE",
            "--conditions",
            *CONDITIONS,
            "eyring_stress_pa=5e6",
            "--slide-to-roll-ratio",
            "0.3",
            *UNITS,
        ],
    ),
    (
        [
            "deform",
            "TRACE",
            "--conditions",
            *CONDITIONS,
            "slip_parameter=1",
            "--slide-to-roll-ratio",
            "0",
            *UNITS,
        ],
        "slip_parameter = 1",
        "remove slip_parameter",
        ["deform", "TRACE", "--conditions", *CONDITIONS, "--slide-to-roll-ratio", "0", *UNITS],
    ),
    (
        ["deform", "TRACE", "--conditions", *CONDITIONS, *UNITS, "--step", "3"],
        "--step 3",
        "whose step is 2",
        ["deform", "TRACE", "--conditions", *CONDITIONS, *UNITS, "--step", "2"],
    ),
]


@pytest.mark.parametrize(("wrong", "culprit", "said", "right"), COMMANDS)
def test_the_command_line_names_options(
    wrong: list[str],
    culprit: str,
    said: str,
    right: list[str],
    trace: str,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def run(words: list[str]) -> int:
        try:
            return main([trace if word == "TRACE" else word for word in words])
        except SystemExit as ended:
            return int(ended.code or 0)

    assert run(wrong) == 2
    message = capsys.readouterr().err
    assert culprit in message
    assert said in message
    assert run(right) == 0


def test_pages_of_the_manual_are_there() -> None:
    folder = Path(__file__).parents[2] / MANUAL
    for page in PAGES.values():
        name, _, place = page.partition("#")
        titles = re.findall(r"^#+ (.*)$", (folder / name).read_text(encoding="utf-8"), re.MULTILINE)
        assert place in [re.sub(r"[^\w -]", "", t).lower().replace(" ", "-") for t in titles]
