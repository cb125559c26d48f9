"""The command behind ``scripts/study elements``: answers of random elements, and their errors."""

import argparse
import math
import re
import sys
import warnings
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from studies.command import checks
from studies.command.options import step_parser
from studies.elements.answers import MOST_PLACES, Answer, by_both, by_laws, by_program
from studies.elements.draw import KINDS
from studies.judged.runs import kept, read_rows
from studies.sweeps import Row, run_command, write_rows

ANSWERED, WITHIN = 0.98, 0.95
"""Least share of elements that are answered, and of films and friction within their errors."""
VALUES = ("central", "minimum", "friction")
POINTS = ("DeepGrooveBallBearing", "AngularContactBallBearing", "BallOnDisc", "MiniTraction")
"""Kinds with elliptical contacts."""


def refused(rows: Sequence[Row]) -> list[int]:
    """Return the numbers of the contacts that no law answers, kinds in turn."""
    return [
        MOST_PLACES * row["number"] + place["place"]
        for row in rows
        for place in row["places"]
        if "reason" in place
    ]


def sample(rows: Sequence[Row], each: int) -> list[int]:
    """Return contacts that a law answers: a random one of each of the first elements of a kind.

    In addition all contacts beyond those that the laws of heat were fitted to. Lines come first.
    """
    found, counts = [], Counter[str]()
    for row in rows:
        known = [place["place"] for place in row["places"] if "reason" not in place]
        if not known or counts[row["kind"]] == each:
            continue
        counts[row["kind"]] += 1
        place = int(np.random.default_rng([row["number"]]).choice(known))
        found.append(MOST_PLACES * row["number"] + place)
    ends = [
        MOST_PLACES * row["number"] + place["place"]
        for row in rows
        for place in row["places"]
        if "beyond" in place
    ]
    own = sorted(found, key=lambda number: _is_point(rows, number))
    return [*own, *(number for number in ends if each and number not in own)]


def _is_point(rows: Sequence[Row], number: int) -> bool:
    """Return whether a contact is a point, which takes longer to compute than a line."""
    return rows[number // MOST_PLACES]["kind"] in POINTS


def times(row: Row, name: str) -> float:
    """Return the difference of law and program over the sum of their errors."""
    law, case = row["law"], row["case"]
    if name not in law or name not in case or (name == "friction" and row["slip"] == 0):
        return math.nan
    most = law[f"{name}_error"] + case[f"{name}_error"]
    return float(abs(law[name] / case[name] - 1) / most)


def contact(row: Row) -> Row:
    """Return a compared contact: differences over both errors, by value."""
    found = {name: row[name] for name in ("number", "kind", "m", "l", "d", "slip")}
    found["beyond"] = row.get("beyond")
    found |= {name: times(row, name) for name in VALUES}
    return found | {"reason": row["case"].get("reason")}


def summary(rows: Sequence[Row], computed: Mapping[int, Answer]) -> list[Row]:
    """Return per kind the shares of elements answered by laws, and by laws or computed.

    A contact that no law answers and that has not been computed counts as not answered.
    """
    kinds = {kind: [row for row in rows if row["kind"] == kind] for kind in KINDS}
    return [_shares(kind, own, computed) for kind, own in kinds.items() if own]


def _shares(kind: str, rows: Sequence[Row], computed: Mapping[int, Answer]) -> Row:
    left = [refused([row]) for row in rows]
    missing: Answer = {"reason": "not computed"}
    found = [[computed.get(number, missing) for number in own] for own in left]
    answered = [all("reason" not in one for one in own) for own in found]
    contacts = sum(len(row["places"]) for row in rows)
    return {
        "element": kind,
        "elements": len(rows),
        "contacts": contacts,
        "contacts_by_law": contacts - sum(map(len, left)),
        "elements_by_law": sum(not own for own in left) / len(rows),
        "contacts_not_computed": sum(own.count(missing) for own in found),
        "elements_answered": sum(answered) / len(rows),
    }


def compared(judged: Sequence[Row]) -> list[Row]:
    """Return the shares of films and friction of laws within the errors.

    By kind and in all, and of contacts beyond the fit by the quantity.
    """
    ends = sorted({row["beyond"] for row in judged if "beyond" in row})
    table = []
    for kind in (*KINDS, "all", *ends):
        own = [
            row
            for row in judged
            if kind == row.get("beyond") or ("beyond" not in row and kind in ("all", row["kind"]))
        ]
        for name in VALUES:
            off = np.array([times(row, name) for row in own])
            off = off[np.isfinite(off)]
            row = {"element": kind, "value": name, "compared": off.size}
            if off.size:
                row |= {"within": float(np.mean(off <= 1)), "largest": float(off.max())}
                table.append(row)
    return table


def reasons(rows: Sequence[Row]) -> Counter[str]:
    """Return how often laws refused, by kind and reason without its numbers."""
    return Counter(
        f"{row['kind']}: {re.sub(r'[-+]?[0-9][0-9.e+-]*', '#', place['reason'])}"
        for row in rows
        for place in row["places"]
        if "reason" in place
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Ask all elements, compare a sample with ``ehlwave-case``; return 1 if too few hold."""
    return run_command(step_parser(checks.elements, __doc__), _run, arguments)


def _run(options: argparse.Namespace) -> int:
    folder = Path(options.output)
    warnings.simplefilter("ignore")
    rows = kept(folder / "laws.jsonl", range(len(KINDS) * options.elements), by_laws, 1)
    for reason, number in reasons(rows).most_common(20):
        print(number, reason, flush=True)
    if not options.report:
        kept(folder / "compared.jsonl", sample(rows, options.contacts), by_both, 1)
        kept(folder / "computed.jsonl", refused(rows)[: options.computed], by_program, 1)
    beside = read_rows(folder / "compared.jsonl")
    write_rows(folder / "contacts.csv", [contact(row) for row in beside], digits=4)
    judged = compared(beside)
    done = read_rows(folder / "computed.jsonl")
    table = summary(rows, {row["number"]: row for row in done})
    write_rows(folder / "elements.csv", table, digits=4)
    write_rows(folder / "compared.csv", judged, digits=4)
    for row in (*table, *judged):
        cells = (f"{k} {v:.4g}" if isinstance(v, float) else f"{k} {v}" for k, v in row.items())
        print(", ".join(cells))
    few = any(row["elements_answered"] < ANSWERED for row in table)
    return int(few or any(row["within"] < WITHIN for row in judged if row["element"] == "all"))


if __name__ == "__main__":
    sys.exit(main())
