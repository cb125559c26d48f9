"""The package and its help import nothing heavy: imports are counted, not their time."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import ehlwave
from ehlwave.cli import command_names

HEAVY = ("numpy", "scipy", "pandas", "xarray", "h5py", "matplotlib", "lmfit")
SOURCE = Path(ehlwave.__file__).parents[1]


def imported_by(code: str) -> set[str]:
    """Return the packages that a new process has imported after a piece of code."""
    end = "import json, sys\nprint(json.dumps(sorted(sys.modules)))"
    path = os.environ | {"PYTHONPATH": str(SOURCE)}
    command = [sys.executable, "-c", f"{code}\n{end}"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=path)
    return {name.split(".")[0] for name in json.loads(done.stdout.splitlines()[-1])}


def helped(*words: str) -> str:
    return (
        "import contextlib, io\nfrom ehlwave.cli import main\n"
        "with contextlib.suppress(SystemExit), contextlib.redirect_stdout(io.StringIO()):\n"
        f"    main({[*words]!r})"
    )


def test_the_package_imports_nothing_before_it_is_asked() -> None:
    assert imported_by("import ehlwave").isdisjoint(HEAVY)
    assert "numpy" in imported_by("import ehlwave\nehlwave.Contact")


@pytest.mark.parametrize("d", [1, 0.4])
def test_a_contact_and_its_film_import_neither_tables_nor_hdf5(d: float) -> None:
    contact = f"ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10, radius_ratio_d={d})"
    heavy = {"pandas", "xarray", "h5py", "matplotlib", "lmfit"} | {
        f"scipy.{part}" for part in ("special", "optimize", "interpolate", "sparse", "io")
    }
    code = f"import ehlwave, sys\n{contact}.film()\nassert not {heavy} & set(sys.modules)"
    assert "numpy" in imported_by(code)


@pytest.mark.parametrize("words", [("--help",), ("--version",), ("refit", "--typo")])
def test_help_imports_nothing_heavy(words: tuple[str, ...]) -> None:
    assert imported_by(helped(*words)).isdisjoint(HEAVY)


def test_help_of_every_command_imports_nothing_heavy() -> None:
    names = command_names()
    assert {"deform", "lambda", "collapse", "export", "stress"} <= set(names)
    code = "\n".join(helped(name, "--help") for name in names)
    assert imported_by(code).isdisjoint(HEAVY)


def test_the_package_runs_as_a_module_and_says_its_version() -> None:
    path = os.environ | {"PYTHONPATH": str(SOURCE)}
    command = [sys.executable, "-m", "ehlwave", "--version"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=path)
    assert done.stdout == f"ehlwave {ehlwave.__version__}\n"
    assert ehlwave.__version__[0].isdigit()
    assert "__version__" in dir(ehlwave)
