"""Write the pages of the manual that are generated: commands, columns of results, Fortran modules.

    python postprocess/manual/pages.py FOLDER

Needs the built programs. Each page is made from what the program or the source says itself.
"""

import inspect
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py

import ehlwave
from ehlwave.programs import find_program

ROOT = Path(__file__).parents[2]
EHLWAVE = (sys.executable, "-c", "from ehlwave.cli import main; main()")
PROGRAMS = ("ehlwave-case", "ehlwave-sweep")
CASE = """&conditions load_parameter_m = 50, lubricant_parameter_l = 10, radius_ratio_d = 1 /
&waviness orientation = 'transverse', wavelength_over_a = 2, response = 'harmonic' /
&grid cells_x = 32, cells_y = 32 /
"""


def main(folder: Path) -> None:
    """Write all pages into `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    pages = {"commands": commands(), "columns": columns(), "modules": modules(), **python()}
    for name, text in pages.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / f"{name}.md").write_text(text, encoding="utf-8")


def commands() -> str:
    """Return the help of every program, command and script."""
    parts = ["# Commands\n\nThe text that each command prints for `--help`.\n"]
    parts.append("## Programs\n")
    parts += [_section(name, _output(find_program(name), "--help")) for name in PROGRAMS]
    parts.append("## The command `ehlwave`\n")
    whole = _output(*EHLWAVE, "--help")
    parts.append(_section("ehlwave", whole))
    names = re.search(r"\{([\w,-]+)\}", whole)
    for name in names[1].split(",") if names else ():
        parts.append(_section(f"ehlwave {name}", _output(*EHLWAVE, name, "--help")))
    parts.append("## Scripts\n")
    for path in sorted((ROOT / "scripts").iterdir()):
        if path.is_file() and os.access(path, os.X_OK):
            parts.append(_section(f"scripts/{path.name}", _output(str(path), "--help")))
    return "\n".join(parts)


def columns() -> str:
    """Return the table of results: name, unit and meaning, as a result file has them."""
    with tempfile.TemporaryDirectory() as place:
        case, output = Path(place, "case.nml"), Path(place, "case.h5")
        case.write_text(CASE, encoding="utf-8")
        _output(find_program("ehlwave-case"), str(case), "--quiet", "--output", str(output))
        rows = []
        with h5py.File(output) as file:
            for name, item in sorted(file.items()):
                unit, meaning = (_text(item.attrs.get(key, "")) for key in ("units", "long_name"))
                rows.append(f"| `{name}` | {unit} | {meaning} |")
    head = (
        "# Columns and quantities of results\n\n"
        "Every result has these names in JSON, in HDF5 and as columns of sweeps. A quantity that a case does not have is NaN,"
        " or is left out.\n\n| name | unit | meaning |\n| --- | --- | --- |\n"
    )
    return head + "\n".join(rows) + "\n"


def modules() -> str:
    """Return the index of Fortran modules: the first sentence of each file."""
    parts = ["# Fortran modules\n\nFolder by folder, what each module does. [The layers](/src/README.md).\n"]
    for folder in sorted({path.parent for path in (ROOT / "src").rglob("*.[fF]90")}):
        parts.append(f"## `{folder.relative_to(ROOT)}`\n\n| module | what it does |\n| --- | --- |")
        for path in sorted(folder.glob("*.[fF]90")):
            parts.append(f"| `{path.stem}` | {_summary(path)} |")
        parts.append("")
    return "\n".join(parts)


def python() -> dict[str, str]:
    """Return the index of the Python package and a page for each of its names."""
    groups: dict[str, list[str]] = {"Classes": [], "Functions": [], "Errors and warnings": []}
    pages = {}
    for name in ehlwave.__all__:
        item = getattr(ehlwave, name)
        is_class = inspect.isclass(item)
        is_error = is_class and issubclass(item, (Exception, Warning))
        group = "Errors and warnings" if is_error else "Classes" if is_class else "Functions"
        first = inspect.getdoc(item).splitlines()[0]
        groups[group].append(f"| [`{name}`](python/{name}.md) | {first} |")
        directive = "autoclass" if is_class else "autofunction"
        members = "   :members:\n" if is_class and not is_error else ""
        home = f"{item.__module__}.{item.__qualname__}"
        pages[f"python/{name}"] = (
            f"---\norphan: true\n---\n\n# `ehlwave.{name}`\n\n"
            f"```{{eval-rst}}\n.. {directive}:: {home}\n{members}```\n"
        )
    parts = ["# The Python package\n\n`import ehlwave` gives these names. Modules are imported on first use.\n"]
    for group, rows in groups.items():
        parts.append(f"## {group}\n\n| name | what it is |\n| --- | --- |\n" + "\n".join(rows) + "\n")
    return {"python": "\n".join(parts), **pages}


def _summary(path: Path) -> str:
    lines = path.read_text(encoding="utf-8").splitlines()
    words = []
    for line in lines:
        if not line.startswith("!>") or not line[2:].strip():
            break
        words.append(line[2:].strip())
    return " ".join(words).replace("|", r"\|") or path.stem


def _section(name: str, text: str) -> str:
    return f"### `{name}`\n\n```text\n{text.rstrip()}\n```\n"


def _output(*command: str) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=600)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def _text(value: object) -> str:
    text = value.decode() if isinstance(value, bytes) else str(value)
    return text.replace("|", r"\|")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
