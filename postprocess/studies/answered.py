"""The command behind ``scripts/study answered``: contacts of catalogues, and the time they take.

Bearings, gears, cams, traction drives, test rigs and a seal; half of them are hot or starved. Each
is asked for its film and for the lambda ratio of a ground trace, with an empty cache and again.
Times are times of the processors, so that a busy machine does not count.
"""

import argparse
import math
import os
import sys
import tempfile
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import ehlwave
from ehlwave import Body, Contact, Oil
from ehlwave.programs import cache
from studies.command import laws
from studies.command.options import step_parser
from studies.sweeps import Row, run_command, write_rows

FILM_S, LAMBDA_S, AGAIN_S = 10.0, 60.0, 1.0
"""Most seconds of the processors, on one core."""
POINTS, STEP_M, RQ_M = 4000, 2e-6, 1e-7


Bodies = tuple[Body, Body]
Speeds = tuple[float, float]


class Asked(NamedTuple):
    """Bodies, oil and the other arguments of :meth:`ehlwave.Contact.from_bodies`."""

    bodies: Bodies
    oil: Oil
    keys: dict[str, Any]


def _steel(radius_x_m: float | None = None, radius_y_m: float | None = None) -> Body:
    radii = {"radius_x_m": radius_x_m, "radius_y_m": radius_y_m}
    known = {name: value for name, value in radii.items() if value is not None}
    return Body(material="steel", **known)


def _ball(diameter_m: float, race_m: float, groove_m: float) -> tuple[Body, Body]:
    return Body.ball(diameter_m, material="steel"), _steel(race_m, -groove_m)


def _rollers(first_m: float, second_m: float | None = None) -> tuple[Body, Body]:
    return _steel(first_m), _steel(second_m)


def _oil(iso_vg: float, celsius: float, eyring_stress_pa: float | None = None) -> Oil:
    more = {} if eyring_stress_pa is None else {"eyring_stress_pa": eyring_stress_pa}
    return Oil.from_grade(iso_vg=iso_vg, temperature_k=273.15 + celsius, **more)


def contacts() -> dict[str, Asked]:
    """Return the contacts by their names."""
    found: dict[str, Asked] = {}

    def add(name: str, bodies: Bodies, oil: Oil, speeds: Speeds, **keys: Any) -> None:  # noqa: ANN401
        found[name] = Asked(bodies, oil, {"speeds_m_per_s": speeds, **keys})

    inner, outer = _ball(11.9e-3, 24.05e-3, 6.19e-3), _ball(11.9e-3, -35.95e-3, 6.31e-3)
    oil = _oil(68, 70)
    add("6208 inner", inner, oil, (7.2, 7.2), load_n=600)
    add("6208 inner, starved", inner, oil, (7.2, 7.2), load_n=600, oil_over_flooded=0.5)
    add("6208 outer, hot", outer, oil, (7.2, 7.2), load_n=600, heat=True)
    bodies = _ball(7.94e-3, -23.5e-3, 4.13e-3)
    add("6205 outer", bodies, _oil(32, 60), (6, 6), load_n=250)
    bodies = _ball(19.05e-3, 30.5e-3, 9.9e-3)
    add("6310 inner, sliding, hot", bodies, _oil(100, 80, 5e6), (5.2, 4.8), load_n=2000, heat=True)
    inner, outer = _ball(12.7e-3, 29e-3, 6.6e-3), _ball(12.7e-3, -42e-3, 6.7e-3)
    add("7210 inner, sliding", inner, _oil(46, 60, 5e6), (9.3, 8.7), load_n=300)
    add("7210 inner, sliding, hot", inner, _oil(46, 60, 5e6), (9.3, 8.7), load_n=300, heat=True)
    add("7210 outer, starved", outer, _oil(46, 60), (9, 9), load_n=300, oil_over_flooded=0.8)
    inner, outer = _rollers(5.5e-3, 24.75e-3), _rollers(5.5e-3, -35.75e-3)
    add("NU 208 inner", inner, oil, (8, 8), load_n_per_m=1.2e5)
    add("NU 208 inner, hot", inner, oil, (8, 8), load_n_per_m=1.2e5, heat=True)
    add("NU 208 outer, starved", outer, oil, (8, 8), load_n_per_m=1.2e5, oil_over_flooded=0.6)
    add("32210 inner", _rollers(7e-3, 31e-3), _oil(150, 80), (5, 5), load_n_per_m=2e5)
    bodies = _steel(5.5e-3, 0.8), _steel(24.75e-3)
    add("crowned roller, starved", bodies, oil, (8, 8), load_n=900, oil_over_flooded=0.7)
    teeth = _oil(220, 80, 5e6)
    add("gear, pitch point", _rollers(12e-3, 24e-3), teeth, (4.1, 4.1), load_n_per_m=2.5e5)
    add("gear, begin of path", _rollers(6e-3, 30e-3), teeth, (2.4, 5.2), load_n_per_m=1.5e5)
    bodies = _rollers(18e-3, 18e-3)
    add("gear, end of path, hot", bodies, teeth, (5.2, 2.6), load_n_per_m=1.5e5, heat=True)
    bodies, newtonian = _rollers(12e-3, 24e-3), _oil(220, 80)
    add("gear, Newtonian, hot", bodies, newtonian, (4.2, 4.0), load_n_per_m=2.5e5, heat=True)
    engine = _oil(100, 90, 5e6)
    add("cam nose", _rollers(10e-3), engine, (1.2, 0.5), load_n_per_m=8e4)
    add("cam flank, hot", _rollers(40e-3), engine, (6, 3), load_n_per_m=3e4, heat=True)
    bodies = _steel(12e-3), _steel(1.0, 1.0)
    add("domed tappet, hot", bodies, engine, (2.2, 0.9), load_n=300, heat=True)
    bodies = _steel(30e-3, 20e-3), _steel(30e-3)
    add("traction drive, hot", bodies, _oil(68, 80, 5e6), (10.2, 9.8), load_n=2500, heat=True)
    ball = Body.ball(19.05e-3, material="steel")
    add(
        "ball on disc, Newtonian, hot",
        (ball, _steel()),
        _oil(46, 40),
        (2.5, 1.5),
        load_n=40,
        heat=True,
    )
    glass = ball, Body(material="glass")
    add("ball on disc, starved", glass, _oil(100, 40), (0.5, 0.5), load_n=20, oil_over_flooded=0.3)
    ring = Body(radius_x_m=2.65e-3, elastic_modulus_pa=1e7, poisson_ratio=0.49)
    add("rod seal", (ring, _steel()), _oil(46, 40), (0.4, 0), load_n_per_m=1500)
    return found


