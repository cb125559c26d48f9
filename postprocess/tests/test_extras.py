"""The core works without the packages of extras, and names the extra that is missing; its pages."""

import importlib.util
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


def command_without(*words: str) -> subprocess.CompletedProcess[str]:
    return without("from ehlwave.cli import main; sys.exit(main())", *words)


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


@pytest.mark.parametrize("name", ["ehlwave.collapse_figure", "ehlwave.surface.deformed_figure"])
def test_python_names_the_extra(name: str) -> None:
    done = without(name)
    assert done.stderr.endswith("matplotlib is missing: pip install './postprocess[figures]'\n")


def test_a_fit_names_the_extra() -> None:
    done = without("ehlwave.fit_formula([0.5, 1, 2, 5, 10], [0.9, 0.8, 0.63, 0.33, 0.16])")
    assert done.stderr.endswith("lmfit is missing: pip install './postprocess[figures]'\n")


def test_commands_without_figures_run_and_others_name_the_extra(tmp_path: Path) -> None:
    results = write_results(tmp_path / "results.h5", make_columns())
    done = command_without("table", str(results))
    assert (done.returncode, done.stderr) == (0, "")
    trace = tmp_path / "trace.csv"
    rows = "\n".join(f"{0.5e-3 * i:.4f},{0.003 * (-1) ** (i // 50)}" for i in range(800))
    trace.write_text(f"x [mm],z [um]\n{rows}\n")
    words = ("deform", str(trace), "--conditions", *CONTACT)
    done = command_without(*words)
    assert (done.returncode, done.stderr) == (0, "")
    assert "lambda ratio" in done.stdout
    done = command_without(*words, "--output", str(tmp_path / "out"))
    said = "ehlwave: error: matplotlib is missing: pip install './postprocess[figures]'\n"
    assert (done.returncode, done.stderr) == (2, said)
    done = command_without("collapse", str(results), "--output", str(tmp_path / "drawn"))
    assert (done.returncode, done.stderr) == (2, said)
    assert not (tmp_path / "drawn").exists()
    (tmp_path / "map.sur").write_text("no surface")
    done = command_without("deform", str(tmp_path / "map.sur"), "--conditions", *CONTACT)
    assert done.returncode == 2
    assert "pip install './postprocess[instruments]'" in done.stderr


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
