"""How long stresses below a surface take: ``python -m studies.stress_speed [POINTS]``."""

import resource
import sys
import time
from collections.abc import Callable

import numpy as np

from ehlwave import Contact
from ehlwave.stress import hertz_pressure, stress_below
from ehlwave.surface import trace_surface
from studies.stress import CONTACT

DEPTHS = (8, 32)
TRACE_POINTS = 1024


def measured(name: str, run: Callable[[], object]) -> None:
    """Print what a run takes."""
    wall, cpu = time.perf_counter(), time.process_time()
    run()
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    print(f"{name:40} {wall:8.2f} s, processor {cpu:8.2f} s, peak {memory:.2f} GiB", flush=True)


def main() -> int:
    """Measure; return 0."""
    points = int(sys.argv[1]) if len(sys.argv) > 1 else 1024
    x = np.linspace(-1.5, 1.5, points)
    rough = 0.2 * np.random.default_rng(1).normal(size=(points, points))
    pressure = 1e9 * hertz_pressure(x[:, None], x[None, :], 1, 1) * (1 + rough)
    step = 1e-4 * (x[1] - x[0])
    contact = Contact(**CONTACT, slip_parameter=1.1)
    places = np.arange(TRACE_POINTS) * 1e-6
    waves = sum(np.sin(2e3 * np.pi * n * places + n**2) / n for n in range(10, 60))
    trace = trace_surface(np.asarray(1e-7 * waves), 1e-6)
    name = f"trace of {TRACE_POINTS} points, both bodies"
    measured(f"{name}, first", lambda: contact.stress(trace))
    measured(name, lambda: contact.stress(trace))
    for count in DEPTHS:
        depths = np.linspace(0, 1e-4, count)
        measured(
            f"{points} x {points} at {count} depths",
            lambda depths=depths: stress_below(
                pressure, (step, step), depths, traction_x_pa=0.05 * pressure
            ),
        )
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
