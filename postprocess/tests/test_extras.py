"""The core works without the packages of extras, and names the extra that is missing; its pages."""

import importlib.util
import json
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest
from contact import BALL
from synthetic import make_columns, write_results

import ehlwave
from ehlwave.cli import command_parser
from ehlwave.extras import CORE, EXTRAS

SOURCE = Path(ehlwave.__file__).parents[1]
PROJECT = Path(__file__).parents[1] / "pyproject.toml"
WITHOUT = f"""
import sys

class Without:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in {sorted(EXTRAS)}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Without())
import ehlwave
"""
CONTACT = [f"{key}={value}" for key, value in BALL.items()]


def without(text: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run Python as if no extra were installed."""
    command = [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(SOURCE)!r})"]
    command[-1] += f"\n{WITHOUT}\n{text}"
    return subprocess.run([*command, *arguments], capture_output=True, text=True, check=False)


def commands_without(*calls: tuple[str, ...]) -> list[tuple[int, str, str]]:
    """Return status, output and errors of commands, all in one process."""
    text = """
import contextlib, io, json
from ehlwave.cli import main
found = []
for words in json.loads(sys.argv[1]):
    with contextlib.redirect_stdout(io.StringIO()) as out:
        with contextlib.redirect_stderr(io.StringIO()) as err:
            status = main(words)
    found.append([status, out.getvalue(), err.getvalue()])
print(json.dumps(found))
"""
    done = without(text, json.dumps(calls))
    assert (done.returncode, done.stderr) == (0, "")
    return [(status, out, err) for status, out, err in json.loads(done.stdout)]


def pages() -> ModuleType:
    path = PROJECT.parent / "manual" / "command_pages.py"
    found = importlib.util.spec_from_file_location("command_pages", path)
    assert found is not None
    assert found.loader is not None
    module = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    return module


def test_every_package_is_in_its_extra() -> None:
    text = PROJECT.read_text(encoding="utf-8")
    core = re.search(r"^dependencies = \[(.*?)\]", text, re.DOTALL | re.MULTILINE)
    assert core is not None
    for package, extra in EXTRAS.items():
        listed = re.search(rf"^{extra} = \[(.*)\]", text, re.MULTILINE)
        assert listed is not None, extra
        assert f'"{package}>=' in listed[1]
        assert f'"{package}>=' not in core[1]
    assert set(re.findall(r'"([a-z0-9]+)>=', core[1])) == set(CORE)


def test_the_source_alone_names_what_to_install(tmp_path: Path) -> None:
    text = "import sys; sys.path.insert(0, sys.argv[1]); from ehlwave.cli import main; "
    text += "sys.exit(main(sys.argv[2:]))"
    command = [sys.executable, "-I", "-S", "-c", text, str(SOURCE), "table", "results.h5"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 2
    assert re.fullmatch(
        r"ehlwave: error: \w+ is missing: .*pip install ./postprocess\n", done.stderr
    )


def test_the_core_answers_without_extras() -> None:
    keys = ", ".join(CONTACT)
    done = without(f"print(ehlwave.Contact({keys}).film().central_m)\nimport ehlwave.stress")
    assert done.returncode == 0, done.stderr
    assert "missing" not in done.stderr  # a warning of the warm inlet is there
    assert float(done.stdout) == pytest.approx(8.35e-7, rel=1e-2)


def test_python_names_the_extra() -> None:
    asked = {
        "ehlwave.collapse_figure": "matplotlib",
        "ehlwave.surface.deformed_figure": "matplotlib",
        "ehlwave.fit_formula([0.5, 1, 2, 5, 10], [0.9, 0.8, 0.63, 0.33, 0.16])": "lmfit",
    }
    tried = "\n".join(
        f"try: {code}\nexcept ModuleNotFoundError as error: print(error)" for code in asked
    )
    said = without(tried).stdout.splitlines()
    assert said == [
        f"{package} is missing: pip install './postprocess[figures]'" for package in asked.values()
    ]


def test_commands_without_figures_run_and_others_name_the_extra(tmp_path: Path) -> None:
    results = write_results(tmp_path / "results.h5", make_columns())
    trace = tmp_path / "trace.csv"
    rows = "\n".join(f"{0.5e-3 * i:.4f},{0.003 * (-1) ** (i // 50)}" for i in range(800))
    trace.write_text(f"x [mm],z [um]\n{rows}\n")
    words = ("deform", str(trace), "--conditions", *CONTACT)
    (tmp_path / "map.sur").write_text("no surface")
    table, deform, drawn, collapse, measured = commands_without(
        ("table", str(results)),
        words,
        (*words, "--output", str(tmp_path / "out")),
        ("collapse", str(results), "--output", str(tmp_path / "drawn")),
        ("deform", str(tmp_path / "map.sur"), "--conditions", *CONTACT),
    )
    assert (table[0], table[2], deform[0], deform[2]) == (0, "", 0, "")
    assert "lambda ratio" in deform[1]
    said = "ehlwave: error: matplotlib is missing: pip install './postprocess[figures]'\n"
    assert (drawn[0], drawn[2]) == (collapse[0], collapse[2]) == (2, said)
    assert not (tmp_path / "drawn").exists()
    assert measured[0] == 2
    assert "pip install './postprocess[instruments]'" in measured[2]


def test_the_parser_needs_the_standard_library_alone() -> None:
    """Wheels and installations make their manual page with it, before any package is there."""
    text = "import sys; sys.path.insert(0, sys.argv[1]); import ehlwave.cli as cli; "
    text += "cli.command_parser(); sys.exit('numpy' in sys.modules)"
    command = [sys.executable, "-I", "-S", "-c", text, str(SOURCE)]
    assert subprocess.run(command, check=False).returncode == 0


def test_a_missing_package_of_no_extra_is_no_advice() -> None:
    done = without("from ehlwave.extras import load; load('ehlwave.absent')")
    assert "No module named 'ehlwave.absent'" in done.stderr


def test_the_manual_page_has_every_command_and_option() -> None:
    parser = command_parser()
    page = pages().man_page(parser, "1.2.3").replace("\\-", "-")
    completion = pages().completion_of(parser)
    assert "ehlwave 1.2.3" in page
    commands = pages().commands(parser)
    assert len(commands) > 8
    for name, command in commands.items():
        assert f".SH EHLWAVE {name.upper()}\n" in page
        section = page.split(f".SH EHLWAVE {name.upper()}\n")[1].split("\n.SH ")[0]
        words = re.findall(rf"^      {name}\) .*-W '([^']*)'", completion, re.MULTILINE)[0].split()
        for action in command._actions:
            for option in (word for word in action.option_strings if word.startswith("--")):
                assert re.search(rf"^\.B .*{option}\b", section, re.MULTILINE), (name, option)
                assert option in words
