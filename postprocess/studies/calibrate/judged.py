"""Errors of numbers against the truths of the sample, beside their declared errors."""

import json
import math
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from ehlwave.writing import Writer
from studies.all_keys.draw import Row
from studies.calibrate.factors import key, kind_of
from studies.calibrate.sample import VALUES, solved

DIGITS = 6
TOLERANCE = 1e-5
"""Relative error of truths and of tolerances, which is no error by the mesh."""
NOTHING = 1e-8
"""Friction of pure rolling, by round-off."""
NUMBERS: dict[str, tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...], str]] = {
    "central_film": (("central_film",), ("film_error_mesh",), (), "film_error_basis"),
    "smallest_film": (
        *(("minimum_film",), ("minimum_film_error",), ("minimum_film_error_domain",)),
        "film_error_basis",
    ),
    "friction": (
        *(("friction_coefficient",), ("friction_error",), ("friction_error_domain",)),
        "film_error_basis",
    ),
    "response": (
        *(("harmonic_real", "harmonic_imaginary"), ("harmonic_error",), ()),
        "harmonic_error_basis",
    ),
    "amplitude_ratio": (
        *(("amplitude_ratio_fit",), ("ratio_error_mesh",), ()),
        "amplitude_error_basis",
    ),
}
"""Each quantity: its numbers, declared errors, parts of them by the domain, and the basis."""


def distilled(contact: Row) -> Row | None:
    """Return keys, classes and truths of a contact; None without a finer solution."""
    runs = contact["runs"]
    base, double, fourfold = (runs.get(name) for name in ("base", "double", "fourfold"))
    if base is None or double is None:
        return None
    fine, coarse = (fourfold, double) if fourfold else (double, base)
    truth = {}
    for name in VALUES:
        if fine.get(name) is not None and coarse.get(name) is not None:
            truth[name] = _short(fine[name] + (fine[name] - coarse[name]) / 3)
    before = {name: declared(base, name) for name in NUMBERS}
    return {
        "number": contact["number"],
        "row": contact["row"],
        "classes": contact["classes"],
        "truth": truth,
        "before": {name: _short(value) for name, value in before.items() if math.isfinite(value)},
    }


def earlier(line: str, number: int) -> Row | None:
    """Return a contact of the earlier sample in the form of `distilled`."""
    found = json.loads(line)
    if "truth" not in found:
        return None
    row = {name: value for keys in found["groups"].values() for name, value in keys.items()}
    is_line = row["radius_ratio_d"] == 0
    row |= {"cells_x": found["n"], "edges": "truncated", "scheme": "averaged"}
    row |= {} if is_line else {"cells_y": found["n"]}
    base, truth = found["base"], found["truth"]
    errors = ("central_film_error", "minimum_film_error", "friction_error", "harmonic_error")
    before = {name: base[error] for name, error in zip(NUMBERS, errors, strict=False)}
    classes = ["line" if is_line else "ellipse"]
    classes += ["oil"] if row["flow_law"] != "newtonian" else []
    classes += ["slip"] if row["slip_parameter"] != 1 else []
    classes += ["starved"] if "oil_over_flooded" in row else []
    names = ("central_film", "minimum_film", "friction_coefficient", "harmonic_ratio")
    return {
        "number": -number,
        "row": row,
        "classes": [*classes, "response"],
        "truth": {name: _short(truth[name]) for name in names if truth[name] is not None},
        "before": {name: _short(value) for name, value in before.items() if value is not None},
    }


def declared(found: Row, quantity: str) -> float:
    """Return the declared error of a number by the mesh."""
    _, errors, less, _ = NUMBERS[quantity]
    return _sum(found, errors) - _sum(found, less)


def errors_of(
    contact: Row, table: dict[str, float], known: dict[str, str], folder: Path
) -> list[Row]:
    """Return the errors of the numbers of a contact, as the program declares them now."""
    found = solved("base", contact["row"], known, folder)
    return [] if found is None else list(_errors(contact, found, table))


def _errors(contact: Row, found: Row, table: dict[str, float]) -> Iterator[Row]:
    truth = contact["truth"]
    for quantity, (names, _, _, basis) in NUMBERS.items():
        if quantity == "response" and "harmonic_real" not in truth:
            names = ("harmonic_ratio",)
        value, true = _number(found, names), _number(truth, names)
        error = declared(found, quantity)
        if not (math.isfinite(abs(value - true)) and error > 0 and abs(value) > NOTHING):
            continue
        off = abs(value - true) / abs(value)
        kind = kind_of(found["scheme"], "line" in contact["classes"])
        factor = table[key(quantity, kind, found[basis])]
        yield {
            "contact": contact["number"],
            "classes": " ".join(contact["classes"]),
            "quantity": quantity,
            "kind": kind,
            "basis": found[basis],
            "resolved": found["is_resolved"],
            "off": off,
            "declared": error,
            "ratio": max(0.0, off - TOLERANCE) * factor / error,
            "before": contact["before"].get(quantity, math.nan),
        }


def write_contacts(path: Path, contacts: Iterable[Row]) -> None:
    """Write the contacts of a record."""
    lines = [json.dumps(contact, separators=(",", ":")) for contact in contacts]
    Writer(overwrite=True).text(path, "\n".join(lines) + "\n")


def _number(found: Row, names: tuple[str, ...]) -> complex:
    values = [found.get(name) for name in names]
    if any(value is None for value in values):
        return complex(math.nan)
    return complex(*(float(value) for value in values))


def _sum(found: Row, names: tuple[str, ...]) -> float:
    values: list[Any] = [found.get(name) for name in names]
    return math.nan if any(value is None for value in values) else float(sum(values))


def _short(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")
