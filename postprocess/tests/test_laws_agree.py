"""All entry points of the package give the same answer: the list of laws decides."""

import ast
from pathlib import Path

import pytest
from agreement import door_differences, response_differences
from drawn_contacts import Drawn, drawn

import ehlwave

SOURCES = Path(ehlwave.__file__).parent
LAWS = {
    "AtlasTransfer",
    "ComputedTransfer",
    "RecommendedTransfer",
    "ShearedRidges",
    "StandingRidges",
    "FormulaTransfer",
    "StarvedTransfer",
    "TableTransfer",
    "TwoWaveTransfer",
    "WarmTransfer",
    "chart_of",
    "computed_film",
    "film_of",
}
"""Constructors and functions that are answers of a law; only the room of the laws calls them."""


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("one", drawn(20, 1))
def test_a_deformed_cosine_is_the_response(one: Drawn) -> None:
    assert response_differences(one) == []


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("one", drawn(6, 2))
def test_all_doors_have_one_film_with_its_error_and_warnings(one: Drawn) -> None:
    assert door_differences(one) == []


def calls_of_laws(folder: Path) -> list[str]:
    """Return the calls of laws outside the room of the laws."""
    found = []
    for path in sorted(folder.rglob("*.py")):
        if path.relative_to(folder).parts[0] == "laws":
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call):
                name = ast.unparse(node.func).rpartition(".")[2]
                if name in LAWS:
                    found.append(f"{path.relative_to(folder)}:{node.lineno} {name}")
    return found


def test_one_place_chooses_a_law(tmp_path: Path) -> None:
    assert calls_of_laws(SOURCES) == []
    (tmp_path / "door.py").write_text("transfer = atlas.AtlasTransfer(conditions)\n")
    assert calls_of_laws(tmp_path) == ["door.py:1 AtlasTransfer"]
