"""All entry points of the package give the same answer: the list of laws decides."""

import ast
from pathlib import Path

import pytest
from agreement import door_differences, response_differences

import ehlwave
from studies.judged.drawn_contacts import Drawn, drawn

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


def uses_of_laws(folder: Path) -> list[str]:
    """Return the imports, calls and other uses of laws outside the room of the laws."""
    found = []
    for path in sorted(folder.rglob("*.py")):
        place = str(path.relative_to(folder))
        if place.startswith("laws") or place in MAY_NAME:
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = {"Name": "id", "Attribute": "attr", "alias": "name", "Constant": "value"}
            name = getattr(node, names.get(type(node).__name__, ""), None)
            if isinstance(name, str) and name in LAWS:
                found.append(f"{place}:{node.lineno} {name}")
    return found


MAY_NAME = ("surface/__init__.py", "surface/film_profile.py")
"""Public names of transfers; the type of an argument."""
USES = (
    "transfer = atlas.AtlasTransfer(conditions)",
    "from ehlwave.laws.computed_film import computed_film",
    "laws = {'paper': FormulaTransfer}",
    "getattr(room, 'TwoWaveTransfer')",
)


def test_one_place_chooses_a_law(tmp_path: Path) -> None:
    assert uses_of_laws(SOURCES) == []
    for number, line in enumerate(USES):
        (tmp_path / f"door{number}.py").write_text(f"{line}\n")
    assert len(uses_of_laws(tmp_path)) == len(USES)
