"""Factors of declared errors from the sample, and their coverage of contacts left out."""

import csv
import gzip
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
QUANTITIES = (
    *("central_film", "smallest_film", "friction", "rolling", "response", "amplitude_ratio"),
)
APART = ("unresolved", "large")
"""Classes of errors whose results carry a warning in any case."""
FEWEST = 100
"""Contacts from which a kind has a factor of its own; the kinds together stand in for fewer."""
ALIKE = {"amplitude_ratio": "response"}
"""Quantities whose factors bound those of one with few contacts."""
CONFIDENCE = 0.6
"""Confidence that the share `BOUND` of all errors is below a factor."""
TAIL, FEWEST_TAIL = 0.1, 3
"""Share and least number of the largest ratios that continue a sample without so many contacts."""
FARTHEST = 1.5
"""Factor by which the tail goes beyond the largest ratio, at most."""
CHANCE = 0.05
"""Probability of fewer covered contacts, had their class `LEAST`, from which on it is covered."""
LEAST = 0.975
HALVES, SEED = 20, 7


def factors(rows: Sequence[Row], present: dict[str, float]) -> dict[str, float]:
    """Return the factor of each quantity, kind and basis, by the names of `key`.

    Rows have the error of a number over its rule, ``ratio``. A factor with few rows is the larger
    of their bound and of the factor of all kinds; without any it keeps its present value.
    """
    found = dict(present)
    judged = [row for row in rows if not _apart(row)]
    for quantity in QUANTITIES:
        for basis in BASES:
            every = _bound(ratios(judged, quantity=quantity, basis=basis))
            for kind in KINDS:
                some = ratios(judged, quantity=quantity, kind=kind, basis=basis)
                own = _bound(some)
                bound = own if some.size >= FEWEST else np.fmax(own, every)
                if quantity in ALIKE and some.size < FEWEST:
                    bound = np.fmax(bound, found[key(ALIKE[quantity], kind, basis)])
                if np.isfinite(bound):
                    found[key(quantity, kind, basis)] = float(bound)
        for kind in KINDS:
            by_model = key(quantity, kind, "model")
            found[by_model] = max(found[by_model], found[key(quantity, kind, "coarse_grid")])
        edges = _bound(ratios(judged, quantity=quantity, basis=DOMAIN))
        if np.isfinite(edges):
            found[key(quantity, DOMAIN, DOMAIN)] = edges
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


def with_factors(
    rows: Sequence[Row], former: dict[str, float], found: dict[str, float]
) -> list[Row]:
    """Return the errors as they are declared with other factors."""
    return [
        row | {"declared": row["declared"] * found[name] / former[name]}
        for row in rows
        for name in [key(row["quantity"], row["kind"], row["basis"])]
    ]


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
            for one in _classes(row):
                held.setdefault((row["quantity"], _part(row), one), []).append(times)
    return [_covered(rows, name, times) for name, times in sorted(held.items())]


def _part(row: Row) -> str:
    """Return the part of the error."""
    return DOMAIN if row["basis"] == DOMAIN else "mesh"


def _apart(row: Row) -> str:
    """Return the class of an error whose result carries a warning in any case; '' of others."""
    unresolved, large = APART
    if row["resolved"] != ".true.":
        return unresolved
    return large if row["is_large"] == ".true." else ""


def _classes(row: Row) -> tuple[str, ...]:
    """Return the classes of an error, its kind among them."""
    apart = _apart(row)
    kind = (row["kind"],) if row["kind"] in KINDS else ()
    return (apart,) if apart else ("all", *kind, *row["classes"].split())


def _covered(rows: Sequence[Row], name: tuple[str, str, str], times: list[float]) -> Row:
    quantity, part, one = name
    same = [
        row
        for row in rows
        if (row["quantity"], _part(row)) == (quantity, part) and one in _classes(row)
    ]
    array = np.array(times)
    covered = float(np.mean(array <= 1))
    return {
        "quantity": quantity,
        "part": part,
        "class": one,
        "contacts": len(same),
        "covered": covered,
        "probability": float(scipy.stats.binom.cdf(round(covered * len(same)), len(same), LEAST)),
        "beyond_1.5": float(np.mean(array > 1.5)),
        "largest": float(array.max()),
        "mean_bar": float(np.mean([row["declared"] for row in same])),
        "mean_bar_before": _mean([row["before"] for row in same]),
    }


def _mean(values: list[float]) -> float:
    some = [value for value in values if value is not None and math.isfinite(value)]
    return float(np.mean(some)) if some else math.nan


def read_errors(path: Path) -> list[Row]:
    """Return the errors of a record, a CSV file or a compressed one."""
    texts = ("classes", "quantity", "kind", "basis", "resolved", "is_large")
    data = path.read_bytes()
    text = (gzip.decompress(data) if path.suffix == ".gz" else data).decode("utf-8")
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
    "`ehlwave_domain_choice`;\n   !> friction and rolling: times the part by the oil outside.",
}

HEAD = """\
!> Factors of declared errors. Written by `scripts/study accuracy --calibrate`: do not edit.
!>
!> 99 % of the errors of {contacts} contacts are below factor times rule, theory eq. (E1). Errors:
!> postprocess/record/accuracy/sample.csv.gz.
module ehlwave_error_factors
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   integer, parameter, public :: central_film = 1, smallest_film = 2, friction = 3, &
                                 rolling = 4, response = 5, amplitude_ratio = 6
"""
