"""Wrong inputs: each message names the culprit and a value that works, and the value works."""

import contextlib
import re
from ast import literal_eval
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
import xarray as xr
from contact import BALL

import ehlwave
from ehlwave.choices import AXES, DECIMALS, FORMS, LAWS, RATIO_COLUMNS, WINDOWS
from ehlwave.cli import main
from ehlwave.contact.alpha_estimates import ESTIMATES, GOLD
from ehlwave.contact.measured_oils import MEASURED
from ehlwave.errors import MANUAL, PAGES
from ehlwave.programs.programs import find_program
from ehlwave.results.schema import EDGES
from ehlwave.surface.units import CHOICES as CHOICES_OF_UNITS

REMOVED = object()
Keys = dict[str, Any]

DATA = BALL | {"mean_speed_m_per_s": 0.5}
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
    """Return the film of a body with these radii on a flat body."""
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
    trace = ehlwave.surface.trace_surface(20e-9 * np.cos(2 * np.pi * x / 1e-4), step_m=2e-6)
    return ehlwave.Contact(**DATA | {"load_n": 0.5}).deform(trace, **keys)


def stressed(**keys: object) -> object:
    x = np.arange(0, 4e-4, 4e-6)
    trace = ehlwave.surface.trace_surface(20e-9 * np.cos(2 * np.pi * x / 1e-4), step_m=4e-6)
    slip = {"slip_parameter": keys.pop("slip_parameter", 1.1), "eyring_stress_pa": 5e6}
    contact = ehlwave.Contact(**DATA, **slip)
    return contact.stress(trace, **{"depths_m": [0, 2e-5, 4e-5]} | keys)


def rough(**keys: object) -> object:
    x = np.arange(0, 4e-4, 4e-6)
    heights = {"surface": 2e-8 * np.cos(2 * np.pi * x / 1e-4), "step": 4e-6}
    return ehlwave.Contact(**DATA).deform(**heights | keys)


def trace_of(**keys: object) -> object:
    return ehlwave.surface.trace_surface(**{"height": np.zeros(9), "step_m": 1e-6} | keys)


def case(**keys: object) -> object:
    return ehlwave.Case(**{**DATA, "cells_x": 64, "cells_y": 64} | keys).plan()


def study(**keys: object) -> object:
    grid = {"load_n": [20, 40], "slide_to_roll_ratio": [0, 0.3]}
    return ehlwave.Study({**grid, **DATA, "cells_x": 64, "cells_y": 64} | grid | keys).plan()


class Wrong(NamedTuple):
    """A wrong input.

    ``right`` replaces the wrong keys; the message contains each of its values, as `said`.
    """

    call: Callable[..., object]
    wrong: Keys
    culprit: str
    said: str
    right: Keys


def value(
    call: Callable[..., object], key: str, wrong: object, right: str, said: str = ""
) -> Wrong:
    """Return a wrong value of a key; the message has the right value, or `said`."""
    return Wrong(call, {key: wrong}, f"{key} = {wrong}", said or right, {key: literal_eval(right)})


def misspelt(call: Callable[..., object], key: str, wrong: str, right: str) -> Wrong:
    return Wrong(call, {key: wrong}, f"{key} = '{wrong}'", f"did you mean {right}", {key: right})


def no_key(call: Callable[..., object], wrong: str, right: str, given: object) -> Wrong:
    said = f"did you mean {right}"
    return Wrong(call, {wrong: given}, f"unknown key {wrong}", said, {right: given})


