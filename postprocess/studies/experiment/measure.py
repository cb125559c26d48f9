"""Measures of the results of the experiment, in micrometres."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from ehlwave.results.case_file import read_contact
from studies.experiment.cases import GRIDS, Run
from studies.experiment.stage import finished
from studies.experiment.trace import AMPLITUDE_UM, WAVELENGTH_UM
from studies.sweeps import fields_file

Floats = NDArray[np.float64]

CENTRAL_WAVES = 3
"""Whole waves of the central region: 180 um about the centre, half of the contact."""

HARMONICS = 3


@dataclass(frozen=True)
class Solved:
    """A run: fields of its last solution, history at the contact centre."""

    run: Run
    result: dict[str, Any]
    a_um: float
    c_um: float
    hertz_pressure_pa: float
    x: Floats
    y: Floats
    film: Floats
    """H, shape (y, x), on the whole domain."""
    pressure: Floats
    time: Floats
    film_at_centre: Floats

    @property
    def line_x_um(self) -> Floats:
        """Positions along the centre line, um."""
        return self.x * self.a_um

    @property
    def line_um(self) -> Floats:
        """Film along the centre line y = 0, um."""
        return self.film[int(np.argmin(np.abs(self.y)))] * self.c_um


@dataclass(frozen=True)
class Value:
    """A value extrapolated to mesh size 0, and its distance from the value on the finest grid."""

    value: float
    error: float
    coarse: float
    fine: float

    def less(self, other: "Value") -> "Value":
        """Return the difference to another value; errors add up."""
        return Value(
            self.value - other.value,
            self.error + other.error,
            self.coarse - other.coarse,
            self.fine - other.fine,
        )


@cache
def read_solved(folder: Path, run: Run) -> Solved:
    """Read a finished run, once.

    Raises ResultsError if the run is not finished, or did not converge on a grid that resolves it.
    """
    result = finished(folder, run)
    fields = read_contact(fields_file(folder, run.surface, result))
    has_history = "time" in fields
    return Solved(
        run=run,
        result=result,
        a_um=float(fields["semi_axis_a_m"]) * 1e6,
        c_um=float(fields["hertz_approach_c_m"]) * 1e6,
        hertz_pressure_pa=float(fields["hertz_pressure_pa"]),
        x=fields["x"].values,
        y=fields["y"].values,
        film=fields["film"].values,
        pressure=fields["pressure"].values,
        time=fields["time"].values if has_history else np.zeros(0),
        film_at_centre=fields["film_at_centre"].values if has_history else np.zeros(0),
    )


def extrapolated(
    folder: Path, surface: str, speed: float, measure: Callable[[Solved], float]
) -> Value:
    """Return a measure at mesh size 0, from the two grids, its error of second order (Richardson).

    The order of the discretisation, observed as 1.8 to 2.0.
    """
    grids = sorted(GRIDS)
    values = [measure(read_solved(folder, Run(surface, speed, *grid))) for grid in grids]
    return richardson(values[0], values[1], grids[1][0] / grids[0][0])


def richardson(coarse: float, fine: float, ratio: float) -> Value:
    """Return the limit of values with an error of second order; ``ratio`` of the mesh sizes."""
    limit = fine + (fine - coarse) / (ratio**2 - 1)
    return Value(limit, abs(limit - fine), coarse, fine)


def smooth_film_um(solved: Solved) -> float:
    """Return the central film of a smooth contact, um."""
    return solved.result["central_film"] * solved.c_um


def line_mean_um(solved: Solved, waves: float = CENTRAL_WAVES) -> float:
    """Return the mean film on the centre line over whole waves about the centre, um."""
    half = 0.5 * waves * WAVELENGTH_UM
    spline = CubicSpline(solved.line_x_um, solved.line_um)
    return float(spline.integrate(-half, half)) / (2 * half)


def line_transfer(solved: Solved) -> complex:
    """Return the wave in the film on the centre line, um, over the whole waves of the region.

    Least squares with a level, a slope and a curvature, which the smooth film has too.
    """
    half = 0.5 * CENTRAL_WAVES * WAVELENGTH_UM
    x = np.linspace(-half, half, 40 * CENTRAL_WAVES, endpoint=False)
    film = CubicSpline(solved.line_x_um, solved.line_um)(x)
    basis = np.column_stack((np.ones(x.size), x / half, (x / half) ** 2, _waves(x / WAVELENGTH_UM)))
    found = np.linalg.lstsq(basis, film, rcond=None)[0]
    return complex(found[3], -found[4])


def line_amplitude_um(solved: Solved) -> float:
    """Return the amplitude of the wave in the film on the centre line, um."""
    return abs(line_transfer(solved))


def time_mean_um(solved: Solved) -> float:
    """Return the mean film at the contact centre over the last wave to pass, um."""
    return float(_history_fit(solved)[0])


def second_order_mean_um(solved: Solved) -> float:
    """Return the mean film at the contact centre by the linear response, to second order, um."""
    return smooth_film_um(solved) + solved.result["mean_film_rise"] * AMPLITUDE_UM


def time_amplitude_um(solved: Solved) -> float:
    """Return the amplitude of the wave in the film at the contact centre, um."""
    return float(np.hypot(*_history_fit(solved)[1:3]))


def half_range_um(solved: Solved) -> float:
    """Return half the distance of the highest and the lowest film at the centre, um."""
    last = solved.film_at_centre[_last_wave(solved)] * solved.c_um
    return float(last.max() - last.min()) / 2


def middle_um(solved: Solved) -> float:
    """Return the middle between the highest and the lowest film at the centre, um."""
    last = solved.film_at_centre[_last_wave(solved)] * solved.c_um
    return float(last.max() + last.min()) / 2


def _history_fit(solved: Solved) -> Floats:
    """Return level, cosine and sine of the film at the centre; higher harmonics fitted with them.

    A wave does not hold a whole number of samples, so that their plain mean is not the level.
    """
    chosen = _last_wave(solved)
    phase = solved.time[chosen] * solved.a_um / WAVELENGTH_UM
    basis = np.column_stack((np.ones(phase.size), _waves(phase)))
    found = np.linalg.lstsq(basis, solved.film_at_centre[chosen] * solved.c_um, rcond=None)[0]
    return np.asarray(found)


def _last_wave(solved: Solved) -> NDArray[np.bool_]:
    """Return which samples belong to the last wave to pass; T is in units of a/ubar."""
    period = WAVELENGTH_UM / solved.a_um
    return np.asarray(solved.time > solved.time[-1] - period * (1 + 1e-9))


def _waves(cycles: Floats) -> Floats:
    """Return columns cos, sin of the first harmonics of a phase in cycles."""
    angles = [2 * np.pi * number * cycles for number in range(1, HARMONICS + 1)]
    return np.column_stack([wave(angle) for angle in angles for wave in (np.cos, np.sin)])
