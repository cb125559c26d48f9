"""A contact by this program and by public solvers, each unchanged.

The contact is the smooth case of Mourier and others (2006), an example of EHL-FBNS. Other solvers
run in a temporary copy; their own folders stay unchanged.
"""

import json
import math
import os
import re
import resource
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from ehlwave.writing import Writer, write_new_text
from studies.programs import Groups, last_line, processor_seconds

RADIUS_M = 12.5e-3
MODULUS_PA = 110e9
LOAD_N = 15.0
SPEED_M_PER_S = 0.09
VISCOSITY_PA_S = 0.25
ALPHA_PER_PA = 22e-9
WIDTH = 3
"""Half the side of the square domain over the radius of the Hertzian contact."""

BOOK: Groups = {
    "conditions": {"load_parameter_m": 20, "lubricant_parameter_l": 10, "radius_ratio_d": 1},
    "lubricant": {"viscosity_law": "barus", "density_law": "incompressible"},
    "grid": {"edges": "truncated", "x_min": -4.5, "x_max": 1.5, "y_max": 3},
}
"""The case of Venner and Lubrecht's book, with its domain."""

Found = tuple[float, float]
"""Film at the contact centre (um, of the book H), and processor time in seconds."""


class FailedError(Exception):
    """A solver has no film, and this is why."""


def hertz_radius() -> float:
    """Return the radius of the Hertzian contact in m."""
    return (1.5 * LOAD_N * RADIUS_M / MODULUS_PA) ** (1 / 3)


def mourier() -> Groups:
    """Return the input of this program."""
    return {
        "conditions": {
            "radius_x_m": RADIUS_M,
            "radius_y_m": RADIUS_M,
            "reduced_modulus_pa": MODULUS_PA,
            "load_n": LOAD_N,
            "mean_speed_m_per_s": SPEED_M_PER_S,
            "viscosity_pa_s": VISCOSITY_PA_S,
        },
        "lubricant": {"pressure_viscosity_per_pa": ALPHA_PER_PA},
        "grid": {"edges": "truncated", "x_min": -WIDTH, "x_max": WIDTH, "y_max": WIDTH},
    }


def ehlwave(groups: Groups, cells: int, **grid_and_solver: str) -> Found:
    """Run this program on one core; keys of ``grid`` and ``solver`` may be given."""
    given: dict[str, Mapping[str, object]] = {name: dict(keys) for name, keys in groups.items()}
    domain = {"domain": grid_and_solver.pop("domain", "auto")}
    given["grid"] = {**given["grid"], **domain, "cells_x": cells, "cells_y": cells}
    given["solver"] = {"threads": 1, **grid_and_solver}
    outcome, seconds = processor_seconds(given, 1, "--json", "--quiet")
    if outcome.returncode != 0:
        said = outcome.stderr.strip()
        if outcome.stdout and not said:
            said = str(last_line(outcome)["message"])
        raise FailedError(said[-200:] or f"exit status {outcome.returncode}")
    film = float(last_line(outcome)["central_film"])
    scale = 1e6 * hertz_radius() ** 2 / RADIUS_M if groups is not BOOK else 1.0
    return scale * film, seconds


def timed(command: Sequence[object], folder: Path, limit: float) -> Found:
    """Run a solver of others; return the film that it prints behind ``film``, and its time."""
    one_thread = {f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "NUMBA", "MKL")}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(
            list(map(str, command)),
            cwd=folder,
            env={**os.environ, **one_thread, "PYTHONPATH": ""},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
            timeout=limit,
        )
    except subprocess.TimeoutExpired as error:
        raise FailedError(f"stopped after {limit:.0f} s") from error
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    found = re.findall(r"(?m)^film ([-+.\deE]+)$", done.stdout)
    if not found or not math.isfinite(float(found[-1])):
        said = (done.stderr or done.stdout).strip() or "no film"
        raise FailedError(said.splitlines()[-1][-300:])
    return float(found[-1]), after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def fbns(folder: Path, cells: int, limit: float) -> Found:
    """Run EHL-FBNS in GNU Octave: its Study A, steady, with QUICK, on so many cells.

    Octave needs functions of scripts in files of their own and lacks ``compose``.
    """
    octave = shutil.which("octave-cli")
    if octave is None:
        raise FailedError("there is no octave-cli")
    setup = (folder / "code" / "EHL_01_setup_Study_A_gen.m").read_text(encoding="utf-8")
    main = (folder / "code" / "EHL_02_mainprocess.m").read_text(encoding="utf-8")
    setup, sizes = re.subn(r"(geo\.Nx[12]\s*=\s*)\d+;", rf"\g<1>{cells + 1};", setup)
    setup, steady = re.subn(r"(alg\.flag_unsteady\s*=\s*)true;", r"\1false;", setup)
    if (sizes, steady) != (2, 1):
        raise FailedError("its setup is not the one that is known")
    begins = [
        match.start()
        for match in re.finditer(r"(?m)^function ", main)
        if re.search(r"(?m)^end\s*\Z", main[: match.start()])
    ]
    with tempfile.TemporaryDirectory() as name:
        code = Path(name, "code")
        Writer().folder(code)
        for first, last in zip(begins, [*begins[1:], None], strict=True):
            text = main[first:last]
            function = re.match(r"function (?:[^=\n]*= *)?(\w+)", text)
            write_new_text(code / f"{function[1] if function else ''}.m", text)
        write_new_text(code / "mainprocess.m", main[: begins[0]])
        write_new_text(code / "setup.m", setup)
        write_new_text(code / "compose.m", COMPOSE)
        write_new_text(code / "peer.m", PEER.format(speed=SPEED_M_PER_S))
        return timed([octave, "--quiet", "peer.m"], code, limit)


COMPOSE = """function text = compose(varargin)
  text = {sprintf(varargin{:})};
end
"""
PEER = """confirm_recursive_rmdir(false);
autorun.sim.it = 1;
autorun.alg.Sim_ID = {{'peer'}};
autorun.opc.u_m_ini = {speed};
autorun.opc.srr_ini = 0;
autorun.alg.FBNS.flag_Couette_Discrete = 2;
setup
mainprocess
printf('film %.10g\\n', 1e6*h.h_ma((h.Nx1 + 1)/2, (h.Nx2 + 1)/2));
"""


def slippy(folder: Path, cells: int, limit: float) -> Found:
    """Run slippy by the Python of the environment in this folder."""
    data = {
        **{"radius": RADIUS_M, "modulus": MODULUS_PA, "load": LOAD_N, "speed": SPEED_M_PER_S},
        **{"viscosity": VISCOSITY_PA_S, "alpha": ALPHA_PER_PA, "points": cells + 1, "width": WIDTH},
    }
    with tempfile.TemporaryDirectory() as name:
        script = Path(name, "peer.py")
        own = Path(__file__).with_name("peer_slippy.py").read_text(encoding="utf-8")
        write_new_text(script, own)
        python = folder / "bin" / "python"
        return timed([python, script, json.dumps(data)], Path(name), limit)


def book(program: Path, cells: int, limit: float, coarsest: int = 40) -> Found:
    """Run the book's program, as the user typed it in.

    Its arguments are the cells and the relaxations on the coarsest grid, 40 as printed.
    """
    with tempfile.TemporaryDirectory() as name:
        return timed([program, cells, coarsest], Path(name), limit)
