"""The runs of the experiment as three sweeps, one per kind of surface."""

from pathlib import Path
from typing import Any

from ehlwave.errors import ResultsError
from ehlwave.surface import cut_period, read_surface
from ehlwave.surface.prepare import remove_form
from studies import sweeps
from studies.experiment.cases import COSINE, TRACE, Groups, Run, all_runs, keys_of, shared_groups
from studies.experiment.trace import WAVELENGTH_UM

REPEATS = 16
"""Waves one behind the other: with the fronts faded they cover the contact from T = 4.0 on."""


def prepare_surface(trace: Path, folder: Path) -> Path:
    """Write the file of a wave of a trace, from its middle, repeated; return its path."""
    wave = cut_period(remove_form(read_surface(trace), "plane"), WAVELENGTH_UM * 1e-6)
    return sweeps.write_surface(folder, wave, REPEATS)


def write_runs(folder: Path, surface: str, base: Groups, trace: Path) -> Path:
    """Write the sweep of a kind of surface, with the wave of `trace`; return its path.

    The cosine needs the results of the smooth contacts: amplitudes are counted in their films.
    """
    rows = []
    for run in all_runs(surface):
        film = None
        if surface == COSINE:
            film = finished(folder, run.smooth)["central_film_um"] * 1e-6
        rows.append(keys_of(run, base, film))
    file = prepare_surface(trace, folder).resolve() if surface == TRACE else None
    shared = shared_groups(surface, base, file)
    return sweeps.write_sweep(folder, surface, rows, shared)


def finished(folder: Path, run: Run) -> dict[str, Any]:
    """Return the result of a run.

    Raises ResultsError if it is not finished, or did not converge on a grid that resolves it.
    """
    runs = all_runs(run.surface)
    row = sweeps.read_sweep(folder, run.surface, len(runs))[runs.index(run)]
    if row["status"] != "converged":
        raise ResultsError(f"{folder / run.surface}.h5: {run.name} has status {row['status']}")
    return row
