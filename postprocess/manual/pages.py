"""Write the pages of the manual that are generated: commands, columns of results, Fortran modules.

    python postprocess/manual/pages.py FOLDER

Needs the built programs. Each page is generated from the program or the source.
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
from ehlwave.cli import command_names
from ehlwave.laws.atlas.kinds import KINDS
from ehlwave.laws.atlas.ranges import WAVE_RANGE
from ehlwave.programs.programs import find_program

ROOT = Path(__file__).parents[2]
EHLWAVE = (sys.executable, "-c", "from ehlwave.cli import main; main()")
STRESS = "stress_modulus_pa2"
FORMER = "# The former name of"
PROGRAMS = ("ehlwave-case", "ehlwave-sweep")
CASE = """&conditions load_parameter_m = 50, lubricant_parameter_l = 10, radius_ratio_d = 1 /
&waviness orientation = 'transverse', wavelength_over_a = 2, response = 'harmonic' /
&grid cells_x = 32, cells_y = 32 /
"""


def main(folder: Path) -> None:
    """Write all pages into `folder`."""
    pages = {
        "commands.md": commands(),
        "columns.md": columns(),
        "modules.md": modules(),
        "atlas.inc": atlas(),
        **python(),
    }
    for name, text in pages.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        # Sphinx reads newer files again.
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
    for path in folder.rglob("*.md"):
        if path.relative_to(folder).as_posix() not in pages:
            path.unlink()


def commands() -> str:
    """Return the help of every program, command and script."""
    parts = ["# Commands\n\nThe text that each command prints for `--help`.\n"]
    parts.append("## Programs\n")
    parts += [_section(name, _output(find_program(name), "--help")) for name in PROGRAMS]
    parts.append("## The command `ehlwave`\n")
    whole = _output(*EHLWAVE, "--help")
    parts.append(_section("ehlwave", whole))
    for name in command_names():
        parts.append(_section(f"ehlwave {name}", _output(*EHLWAVE, name, "--help")))
    parts.append("## Scripts\n")
    for path in sorted((ROOT / "scripts").iterdir()):
        if path.is_file() and os.access(path, os.X_OK) and FORMER not in path.read_text():
            parts.append(_section(f"scripts/{path.name}", _output(str(path), "--help")))
    parts.append("## Studies\n")
    study = str(ROOT / "scripts" / "study")
    names = re.findall(
        r"^  ([\w-]+)  ", _output(study, "--help").split("studies:")[1], re.MULTILINE
    )
    parts += [_section(f"scripts/study {name}", _output(study, name, "--help")) for name in names]
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
        "Every result has these names in JSON, in HDF5 and as columns of sweeps. A quantity that a"
        " case does not have is NaN, or is left out.\n\n"
        "| name | unit | meaning |\n| --- | --- | --- |\n"
    )
    return head + "\n".join(rows) + "\n"


def modules() -> str:
    """Return the index of Fortran modules: the first sentence of each file."""
    parts = [
        "# Fortran modules\n\nFolder by folder, what each module does."
        " [The layers](/src/README.md).\n"
    ]
    for folder in sorted({path.parent for path in (ROOT / "src").rglob("*.[fF]90")}):
        parts.append(f"## `{folder.relative_to(ROOT)}`\n\n| module | what it does |\n| --- | --- |")
        for path in sorted(folder.glob("*.[fF]90")):
            parts.append(f"| `{path.stem}` | {_summary(path)} |")
        parts.append("")
    return "\n".join(parts)


def atlas() -> str:
    """Return the table of the ranges of the atlases, for a page to include."""
    names = {
        "rolling": "rolling",
        "rolling_wide": "rolling, wide",
        "sliding": "sliding",
        "sliding_wide": "sliding, wide",
        "line": "line contacts, rolling",
        "line_sliding": "line contacts, sliding",
        "line_newtonian": "line contacts, sliding, Newtonian",
    }
    columns = [KINDS[kind].ranges for kind in names]
    keys = list(dict.fromkeys(key for ranges in columns for key in ranges))
    rows = [
        f"| {' | '.join(['key', *names.values()])} |",
        f"| {' | '.join(['---'] * (1 + len(names)))} |",
    ]
    for key in keys:
        name = "`eyring_stress_pa` x `reduced_modulus_pa`" if key == STRESS else f"`{key}`"
        cells = [_range(ranges.get(key)) for ranges in columns]
        rows.append(f"| {' | '.join([name, *cells])} |")
    cells = [_range(WAVE_RANGE)] * len(names)
    return "\n".join([*rows, f"| {' | '.join(['`wavelength_over_a`', *cells])} |", ""])


def _range(ends: tuple[float, float] | None) -> str:
    if ends is None:
        return ""
    return f"{ends[0]:g} to {ends[1]:g}".replace("e-0", "e-").replace("e+", "e")


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
        own = [] if is_error or not is_class else _members(item)
        members = f"   :members: {', '.join(own)}\n" if own else ""
        pages[f"python/{name}.md"] = (
            f"---\norphan: true\n---\n\n# `ehlwave.{name}`\n\n"
            f"```{{eval-rst}}\n.. {directive}:: ehlwave.{name}\n{members}```\n"
        )
    parts = [
        "# Python: classes and functions\n\n`import ehlwave` gives these names. Modules are"
        " imported on first use. What they are for: [the Python package](/postprocess/README.md).\n"
    ]
    for group, rows in groups.items():
        table = "\n".join(["| name | what it is |", "| --- | --- |", *rows])
        parts.append(f"## {group}\n\n{table}\n")
    return {"python.md": "\n".join(parts), **pages}


def _members(item: type) -> list[str]:
    """Return the methods and properties of a class that are for users, inherited members first."""
    kinds = (property, classmethod, staticmethod)
    bases = [base for base in reversed(item.__mro__) if base.__module__.startswith("ehlwave.")]
    return [
        name
        for base in bases
        for name, value in vars(base).items()
        if not name.startswith("_") and (inspect.isfunction(value) or isinstance(value, kinds))
    ]


def _summary(path: Path) -> str:
    lines = path.read_text(encoding="utf-8").splitlines()
    words = []
    for line in lines:
        if line.startswith("#") and not words:
            continue
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
