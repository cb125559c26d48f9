"""The command behind ``scripts/study elements``: answers of random elements, and their errors."""

import argparse
import math
import multiprocessing
import os
import re
import resource
import sys
import warnings
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import numpy as np

from ehlwave.elements.answers import REFUSALS
from ehlwave.elements.place import ElementContact
from studies.command import checks
from studies.command.options import step_parser
from studies.elements.draw import KINDS, places
from studies.judged.runs import kept
from studies.sweeps import Row, run_command, write_rows

ANSWERED, WITHIN = 0.98, 0.95
"""Least share of elements that are answered, and of films and friction within their errors."""
COMPUTE_S = 60
"""Most seconds of a processor for each run of a computed contact."""
EXACT = {"viscosity_error": 0.0, "pressure_viscosity_error": 0.0, "conductivity_error": 0.0}
VALUES = ("central", "minimum", "friction")
Answer = dict[str, Any]


def answer(place: ElementContact, by: str) -> Answer:
    """Return film and friction of a contact, their errors and source, or the reason for none."""
    try:
        film = place.contact.film(by=by)
    except REFUSALS as error:
        return {"reason": str(error)[:150]}
    rolls = place.slide_to_roll_ratio == 0
    found: Answer = {"source": film.source[:40]}
    for name, value, error in (
        ("central", film.central_m, film.central_error),
        ("minimum", film.minimum_m, film.minimum_error),
        ("friction", 0.0 if rolls else film.friction, 0.0 if rolls else film.friction_error),
    ):
        if value is not None and error is not None and math.isfinite(value + error):
            found |= {name: value, f"{name}_error": error}
    if "central" not in found or "friction" not in found:
        found["reason"] = f"no {'friction' if 'central' in found else 'film'}"
    return found


def _send(pipe: Connection, place: ElementContact) -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (COMPUTE_S, COMPUTE_S))  # programs inherit it
    start = _processor_s()
    found = answer(place, "computed")
    pipe.send(found | {"seconds": _processor_s() - start})


def computed(place: ElementContact) -> Answer:
    """Return the answer of ``ehlwave-case`` within the limit of processor time."""
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=_send, args=(there, place))
    process.start()
    there.close()
    try:
        return dict(here.recv())
    except EOFError:
        return {"reason": f"more than {COMPUTE_S} s of a processor"}
    finally:
        process.join()


def study(number: int, _folder: Path) -> Row:
    """Return the answers of an element; contacts that no law covers are computed."""
    kind, drawn = places(number)
    found = []
    for index, place in enumerate(drawn):
        first, second = place.speeds_m_per_s
        if first * second < 0 or first + second == 0:
            continue  # surfaces move in opposite directions: the element names these angles
        row = answer(place, "laws")
        if "reason" in row:
            row = {"refused": row["reason"]} | computed(place)
        found.append({"place": index} | row)
    return {"kind": kind, "places": found}


def compared(number: int, _folder: Path) -> Row:
    """Return law and computed values of a random contact of an element, where a law answers.

    The oil's data count as exact: law and program take the same, so that their errors would hide
    differences.
    """
    kind, drawn = places(number)
    place = drawn[int(np.random.default_rng([number]).integers(len(drawn)))]
    place = replace(place, oil=replace(place.oil, **EXACT))
    law = answer(place, "laws")
    row: Row = {"kind": kind, "rolls": place.slide_to_roll_ratio == 0, "law": law}
    return row if "reason" in law else row | {"case": computed(place)}


def times(row: Row, name: str) -> float:
    """Return the difference of law and program over the sum of their errors."""
    law, case = row["law"], row.get("case", {})
    if name not in law or name not in case or (name == "friction" and row["rolls"]):
        return math.nan
    most = law[f"{name}_error"] + case[f"{name}_error"]
    return float(abs(law[name] / case[name] - 1) / most)


def summary(rows: Sequence[Row]) -> list[Row]:
    """Return per kind the shares of elements answered by laws and at all."""
    table = []
    for kind in KINDS:
        own = [row["places"] for row in rows if row["kind"] == kind]
        every = [place for drawn in own for place in drawn]
        table.append(
            {
                "element": kind,
                "elements": len(own),
                "contacts": len(every),
                "contacts_by_law": sum("refused" not in place for place in every),
                "elements_by_law": _share(own, "refused"),
                "elements_answered": _share(own, "reason"),
            }
        )
    return table


def _share(elements: Sequence[Sequence[Answer]], missing: str) -> float:
    done = [all(missing not in place for place in drawn) for drawn in elements]
    return sum(done) / len(done) if done else math.nan


def reasons(rows: Sequence[Row]) -> Counter[str]:
    """Return how often laws refused, by kind and reason without its numbers."""
    return Counter(
        f"{row['kind']}: {re.sub(r'[-+]?[0-9][0-9.e+-]*', '#', place['refused'])}"
        for row in rows
        for place in row["places"]
        if "refused" in place
    )


def _processor_s() -> float:
    found = os.times()
    return found.user + found.system + found.children_user + found.children_system


def main(arguments: Sequence[str] | None = None) -> int:
    """Ask all elements, compare a sample with ``ehlwave-case``; return 1 if too few hold."""
    return run_command(step_parser(checks.elements, __doc__), _run, arguments)


def _run(options: argparse.Namespace) -> int:
    folder, count = Path(options.output), options.contacts
    warnings.simplefilter("ignore")
    rows = kept(folder / "elements.jsonl", range(len(KINDS) * options.elements), study, 1)
    table = summary(rows)
    judged = kept(folder / "compared.jsonl", range(count), compared, 1)
    for name in VALUES:
        off = np.array([times(row, name) for row in judged])
        off = off[np.isfinite(off)]
        table.append(
            {
                "element": f"{name}, law against ehlwave-case",
                "contacts": off.size,
                "within": float(np.mean(off <= 1)) if off.size else math.nan,
                "largest": float(off.max()) if off.size else math.nan,
            }
        )
    write_rows(folder / "elements.csv", table, digits=4)
    for row in table:
        print(
            ", ".join(
                f"{k} {v:.4g}" if isinstance(v, float) else f"{k} {v}" for k, v in row.items()
            )
        )
    for reason, number in reasons(rows).most_common(20):
        print(number, reason)
    few = any(row.get("elements_answered", 1.0) < ANSWERED for row in table)
    return int(few or any(row.get("within", 1.0) < WITHIN for row in table))


if __name__ == "__main__":
    sys.exit(main())
