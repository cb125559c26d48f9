"""Keys of input files: used by predictions, refused, reported as unused, or without effect."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import ehlwave
from ehlwave.cases.keys import key_table
from ehlwave.cli import main
from ehlwave.contact.conditions_from_keys import KNOWN_KEYS
from ehlwave.contact.conditions_read import Given, read_conditions, read_given
from ehlwave.contact.file_keys import (
    LEFT_OUT,
    LIMIT_WIDTH,
    NOT_USED,
    OTHER_INLET_KEYS,
    USED,
    is_classified,
)
from ehlwave.errors import ProgramError, RangeError, SurfaceError
from ehlwave.operating_point import contact_of
from ehlwave.programs.programs import namelist

Capture = pytest.CaptureFixture[str]
READING = ["--length-unit", "mm", "--height-unit", "um"]

CONDITIONS = {
    "radius_x_m": 0.0125,
    "radius_y_m": 0.0125,
    "reduced_modulus_pa": 2.26e11,
    "load_n": 150.0,
    "mean_speed_m_per_s": 9.0,
    "viscosity_pa_s": 0.05,
    "slip_parameter": 1.11,
}
LUBRICANT = {
    "pressure_viscosity_per_pa": 2e-8,
    "roelands_index": 0.6,
    "flow_law": "eyring",
    "eyring_stress_pa": 5e6,
    "temperature_k": 333.15,
}
HEAT = {
    "oil_conductivity_w_per_m_k": 0.13,
    "oil_heat_capacity_j_per_kg_k": 2000.0,
    "oil_density_kg_per_m3": 850.0,
    "viscosity_temperature_per_k": 0.04,
    "oil_expansion_per_k": 7e-4,
    "body_conductivity_w_per_m_k": 21.0,
}
BASE = {"conditions": CONDITIONS, "lubricant": LUBRICANT}
WARM = BASE | {"heat": HEAT}


def file_of(folder: Path, groups: dict[str, dict[str, Any]], **more: dict[str, Any]) -> str:
    """Return the name of an input file; `more` are keys of groups besides."""
    names = dict.fromkeys((*groups, *more))
    whole = {name: groups.get(name, {}) | more.get(name, {}) for name in names}
    path = folder / "contact.nml"
    path.write_text(namelist(whole))
    return str(path)


def trace(folder: Path) -> str:
    x = np.arange(0, 2, 0.002)
    np.savetxt(folder / "t.csv", np.column_stack([x, 0.05 * np.cos(20 * np.pi * x)]), delimiter=",")
    return str(folder / "t.csv")


def program_keys() -> list[dict[str, Any]]:
    try:
        return [dict(row) for row in key_table().to_dict("records")]
    except ProgramError:
        pytest.skip("no program")


def test_every_key_of_the_program_is_in_one_class() -> None:
    assert [row["name"] for row in program_keys() if not is_classified(row["name"])] == []
    for key in LEFT_OUT:
        assert key not in (*USED, *NOT_USED, *OTHER_INLET_KEYS)
    assert not set(NOT_USED) & {*USED, *OTHER_INLET_KEYS}


def other_value(row: dict[str, Any], given: dict[str, Any]) -> Any:  # noqa: ANN401
    """Return a value of a key other than the default and the given value."""
    if row["choices"]:
        return next(c for c in row["choices"] if c not in (row["default"], given.get(row["name"])))
    if row["name"] in given:
        return given[row["name"]] * 1.1
    if row["kind"] == "truth":
        return not row["default"]
    if row["kind"] == "word":
        return "other.csv"
    low = row["above"] if row["above"] == row["above"] else row["minimum"]
    high = row["maximum"] if row["maximum"] == row["maximum"] else None
    start = row["default"] if isinstance(row["default"], (int, float)) else None
    if start and start == start and (high is None or start * 1.5 <= high):
        return int(start) + 2 if row["kind"] == "whole" else start * 1.5
    middle = 0.5 * ((low or 0) + (1.0 if high is None else high))
    return round(middle + 0.5) if row["kind"] == "whole" else middle


def test_every_key_that_may_change_an_answer_changes_it_or_is_named(tmp_path: Path) -> None:
    """Each key of the program in turn; ignored keys change nothing."""
    base = read_given([file_of(tmp_path, WARM)])
    given = CONDITIONS | LUBRICANT | HEAT
    silent, loud = [], []
    for row in program_keys():
        name, group = row["name"], row["group"]
        if name in (LIMIT_WIDTH, "viscosity_table"):  # keys of the limit, of a law
            continue
        file = file_of(tmp_path, WARM, **{group: {name: other_value(row, given)}})
        try:
            found: Given | None = read_given([file])
        except (SurfaceError, RangeError):
            found = None
        (silent if found == base else loud).append(name)
    assert set(silent) == LEFT_OUT & {row["name"] for row in program_keys()}
    assert len(loud) > 50


def test_heat_of_a_file_is_that_of_the_one_call(tmp_path: Path, capsys: Capture) -> None:
    file, words = file_of(tmp_path, WARM), [trace(tmp_path), *READING]
    given = {k: v for k, v in (CONDITIONS | LUBRICANT).items() if k in KNOWN_KEYS}
    bodies = {"body": ehlwave.BodyHeat(21.0)}
    heat = {k: v for k, v in HEAT.items() if not k.startswith("body")} | bodies
    heat = ehlwave.Heat(temperature_k=333.15, **heat)
    film = ehlwave.Contact(**given, heat=heat).film()
    assert contact_of(read_given([file])).film() == film
    assert main(["lambda", *words, "--conditions", file, "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert said["conditions"]["central_film_m"] == film.central_m
    assert said["statistics"]["lambda_errors"]["film"] == film.central_error
    thin = [file, "viscosity_temperature_per_k=0.08"]
    assert main(["lambda", *words, "--json", "--conditions", *thin]) == 0
    assert json.loads(capsys.readouterr().out)["conditions"]["central_film_m"] < film.central_m
    slow = [file, "mean_speed_m_per_s=9", "body_conductivity_w_per_m_k=0.2"]
    assert main(["lambda", *words, "--conditions", *slow]) == 2
    assert "the range of the laws of heat" in capsys.readouterr().err
    with pytest.raises(SurfaceError, match="gives &heat, which is not taken here"):
        read_conditions([file])


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ({"heat": {}}, "&heat needs oil_conductivity_w_per_m_k"),
        ({"heat": {"levels": 16}}, "&heat needs oil_conductivity_w_per_m_k"),
        (
            {"heat": {"oil_conductivity_w_per_m_k": 0.13}},
            "&heat needs viscosity_temperature_per_k",
        ),
        ({"heat": HEAT, "lubricant": {"density_law": "tait"}}, "laws of heat do not know both"),
        ({"lubricant": {"shear_limit_over_pressure": 0.02}}, "shear_limit_over_pressure = 0.02: "),
        ({"lubricant": {"density_law": "incompressible"}}, "density_law = 'incompressible': the"),
        ({"lubricant": {"viscosity_law": "barus"}}, "viscosity_law = 'barus': the atlas"),
        ({"touching": {"film_m": 2e-8}}, "&touching: no law has this effect: remove the group"),
        ({"lubricant": {"eyring_stres_pa": 1e6}}, r"unknown key eyring_stres_pa \(did you mean"),
        ({"lubrication": {"roelands_index": 0.5}}, r"&lubrication is no group .*did you mean"),
    ],
)
def test_what_no_law_knows_is_refused_by_name(
    tmp_path: Path, more: dict[str, dict[str, Any]], said: str
) -> None:
    with pytest.raises((SurfaceError, RangeError), match=said):
        contact_of(read_given([file_of(tmp_path, BASE, **more)])).transfer()


def test_a_law_without_alpha_asks_for_it(tmp_path: Path) -> None:
    law = {"viscosity_law": "mcewen", "mcewen_coefficient_per_pa": 2e-8, "mcewen_exponent": 16.0}
    oil = {key: value for key, value in LUBRICANT.items() if "pressure" not in key} | law
    file = file_of(tmp_path, {"conditions": CONDITIONS, "lubricant": oil})
    with pytest.raises(SurfaceError, match="has no pressure_viscosity_per_pa: give it besides"):
        read_given([file])
    given = read_given([file, "pressure_viscosity_per_pa=2e-8"])
    assert dict(given.conditions.oil.other_keys)["mcewen_exponent"] == 16
    assert given.conditions.central_film_error is None


def test_a_limit_counts_where_surfaces_slide(tmp_path: Path) -> None:
    file = file_of(tmp_path, BASE, lubricant={"shear_limit_over_pressure": 0.02})
    rolls = read_given([file, "slip_parameter=1"])
    assert rolls.conditions.oil.other_laws == ()
    assert read_given([file, "shear_limit_over_pressure=0"]).conditions.oil.other_laws == ()


def test_films_of_other_oils_have_no_error_and_a_warning(tmp_path: Path, capsys: Capture) -> None:
    file = file_of(tmp_path, BASE, lubricant={"viscosity_law": "barus"})
    words = [trace(tmp_path), *READING, "--formula", "two-waves", "--conditions", file]
    assert main(["lambda", *words]) == 0
    said = capsys.readouterr().out
    assert "error not known. Mean film" in said
    assert "Warning      viscosity_law = 'barus': the film comes from a formula for Roe" in said
    assert main(["lambda", *words, "central_film_m=1e-6"]) == 0
    assert "the film comes from a formula" not in capsys.readouterr().out


@pytest.mark.parametrize("command", [["lambda"], ["stress", "--depths", "0", "20", "60"]])
def test_keys_that_are_not_used_are_named(
    tmp_path: Path, command: list[str], capsys: Capture
) -> None:
    file = file_of(tmp_path, BASE, dynamics={"load_factor": 2.0}, grid={"edges": "truncated"})
    name, *more = command
    assert main([name, trace(tmp_path), *more, *READING, "--conditions", file, "--json"]) == 0
    warnings = json.loads(capsys.readouterr().out)["warnings"]
    for key in ("load_factor = 2.0 is not used: ", "edges = truncated is not used: "):
        assert sum(text.startswith(key) for text in warnings) == 1
    with pytest.warns(UserWarning, match="is not used"):
        read_conditions([file])
