"""Modules and packages do not import each other in circles, and all names can be imported."""

import ast
import os
import subprocess
import sys
from collections.abc import Iterable, Mapping
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import ehlwave

ROOT = Path(__file__).parents[1]
TREES = {"ehlwave": ROOT / "src", "studies": ROOT}

Graph = Mapping[str, set[str]]


def modules(package: str, folder: Path) -> dict[str, Path]:
    """Return the files of a package by the names of their modules."""
    paths = sorted((folder / package).rglob("*.py"))
    parts = {path: path.relative_to(folder).with_suffix("").parts for path in paths}
    return {".".join(p[:-1] if p[-1] == "__init__" else p): path for path, p in parts.items()}


def imported(text: str, known: Iterable[str]) -> set[str]:
    """Return the known modules that a text imports, at its beginning, within functions or types."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            found.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports name the whole path of a module"
            names = {f"{node.module}.{alias.name}" for alias in node.names} & set(known)
            found |= names or {str(node.module)}
        elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module"):
            found.update(one.value for one in node.args if isinstance(one, ast.Constant))
    return found & set(known)


def graph(texts: Mapping[str, str]) -> Graph:
    """Return the imports of each module."""
    return {name: imported(text, texts) - {name} for name, text in texts.items()}


def of_packages(of_modules: Graph) -> Graph:
    """Return the imports of packages, and modules outside packages; commands are above packages."""
    found: dict[str, set[str]] = {}
    for name, others in of_modules.items():
        own = _package(name)
        found.setdefault(own, set()).update({_package(other) for other in others} - {own})
    return found


def _package(name: str) -> str:
    return name if name.endswith((".cli", ".__main__")) else ".".join(name.split(".")[:2])


def circle(of_modules: Graph) -> list[str]:
    """Return the modules of a circle, none where there is no circle."""
    try:
        TopologicalSorter(of_modules).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def test_a_circle_is_found_at_the_beginning_and_within_functions_and_types() -> None:
    texts = {
        "p.a": "from p import b",
        "p.b": "def f():\n    from p.c import g",
        "p.c": "import typing\nif typing.TYPE_CHECKING:\n    import p.a",
    }
    assert set(circle(graph(texts))) == {"p.a", "p.b", "p.c"}
    assert not circle(graph({**texts, "p.c": ""}))
    texts = {"p.q.a": "import p.r.a", "p.r.a": "", "p.r.b": "from p.q.b import x", "p.q.b": ""}
    assert not circle(graph(texts))
    assert set(circle(of_packages(graph(texts)))) == {"p.q", "p.r"}


@pytest.mark.parametrize("package", TREES)
def test_nothing_imports_in_circles(package: str) -> None:
    files = modules(package, TREES[package])
    found = graph({name: path.read_text(encoding="utf-8") for name, path in files.items()})
    assert len(found) > 30
    assert not circle(found)
    assert not circle(of_packages(found))


def test_names_of_the_package_can_be_imported() -> None:
    assert len(set(ehlwave.__all__)) == len(ehlwave.__all__)
    for name in ehlwave.__all__:
        assert getattr(ehlwave, name) is not None
    with pytest.raises(AttributeError, match="nothing_of_the_kind"):
        ehlwave.nothing_of_the_kind  # noqa: B018


def test_running_the_programs_needs_the_standard_library_alone() -> None:
    path = os.pathsep.join(map(str, TREES.values()))
    code = "import studies.programs as p; p.namelist({'a': {'b': 'c'}}); p.write_new_text"
    subprocess.run(
        [sys.executable, "-S", "-c", code], check=True, env={**os.environ, "PYTHONPATH": path}
    )
