"""The command behind ``scripts/study peers``: a contact by this program and by public solvers."""

import argparse
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from itertools import cycle
from pathlib import Path

from matplotlib.figure import Figure

from ehlwave.results.colour_key import COLOURS
from ehlwave.results.figures import write_figure
from studies import peer_runs
from studies.command import costs
from studies.command.options import step_parser
from studies.peer_runs import BOOK, FailedError, Found, mourier
from studies.sweeps import run_command, write_rows

CELLS = 32, 64, 128, 256, 512, 1024, 2048
LIMIT_CELLS = 512
"""Cells from which the film for mesh size 0 is found, at least."""
ORDER = 2
HOUR_S = 3600.0
WHOLE = "ehlwave, whole domain"
QUICK = 4
"""Relaxations on the coarsest grid with which the book's program does, too."""

Run = Callable[[int], Found]
"""Runs a solver on so many cells along each side."""


@dataclass(frozen=True)
class Row:
    """A run: film in um (of the book H), and its distance from the film at mesh size 0.

    ``times`` is the time of another solver in units of ``at_equal_error``.
    """

    contact: str
    solver: str
    cells: int
    film: float
    error: float
    seconds: float
    message: str = ""
    times: float | None = None


def solvers(options: argparse.Namespace) -> Iterator[tuple[str, str, Run]]:
    """Yield contact, name and run of each available solver; report skipped solvers."""
    limit = options.limit or HOUR_S
    quick_book = partial(peer_runs.book, coarsest=QUICK)
    peers = (
        ("EHL-FBNS", "mourier", "--fbns", options.fbns, peer_runs.fbns),
        ("slippy", "mourier", "--slippy", options.slippy, peer_runs.slippy),
        ("book", "book", "--book", options.book, peer_runs.book),
        (f"book, {QUICK} relaxations", "book", "--book", options.book, quick_book),
    )
    there = []
    for name, contact, option, path, run in peers:
        if path is None:
            print(f"{name}: skipped, no {option} was given")
        elif not path.exists():
            print(f"{name}: skipped, there is no {path}")
        else:
            there.append((contact, name, partial(run, path, limit=limit)))
    for contact, groups in (("mourier", mourier()), ("book", BOOK)):
        if contact == "book" and not any(one == "book" for one, *_ in there):
            continue
        yield contact, "ehlwave", partial(peer_runs.ehlwave, groups)
        whole = partial(peer_runs.ehlwave, groups, domain="whole")
        yield contact, WHOLE, whole
        yield contact, f"{WHOLE}, fitted", partial(whole, scheme="fitted")
    yield from there


def limit_of(contact: str, cells: int) -> float:
    """Return the film for mesh size 0, from grids of so many and half as many cells."""
    run = partial(peer_runs.ehlwave, BOOK if contact == "book" else mourier())
    coarse, fine = (run(n)[0] for n in (cells // 2, cells))
    return fine + (fine - coarse) / (2**ORDER - 1)


def measure(
    table: Iterator[tuple[str, str, Run]], cells: Sequence[int], limits: Callable[[str], float]
) -> Iterator[Row]:
    """Run every solver on every grid; after a failure or timeout it runs on no finer grid."""
    known: dict[str, float] = {}
    for contact, solver, run in table:
        if contact not in known:
            known[contact] = limits(contact)
        for n in cells:
            try:
                film, seconds = run(n)
            except FailedError as error:
                yield Row(contact, solver, n, float("nan"), float("nan"), float("nan"), str(error))
                break
            yield Row(contact, solver, n, film, abs(film / known[contact] - 1), seconds)


def at_equal_error(row: Row, rows: Sequence[Row]) -> float | None:
    """Return the time of this program's cheapest run that is no farther off, of the same domain."""
    own = [one for one in rows if one.contact == row.contact and one.solver.startswith(WHOLE)]
    return min((one.seconds for one in own if one.error <= row.error), default=None)


def compared(rows: Sequence[Row]) -> Iterator[Row]:
    """Yield the rows, with the relative times of other solvers."""
    for row in rows:
        own = None if row.solver.startswith("ehlwave") else at_equal_error(row, rows)
        yield row if own is None else replace(row, times=row.seconds / own)


def figure_of(rows: Sequence[Row]) -> Figure:
    """Return error against processor time, a line for each solver."""
    figure = Figure(figsize=(4.4, 3.2), layout="constrained")
    axes = figure.subplots()
    lines = dict.fromkeys((row.contact, row.solver) for row in rows)
    for (contact, solver), colour, mark in zip(
        lines, cycle(COLOURS), cycle("os^Dv<"), strict=False
    ):
        line = [row for row in rows if (row.contact, row.solver) == (contact, solver)]
        name = solver if contact == "mourier" else f"{solver} ({contact})"
        seconds, errors = [row.seconds for row in line], [row.error for row in line]
        axes.loglog(seconds, errors, color=colour, marker=mark, markersize=4, label=name)
    axes.set_xlabel("processor time [s]")
    axes.set_ylabel("relative error of the central film")
    axes.legend(fontsize="x-small", frameon=False)
    return figure


def _run(options: argparse.Namespace) -> None:
    rows = []
    cells = [n for n in CELLS if n <= options.largest]
    limit = partial(limit_of, cells=max(LIMIT_CELLS, *cells))
    for row in measure(solvers(options), cells, limit):
        rows.append(row)
        said = row.message or f"film {row.film:.6g}, error {row.error:.4f}, {row.seconds:.2f} s"
        print(f"{row.contact:8} {row.solver:30} {row.cells:4} cells: {said}", flush=True)
    folder: Path = options.output
    write_rows(folder / "peers.csv", map(asdict, compared(rows)), digits=5)
    write_figure(figure_of(rows), folder, "peers", dots_per_inch=150)
    print(folder / "peers.csv")


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, print, write table and figure; return 0, or 1 with a message."""
    return run_command(step_parser(costs.peers, __doc__), _run, arguments)


if __name__ == "__main__":
    sys.exit(main())
