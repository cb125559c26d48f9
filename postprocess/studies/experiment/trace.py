"""The surface of the experiment: a synthetic stylus trace, and the fit of a sinusoid to it.

The paper prints its trace (Figure 4) and describes it: almost harmonic; a least-squares sinusoid
has a wavelength of 60 um and an amplitude of 0.14 um, and fitted to parts of the trace amplitudes
from 0.13 to 0.16 um at a wavelength that hardly varies. Its points are not available, so the trace
here is synthetic with these properties.
"""

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import lmfit
import numpy as np
from numpy.typing import NDArray

from ehlwave.surface.files.text_table import read_text_table

Floats = NDArray[np.float64]

WAVELENGTH_UM = 60.0
AMPLITUDE_UM = 0.14
PARTS = 5


@dataclass(frozen=True)
class Sinusoid:
    """A least-squares sinusoid: level + amplitude cos(2 pi x/wavelength + phase)."""

    wavelength: float
    amplitude: float
    phase: float
    level: float
    rms_left: float
    """Root mean square of the residual, in the unit of the heights."""


def synthetic_trace() -> tuple[Floats, Floats]:
    """Return positions and heights of the trace, um: 601 points from -300 to 300 um.

    A sinusoid of 60 um whose amplitude has a rise of 27 % about x = -125 um, 180 um wide; whose
    phase wanders by 0.05 rad; with a second harmonic of 5 % and a third of 2 % (troughs wider than
    crests); with four waves of 9 to 41 um and 1 to 2 nm for the rest of the ground surface; on the
    level of 9.5 um in the paper's figure. The whole is scaled so that the fitted amplitude is 0.14
    um. Heights are rounded to 0.1 nm, as in inputs/full/sputtered_profile.csv.
    """
    x = np.arange(-300.0, 301.0)
    amplitude = 1 + 0.27 * np.exp(-(((x + 125) / 90) ** 2))
    angle = 2 * np.pi * x / WAVELENGTH_UM + 0.05 * np.sin(2 * np.pi * x / 190 + 1)
    wave = np.cos(angle) + 0.05 * np.cos(2 * angle + 0.4) + 0.02 * np.cos(3 * angle)
    rough = sum(
        height * np.cos(2 * np.pi * x / length + 2.4 * number)
        for number, (length, height) in enumerate(
            ((41.3, 0.014), (23.1, 0.011), (13.7, 0.009), (8.9, 0.007))
        )
    )
    heights = amplitude * wave + rough
    heights *= AMPLITUDE_UM / fit_sinusoid(x, heights, WAVELENGTH_UM).amplitude
    return x, np.round(9.5 + heights, 4)


def fit_sinusoid(x: Floats, height: Floats, wavelength: float) -> Sinusoid:
    """Fit a sinusoid by least squares; ``wavelength`` is where the search begins.

    The paper's two parameters are wavelength and amplitude; position and level have to be found
    with them.
    """
    start = _harmonic(x, height, wavelength)
    parameters = lmfit.create_params(
        wavelength={"value": wavelength, "min": 0.5 * wavelength, "max": 2 * wavelength},
        amplitude=float(np.hypot(*start[1:])),
        phase=float(np.arctan2(-start[2], start[1])),
        level=float(start[0]),
    )

    def left(values: lmfit.Parameters) -> Floats:
        angle = 2 * np.pi * x / values["wavelength"].value + values["phase"].value
        return height - values["level"].value - values["amplitude"].value * np.cos(angle)

    best = lmfit.minimize(left, parameters).params
    found = {name: float(best[name].value) for name in best}
    return Sinusoid(**found, rms_left=float(np.sqrt(np.mean(left(best) ** 2))))


def harmonic(x: Floats, height: Floats, wavelength: float) -> complex:
    """Return the transfer of a known wavelength: height = Re(result exp(2 pi i x/wavelength)).

    Least squares with the level free; the modulus is the amplitude.
    """
    _, cosine, sine = _harmonic(x, height, wavelength)
    return complex(cosine, -sine)


def fits_of_trace(x: Floats, height: Floats, parts: int = PARTS) -> list[tuple[str, Sinusoid]]:
    """Return the fit to the whole and to equal parts of a trace, with the names of the parts."""
    found = [("whole trace", fit_sinusoid(x, height, WAVELENGTH_UM))]
    edges = np.linspace(0, x.size - 1, parts + 1).round().astype(int)
    for first, last in pairwise(edges):
        name = f"{x[first]:g} to {x[last]:g} um"
        piece = slice(first, last + 1)
        found.append((name, fit_sinusoid(x[piece], height[piece], WAVELENGTH_UM)))
    return found


def read_trace(path: Path) -> tuple[Floats, Floats]:
    """Return positions and heights of the file of a trace, um."""
    numbers = read_text_table(path).numbers
    return numbers[:, 0], numbers[:, 1]


def _harmonic(x: Floats, height: Floats, wavelength: float) -> Floats:
    angle = 2 * np.pi * x / wavelength
    basis = np.column_stack((np.ones(x.size), np.cos(angle), np.sin(angle)))
    return np.asarray(np.linalg.lstsq(basis, height, rcond=None)[0])
