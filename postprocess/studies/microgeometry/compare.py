"""A surface inside the contact: simulated, by formula, by harmonic table."""

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from ehlwave.errors import ResultsError
from ehlwave.results.case_file import read_contact
from ehlwave.results.schema import SETTLED
from ehlwave.surface import (
    FormulaTransfer,
    Surface,
    TableTransfer,
    deform_surface,
    read_surface,
    read_table,
)
from ehlwave.surface.prepare import TAPERED_SHARE
from studies import sweeps
from studies.microgeometry.simulate import SPEEDS, conditions_at, contact_at, table_file
from studies.microgeometry.surfaces import Floats, amplitude_of


@dataclass
class Comparison:
    """One surface at one condition: positions in units of a, heights in m by what they are of.

    These are ``undeformed``, ``simulated`` and predicted by ``formula``, by ``amplitudes`` (a table
    without its phases), by the ``linear`` part of a table and by ``table``, the rise of the mean
    film included; by ``default`` settings of :class:`ehlwave.Contact`, from the atlas, with what it
    knows of the rise. They count from the smooth film down, each from its own.
    """

    surface: str
    speed: float
    amplitude_over_film: float
    position: Floats
    heights: dict[str, Floats]
    simulation_seconds: float
    prediction_seconds: float
    film_over_simulated: float
    """Smooth central film of the default settings over that of the simulation."""

    def rq(self, name: str) -> float:
        """Return the root mean square roughness of one of the lines, m."""
        return float(np.std(self.heights[name]))

    def error(self, name: str) -> float:
        """Return the root mean square error of a prediction over the undeformed Rq."""
        left = self.heights[name] - self.heights["simulated"]
        return float(np.sqrt(np.mean(left**2)) / self.rq("undeformed"))

    def mean_shift(self, name: str) -> float:
        """Return how much thicker the mean film is than predicted, over the undeformed Rq."""
        left = self.heights[name] - self.heights["simulated"]
        return float(np.mean(left) / self.rq("undeformed"))


def compare_speeds(
    folder: Path, surface: Surface, tables: Path, speeds: Sequence[float] = SPEEDS
) -> list[Comparison]:
    """Return a surface's comparison at each speed of its sweep in `folder`.

    `tables` is the folder of the harmonic tables.

    Raises ResultsError if a simulation is not finished, or did not converge.
    """
    rows = sweeps.read_sweep(folder, surface.name, len(speeds))
    moved = read_surface(sweeps.surface_file(folder, surface))
    found = []
    for speed, row in zip(speeds, rows, strict=True):
        if row["status"] not in SETTLED:
            raise ResultsError(f"{surface.name} at {speed:g} m/s: status {row['status']}")
        table = read_table(table_file(tables, speed))
        fields = sweeps.fields_file(folder, surface.name, row)
        found.append(_compare(replace(moved, name=surface.name), speed, row, fields, table))
    return found


def _compare(
    moved: Surface, speed: float, row: dict[str, Any], fields: Path, table: pd.DataFrame
) -> Comparison:
    conditions = conditions_at(speed)
    scale = conditions.hertz_approach_c_m
    film_m = row["central_film"] * scale
    known = replace(conditions, central_film_m=film_m, film_source="simulated smooth contact")
    by_formula = deform_surface(moved, known, FormulaTransfer(known), "none", "none")
    start = time.perf_counter()
    by_default = contact_at(speed).deform(moved, form="none", ends="none")
    seconds = time.perf_counter() - start
    by_table, by_amplitudes = (
        deform_surface(moved, known, TableTransfer(known, one), "none", "none")
        for one in (table, without_phase(table))
    )
    simulated = read_contact(fields)
    at_centre = simulated["surface_position_m"].values
    film = simulated["film_at_centre"].values * scale
    length = (moved.height.shape[0] - 1) * moved.step_x_m
    inside = np.abs(at_centre / length - 0.5) <= 0.5 - TAPERED_SHARE
    at_centre, film = at_centre[inside], film[inside]
    positions = np.arange(moved.height.shape[0]) * moved.step_x_m
    surfaces = {
        "undeformed": moved.height,
        "formula": by_formula.height,
        "amplitudes": by_amplitudes.height,
        "linear": by_table.height,
        "default": by_default.height,
    }
    lines = {
        name: np.interp(at_centre, positions, heights[:, heights.shape[1] // 2])
        for name, heights in surfaces.items()
    }
    # The ends of the surface are faded: the waves inside are higher than in the mean of all.
    share = np.std(lines["undeformed"]) / by_table.statistics.rq_before_m
    lines["table"] = lines["linear"] - (by_table.statistics.mean_rise_m or 0.0) * share**2
    lines["default"] -= (by_default.statistics.mean_rise_m or 0.0) * share**2
    return Comparison(
        moved.name,
        speed,
        amplitude_of(moved) / film_m,
        at_centre / conditions.semi_axis_a_m,
        lines | {"simulated": film_m - film},
        row["seconds"],
        seconds,
        (by_default.conditions.central_film_m or np.nan) / film_m,
    )


def without_phase(table: pd.DataFrame) -> pd.DataFrame:
    """Return a table with amplitudes alone, as a formula for them could give them at best."""
    amplitude = np.hypot(table["transfer_real"], table["transfer_imag"])
    return table.assign(transfer_real=amplitude, transfer_imag=0.0)