WRONG = [
    # a prefix forgotten
    value(film, "reduced_modulus_pa", 220, "220e9"),
    value(film, "reduced_modulus_pa", 226000, "226000e6"),
    value(film, "radius_x_m", 12.7, "0.0127"),
    value(film, "viscosity_pa_s", 50, "0.05"),
    value(film, "mean_speed_m_per_s", 500, "0.5"),
    value(film, "pressure_viscosity_per_pa", 22, "22e-9"),
    value(film, "central_film_m", 0.3, "0.3e-6"),
    value(sliding, "slide_to_roll_ratio", 30, "0.3"),
    value(sliding, "eyring_stress_pa", 5, "5e6"),
    value(body, "elastic_modulus_pa", 206, "206e9"),
    value(body, "poisson_ratio", 30, "0.3"),
    value(body, "radius_x_m", 25, "0.025"),
    value(sheet, "temperature_k", 60, "333.15"),
    value(sheet, "density_15c_kg_per_m3", 0.88, "880"),
    Wrong(
        sheet,
        {"iso_vg": REMOVED, "viscosity_40c_mm2_per_s": 68e-6},
        "viscosity_40c_mm2_per_s = 6.8e-05",
        "68",
        {"iso_vg": REMOVED, "viscosity_40c_mm2_per_s": 68},
    ),
    value(stressed, "poisson_ratio", 30, "0.3"),
    value(stressed, "friction", 5, "0.05"),
    value(stressed, "friction", float("nan"), "0.05", "not a finite number"),
    value(stressed, "poisson_ratio", -1, "0.3", "above -1 and at most 0.5"),
    Wrong(stressed, {"depths_m": [1, 50]}, "depths_m: 50 m", "did you mean 50e-6", {}),
    Wrong(
        stressed,
        {"slip_parameter": 1.0, "friction": 0.05},
        "friction = 0.05 in pure rolling",
        "remove it",
        {"slip_parameter": 1.0},
    ),
    value(case, "reduced_modulus_pa", 220, "220e9"),
    Wrong(study, {"load_n": [20, 4e10]}, "load_n = 4e+10", "40000", {"load_n": [20, 40000]}),
    # outside the atlas, in the user's quantities
    Wrong(film, {"load_n": 0.02}, "load_n = 0.02 gives M = 0.06", "holds {} to", {"load_n": None}),
    Wrong(
        film,
        {"mean_speed_m_per_s": 300, "load_n": 800},
        "mean_speed_m_per_s = 300 gives L = ",
        "holds {} to",
        {"mean_speed_m_per_s": None, "load_n": 800},
    ),
    Wrong(
        film, {"viscosity_pa_s": 0.7, "load_n": 0.05}, "gives M = ", "holds {} to", {"load_n": None}
    ),
    Wrong(balls, {"load_n": 0.004}, "load_n = 0.004 gives M = ", "holds {} to", {"load_n": None}),
    Wrong(lines, {"load_n": 1.4}, "load_n = 1.4 gives M = ", "holds {} to", {"load_n": None}),
    value(moes, "load_parameter_m", 3, "20", "5 to 100000"),
    value(sliding, "slide_to_roll_ratio", 3, "1", "-2 to 2"),
    value(response, "wavelength_over_a", 9, "4", "0.1 to 4"),
    value(response, "angle_deg", 120, "90", "0 to 90"),
    value(response, "slip_parameter", 1.9, "1.5", "0.5 to 1.5"),
    Wrong(law, {}, "load_n = 0.5 gives M", "by='recommended'", {"by": "recommended"}),
    # misspelt
    Wrong(film, {"load": 40}, "unknown key load", "load_n", {"load_n": 40}),
    no_key(film, "radus_y_m", "radius_y_m", 0.0127),
    no_key(balls, "speed_m_per_s", "speeds_m_per_s", (0.5, 0.5)),
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
    misspelt(sheet, "kind", "minral", "mineral"),
    misspelt(rough, "by", "recomended", "recommended"),
    misspelt(rough, "form", "plain", "plane"),
    misspelt(rough, "ends", "mirrored", "mirror"),
    misspelt(rough, "decimal", "coma", "comma"),
    misspelt(rough, "rolling_axis", "X", "x"),
    misspelt(trace_of, "axis", "Y", "y"),
    misspelt(sheet, "alpha", "goldd", "gold"),
    value(sheet, "iso_vg", 65, "68"),
    misspelt(measured, "name", "heavy oil 153", "heavy machine oil 153"),
    # missing, contradicting, impossible
    Wrong(
        film,
        {"slip_parameter": 1.1, "slide_to_roll_ratio": 0},
        "slip_parameter = 1.1 and slide_to_roll_ratio = 0",
        "remove slip_parameter",
        {"slide_to_roll_ratio": 0},
    ),
    Wrong(film, {"load_n_per_m": 1e5}, "load_n_per_m", "remove one", {}),
    Wrong(
        lines,
        {"load_n": None, "load_n_per_m": 1e5},
        "gives length_m and load_n_per_m",
        "remove one",
        {"load_n": None, "load_n_per_m": 1e5, "length_m": None},
    ),
    Wrong(moes, {"radius_x_m": 0.01}, "radius_x_m", "remove it", {}),
    Wrong(rough, {"step_across": 4e-6}, "step_across=4e-06", "remove it", {}),
    Wrong(
        sheet,
        {"pressure_viscosity_error": 0.1},
        "pressure_viscosity_error",
        "give both",
        {"pressure_viscosity_error": 0.1, "pressure_viscosity_per_pa": 2e-8},
    ),
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
    value(balls, "speeds_m_per_s", 0.5, "(0.5, 0.5)"),
    Wrong(balls, {"speeds_m_per_s": (1, 2, 3)}, "(1, 2, 3)", "(1, 1)", {"speeds_m_per_s": (1, 1)}),
    Wrong(balls, {"speeds_m_per_s": None}, "speeds_m_per_s is missing", "two bodies need", {}),
    Wrong(balls, {"flow_law": "newtonian"}, "flow_law is a key of ehlwave.Case", "known are", {}),
    value(film, "slip_parameter", -0.1, "0", "0 to 2"),
    value(film, "viscosity_error", -0.1, "0", "must be at least 0"),
    Wrong(
        film,
        {"radius_y_m": 0.0127 / (1 + 1e-9)},
        "D = Rx/Ry = 1.000000001",
        "0.005 to 1",
        {"radius_y_m": 0.0127},
    ),
    Wrong(film, {"radius_x_m": 0.5}, "radius_x_m = 0.5 and radius_y_m = 0.0127", "0.005 to 1", {}),
    value(balls, "speeds_m_per_s", (0.5, -0.5), "(0.5, 0.5)"),
    value(balls, "speeds_m_per_s", (0, 0), "(1, 1)"),
    value(balls, "speeds_m_per_s", (0.6, -0.3), "(0.6, 0.3)"),
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
    value(race, "osculation", 0.4, "0.52"),
    value(race, "pitch_diameter_m", 0.006, "0.04"),
    value(race, "pitch_diameter_m", 39, "0.039"),
    value(race, "element_diameter_m", 8, "0.008"),
    value(race, "element_diameter_m", -0.008, "0.008", "must be above 0"),
    Wrong(
        sheet,
        {"temperature_k": REMOVED},
        "temperature_k is missing",
        "313.15",
        {"temperature_k": 313.15},
    ),
    Wrong(sheet, {"iso_vg": REMOVED}, "iso_vg is missing", "such as 68", {"iso_vg": 68}),
    value(sheet, "viscosity_index", 900, "95"),
    Wrong(
        sheet,
        {"pressure_viscosity_per_pa": 2e-8, "pressure_viscosity_error": 10},
        "pressure_viscosity_error = 10",
        "0.1",
        {"pressure_viscosity_per_pa": 2e-8, "pressure_viscosity_error": 0.1},
    ),
    value(sheet, "viscosity_100c_mm2_per_s", 70, "8.53"),
    Wrong(
        sheet,
        {"kind": "pao", "alpha": "wooster"},
        "alpha = 'wooster'",
        "alpha='gold'",
        {"kind": "pao", "alpha": "gold"},
    ),
    value(measured, "temperature_k", 250, "303.15", "303.15 to 373.15"),
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
    """Call with keys, without removed keys, which are also dropped from the call's own."""
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
    with pytest.raises(ehlwave.EhlwaveError) as caught:
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


def results(**keys: object) -> object:
    return ehlwave.select_points(xr.Dataset(), **keys)


def words(name: str, right: Iterable[str]) -> str:
    """Return a word outside the right words."""
    rng = np.random.default_rng(sum(map(ord, name)))
    letters = list("abcdefghijklmnopqrstuvwxyz-_ ")
    return next(w for w in iter(lambda: "".join(rng.choice(letters, 4)), "") if w not in right)


CHOICES = [
    (rough, "by", (*LAWS, "laws")),
    (rough, "form", FORMS),
    (rough, "ends", WINDOWS),
    (rough, "decimal", DECIMALS),
    (rough, "rolling_axis", AXES),
    (trace_of, "axis", AXES),
    (rough, "length_unit", CHOICES_OF_UNITS),
    (rough, "height_unit", CHOICES_OF_UNITS),
    (sheet, "kind", GOLD),
    (sheet, "alpha", ESTIMATES),
    (measured, "name", MEASURED),
    (results, "ratio", RATIO_COLUMNS),
    (results, "edges", EDGES),
]


@pytest.mark.parametrize(("door", "name", "known"), CHOICES)
def test_another_word_is_refused_with_those_that_there_are(
    door: Callable[..., object], name: str, known: Iterable[str]
) -> None:
    for wrong in (words(name, known), next(iter(known)).upper() + " ", 3, None, 1.5, ["x"]):
        if wrong is None and name in ("by", "decimal", "length_unit", "height_unit", "edges"):
            continue
        with pytest.raises(ehlwave.EhlwaveError) as caught:
            door(**{name: wrong})
        message = str(caught.value)
        assert repr(wrong) in message
        assert all(word in message for word in known)


@pytest.mark.parametrize("option", [{"rolling_axis": "y"}, {"step": 2e-6}, {"height_unit": "um"}])
def test_a_surface_takes_no_options_of_files(option: Keys) -> None:
    surface = ehlwave.surface.trace_surface(np.zeros(200), step_m=4e-6)
    with pytest.raises(ehlwave.SurfaceError, match=f"{next(iter(option))}= is for files"):
        ehlwave.Contact(**DATA).deform(surface, **option)


def two_bodies(**keys: object) -> object:
    steel = ehlwave.Body.ball(0.02, material="steel")
    return ehlwave.Contact.from_bodies(**{"body1": steel, "body2": steel} | BALLS | keys)


def heated(**keys: object) -> object:
    usual = dict(zip(HEAT, (313.15, 0.045, 0.13, 1950, 870), strict=True))
    return ehlwave.Heat(**usual | keys)


HEAT = ("temperature_k", "viscosity_temperature_per_k", "oil_conductivity_w_per_m_k")
HEAT += ("oil_heat_capacity_j_per_kg_k", "oil_density_kg_per_m3")
JUNK = (None, "abc", "", True, float("nan"), float("inf"), -1, 0, 3 + 1j, [1, 2], np.array([1, 2]))
JUNK += ({}, object(), b"x", (2.2, None), ("a", "b"), 699.9)
DOORS = [
    (case, ("load_n", "cells_x", "orientation")),
    (ehlwave.Study, ("grid",)),
    (response, ("wavelength_over_a", "angle_deg", "slip_parameter", "slide_to_roll_ratio")),
    (rough, ("step", "step_across", "cutoffs_m", "length_unit", "form", "surface")),
    (trace_of, ("height", "step_m", "axis")),
    (two_bodies, ("body1", "oil", "heat", *BALLS)),
    (body, ("radius_x_m", "elastic_modulus_pa", "poisson_ratio", "material")),
    (race, ("element_diameter_m", "pitch_diameter_m", "osculation", "contact_angle_deg")),
    (sheet, ("iso_vg", "temperature_k", "viscosity_index", "density_15c_kg_per_m3", "kind")),
    (sheet, ("alpha", "pressure_viscosity_per_pa", "roelands_index", "eyring_stress_pa")),
    (measured, ("name", "temperature_k", "eyring_stress_pa")),
    (heated, (*HEAT, "oil_expansion_per_k", "body", "body2")),
]


@pytest.mark.parametrize(("door", "names"), DOORS)
def test_what_is_no_value_at_all_is_an_error_of_ours(
    door: Callable[..., object], names: tuple[str, ...]
) -> None:
    """Whatever is given, an answer or an EhlwaveError comes back; numbers are no True or False."""
    for name in names:
        for junk in JUNK:
            with contextlib.suppress(ehlwave.EhlwaveError):
                door(**{name: junk})
                assert junk is not True or name == "heat", name


@pytest.mark.parametrize(
    ("height", "step"), [(np.zeros(9), 1e-6), ("x", 1e-6), (np.zeros((9, 1)), "1e-6"), (None, None)]
)
def test_a_surface_made_by_hand_is_checked(height: Any, step: Any) -> None:  # noqa: ANN401
    with pytest.raises(ehlwave.SurfaceError, match=r"heights must be|step along x is 1e-6"):
        ehlwave.Contact(**DATA).deform(ehlwave.surface.Surface(height, step, 0.0))


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
DEFORM = ["deform", "TRACE", "--conditions", *CONDITIONS]
RATIO = "--slide-to-roll-ratio"
UNDER_SLIP = [*DEFORM, "eyring_stress_pa=5e6", RATIO, "0.3", *UNITS]
TWICE = [*DEFORM, "slip_parameter=1", RATIO, "0", *UNITS]
TOO_LIGHT = ["deform", "TRACE", "--conditions", *LIGHT, *UNITS]
WORKS = [*DEFORM, *UNITS]
COMMANDS = [
    (["deforn"], "'deforn'", "did you mean deform", WORKS),
    (
        [*DEFORM, "--lenght-unit", "um", *UNITS[2:]],
        "--lenght-unit",
        "did you mean --length-unit",
        WORKS,
    ),
    (DEFORM, "unit", "set --height-unit (m, mm, um, nm)", WORKS),
    (
        TOO_LIGHT,
        "load_n = 0.5 gives M",
        "--by recommended",
        [*TOO_LIGHT, "--formula", "recommended"],
    ),
    ([*DEFORM, RATIO, "30", *UNITS], "slide_to_roll_ratio = 30", "did you mean 0.3?", UNDER_SLIP),
    (TWICE, "slip_parameter = 1", "remove slip_parameter", [*DEFORM, RATIO, "0", *UNITS]),
    ([*WORKS, "--step", "3"], "--step 3", "whose step is 2", [*WORKS, "--step", "2"]),
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
