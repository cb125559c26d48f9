"""Cases of the experiment: speeds, kinds of surface, grids, and variants of the model."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ehlwave.errors import ResultsError
from ehlwave.inputs.key_values import values_of
from ehlwave.inputs.namelist import read_namelist
from ehlwave.surface import conditions_from_keys
from studies.experiment.trace import AMPLITUDE_UM, WAVELENGTH_UM

SPEEDS = (0.024, 0.048, 0.096)
GRIDS = ((256, 128), (384, 192))
"""Cells along X and Y: 257 x 129 and 385 x 193 nodes."""

SMOOTH, TRACE, COSINE = "smooth", "trace", "cosine"
PAPER_ML = "printed_ml"
Z_DEFAULT, INCOMPRESSIBLE = "z_0.68", "incompressible"
PRINTED_M = {0.024: 130.77, 0.048: 79.90, 0.096: 47.51}
PRINTED_L = {0.024: 6.61, 0.048: 7.88, 0.096: 9.36}

Groups = dict[str, dict[str, Any]]


@dataclass(frozen=True)
class Run:
    """A case.

    ``surface`` is smooth, trace (one wave of the trace, repeated) or cosine; ``variant`` is empty,
    or names the difference from the paper's Table 1.
    """

    surface: str
    speed: float
    cells_x: int
    cells_y: int
    variant: str = ""

    @property
    def name(self) -> str:
        """For messages and tables."""
        parts = (self.surface, f"{self.speed:g}", str(self.cells_x), self.variant)
        return "-".join(part for part in parts if part)

    @property
    def smooth(self) -> "Run":
        """Return the run with smooth surfaces."""
        return Run(SMOOTH, self.speed, self.cells_x, self.cells_y, self.variant)


def all_runs(surface: str | None = None) -> list[Run]:
    """Return every run, or all runs of a kind of surface."""
    runs = []
    for speed in SPEEDS:
        for grid in GRIDS:
            runs += [Run(kind, speed, *grid) for kind in (SMOOTH, TRACE, COSINE)]
        runs += [Run(kind, speed, *min(GRIDS), PAPER_ML) for kind in (SMOOTH, TRACE)]
        for variant in (Z_DEFAULT, INCOMPRESSIBLE):
            runs.append(Run(SMOOTH, speed, *min(GRIDS), variant))
    return [run for run in runs if surface in (None, run.surface)]


def read_input(path: Path) -> Groups:
    """Return the groups of the study's input file.

    Raises ResultsError if it cannot be read.
    """
    if not path.is_file():
        raise ResultsError(f"{path}: no such file; --inputs names the folder of experiment.nml")
    return values_of(read_namelist(path), other_groups=("sweep",))


def keys_of(run: Run, base: Groups, smooth_film_m: float | None = None) -> dict[str, Any]:
    """Return the individual keys of a run.

    Parameters
    ----------
    run : Run
        Case to run.
    base : dict
        The study's input file: the trace at the lowest speed.
    smooth_film_m : float or None
        Central film of the smooth contact on the same grid, m, which ``&waviness`` counts
        amplitudes in; needed for the cosine.
    """
    keys = {"mean_speed_m_per_s": run.speed, "cells_x": run.cells_x, "cells_y": run.cells_y}
    if run.variant == PAPER_ML:
        keys |= _keys_of_printed_ml(base, run.speed)
    elif run.variant == Z_DEFAULT:
        keys["roelands_index"] = 0.68
    elif run.variant == INCOMPRESSIBLE:
        keys["density_law"] = "incompressible"
    if run.surface == COSINE:
        if smooth_film_m is None:
            raise ValueError("the cosine needs the film of the smooth contact")
        keys |= {
            "orientation": "transverse",
            "wavelength_over_a": WAVELENGTH_UM * 1e-6 / semi_axis_m(base),
            "amplitude_over_film": AMPLITUDE_UM * 1e-6 / smooth_film_m,
            "response": "both",
        }
    return keys


def shared_groups(surface: str, base: Groups, file: Path | None) -> Groups:
    """Return the shared keys of all runs of a kind of surface; ``file`` holds the trace's wave."""
    left_out = {SMOOTH: ("surface", "dynamics"), COSINE: ("surface",), TRACE: ()}[surface]
    groups = {name: keys for name, keys in base.items() if name not in left_out}
    if surface == TRACE:
        groups["surface"] = {"file": str(file)}
    return groups | {"output": {"fields": True}}


def semi_axis_m(groups: Groups) -> float:
    """Return the Hertz semi-axis a of an input, m."""
    return conditions_from_keys(groups["conditions"]).semi_axis_a_m


def _keys_of_printed_ml(groups: Groups, speed: float) -> dict[str, float]:
    """Return load and viscosity that give the M and L the paper prints, at its R, E' and alpha.

    2U = (L/G)^4 and W = M (2U)^(3/4), eq. (2).
    """
    keys = groups["conditions"]
    modulus, radius = keys["reduced_modulus_pa"], keys["radius_x_m"]
    g = groups["lubricant"]["pressure_viscosity_per_pa"] * modulus
    two_u = (PRINTED_L[speed] / g) ** 4
    w = PRINTED_M[speed] * two_u**0.75
    return {
        "load_n": w * modulus * radius**2,
        "viscosity_pa_s": two_u * modulus * radius / (2 * speed),
    }
