"""Ridges and dimples in the contact: simulated, and predicted from both waves.

Predictions are the law, which needs no simulation, and both waves of a sweep of linear responses at
these conditions.
"""

import itertools
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from ehlwave.errors import ResultsError
from ehlwave.results.case_file import read_contact
from ehlwave.results.schema import SETTLED
from ehlwave.surface import Mover, TwoWaveTransfer
from studies import sweeps
from studies.two_waves.computed_waves import ComputedWaves
from studies.two_waves.shapes import (
    HALF_WIDTH,
    LENGTH,
    MARCHES,
    PLACE,
    SHARE,
    SIGNS,
    SLIPS,
    SMOOTH,
    WAVELENGTHS,
    WAVELENGTHS_ACROSS,
    WAVES,
    conditions_at,
    shape,
)

Floats = NDArray[np.float64]

WINDOW = 0.5
"""Range of |X| in which profiles are compared."""


@dataclass(frozen=True)
class Passing:
    """A shape in the contact at a time: film less smooth film, over its height, against X.

    All along Y = 0. ``surface`` is the undeformed surface over its height.
    """

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

    Raises ResultsError if a sweep has not been run, or a case did not converge.
    """
    count = (len(WAVELENGTHS) + 1) * (len(WAVELENGTHS_ACROSS) + 1) - 1
    waves = pd.DataFrame(sweeps.read_sweep(folder, WAVES, len(SLIPS) * count))
    marches = sweeps.read_sweep(folder, MARCHES, len(SLIPS) * len(SIGNS))
    still = sweeps.read_sweep(folder, SMOOTH, len(SLIPS))
    found = []
    for (slip, name), row in zip(itertools.product(SLIPS, SIGNS), marches, strict=True):
        if row["status"] not in SETTLED:
            raise ResultsError(f"{name} at S = {slip:g}: status {row['status']}")
        table = waves[np.isclose(waves["slip_parameter"], slip)]
        cases = (row, still[SLIPS.index(slip)])
        found.append(_passing(folder, name, slip, cases, table))
    return found


def _passing(
    folder: Path, name: str, slip: float, cases: tuple[sweeps.Row, sweeps.Row], table: pd.DataFrame
) -> Passing:
    row, smooth = cases
    contact = conditions_at(slip)
    a_m, scale = contact.semi_axis_a_m, float(contact.hertz_approach_c_m or np.nan)
    known = conditions_at(slip, float(row["central_film"]) * scale)
    film_m = float(conditions_at(1.0).central_film_m or np.nan)
    x, film = _line(sweeps.fields_file(folder, MARCHES, row))
    _, still = _line(sweeps.fields_file(folder, SMOOTH, smooth))
    near = np.abs(x) <= 1
    lines = {"simulated": (film - still)[near] * scale / (SHARE * film_m)}
    for transfer in (ComputedWaves(known, table), TwoWaveTransfer(known)):
        label = "law" if isinstance(transfer, TwoWaveTransfer) else transfer.name
        mover = Mover(shape(name, film_m), transfer, (LENGTH / 2 - PLACE) * a_m)
        lines[label] = mover.film_change(x[near] * a_m, 0.0) / (SHARE * film_m)
    surface = SIGNS[name] * np.exp(-(((x[near] - PLACE) / HALF_WIDTH) ** 2))
    return Passing(name, slip, x[near], surface, lines)


def _line(path: Path) -> tuple[Floats, Floats]:
    """Return X, and H along Y = 0."""
    fields = read_contact(path)
    middle = int(np.argmin(np.abs(fields["y"].values)))
    return fields["x"].values, fields["film"].values[middle]
