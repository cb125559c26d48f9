"""How a sweep would go on more ranks than there are: its scheduler with measured service times.

``python -m studies.many_ranks SYNTHETIC`` is ``scripts/study many-ranks``. The program SYNTHETIC
(``tests/support/synthetic_sweep.f90``) runs the scheduler and the store with real MPI and real
files on cases that take no time, which gives the time of rank 0 for one case, and on cases that
sleep, beside which the simulation stands first. Then the simulation goes where no machine is.
"""

import dataclasses
import heapq
import os
import re
import subprocess
import tempfile
from collections import deque

import numpy as np
from numpy.typing import NDArray

from studies.command import robustness
from studies.command.options import step_parser
from studies.programs import MPI_ENVIRONMENT, mpi_command

CASES_FOR_SERVICE = 20_000
RANKS_FOR_SERVICE = 16
"""So many that the cases rank 0 computes itself, and plans and stores as others do, are few."""
SPREAD = 0.5
"""Standard deviation of ln(time of a case/expected time); synthetic_sweep draws the same."""


@dataclasses.dataclass(frozen=True)
class Sweep:
    """A sweep to simulate; times in seconds."""

    ranks: int
    cases: int
    mean: float
    """Time of a case."""
    service: float
    """Time of rank 0 for one case: request, answer, outcome and its share of the results file."""
    step: float = 0.02
    """Time step of a case of rank 0, in which it answers nobody."""


def case_times(sweep: Sweep, seed: int = 1) -> NDArray[np.float64]:
    """Return the times of the cases in the order of the queue: longest expected first."""
    random = np.random.default_rng(seed)
    expected = random.lognormal(0, 0.5, sweep.cases)
    times = expected * random.lognormal(0, SPREAD, sweep.cases)
    return np.asarray(times[np.argsort(-expected)] * (sweep.mean / times.mean()))


def makespan(sweep: Sweep) -> float:
    """Return when the last case ends.

    A rank has one case in reserve and asks for the next whenever it begins one; rank 0 answers in
    the order of arrival, between the steps of its own cases, and takes a case when nobody waits.
    """
    times = deque(case_times(sweep).tolist())
    # (time, rank, kind): a message arrives at rank 0 ("ask"), or a case of a worker ends ("end").
    events = [(0.0, rank, "ask") for rank in range(1, sweep.ranks) for _ in range(2)]
    heapq.heapify(events)
    # Of each rank: when a case arrived, and the time that it takes.
    reserve: list[deque[tuple[float, float]]] = [deque() for _ in range(sweep.ranks)]
    is_busy = [False] * sweep.ranks
    clock = last = own = 0.0

    def begin(rank: int, now: float) -> None:
        is_busy[rank] = True
        arrived, seconds = reserve[rank].popleft()
        heapq.heappush(events, (max(now, arrived) + seconds, rank, "end"))

    while events or times or own > 0:
        if not events or (events[0][0] > clock and (own > 0 or times)):
            # Nobody waits: a step of rank 0's own case.
            own = own if own > 0 else times.popleft()
            step = min(own, sweep.step)
            clock, own = clock + step, own - step
            last = max(last, clock)
            continue
        time, rank, kind = heapq.heappop(events)
        if kind == "end":
            last = max(last, time)
            is_busy[rank] = False
            heapq.heappush(events, (time, rank, "ask"))
            if reserve[rank]:
                begin(rank, time)
            continue
        clock = max(clock, time) + sweep.service
        if times:
            reserve[rank].append((clock, times.popleft()))
            if not is_busy[rank]:
                begin(rank, clock)
    return last


def efficiency(sweep: Sweep) -> float:
    """Return the share of the ranks' time that is spent in cases."""
    return sweep.cases * sweep.mean / (sweep.ranks * makespan(sweep))


def measure(program: str, ranks: int, cases: int, mean: float) -> tuple[float, float]:
    """Run the synthetic sweep; return efficiency and processor time of rank 0 for one case, s."""
    with tempfile.TemporaryDirectory() as folder:
        said = subprocess.run(
            [*mpi_command(ranks), program, str(cases), str(mean), "results.h5"],
            cwd=folder,
            env={**os.environ, **MPI_ENVIRONMENT},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
    found = re.search(r"efficiency ([\d.E+-]+);.* ([\d.E+-]+) of them on rank 0", said)
    if not found:
        raise SystemExit(f"{program} did not say what it measured:\n{said}")
    return float(found[1]), float(found[2]) * 1e-3


def main() -> None:
    """Measure, compare, simulate, print."""
    parser = step_parser(robustness.many_ranks, __doc__)
    parser.add_argument("synthetic", help="the program synthetic_sweep of the build")
    chosen = parser.parse_args()

    _, service = measure(chosen.synthetic, RANKS_FOR_SERVICE, CASES_FOR_SERVICE, 0)
    print(f"rank 0: {1e3 * service:.3f} ms for one case, its share of the cases included\n")
    line = "{:>7} {:>9} {:>8}  {:>10} {:>9}"
    print(line.format("ranks", "cases", "mean, s", "efficiency", "measured"))
    for ranks, cases, mean in ((16, 480, 1.0), (64, 1920, 1.0)):
        here, _ = measure(chosen.synthetic, ranks, cases, mean)
        there = efficiency(Sweep(ranks, cases, mean, service))
        print(line.format(ranks, cases, mean, f"{there:.3f}", f"{here:.3f}"))
    cases = chosen.ranks * chosen.cases_per_rank
    for mean in (1.0, 2.5, 5.0, 10.0, 20.0, 60.0):
        found = efficiency(Sweep(chosen.ranks, cases, mean, service))
        print(line.format(chosen.ranks, cases, mean, f"{found:.3f}", ""), flush=True)


if __name__ == "__main__":
    main()
