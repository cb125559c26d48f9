"""The command behind ``scripts/study threads``: threads that share a contact against runs."""

import argparse
import os
import sys
import threading
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import asdict, dataclass
from functools import partial
from statistics import fmean

import numpy as np

from studies.command import costs
from studies.command.options import step_parser
from studies.programs import Groups
from studies.speed import WAVES, Answer, case_groups, number, solved
from studies.sweeps import run_command, write_rows

TIME_STEPS = 32
LENGTH = 4.0
"""Length of the default domain along X: a step in time is as long as a cell."""
ROOTS, ROUNDS = 2**21, 200
"""Square roots, and repetitions: an independent loop, for the limit of the machine itself."""


@dataclass(frozen=True)
class Row:
    """A line of the table; seconds of the fastest runs."""

    work: str
    cells: int
    threads: int
    one_run_s: float
    runs_side_by_side_s: float
    share: float
    """Throughput of one run on all threads, over the throughput of as many runs with one thread
    each.
    """


Run = Callable[[Groups], Answer]


def measure(run: Run, cells: int, threads: int, repeats: int) -> list[Row]:
    """Run a steady state and a march both ways in turn, each `repeats` times."""
    end = {"dynamics": {"end_time": TIME_STEPS * LENGTH / cells}}
    cases = {
        "steady state": case_groups(cells, "auto"),
        f"the same and {TIME_STEPS} time steps": {**case_groups(cells, "auto", WAVES), **end},
    }
    rows = []
    for work, groups in cases.items():
        shared = partial(_seconds, run, _on(threads, groups))
        apart = partial(_side_by_side, run, _on(1, groups), threads)
        rows.append(_row(work, cells, threads, shared, apart, repeats))
    return rows


def machine(threads: int, repeats: int) -> Row:
    """Share square roots among threads that wait for each other after each round, and do not."""
    shared, apart = partial(_shared_roots, threads), partial(_roots_apart, threads)
    return _row("square roots", 0, threads, shared, apart, repeats)


Seconds = Callable[[], float]


def _row(work: str, cells: int, threads: int, shared: Seconds, apart: Seconds, repeats: int) -> Row:
    """Take the fastest of shared and of simultaneous runs, measured in turn."""
    seconds = [(shared(), apart()) for _ in range(repeats)]
    one, many = map(min, zip(*seconds, strict=True))
    return Row(work, cells, threads, one, many, many / one / threads)


def _shared_roots(threads: int) -> float:
    barrier = threading.Barrier(threads)
    with ThreadPoolExecutor(threads) as pool:
        return max(pool.map(_roots, [ROOTS // threads] * threads, [barrier] * threads))


def _roots_apart(processes: int) -> float:
    with ProcessPoolExecutor(processes) as pool:
        return fmean(pool.map(_roots, [ROOTS] * processes))


def _roots(count: int, barrier: threading.Barrier | None = None) -> float:
    """Return the seconds of all rounds."""
    values, roots = np.arange(float(count)), np.zeros(count)
    if barrier:
        barrier.wait()
    start = time.perf_counter()
    for _ in range(ROUNDS):
        np.sqrt(values, out=roots)
        if barrier:
            barrier.wait()
    return time.perf_counter() - start


def _on(threads: int, groups: Groups) -> Groups:
    return {**groups, "solver": {**groups["solver"], "threads": threads}}


def _seconds(run: Run, groups: Groups) -> float:
    return number(run(groups), "seconds")


def _side_by_side(run: Run, groups: Groups, runs: int) -> float:
    """Return the mean seconds of runs that begin together."""
    with ThreadPoolExecutor(runs) as pool:
        return fmean(pool.map(partial(_seconds, run), [groups] * runs))


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, print and write the table; return 0, or 1 with a message."""
    return run_command(step_parser(costs.threads, __doc__), _run, arguments)


def _run(options: argparse.Namespace) -> None:
    threads = options.threads or len(os.sched_getaffinity(0))
    rows = [machine(threads, options.repeats)]
    rows += measure(solved, options.cells, threads, options.repeats)
    for row in rows:
        print(
            f"{row.work:30} {row.one_run_s:.3g} s on {threads} threads, "
            f"{row.runs_side_by_side_s:.3g} s each of {threads} runs: {row.share:.2f}"
        )
    path = options.output / "threads.csv"
    write_rows(path, map(asdict, rows), digits=4)
    print(path)


if __name__ == "__main__":
    sys.exit(main())
