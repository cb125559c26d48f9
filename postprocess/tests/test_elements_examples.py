"""Elements in TOML files: each example answers, by the command, with its reports."""

import json
import re
import shutil
from pathlib import Path

import pytest
import xarray as xr

import ehlwave
from ehlwave.cli import main
from ehlwave.cli.arguments.elements import EXAMPLES
from ehlwave.elements.columns import TEXTS
from ehlwave.elements.document import CALLS, KINDS, read_element
from ehlwave.elements.drawing import DRAWINGS, drawing_svg
from ehlwave.elements.formulas import FORMULAS
from ehlwave.elements.report import reasons, report_html

FOLDER = Path(__file__).parents[1] / "examples" / "elements"
FILES = sorted(FOLDER.glob("*.toml"))


def kind_of(path: Path) -> str:
    return next(kind for kind, names in KINDS.items() if read_element(path).name in names)


def test_each_element_has_an_example_and_a_drawing() -> None:
    assert {read_element(path).name for path in FILES} == set(CALLS) == set(DRAWINGS)


def test_a_kind_of_doubts_has_the_largest_numbers_of_all_places() -> None:
    texts = ["friction within 40 %", "friction within 54 %", "friction within 9 %\nwarm by 2 K"]
    table = xr.Dataset({"refusal": ("place", texts), "load_n": ("place", [1.0, 2.0, 3.0])})
    found = reasons(table)
    assert found == ["3 of 3 places: friction within 54 %", "1 of 3 places: warm by 2 K"]


@pytest.mark.parametrize("kind", sorted(KINDS))
def test_the_example_of_the_help_is_an_element(kind: str, tmp_path: Path) -> None:
    shutil.copy(FOLDER / "cam_lift.csv", tmp_path / "lift.csv")
    file = tmp_path / "element.toml"
    file.write_text(EXAMPLES[kind], encoding="utf-8")
    found = read_element(file)
    assert found.name in KINDS[kind]
    assert type(found.element()).__name__ == found.name
    assert found.places()


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_examples_answer(path: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / path.name
    text = path.read_text(encoding="utf-8")
    text = text.replace("[conditions]", '[conditions]\nby = "laws"')  # nothing is computed here
    for beside in FOLDER.glob("*.csv"):
        shutil.copy(beside, tmp_path)
    file.write_text(text, encoding="utf-8")
    assert main([kind_of(file), str(file), "--output", str(tmp_path / "report"), "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    written = {one.name for one in (tmp_path / "report").iterdir()}
    assert {"report.html", "report.json", "table.csv", "cases.csv", "sweep.nml"} <= written
    page = (tmp_path / "report" / "report.html").read_text(encoding="utf-8")
    assert "data:image/png;base64," in page
    assert "<svg" in page
    assert "http" not in page.split("<svg")[0]
    assert json.loads((tmp_path / "report" / "report.json").read_text(encoding="utf-8")) == said
    assert said["attributes"]["element"] == read_element(path).name
    known = [
        value is not None
        for name in ("central_film_m", "isothermal_central_film_m")
        for value in str(said["columns"].get(name, {}).get("values", [])).split(",")
        if value.strip("[] ") not in ("", "None")
    ]
    assert known


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("SpurGearPair", "SpurGears", "element = 'SpurGears': give one of SpurGearPair"),
        ("module_m", "modul_m", "unknown modul_m"),
        ("pinion_torque_n_m = 150", "", "pinion_torque_n_m is missing"),
        ("pinion_speed_rpm", "speed_rpm", "unknown speed_rpm"),
        ("[oil]", "[oil", "not a TOML file"),
        ("module_m = 0.003", "module_m = -3", "module_m = -3 must be above 0"),
        ("iso_vg = 220", "iso_vg = 219", "no grade"),
        ("heat = true", "warm = true", "unknown warm"),
    ],
)
def test_wrong_files_are_refused_by_name(
    old: str, new: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (FOLDER / "gear_module_3.toml").read_text(encoding="utf-8")
    assert old in text
    path = tmp_path / "gear.toml"
    path.write_text(text.replace(old, new), encoding="utf-8")
    assert main(["gear", str(path)]) == 2
    assert said in capsys.readouterr().err


def test_a_bearing_is_no_gear(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["gear", str(FOLDER / "bearing_6208.toml")]) == 2
    assert "give one of SpurGearPair, HelicalGearPair" in capsys.readouterr().err


def test_drawings_are_the_same_again() -> None:
    assert drawing_svg("CamFollower") == drawing_svg("CamFollower")
    with pytest.raises(ehlwave.EhlwaveError):
        drawing_svg("Screw")


@pytest.mark.parametrize("name", ["bearing_6208", "gear_module_3", "cam_flat", "mini_traction"])
def test_reports_name_every_number_and_its_formula(name: str) -> None:
    table = read_element(FOLDER / f"{name}.toml").table(by="laws", stress=False)
    html = report_html(table)
    headings = re.findall(r"<th><a href='#(\w+)'>([^<]+)</a></th>", html)
    lines = dict(re.findall(r"<tr id='(\w+)'><th>[^<]+</th><td class='text'>([^<]+)</td>", html))
    assert len(headings) > 15
    for key, label in headings:
        assert lines[key], key
        assert "_" not in label.replace("h_c", ""), label
    known = {*map(str, table.variables), *map(str, table.attrs)} - {*TEXTS, "worst", "element"}
    assert known <= FORMULAS.keys()
