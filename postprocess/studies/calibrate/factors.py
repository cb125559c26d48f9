"""Factors of declared errors from the sample, and their coverage of contacts left out."""

import csv
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ehlwave.writing import Writer
from studies.programs import ROOT
from studies.sweeps import Row

TABLE = ROOT / "src" / "case" / "error_factors.f90"
BOUND = 0.99
"""Share of errors below the declared errors."""
KINDS = ("averaged ellipse", "averaged line", "fitted ellipse", "fitted line")
"""Schemes and shapes of contacts: the columns of the table."""
BASES = ("coarse_grid", "model")
QUANTITIES = (
    *("central_film", "smallest_film", "friction", "rolling", "response", "amplitude_ratio"),
)
FEWEST = 30
"""Contacts from which a quantile is taken; the larger factors of other kinds stand in for fewer."""
HALVES, SEED = 20, 7


def factors(rows: Sequence[Row], present: dict[str, float]) -> dict[str, float]:
    """Return the factor of each quantity, kind and basis, by the names of `key`.

    Rows have the error of a number over its rule, ``ratio``. A factor without enough rows is the
    larger of its present value and of the factors of other kinds.
    """
    found = dict(present)
    for quantity in QUANTITIES:
        for basis in BASES:
            enough = {}
            for kind in KINDS:
                some = ratios(rows, quantity=quantity, kind=kind, basis=basis)
                if some.size >= FEWEST:
                    enough[kind] = float(np.quantile(some, BOUND, method="weibull"))
            for kind in KINDS:
                name = key(quantity, kind, basis)
                others = max(enough.values(), default=0.0)
                found[name] = enough.get(kind, max(others, present[name]))
    for quantity in QUANTITIES:
        for kind in KINDS:
            by_model = key(quantity, kind, "model")
            found[by_model] = max(found[by_model], found[key(quantity, kind, "coarse_grid")])
    return found


def kind_of(scheme: str, is_line: bool) -> str:
    """Return the kind of a contact."""
    return f"{scheme} {'line' if is_line else 'ellipse'}"


def key(quantity: str, kind: str, basis: str) -> str:
    """Return the name of a factor."""
    return f"{quantity} {kind} {basis}"


def ratios(rows: Sequence[Row], **equal: Any) -> np.ndarray:  # noqa: ANN401
    """Return errors over rules of the rows that have these values."""
    return np.array([row["ratio"] for row in rows if all(row[k] == v for k, v in equal.items())])


def coverage(rows: Sequence[Row], present: dict[str, float]) -> list[Row]:
    """Return the coverage of contacts by factors of random halves without them, by class."""
    rng = np.random.default_rng(SEED)
    contacts = sorted({row["contact"] for row in rows})
    held: dict[tuple[str, str, str], list[float]] = {}
    for _ in range(HALVES):
        half = set(rng.permutation(contacts)[: len(contacts) // 2])
        fitted = factors([row for row in rows if row["contact"] in half], present)
        for row in rows:
            if row["contact"] in half:
                continue
            times = row["ratio"] / fitted[key(row["quantity"], row["kind"], row["basis"])]
            for one in ("all", *row["classes"].split()):
                held.setdefault((row["quantity"], row["kind"], one), []).append(times)
    return [_covered(rows, name, times) for name, times in sorted(held.items())]


def _covered(rows: Sequence[Row], name: tuple[str, str, str], times: list[float]) -> Row:
    quantity, kind, one = name
    same = [
        row
        for row in rows
        if (row["quantity"], row["kind"]) == (quantity, kind)
        and one in ("all", *row["classes"].split())
    ]
    array = np.array(times)
    return {
        "quantity": quantity,
        "kind": kind,
        "class": one,
        "contacts": len(same),
        "covered": float(np.mean(array <= 1)),
        "beyond_1.5": float(np.mean(array > 1.5)),
        "largest": float(array.max()),
        "mean_bar": float(np.mean([row["declared"] for row in same])),
        "mean_bar_before": _mean([row["before"] for row in same]),
    }


def _mean(values: list[float]) -> float:
    some = [value for value in values if value is not None and math.isfinite(value)]
    return float(np.mean(some)) if some else math.nan


def read_errors(path: Path) -> list[Row]:
    """Return the errors of a record."""
    texts = ("classes", "quantity", "kind", "basis", "resolved")
    with path.open(newline="", encoding="utf-8") as file:
        return [
            {name: cell if name in texts else float(cell or "nan") for name, cell in row.items()}
            for row in csv.DictReader(file)
        ]


def read_table(path: Path = TABLE) -> dict[str, float]:
    """Return the factors in the Fortran table."""
    lines = path.read_text(encoding="utf-8").splitlines()
    found = {}
    for basis, name in zip(BASES, ("by_grids", "by_model"), strict=True):
        first = next(n for n, line in enumerate(lines) if f":: {name}(" in line)
        for number, kind in enumerate(KINDS):
            words = lines[first + 1 + number].split("]")[0].replace("&", "").split(",")
            values = [float(word.replace("_dp", "")) for word in words if word.strip()]
            found |= {key(q, kind, basis): v for q, v in zip(QUANTITIES, values, strict=True)}
    return found


def write_table(found: dict[str, float], contacts: int, path: Path = TABLE) -> None:
    """Write the Fortran table."""
    text = HEAD.format(contacts=contacts)
    for basis, name in zip(BASES, ("by_grids", "by_model"), strict=True):
        shape = f"{len(QUANTITIES)}, {len(KINDS)}"
        text += f"   real(dp), parameter, public :: {name}({shape}) = reshape([ &\n"
        for kind in KINDS:
            end = ", &" if kind != KINDS[-1] else f"], [{shape}])"
            values = [f"{found[key(q, kind, basis)]:#.3g}_dp" for q in QUANTITIES]
            text += f"      {', '.join(values)}{end}\n"
    Writer(overwrite=True).text(path, text + "\nend module ehlwave_error_factors\n")


HEAD = """\
!> Factors of declared errors. Written by `scripts/study accuracy --calibrate`: do not edit.
!>
!> 99 % of the errors of {contacts} contacts are below factor times rule, theory eq. (E1). Errors:
!> postprocess/record/accuracy/sample.csv.
module ehlwave_error_factors
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   integer, parameter, public :: central_film = 1, smallest_film = 2, friction = 3, &
                                 rolling = 4, response = 5, amplitude_ratio = 6

   !> With a coarser grid, and by the model alone: (quantity, kind), kinds of `kind_of`.
"""
