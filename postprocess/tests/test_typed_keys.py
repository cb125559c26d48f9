"""Keys are typed arguments: the types match the program, and mypy refuses a wrong key."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import ehlwave
from ehlwave.cases.keys import key_table
from ehlwave.contact.conditions_from_keys import KNOWN_KEYS
from ehlwave.inputs.keys import CaseKeys, ContactKeys, StudyKeys
from ehlwave.programs.programs import find_program
from studies import typed_keys

SOURCE = Path(ehlwave.__file__).parents[1]

RIGHT = """
from typing import Any
import ehlwave
moes: dict[str, Any] = {"load_parameter_m": 100}
contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10, radius_ratio_d=1)
ehlwave.Contact(**moes)
case = ehlwave.Case(load_parameter_m=10, response="harmonic", cells_x=64, oblique=True)
ehlwave.Study({"slip_parameter": [1, 1.2]}, load_parameter_m=10, unresolved="skip")
"""

WRONG = {
    "ehlwave.Case(load_paramter_m=10)": '"load_paramter_m" for "Case"; did you mean "load_param',
    "ehlwave.Case(response='harmonc')": 'expected "Literal[',
    "ehlwave.Case(cells_x=0.5)": 'expected "SupportsIndex"',
    "ehlwave.Study({}, radius_ratio=1)": '"radius_ratio" for "Study"',
    "ehlwave.Contact(radius_x_mm=1)": '"radius_x_mm" for "Contact"',
    "contact.film().centre_m": 'has no attribute "centre_m"',
}


def checked(text: str, folder: Path) -> list[str]:
    """Return the output of mypy for a text."""
    pytest.importorskip("mypy")
    (folder / "snippet.py").write_text(text)
    options = ["--follow-imports=silent", "--ignore-missing-imports", "--no-site-packages"]
    command = [sys.executable, "-m", "mypy", "--no-error-summary", *options, "snippet.py"]
    # Types are found where the package is: a checker that ignores it would find nothing wrong.
    path = os.environ | {"MYPYPATH": str(SOURCE)}
    done = subprocess.run(command, cwd=folder, env=path, capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr
    return [line for line in done.stdout.splitlines() if ": error:" in line]


def test_a_type_checker_takes_keys_and_refuses_those_that_are_not(tmp_path: Path) -> None:
    assert checked(RIGHT, tmp_path) == []
    found = checked(RIGHT + "\n".join(WRONG), tmp_path)
    assert len(found) == len(WRONG)
    for line, said in zip(found, WRONG.values(), strict=True):
        assert said in line


def test_the_package_says_that_it_is_typed() -> None:
    assert (SOURCE / "ehlwave" / "py.typed").is_file()


def test_types_are_those_of_the_program() -> None:
    try:
        find_program("ehlwave-case")
    except ehlwave.ProgramError:
        pytest.skip("the programs are not built")
    text = typed_keys.module(key_table().to_dict("records"))
    assert typed_keys.PLACE.read_text() == text, "run python -m studies.typed_keys"
    rows = typed_keys.table(key_table().to_dict("records"))
    assert typed_keys.TABLE_PLACE.read_text() == rows, "run python -m studies.typed_keys"
    assert set(key_table()["name"]) == set(CaseKeys.__annotations__)


def test_types_of_contacts_are_what_contacts_take() -> None:
    assert set(ContactKeys.__annotations__) == set(KNOWN_KEYS)
    assert set(StudyKeys.__annotations__) > set(CaseKeys.__annotations__)
