"""Errors of numbers against the truths of the sample, beside their declared errors."""

import gzip
import json
import math
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from ehlwave.writing import Writer
from studies.all_keys.draw import Row
from studies.calibrate.factors import DOMAIN, key, kind_of
from studies.calibrate.sample import VALUES, solved

DIGITS = 6
ROUNDING = 1e-5
"""Relative error of truths and of tolerances, which is no error by the mesh."""
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
    before = {name: declared(base, name) for name in NUMBERS}
    wide = runs.get("wide") or {}
    return {
        "number": contact["number"],
        "row": contact["row"],
        "classes": contact["classes"],
        "truth": truth,
        "wide": {name: _short(wide[name]) for name in VALUES if wide.get(name) is not None},
        "before": {name: _short(value) for name, value in before.items() if math.isfinite(value)},
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
    found = solved("base", contact["row"], known, folder)
    return [] if found is None else list(_errors(contact, found, table))


def _errors(contact: Row, found: Row, table: dict[str, float]) -> Iterator[Row]:
    kind = kind_of(found["scheme"], "line" in contact["classes"])
    is_starved = "starved" in contact["classes"]
    for quantity, (names, _, domain, basis) in NUMBERS.items():
        if quantity == "response" and "harmonic_real" not in contact["truth"]:
            names = ("harmonic_ratio",)
        value = _number(found, names)
        if not abs(value) > (NOTHING if quantity == "friction" else 0):
            continue
        error, edges = declared(found, quantity), _value(found, domain)
        by_grids = found.get(f"{basis}_error_basis", "")
        estimate = error / table.get(key(quantity, kind, by_grids), math.nan)
        for truth, part, column, name in (
            ("truth", error, kind, by_grids),
            ("wide", edges, DOMAIN, DOMAIN),
        ):
            off = abs(value - _number(contact.get(truth, {}), names)) / abs(value)
            if not (math.isfinite(off) and part > 0 and math.isfinite(estimate)):
                continue
            is_share = name == DOMAIN and quantity in BY_OIL_OUTSIDE
            by_film = _value(found, "film_error_domain") if is_share and not is_starved else 0.0
            if not part > by_film:
                continue
            over = max(0.0, off - ROUNDING - by_film) / (part - by_film)
            yield {
                "contact": contact["number"],
                "classes": " ".join(contact["classes"]),
                "quantity": quantity,
                "kind": column,
                "basis": name,
                "is_large": estimate > LARGE,
                "resolved": found["is_resolved"],
                "off": off,
                "declared": part,
                "ratio": over * table[key(quantity, column, name)],
                "before": contact["before"].get(quantity, math.nan) if name != DOMAIN else math.nan,
            }


def write_contacts(path: Path, contacts: Iterable[Row]) -> None:
    """Write the contacts of a record, compressed, without those that need files."""
    whole = (one for one in contacts if not any("/" in str(key) for key in one["row"].values()))
    lines = [json.dumps(contact, separators=(",", ":")) for contact in whole]
    text = "\n".join(lines) + "\n"
    Writer(overwrite=True).data(path, gzip.compress(text.encode(), mtime=0))


def read_contacts(path: Path) -> list[Row]:
    """Return the contacts of a record."""
    return [json.loads(line) for line in gzip.decompress(path.read_bytes()).splitlines()]


def _number(found: Row, names: tuple[str, ...]) -> complex:
    return complex(*(_value(found, name) for name in names))


def _value(found: Row, name: str) -> float:
    value: Any = found.get(name)
    return math.nan if value is None else float(value)


def _short(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")
