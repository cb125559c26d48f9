"""Coverage of errors left out, by class."""

import math
from collections.abc import Sequence

import numpy as np
import scipy

from studies.calibrate.factors import (
    APART,
    DOMAIN,
    KINDS,
    apart,
    declared,
    factors,
    key_of,
    ratio,
)
from studies.sweeps import Row

CHANCE = 0.05
"""Probability that any class is so far outside `LEAST` to `MOST` by chance: smaller ones count."""
LEAST, MOST = 0.975, 0.998
"""Least and largest coverage."""
HALVES, SEED = 20, 7


def coverage(rows: Sequence[Row], table: dict[str, float]) -> list[Row]:
    """Return the coverage of contacts by factors of random halves without them, by class."""
    rng = np.random.default_rng(SEED)
    contacts = sorted({row["contact"] for row in rows})
    held: dict[tuple[str, str, str], list[float]] = {}
    for _ in range(HALVES):
        half = set(rng.permutation(contacts)[: len(contacts) // 2])
        fitted = factors([row for row in rows if row["contact"] in half], table)
        for row in rows:
            if row["contact"] in half:
                continue
            times = ratio(row, fitted) / fitted.get(key_of(row), 1.0)
            for one in _classes(row):
                held.setdefault((row["quantity"], _part(row), one), []).append(times)
    return [_covered(rows, table, name, times) for name, times in sorted(held.items())]


def _part(row: Row) -> str:
    """Return the part of the error."""
    return DOMAIN if row["kind"] == DOMAIN else "mesh"


def _classes(row: Row) -> tuple[str, ...]:
    """Return the classes of an error, its kind among them."""
    warned = apart(row)
    kind = (row["kind"],) if row["kind"] in KINDS else ()
    return (warned,) if warned else ("all", *kind, *row["classes"].split())


def _covered(
    rows: Sequence[Row], table: dict[str, float], name: tuple[str, str, str], times: list[float]
) -> Row:
    quantity, part, one = name
    same = [
        row
        for row in rows
        if (row["quantity"], _part(row)) == (quantity, part) and one in _classes(row)
    ]
    array, count = np.array(times), len(same)
    covered = float(np.mean(array <= 1))
    whole = round(covered * count)
    both = [row for row in same if math.isfinite(row["before"])]
    now = _mean([declared(row, table) for row in both])
    return {
        "quantity": quantity,
        "part": part,
        "class": one,
        "contacts": count,
        "covered": covered,
        "probability": float(scipy.stats.binom.cdf(whole, count, LEAST)),
        "probability_above": float(scipy.stats.binom.sf(whole - 1, count, MOST)),
        "beyond_1.5": float(np.mean(array > 1.5)),
        "largest": float(array.max()),
        "mean_bar": _mean([declared(row, table) for row in same]),
        "over_before": now / _mean([row["before"] for row in both]),
    }


def _mean(values: list[float]) -> float:
    return float(np.mean(values)) if values else math.nan


def deviating(held_out: Sequence[Row]) -> list[Row]:
    """Return the classes whose coverage is outside `LEAST` to `MOST` by more than chance.

    The probability counts the number of classes that are judged.
    """
    some = [row for row in held_out if row["class"] not in APART]
    return [
        row
        for row in some
        if min(row["probability"], row["probability_above"]) < CHANCE / len(some)
    ]
