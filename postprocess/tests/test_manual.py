"""Parts of the manual: its picture of the layers, its check of links, its first page."""

import re
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

import pytest

MANUAL = Path(__file__).parents[1] / "manual"
GRAPH = """digraph "ehlwave" {
  "node0" [ label = "ehlwave-case", shape = egg ];
  "node1" [ label = "ehlwave_run", shape = octagon ];
  "node2" [ label = "ehlwave_io", shape = octagon ];
  "node3" [ label = "hdf5::hdf5_fortran", shape = septagon ];
  "node4" [ label = "ehlwave_core", shape = octagon ];
  "node5" [ label = "test_grid", shape = egg ];
  "node6" [ label = "ehlwave_alone", shape = octagon ];
  "node7" [ label = "ehlwave_petsc", shape = tripleoctagon ];
  "node8" [ label = "PETSc::petsc", shape = pentagon ];
  "node0" -> "node1" [ style = dotted ] // ehlwave-case -> ehlwave_run
  "node1" -> "node2"  // ehlwave_run -> ehlwave_io
  "node1" -> "node4"  // ehlwave_run -> ehlwave_core
  "node2" -> "node3"  // ehlwave_io -> hdf5::hdf5_fortran
  "node2" -> "node4"  // ehlwave_io -> ehlwave_core
  "node1" -> "node7" [ style = dotted ] // ehlwave_run -> ehlwave_petsc
  "node7" -> "node8" [ style = dotted ] // ehlwave_petsc -> PETSc::petsc
  "node5" -> "node1"  // test_grid -> ehlwave_run
}
"""


def module(name: str) -> ModuleType:
    spec = spec_from_file_location(name, MANUAL / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    found = module_from_spec(spec)
    sys.modules[name] = found
    spec.loader.exec_module(found)
    return found


def test_the_picture_has_layers_and_programs_alone() -> None:
    layers = module("layers")
    uses, libraries = layers.read_graph(GRAPH)
    assert uses == {"ehlwave-case": ["run"], "core": [], "io": ["core"], "run": ["core", "io"]}
    assert libraries == {"io": "HDF5"}
    assert layers.ranks(uses) == {"core": 0, "io": 1, "run": 2, "ehlwave-case": 3}
    rows, chains = layers.arranged(uses, layers.ranks(uses))
    assert [len(row) for row in rows] == [1, 2, 1, 1]  # a link passes beside io
    assert all(len(chain) == 3 for chain in chains if chain[0] == "run" and chain[-1] == "core")
    drawn = layers.svg(uses, libraries)
    assert re.findall(r">([\w-]+)</text>", drawn) == ["ehlwave-case", "core", "io", "HDF5", "run"]
    (arrows,) = re.findall(r'<g [^>]*marker-end="url\(#tip\)">(.*?)</g>', drawn, re.DOTALL)
    assert arrows.count("<path") == 4


def test_a_picture_that_was_not_up_to_date_is_drawn_and_fails(tmp_path: Path) -> None:
    layers = module("layers")
    graph, picture = tmp_path / "g.dot", tmp_path / "layers.svg"
    graph.write_text(GRAPH)
    assert layers.main(graph, picture) == 1
    assert layers.main(graph, picture) == 0
    graph.write_text(GRAPH.replace("ehlwave_io", "ehlwave_files"))
    assert layers.main(graph, picture) == 1
    assert ">files<" in picture.read_text()


def test_links_that_lead_nowhere_are_found(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "b.html").write_text('<h1 id="here">x</h1><a href="../c.html#there">y</a>')
    page = tmp_path / "c.html"
    page.write_text('<p id="there"><a href="a/b.html#here">x</a> <a href="https://x.org/#z">y</a>')
    links = module("check_links")
    assert links.broken(tmp_path) == []
    page.write_text('<p id="other"><a href="a/d.html">x</a> <img src="no.png"> <a href="#z">y</a>')
    assert links.broken(tmp_path) == [
        "a/b.html: ../c.html#there: no such place",
        "c.html: a/d.html: no such file",
        "c.html: no.png: no such file",
        "c.html: #z: no such place",
    ]
    assert links.main(tmp_path) == 1


@pytest.mark.parametrize(
    "question", ["slide-to-roll", "`inaccurate`", "add an oil", "atlas cover", "resume a sweep"]
)
def test_the_first_page_answers(question: str) -> None:
    text = (MANUAL / "index.md").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if question in line and "](" in line]
    assert len(lines) == 1
