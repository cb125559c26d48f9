"""Runs of ``ehlwave-case`` for many contacts, each kept in a file of JSON lines."""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from ehlwave.contact import conditions_from_keys
from ehlwave.writing import keep_own_file
from studies.programs import Groups, namelist, run
from studies.sweeps import Row

PROCESSOR_S = 10
"""Processor time of a case, at most, seconds."""


def solved(groups: Groups, folder: Path) -> Row | None:
    """Return the result of a case; None if it was refused, did not converge or took too long.

    A result that is less accurate than asked has its error.
    """
    path = folder / "case.nml"
    keep_own_file(path, namelist(groups).encode())
    outcome = run("case", path, "--json", "--quiet", processor_s=PROCESSOR_S)
    lines = outcome.stdout.strip().split("\n")
    if not lines[-1].startswith("{"):
        return None
    found: Row = json.loads(lines[-1])
    return found if found["status"] in ("converged", "inaccurate") else None


def kept(
    path: Path, numbers: Iterable[int], work: Callable[[int, Path], Row], at_once: int
) -> list[Row]:
    """Return rows of all numbers, in their order; those that the file has are not computed again.

    `work` takes a number and a folder of its own.
    """
    rows = {row["number"]: row for row in read_rows(path)}
    numbers = list(numbers)
    missing = [number for number in numbers if number not in rows]

    def one(number: int) -> Row:
        return {"number": number, **work(number, path.parent / f"{path.stem}-{number % at_once}")}

    def lane(first: int) -> list[Row]:
        return [one(number) for number in missing if number % at_once == first]

    with ThreadPoolExecutor(at_once) as pool:
        for done in pool.map(lane, range(at_once)) if at_once > 1 else _each(missing, one):
            rows |= {row["number"]: row for row in done}
            keep_own_file(path, "".join(f"{json.dumps(row)}\n" for row in rows.values()).encode())
    return [rows[number] for number in numbers]


def _each(numbers: Iterable[int], one: Callable[[int], Row]) -> Iterator[list[Row]]:
    return ([one(number)] for number in numbers)


def read_rows(path: Path) -> list[Row]:
    """Return the rows of a file of JSON lines; none where there is no file."""
    if not path.is_file():
        return []
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def log_uniform(random: Any, low: float, high: float) -> float:  # noqa: ANN401 - a Generator
    """Return a number drawn evenly in its logarithm, with four digits."""
    return float(f"{low * (high / low) ** random.random():.4g}")


def groups_of(keys: Mapping[str, float], **more: Mapping[str, object]) -> Groups:
    """Return the input groups of a contact by its keys, one thread, with further groups."""
    names = conditions_keys(keys)
    law = {"carreau_exponent": "carreau", "eyring_stress_pa": "eyring"}
    flow = next(({"flow_law": law[name]} for name in law if name in keys), {})
    lubricant = {name: value for name, value in keys.items() if name not in names}
    groups = {"conditions": {name: keys[name] for name in names}, "lubricant": lubricant | flow}
    shared: Groups = {"grid": {"edges": "flooded"}, "solver": {"threads": 1}}
    for source in (shared, more):
        for name, values in source.items():
            groups[name] = {**groups.get(name, {}), **values}
    return groups


def conditions_keys(keys: Mapping[str, float]) -> list[str]:
    """Return the keys of the group ``&conditions``."""
    oil = ("pressure_viscosity_per_pa", "roelands_index", "temperature_k")
    oil = (*oil, "eyring_stress_pa", "carreau_modulus_pa", "carreau_exponent")
    return [name for name in keys if name not in oil]


__all__ = [
    "conditions_from_keys",
    "conditions_keys",
    "groups_of",
    "kept",
    "log_uniform",
    "read_rows",
    "solved",
]
