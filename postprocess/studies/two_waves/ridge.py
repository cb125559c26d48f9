"""Ridges and dimples that slide through a contact: simulated, and predicted from both waves.

The surface is low, 5 per cent of the film, so that a march in time is linear. Predictions are the
law, which needs no simulation, and both waves of a sweep of linear responses at these conditions.
"""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from ehlwave.contact import read_contact
from ehlwave.deform import (
    Conditions,
    Mover,
    Surface,
    TwoWaveTransfer,
    conditions_from_keys,
    film_profile,
    trace_surface,
)
from ehlwave.errors import ResultsError
from ehlwave.two_waves import TwoWaves
from studies import sweeps

Floats = NDArray[np.float64]

CONTACT = {
    "radius_x_m": 12.5e-3,
    "radius_y_m": 12.5e-3,
    "reduced_modulus_pa": 226e9,
    "load_n": 20.0,
    "mean_speed_m_per_s": 0.5,
    "viscosity_pa_s": 0.1,
}
"""As inputs/sliding.nml."""

STRESS_PA = 5e6
SLIPS = (1.3, 0.7)
SHAPES = ("ridge", "groove")
SHARE = 0.05
"""Height over film."""

WAVELENGTHS = tuple(float(x) for x in np.geomspace(0.2, 8.0, 24).round(4))
WAVES, MARCHES, SMOOTH = "sliding_waves", "sliding_ridges", "sliding_smooth"
ALONG = "sliding_along"
"""Names of the sweeps."""

HALF_WIDTH = 0.25
"""Of the ridge, in units of a: height exp(-(x/0.25 a)^2)."""

LENGTH = 6.0
"""Of the surface, in units of a, the ridge in its middle."""

X_MIN, PLACE = -2.5, 0.1
"""Where the leading end of the surface starts, and where its middle is at the end, X."""

WINDOW = 0.5
"""Of |X|, within which profiles are compared."""


def conditions_at(slip: float, film_m: float | None = None) -> Conditions:
    """Return the contact at this slip, with the computed film where it is known."""
    known = {} if film_m is None else {"central_film_m": film_m}
    keys = {"pressure_viscosity_per_pa": 2.2e-8, "eyring_stress_pa": STRESS_PA}
    return conditions_from_keys({**CONTACT, **keys, **known, "slip_parameter": slip})


def shape(name: str, film_m: float) -> Surface:
    """Return a ridge or groove across rolling as a trace; heights 5 per cent of the film."""
    a_m = conditions_at(1.0).semi_axis_a_m
    step = a_m / 64
    x = np.arange(round(LENGTH * 64) + 1) * step
    sign = 1 if name == "ridge" else -1
    hill = np.exp(-(((x - x[-1] / 2) / (HALF_WIDTH * a_m)) ** 2))
    return trace_surface(sign * SHARE * film_m * hill, step, name=name)


def write_cases(folder: Path, cells: int = 128) -> list[str]:
    """Write the sweep of linear responses and that of marches; return their names."""
    shared = {
        "conditions": CONTACT,
        "lubricant": {"flow_law": "eyring", "eyring_stress_pa": STRESS_PA},
        "grid": {"cells_x": cells, "cells_y": cells, "edges": "flooded"},
    }
    waviness = {"orientation": "transverse", "response": "harmonic"}
    rows: list[sweeps.Row] = [
        {"slip_parameter": slip, "wavelength_over_a": wave}
        for slip in SLIPS
        for wave in WAVELENGTHS
    ]
    sweeps.write_sweep(folder, WAVES, rows, {**shared, "waviness": waviness})
    film_m = float(conditions_at(1.0).central_film_m or np.nan)
    rows = []
    for slip in SLIPS:
        for name in SHAPES:
            path = sweeps.write_surface(folder, shape(name, film_m))
            place = {"file": str(path.resolve()), "end_time": end_time(slip)}
            rows.append({"slip_parameter": slip, **place})
    march = {**shared, "solver": {"error_estimate": "model"}, "output": {"fields": True}}
    sweeps.write_sweep(folder, MARCHES, rows, march)
    sweeps.write_sweep(folder, SMOOTH, [{"slip_parameter": slip} for slip in SLIPS], march)
    _write_along(folder, cells)
    return [WAVES, MARCHES, SMOOTH, ALONG]


def _write_along(folder: Path, cells: int) -> None:
    """Write the two cases of which the film along the contact is drawn: both oils."""
    groups = {
        "conditions": {**CONTACT, "slip_parameter": SLIPS[0]},
        "waviness": {"orientation": "transverse", "response": "harmonic"},
        "grid": {"cells_x": cells, "cells_y": cells, "edges": "flooded"},
        "output": {"fields": True},
    }
    oils: list[sweeps.Row] = [
        {"flow_law": "newtonian"},
        {"flow_law": "eyring", "eyring_stress_pa": STRESS_PA},
    ]
    rows = [{"wavelength_over_a": 0.7, **oil} for oil in oils]
    sweeps.write_sweep(folder, ALONG, rows, groups)


def end_time(slip: float) -> float:
    """Return the T at which the middle of the surface is at X = ``PLACE``."""
    return (PLACE - X_MIN + LENGTH / 2) / slip


