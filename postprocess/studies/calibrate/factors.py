"""Factors of declared errors from the sample, and their coverage of contacts left out."""

import csv
import lzma
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from ehlwave.writing import Writer
from studies.programs import ROOT
from studies.sweeps import Row

TABLE = ROOT / "src" / "case" / "error_factors.f90"
BOUND = 0.99
"""Share of errors below the declared errors."""
KINDS = ("averaged ellipse", "averaged line", "fitted ellipse", "fitted line")
"""Schemes and shapes of contacts: the columns of the table."""
BASES = ("coarse_grid", "model")
DOMAIN = "domain"
"""Kind and basis of errors by the edges of the domain."""
STARVED, BY_RESPONSE = "starved", "response"
"""Bases without a factor: friction by oil outside, most of which is farther out than the truth
reaches, and errors by oil that starved contacts may lack: the part counts whole; and errors of
Ad/Ai that are those of the response."""
QUANTITIES = (
    *("central_film", "smallest_film", "friction", "rolling", "response", "amplitude_ratio"),
)
APART = ("unresolved", "large")
"""Classes of errors whose results carry a warning in any case."""
FEWEST = 100
"""Errors from which a kind has a factor of its own."""
FEW = 20
"""Errors from which a kind has a spread of its own: `SPREAD` of its ratios are below. Over it the
ratios of all kinds are alike."""
SPREAD = 0.9
MODEL_SHARE = 0.3
"""Share of the expected error that every error has, as in ``src/case/mesh_errors.f90``."""
ALIKE = {"amplitude_ratio": "response"}
"""Quantities whose factors stand in for those of one with fewer than `FEW` errors."""
ROUNDING = 1e-5
"""Relative error of truths and of tolerances, which is no error by the mesh; of responses over
Ai."""
CONFIDENCE = 0.6
"""Confidence that the share `BOUND` of all errors is below a factor."""
TAIL, FEWEST_TAIL = 0.1, 3
"""Share and least number of the largest ratios that continue a sample without so many contacts."""
FARTHEST = 1.5
"""Factor by which the tail goes beyond the largest ratio, at most."""


def factors(rows: Sequence[Row], present: dict[str, float]) -> dict[str, float]:
    """Return the factor of each quantity, kind and basis, by the names of `key`.

    A factor without any errors keeps its present value.
    """
    found = dict(present)
    judged = [row for row in rows if not apart(row)]
    for quantity in QUANTITIES:
        for basis in BASES:
            some = {
                kind: _ratios(judged, found, quantity=quantity, kind=kind, basis=basis)
                for kind in KINDS
            }
            for kind, bound in _bounds(some).items():
                if quantity in ALIKE and some[kind].size < FEW:
                    bound = np.fmax(bound, found[key(ALIKE[quantity], kind, basis)])
                if np.isfinite(bound):
                    found[key(quantity, kind, basis)] = float(bound)
        for kind in KINDS:
            by_model, least = key(quantity, kind, "model"), key(quantity, kind, "coarse_grid")
            found[by_model] = max(found[by_model], MODEL_SHARE * found[least])
        edges = _bound(_ratios(judged, found, quantity=quantity, basis=DOMAIN))
        if np.isfinite(edges):
            found[key(quantity, DOMAIN, DOMAIN)] = edges
    return found


def _bounds(some: dict[str, np.ndarray]) -> dict[str, float]:
    """Return the bounds of the ratios of each kind.

    A kind with few errors has the bound of all ratios over their spread, times its own spread, and
    at least its largest ratio; without a spread the bound of all ratios.
    """
    spread = {kind: np.quantile(one, SPREAD) for kind, one in some.items() if one.size >= FEW}
    every = _bound(np.concatenate(list(some.values())))
    alike = _bound(np.concatenate([[], *(some[kind] / spread[kind] for kind in spread)]))
    found = {}
    for kind, one in some.items():
        if one.size >= FEWEST:
            found[kind] = _bound(one)
        else:
            bound = spread[kind] * alike if kind in spread else every
            found[kind] = float(max(bound, one.max()) if one.size else bound)
    return found


def _bound(ratios: np.ndarray) -> float:
    """Return the upper confidence limit of the quantile `BOUND`: an order statistic; NaN of none.

    A sample that is too small for one has it by an exponential tail of the logarithms.
    """
    count = ratios.size
    if not count:
        return math.nan
    ordered = np.sort(ratios)
    ranks = np.arange(1, count + 1)
    enough = ranks[scipy.stats.binom.cdf(ranks - 1, count, BOUND) >= CONFIDENCE]
    if enough.size:
        return float(ordered[enough[0] - 1])
    most = min(max(FEWEST_TAIL, int(TAIL * count)), count - 1)
    threshold = ordered[-most - 1]
    if count < FEWEST_TAIL / TAIL or threshold <= 0:
        return float(ordered[-1])
    slope = float(np.mean(np.log(ordered[-most:] / threshold)))
    tail = threshold * (most / count / (1 - BOUND)) ** slope
    return float(np.clip(tail, ordered[-1], FARTHEST * ordered[-1]))


