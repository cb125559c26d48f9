"""Errors of laws stand in one table, and its rows follow from records."""

import ast
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from ehlwave.error_bars import TABLE, bar, bars
from studies.error_bars import LAWS, Found, rounded_up

PACKAGE = Path(__file__).parents[1] / "src" / "ehlwave"
OF_ERRORS = re.compile(r"(^|_)(ERROR|BAR|FACTOR|DEVIATION)S?(_|$)")
LIMITS = re.compile(r"^_*(LARGE|LARGEST|LEAST|MOST|STRIBECK)_")
"""Limits from which a result is refined, refused or named, and speeds of a curve: no errors."""
GENERATED = ("inlet_coefficients.py",)


def numbers_of_errors(source: str) -> list[str]:
    """Return the constants of a module that are errors with numbers of their own."""
    found = []
    for node in ast.parse(source).body:
        if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None:
            continue
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        pairs = [pair for target in targets for pair in _pairs(target, node.value)]
        for name, value in pairs:
            if not OF_ERRORS.search(name) or LIMITS.search(name):
                continue
            calls = {id(part) for call in _calls(value) for part in ast.walk(call)}
            if any(_is_number(part) and id(part) not in calls for part in ast.walk(value)):
                found.append(name)
    return found


def _pairs(target: ast.expr, value: ast.expr) -> list[tuple[str, ast.expr]]:
    if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
        both = zip(target.elts, value.elts, strict=True)
        return [pair for one, its in both for pair in _pairs(one, its)]
    return [(name.id, value) for name in ast.walk(target) if isinstance(name, ast.Name)]


def _calls(value: ast.expr) -> list[ast.Call]:
    return [
        part
        for part in ast.walk(value)
        if isinstance(part, ast.Call) and getattr(part.func, "id", "") == "bar"
    ]


def _is_number(part: ast.AST) -> bool:
    return isinstance(part, ast.Constant) and type(part.value) in (int, float)


def test_no_module_has_an_error_of_its_own() -> None:
    found = {
        str(path.relative_to(PACKAGE)): names
        for path in PACKAGE.rglob("*.py")
        if path.name not in GENERATED
        and (names := numbers_of_errors(path.read_text(encoding="utf-8")))
    }
    assert found == {}


@pytest.mark.parametrize(
    ("source", "names"),
    [
        ("FILM_ERROR = 0.1", ["FILM_ERROR"]),
        ("A, TIME_FACTOR = 3, 2.0", ["TIME_FACTOR"]),
        ("ERRORS: dict = {'a': (0.01, 0.2)}", ["ERRORS"]),
        ("WAVE_BAR = bar('a') + 0.03", ["WAVE_BAR"]),
        ("WAVE_BAR = bar('a')", []),
        ("LARGE_ERROR = 0.3", []),
        ("FACTORY = 3", []),
    ],
)
def test_numbers_of_errors_are_found(source: str, names: list[str]) -> None:
    assert numbers_of_errors(source) == names


def test_rows_are_complete_and_used() -> None:
    every = "".join(path.read_text(encoding="utf-8") for path in PACKAGE.rglob("*.py"))
    for name, row in bars().items():
        assert bar(name) > 0
        assert row["basis"] in ("record", "kept", "standard"), name
        assert row["study"], name
        assert row["meaning"], name
        group = name.split(".")[0]
        assert f'"{name}"' in every or f'f"{group}.{{' in every, name
    lines = (PACKAGE / TABLE).read_text(encoding="utf-8").splitlines()
    assert len(bars()) == len(lines) - 1  # no name twice


@pytest.mark.filterwarnings("ignore::ehlwave.ExtrapolationWarning")
@pytest.mark.parametrize("law", LAWS)
def test_rows_of_records_are_those_of_the_records(law: Callable[[], Found]) -> None:
    for name, (value, _) in law().items():
        assert bars()[name]["basis"] == "record"
        assert bar(name) == rounded_up(value), name


def test_every_row_of_records_has_a_law() -> None:
    quick = {name for law in LAWS[1:] for name in law()}
    records = {name for name, row in bars().items() if row["basis"] == "record"}
    assert records - quick == {"film.formula", "film.formula_line", "film.thinned"}
