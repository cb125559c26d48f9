"""Keys of the programs by the programs themselves, and runs of them."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

import pandas as pd

from ehlwave.errors import ProgramError, did_you_mean, see
from ehlwave.programs.programs import find_program
from ehlwave.programs.progress import run_following
from ehlwave.quantities import in_si


def grouped(keys: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Return keys by the group that they belong to in an input file.

    Raises ProgramError if a key is not known to the program.
    """
    known, groups = key_groups(), {}
    for key, value in keys.items():
        if key not in known:
            near = did_you_mean(key, known)
            raise ProgramError(
                f"unknown key {key}{near}; ehlwave-case --keys lists all{see('keys')}"
            )
        groups.setdefault(known[key], {})[key] = in_si(value, key)
    return groups


@cache
def key_table() -> pd.DataFrame:
    """Return the program's table of its keys, a row each: ``ehlwave-case --keys --json``.

    Columns: ``group``, ``name``, ``kind``, ``unit``, the bounds ``above``, ``minimum`` and
    ``maximum``, ``choices``, ``default``, ``default_text``, ``required``, ``help`` and
    ``belongs_to``, the cases that have the key.

    Raises ProgramError if there is no program, or its version has no such table.
    """
    said = run_program("ehlwave-case", "--keys", "--json").stdout
    try:
        return pd.DataFrame(json.loads(said)["keys"])
    except (ValueError, KeyError) as error:
        program = find_program("ehlwave-case")
        raise ProgramError(
            f"{program}: lists no keys as JSON: take the program of this package"
        ) from error


def key_groups() -> dict[str, str]:
    """Return the group of each key."""
    table = key_table()
    return dict(zip(table["name"], table["group"], strict=True))


def run_program(name: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run a program; ProgramError with its message unless its exit status is 0 or 1."""
    done = run_following([str(find_program(name)), *arguments], None, "stdout")
    return checked(done, (0, 1))


def checked(
    done: subprocess.CompletedProcess[str], fine: Sequence[int]
) -> subprocess.CompletedProcess[str]:
    """Return the completed run; ProgramError with its message unless its exit status is fine."""
    if done.returncode not in fine:
        said = "; ".join((done.stderr or done.stdout).strip().splitlines())
        command = " ".join(map(str, done.args))
        raise ProgramError(f"{command}: exit status {done.returncode}: {said}")
    return done