def kind_of(scheme: str, is_line: bool) -> str:
    """Return the kind of a contact."""
    return f"{scheme} {'line' if is_line else 'ellipse'}"


def key(quantity: str, kind: str, basis: str) -> str:
    """Return the name of a factor."""
    return f"{quantity} {kind} {basis}"


FILM = key("central_film", DOMAIN, DOMAIN)
"""Factor of the part of the film in other errors by the edges."""


def declared(row: Row, table: dict[str, float]) -> float:
    """Return the declared error: a factor times the rule, and the part of the film."""
    return float(row["film"] * table[FILM] + row["rule"] * table.get(key_of(row), 1.0))


def ratio(row: Row, table: dict[str, float]) -> float:
    """Return the error over its rule, without the part of the film."""
    return float(max(0.0, row["off"] - ROUNDING - row["film"] * table[FILM]) / row["rule"])


def _ratios(rows: Sequence[Row], table: dict[str, float], **equal: Any) -> np.ndarray:  # noqa: ANN401
    """Return errors over rules of the rows that have these values."""
    some = (row for row in rows if all(row[k] == v for k, v in equal.items()))
    return np.array([ratio(row, table) for row in some])


def key_of(row: Row) -> str:
    """Return the name of the factor of an error."""
    return key(row["quantity"], row["kind"], row["basis"])


def apart(row: Row) -> str:
    """Return the class of an error whose result carries a warning in any case; '' of others."""
    unresolved, large = APART
    if row["resolved"] != ".true.":
        return unresolved
    return large if row["is_large"] == ".true." else ""


def read_errors(path: Path) -> list[Row]:
    """Return the errors of a record, a CSV file or a compressed one."""
    texts = ("classes", "quantity", "kind", "basis", "resolved", "is_large")
    data = path.read_bytes()
    text = (lzma.decompress(data) if path.suffix == ".xz" else data).decode("utf-8")
    return [
        {name: cell if name in texts else float(cell or "nan") for name, cell in row.items()}
        for row in csv.DictReader(text.splitlines())
    ]


def read_table(path: Path = TABLE) -> dict[str, float]:
    """Return the factors in the Fortran table."""
    text = path.read_text(encoding="utf-8")
    found = {}
    for name, names in TABLES.items():
        numbers = text.split(f":: {name}(", 1)[1].split("[", 1)[1].split("]", 1)[0]
        words = numbers.replace("&", "").replace("_dp", "").split(",")
        found |= dict(zip(names, map(float, words), strict=True))
    return found


def write_table(found: dict[str, float], contacts: int, path: Path = TABLE) -> None:
    """Write the Fortran table."""
    text = HEAD.format(contacts=contacts)
    count = len(QUANTITIES)
    for name, names in TABLES.items():
        lines = [
            ", ".join(f"{found[one]:#.3g}_dp" for one in names[first : first + count])
            for first in range(0, len(names), count)
        ]
        shape = f"{count}, {len(lines)}" if len(lines) > 1 else f"{len(names)}"
        start, end = ("reshape([", f"], [{shape}])") if len(lines) > 1 else ("[", "]")
        text += f"\n   !> {MEANINGS[name]}\n"
        text += f"   real(dp), parameter, public :: {name}({shape}) = {start} &\n      "
        text += ", &\n      ".join(lines) + f"{end}\n"
    Writer(overwrite=True).text(path, text + "\nend module ehlwave_error_factors\n")


TABLES = {
    "by_grids": [key(q, kind, "coarse_grid") for kind in KINDS for q in QUANTITIES],
    "by_model": [key(q, kind, "model") for kind in KINDS for q in QUANTITIES],
    "by_domain": [key(q, DOMAIN, DOMAIN) for q in QUANTITIES if q != "amplitude_ratio"],
}
"""Tables of the Fortran module, and the factors in each."""
MEANINGS = {
    "by_grids": "With a coarser grid: (quantity, kind), kinds of `kind_of`.",
    "by_model": "By the model alone, likewise.",
    "by_domain": "By the edges of a flooded domain: (quantity), times the error of "
    "`ehlwave_domain_choice`;\n   !> rolling: times the part by the oil outside, which "
    "counts whole for friction.",
}

HEAD = """\
!> Factors of declared errors. Written by `scripts/study accuracy --calibrate`: do not edit.
!>
!> 99 % of the errors of {contacts} contacts are below factor times rule, theory eq. (E1). Errors:
!> postprocess/record/accuracy/sample.csv.xz.
module ehlwave_error_factors
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   integer, parameter, public :: central_film = 1, smallest_film = 2, friction = 3, &
                                 rolling = 4, response = 5, amplitude_ratio = 6
"""
