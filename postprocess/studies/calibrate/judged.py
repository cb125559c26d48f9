"""Errors of numbers against the truths of the sample, beside their declared errors."""

import json
import lzma
import math
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from ehlwave.writing import Writer
from studies.all_keys.draw import Row
from studies.calibrate.factors import (
    BY_RESPONSE,
    DOMAIN,
    FILM,
    ROUNDING,
    STARVED,
    key,
    kind_of,
)
from studies.calibrate.sample import VALUES, solved

DIGITS = 6
NOTHING = 1e-5
"""Friction that is not judged: what heat leaves of it in pure rolling."""
LARGE = 0.3
"""Estimates from which on results carry a warning in any case: they are judged apart."""
NUMBERS: dict[str, tuple[tuple[str, ...], str, str, str]] = {
    "central_film": (("central_film",), "film_error_mesh", "film_error_domain", "film"),
    "smallest_film": (
        ("minimum_film",),
        "minimum_film_error",
        "minimum_film_error_domain",
        "film",
    ),
    "friction": (("friction_coefficient",), "friction_error", "friction_error_domain", "film"),
    "rolling": (
        ("rolling_resistance",),
        "rolling_resistance_error",
        "rolling_resistance_error_domain",
        "film",
    ),
    "response": (
        ("harmonic_real", "harmonic_imaginary"),
        "harmonic_error",
        "ratio_error_domain",
        "harmonic",
    ),
    "amplitude_ratio": (
        ("amplitude_ratio_fit",),
        "ratio_error_mesh",
        "ratio_error_domain",
        "amplitude",
    ),
}
"""Each quantity: its numbers, their declared error by the mesh, by the domain, and the basis."""
SAME = 1e-3
"""Relative difference of errors that are the same."""
WITH_DOMAIN = ("smallest_film", "friction", "rolling")
"""Quantities whose declared error includes the part by the domain."""
BY_OIL_OUTSIDE = ("friction", "rolling")
"""Quantities whose error by the domain is the film's and a share of the part by the oil outside."""


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
    wide = runs.get("wide") or {}
    return {
        "number": contact["number"],
        "row": contact["row"],
        "classes": contact["classes"],
        "truth": truth,
        "wide": {name: _short(wide[name]) for name in VALUES if wide.get(name) is not None},
        "before": {},
    }


def declared(found: Row, quantity: str) -> float:
    """Return the declared error of a number by the mesh."""
    _, error, domain, _ = NUMBERS[quantity]
    less = _value(found, domain) if quantity in WITH_DOMAIN else 0.0
    return _value(found, error) - less


def errors_of(
    contact: Row, table: dict[str, float], known: dict[str, str], folder: Path
) -> list[Row]:
    """Return the errors of the numbers of a contact, as the program declares them now."""
    return list(_errors(contact, solved(contact["row"], known, folder), table))


def _errors(contact: Row, found: Row, table: dict[str, float]) -> Iterator[Row]:
    kind = kind_of(found["scheme"], "line" in contact["classes"])
    for quantity, (names, _, _, basis) in NUMBERS.items():
        if quantity == "response" and "harmonic_real" not in contact["truth"]:
            names = ("harmonic_ratio",)
        value = _number(found, names)
        if not abs(value) > (NOTHING if quantity == "friction" else 0):
            continue
        by_grids = found.get(f"{basis}_error_basis", "")
        estimate = declared(found, quantity) / table.get(key(quantity, kind, by_grids), math.nan)
        if quantity == "amplitude_ratio" and _is_by_response(found):
            by_grids, estimate = BY_RESPONSE, declared(found, quantity)
        before = contact["before"].get(quantity, math.nan)
        edges = _edges(found, quantity, "starved" in contact["classes"], table)
        for truth, column, (name, rule, film) in (
            ("truth", kind, (by_grids, estimate, 0.0)),
            ("wide", DOMAIN, edges),
        ):
            off = abs(value - _number(contact.get(truth, {}), names)) / abs(value)
            if not (math.isfinite(off) and rule > 0 and math.isfinite(estimate)):
                continue
            if quantity == "response":
                off = max(0.0, off - ROUNDING / abs(value))
            yield {
                "contact": contact["number"],
                "classes": " ".join(contact["classes"]),
                "quantity": quantity,
                "kind": column,
                "basis": name,
                "is_large": estimate > LARGE,
                "resolved": found["is_resolved"],
                "off": off,
                "rule": rule,
                "film": film,
                "before": math.nan if column == DOMAIN else before,
            }


def _is_by_response(found: Row) -> bool:
    """Return whether the error of Ad/Ai in time is the error of the response, which is larger."""
    response = NUMBERS["response"][1]
    return declared(found, "amplitude_ratio") <= (1 + SAME) * _value(found, response)


def _edges(
    found: Row, quantity: str, is_starved: bool, table: dict[str, float]
) -> tuple[str, float, float]:
    """Return basis, rule and part of the film of the error by the edges of the domain."""
    part = _value(found, NUMBERS[quantity][2])
    if quantity not in BY_OIL_OUTSIDE:
        return DOMAIN, part / table.get(key(quantity, DOMAIN, DOMAIN), math.nan), 0.0
    if is_starved or quantity == "friction":
        return STARVED, part, 0.0
    film = _value(found, "film_error_domain")
    return DOMAIN, (part - film) / table[key(quantity, DOMAIN, DOMAIN)], film / table[FILM]


def write_contacts(path: Path, contacts: Iterable[Row]) -> None:
    """Write the contacts of a record, compressed."""
    text = "".join(json.dumps(one, separators=(",", ":")) + "\n" for one in contacts)
    Writer(overwrite=True).data(path, lzma.compress(text.encode()))


def read_contacts(path: Path) -> list[Row]:
    """Return the contacts of a record."""
    return [json.loads(line) for line in lzma.decompress(path.read_bytes()).splitlines()]


def _number(found: Row, names: tuple[str, ...]) -> complex:
    return complex(*(_value(found, name) for name in names))


def _value(found: Row, name: str) -> float:
    value: Any = found.get(name)
    return math.nan if value is None else float(value)


def _short(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")