def ground_trace() -> ehlwave.surface.Surface:
    """Return a random trace across grinding marks, Rq 0.1 um."""
    walk = np.cumsum(np.random.default_rng(1).standard_normal(POINTS))
    height = walk - np.convolve(walk, np.ones(101) / 101, "same")
    return ehlwave.surface.trace_surface(height * RQ_M / height.std(), STEP_M, "x", "ground")


def answer(name: str, asked: Asked) -> Row:
    """Return film and lambda ratio of a contact, their errors, sources and times."""
    row: Row = {"contact": name}
    for again in ("", "_again"):
        contact = Contact.from_bodies(*asked.bodies, oil=asked.oil, **asked.keys)
        start = _processor_s()
        film = contact.film()
        row[f"film{again}_s"], start = _processor_s() - start, _processor_s()
        deformed = contact.deform(ground_trace())
        row[f"lambda{again}_s"] = _processor_s() - start
    s = deformed.statistics
    row |= {"central_um": (film.central_m or math.nan) * 1e6, "film_error": film.central_error}
    row |= {"lambda_ratio": s.lambda_ratio_after, "lambda_error": s.lambda_error}
    return row | {"film_source": film.source[:40], "waves": deformed.transfer_name[:60]}


def _processor_s() -> float:
    found = os.times()
    return found.user + found.system + found.children_user + found.children_system


def is_right(row: Row) -> bool:
    """Return whether a contact was answered in time, and at once the second time."""
    most = {
        "film_s": FILM_S,
        "lambda_s": LAMBDA_S,
        "film_again_s": AGAIN_S,
        "lambda_again_s": AGAIN_S,
    }
    return "reason" not in row and all(float(row[name]) <= most[name] for name in most)


def main(arguments: Sequence[str] | None = None) -> int:
    """Ask for all contacts, write ``answered.csv``; return 1 if one has no answer in time."""
    return run_command(step_parser(laws.answered, __doc__), _run, arguments)


def _run(options: argparse.Namespace) -> int:
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        os.environ[cache.FOLDER] = folder
        for name, asked in contacts().items():
            try:
                rows.append(answer(name, asked))
            except ehlwave.EhlwaveError as error:
                rows.append({"contact": name, "reason": str(error)[:200]})
            words = (
                f"{k} {v:.3g}" if isinstance(v, float) else str(v) for k, v in rows[-1].items()
            )
            print(", ".join(words), flush=True)
    write_rows(Path(options.output) / "answered.csv", rows, digits=3)
    right = sum(is_right(row) for row in rows)
    print(f"{right} of {len(rows)} contacts answered in time")
    return int(right < len(rows))


if __name__ == "__main__":
    sys.exit(main())