@dataclass(frozen=True)
class ComputedWaves:
    """Both waves of transverse patterns, interpolated between computed responses of one contact.

    Stands for a :class:`ehlwave.deform.TwoWaveTransfer`. Interpolated against the wave number are
    a, psi - kx, and c exp(-i (psi - kx)), which turns slowly; a and psi are the closed forms at the
    computed contact centre, c what a leaves of the film there. Longer waves than the longest fade
    to nothing, shorter ones than the shortest are left as they are.
    """

    conditions: Conditions
    table: pd.DataFrame
    name: str = "computed waves"

    def waves(self, per_length_x: Floats, per_length_y: Floats) -> TwoWaves:
        """Return both waves for waves per metre along x."""
        kx = 2 * np.pi * per_length_x * self.conditions.semi_axis_a_m
        rows = self.table.sort_values("wavelength_over_a", ascending=False)
        known = 2 * np.pi / rows["wavelength_over_a"].to_numpy()
        a, psi, film = (
            rows[f"{name}_real"].to_numpy() + 1j * rows[f"{name}_imaginary"].to_numpy()
            for name in ("attenuated_formula", "psi_formula", "harmonic")
        )
        c, mismatch = film - a, psi - known
        grid = np.append(0.0, known)
        own = np.interp(kx, grid, np.append(0.0, a))
        between = np.interp(kx, grid, np.append(0.0, mismatch))
        launched = np.interp(kx, grid, np.append(0.0, c * np.exp(-1j * mismatch)))
        shorter = kx > known[-1]
        own[shorter], launched[shorter] = 1.0, 0.0
        return TwoWaves(own, launched * np.exp(1j * between), kx, kx + between)

    def ratio(self, per_length_x: Floats, per_length_y: Floats) -> NDArray[np.complex128]:
        """Return 0: what stands still is not in these surfaces."""
        return np.zeros(np.shape(per_length_x), dtype=complex)


@dataclass(frozen=True)
class Passing:
    """A shape in the contact at one time: film less the smooth one over its height, against X."""

    name: str
    slip: float
    x: Floats
    surface: Floats
    lines: dict[str, Floats]

    def error(self, prediction: str) -> float:
        """Return the rms error of a prediction over the Rq of the surface, both within WINDOW."""
        inside = np.abs(self.x) <= WINDOW
        left = (self.lines[prediction] - self.lines["simulated"])[inside]
        return float(np.sqrt(np.mean(left**2)) / np.std(self.surface[inside]))


def passings(folder: Path) -> list[Passing]:
    """Return every shape at every slip.

    Raises
    ------
    ResultsError
        If a sweep has not been run, or a case did not converge.
    """
    waves = pd.DataFrame(sweeps.read_sweep(folder, WAVES, len(SLIPS) * len(WAVELENGTHS)))
    marches = sweeps.read_sweep(folder, MARCHES, len(SLIPS) * len(SHAPES))
    still = sweeps.read_sweep(folder, SMOOTH, len(SLIPS))
    names = [(slip, name) for slip in SLIPS for name in SHAPES]
    found = []
    for (slip, name), row in zip(names, marches, strict=True):
        if row["status"] not in ("converged", "unresolved"):
            raise ResultsError(f"{name} at S = {slip:g}: status {row['status']}")
        table = waves[np.isclose(waves["slip_parameter"], slip)]
        cases = (row, still[SLIPS.index(slip)])
        found.append(_passing(folder, name, slip, cases, table))
    return found


def _passing(
    folder: Path,
    name: str,
    slip: float,
    cases: tuple[sweeps.Row, sweeps.Row],
    table: pd.DataFrame,
) -> Passing:
    row, smooth = cases
    a_m = conditions_at(slip).semi_axis_a_m
    scale = float(conditions_at(slip).hertz_approach_c_m or np.nan)
    known = conditions_at(slip, float(row["central_film"]) * scale)
    moved = shape(name, float(conditions_at(1.0).central_film_m or np.nan))
    x, film = _line(sweeps.fields_file(folder, MARCHES, row))
    _, still = _line(sweeps.fields_file(folder, SMOOTH, smooth))
    near = np.abs(x) <= 1
    height = SHARE * float(conditions_at(1.0).central_film_m or np.nan)
    at_centre = (LENGTH / 2 - PLACE) * a_m
    lines = {"simulated": (film - still)[near] * scale / height}
    for label, transfer in (
        ("computed waves", ComputedWaves(known, table)),
        ("law", TwoWaveTransfer(known)),
    ):
        mover = Mover(moved, transfer, at_centre)
        profile = film_profile([mover], x[near] * a_m, 0.0)
        lines[label] = (profile - float(known.central_film_m or np.nan)) / height
    place = np.arange(moved.height.shape[0]) * moved.step_x_m
    surface = np.interp(at_centre + x[near] * a_m, place, moved.height[:, 0]) / height
    return Passing(name, slip, x[near], surface, lines)


def _line(path: Path) -> tuple[Floats, Floats]:
    """Return X, and H along Y = 0."""
    fields = read_contact(path)
    middle = int(np.argmin(np.abs(fields["y"].values)))
    return fields["x"].values, fields["film"].values[middle]


if __name__ == "__main__":
    print(" ".join(write_cases(Path(sys.argv[1]))))
