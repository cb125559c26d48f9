"""Lambda ratios in one call from traces, against the film that the full simulation leaves.

Traces stand for transverse ridges. They run out to zero at both ends, so that the simulation,
through which they pass from end to end, and the prediction have the same surface.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from ehlwave import Contact
from ehlwave.errors import ResultsError
from ehlwave.results.case_file import read_contact
from ehlwave.results.schema import SETTLED
from ehlwave.surface import Surface, trace_surface
from ehlwave.surface.prepare import taper
from ehlwave.writing import Writer
from studies import sweeps
from studies.microgeometry.simulate import CONTACT, LUBRICANT

Floats = NDArray[np.float64]
Spectrum = Callable[[Floats], Floats]

SWEEP = "traces"
CONTACTS = {
    "experiment": {**CONTACT, **LUBRICANT, "mean_speed_m_per_s": 0.024},
    "ball": {
        "radius_x_m": 12.5e-3,
        "radius_y_m": 12.5e-3,
        "reduced_modulus_pa": 2.2e11,
        "load_n": 20.0,
        "mean_speed_m_per_s": 0.5,
        "viscosity_pa_s": 0.1,
    },
}
"""That of the paper's experiment, M = 134, and the one of the package's examples, M = 39."""

NAMES = ("ground", "isotropic", "honed", "measured")
POINTS_PER_A = 48

LENGTH = 8.0
"""Of a trace, in units of a."""

SHORTEST, LONGEST = 0.35, 3.2
"""Waves of a trace, in units of a: what filters with cut-offs of 65 and 590 um would leave."""

SHARE = 0.1
"""Amplitude, sqrt(2) Rq, over the film: the range where responses are linear."""


@dataclass(frozen=True)
class LambdaRatio:
    """Lambda ratios of one trace in one contact: in one call, simulated, and by other ways."""

    trace: str
    contact: str
    undeformed: float
    predicted: float
    simulated: float
    by_formula: float
    film_over_simulated: float
    rq_over_simulated: float
    own_error: float
    """Return the relative grid error of the simulated film, by its own estimate."""

    @property
    def at_mesh_zero(self) -> float:
        """Return the simulated ratio with its film at mesh size 0, which is what the atlas has."""
        return self.simulated * (1 + self.own_error)

    @property
    def error(self) -> float:
        """Return how far the prediction is from that, relative."""
        return self.predicted / self.at_mesh_zero - 1


def traces(a_m: float, film_m: float, points_per_a: int = POINTS_PER_A) -> dict[str, Surface]:
    """Return four traces of a contact: as ground, as of an isotropic surface, honed, measured."""
    step = a_m / points_per_a
    x = np.arange(round(LENGTH * points_per_a) + 1) / points_per_a
    ground = _noise(x, 1, lambda q: np.exp(-(((q - 1.6) / 0.6) ** 2)))
    fractal = _noise(x, 2, lambda q: (1 + (q / 0.5) ** 2) ** -0.9)  # Hurst exponent 0.8
    plateaus = _noise(x, 3, lambda q: np.exp(-((q / 1.2) ** 2)))
    honed = _limited(x, np.minimum(plateaus, 0.3 * np.std(plateaus)))
    worn = _noise(x, 4, lambda q: (1 + (q / 0.3) ** 2) ** -0.7)
    measured = worn / np.std(worn) + np.cos(2 * np.pi * x / 0.8) + 0.6 * np.cos(2 * np.pi * x / 2.9)
    found = {}
    for name, heights in zip(NAMES, (ground, fractal, honed, measured), strict=True):
        faded = (heights - heights.mean()) * taper(x.size)
        faded *= SHARE * film_m / np.sqrt(2) / np.std(faded)
        found[name] = trace_surface(faded, step, name=name)
    return found


def write_traces(
    folder: Path,
    cells: int,
    names: Sequence[str] = NAMES,
    contacts: Sequence[str] = tuple(CONTACTS),
    points_per_a: int = POINTS_PER_A,
) -> Path:
    """Write the traces as text and the sweep that simulates them; return the path of that."""
    rows: list[sweeps.Row] = []
    for contact in contacts:
        made = traces(*_lengths(contact), points_per_a)
        for name in names:
            surface = made[name]
            simulated = sweeps.write_surface(folder, surface)
            rows.append({**CONTACTS[contact], "file": str(simulated.resolve())})
            x_mm = 1e3 * surface.step_x_m * np.arange(surface.height.size)
            table = pd.DataFrame({"x [mm]": x_mm, "z [um]": 1e6 * surface.height[:, 0]})
            Writer().table(_text_file(folder, name, contact), table)
    groups = {
        "grid": {"cells_x": cells, "cells_y": cells, "edges": "flooded"},
        "solver": {"error_estimate": "model"},
        "output": {"fields": True},
    }
    return sweeps.write_sweep(folder, SWEEP, rows, groups)


def compare_traces(folder: Path, points_per_a: int = POINTS_PER_A) -> list[LambdaRatio]:
    """Return the lambda ratios of all traces of the sweep.

    Raises ResultsError if a simulation is not finished, or did not converge.
    """
    files = sorted(folder.glob("trace-*.csv"))
    rows = {Path(row["file"]).stem: row for row in sweeps.read_sweep(folder, SWEEP, len(files))}
    found = []
    for file in files:
        _, contact, name = file.stem.split("-")
        surface = traces(*_lengths(contact), points_per_a)[name]
        row = rows[sweeps.surface_file(folder, surface).stem]
        if row["status"] not in SETTLED:
            raise ResultsError(f"{name} in {contact}: status {row['status']}")
        found.append(_compare(file, Contact(**CONTACTS[contact]), surface, folder, row))
    return found


def ratio_table(ratios: Sequence[LambdaRatio]) -> pd.DataFrame:
    """Return one row for each trace and contact."""
    return pd.DataFrame(
        {
            "contact": one.contact,
            "trace": one.trace,
            "lambda_undeformed": f"{one.undeformed:.3f}",
            "lambda_predicted": f"{one.predicted:.3f}",
            "lambda_simulated": f"{one.at_mesh_zero:.3f}",
            "error": f"{one.error:.4f}",
            "lambda_on_grid": f"{one.simulated:.3f}",
            "lambda_by_formula": f"{one.by_formula:.3f}",
            "film_over_simulated": f"{one.film_over_simulated:.4f}",
            "rq_over_simulated": f"{one.rq_over_simulated:.4f}",
            "own_error_of_film": f"{one.own_error:.4f}",
        }
        for one in ratios
    )


def _compare(
    file: Path, contact: Contact, surface: Surface, folder: Path, row: sweeps.Row
) -> LambdaRatio:
    by_atlas = contact.deform(file).statistics
    simulated = read_contact(sweeps.fields_file(folder, SWEEP, row))
    film = simulated["film_at_centre"].values * contact.conditions.hertz_approach_c_m
    at_centre = simulated["surface_position_m"].values
    length = (surface.height.size - 1) * surface.step_x_m
    passing = film[(at_centre >= 0) & (at_centre <= length)]
    mean, rq = float(np.mean(passing)), float(np.std(passing))
    return LambdaRatio(
        trace=surface.name,
        contact=file.stem.split("-")[1],
        undeformed=by_atlas.lambda_ratio_before or np.nan,
        predicted=contact.lambda_ratio(file),
        simulated=mean / rq,
        by_formula=contact.lambda_ratio(file, by="paper"),
        film_over_simulated=(by_atlas.mean_film_m or np.nan) / mean,
        rq_over_simulated=by_atlas.rq_after_m / rq,
        own_error=row["central_film_error"],
    )


def _lengths(contact: str) -> tuple[float, float]:
    """Return a and the film by formula, m."""
    conditions = Contact(**CONTACTS[contact]).conditions
    return conditions.semi_axis_a_m, float(conditions.central_film_m or np.nan)


def _text_file(folder: Path, name: str, contact: str) -> Path:
    return folder / f"trace-{contact}-{name}.csv"


def _noise(x: Floats, seed: int, spectrum: Spectrum) -> Floats:
    """Return Gaussian heights with amplitudes by `spectrum` of waves per a, cut at both ends."""
    return _limited(x, np.random.default_rng([seed, 21920]).standard_normal(x.size), spectrum)


def _limited(x: Floats, heights: Floats, spectrum: Spectrum | None = None) -> Floats:
    q = np.fft.rfftfreq(x.size, x[1] - x[0])
    parts = np.fft.rfft(heights) * (1.0 if spectrum is None else spectrum(q))
    parts[(q > 1 / SHORTEST) | (q < 1 / LONGEST)] = 0
    return np.asarray(np.fft.irfft(parts, x.size))
