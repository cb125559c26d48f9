"""Ad/Ai of the line contact to mesh size 0, with errors, from its runs."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from studies.validation.line_runs import DOMAINS, responses
from studies.validation.published import LineRatio, line_ratios


@dataclass(frozen=True)
class Ratio:
    """Ad/Ai to mesh size 0 and its error, absolute."""

    value: float
    error: float


def linear_ratios(results: xr.Dataset) -> dict[float, Ratio]:
    """Return by lambda/a what linear responses give, extrapolated by the program."""
    columns = ("wavelength_over_a", "harmonic_extrapolated", "harmonic_error")
    rows = zip(*(results[name].values.tolist() for name in columns), strict=True)
    return {wave: Ratio(value, abs(value * error)) for wave, value, error in rows}


def domain_changes(folder: Path) -> dict[float, float]:
    """Return by lambda/a the change of Ad/Ai on the wide domain, at equal mesh size."""
    near, wide = (responses(folder, domain) for domain in DOMAINS)
    change = wide["harmonic_ratio"].values - near["harmonic_ratio"].values
    return dict(zip(near["wavelength_over_a"].values.tolist(), change.tolist(), strict=True))


def marched_ratios(
    results: xr.Dataset, linear: dict[float, Ratio], domain: dict[float, float]
) -> dict[LineRatio, Ratio]:
    """Return Ad/Ai of eq. (14) by published value.

    What the march has more than the linear response on its own grid is added to the linear
    response at mesh size 0: both have the same discretisation error to first order. The error is
    the change of that difference from the coarser grid to the finer one, the linear response's
    own, and what the domain changes.
    """
    ratios = {}
    for one in line_ratios():
        wave = one.wavelength_over_a
        chosen = np.isclose(results["wavelength_over_a"].values, wave)
        chosen &= np.isclose(results["amplitude_over_film"].values, one.amplitude_over_film)
        both = results.isel(case=np.flatnonzero(chosen)).sortby("cells_x")
        coarse, fine = (both["amplitude_ratio"] - both["harmonic_ratio"]).values.tolist()
        error = abs(fine - coarse) + linear[wave].error + abs(domain[wave])
        ratios[one] = Ratio(linear[wave].value + fine, error)
    return ratios
