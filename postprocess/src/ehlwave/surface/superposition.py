"""A surface as the sum of its components: each times its transfer, and their sum."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ehlwave.contact.conditions import Conditions
from ehlwave.laws.transfer import Transfer
from ehlwave.surface.spectrum import Coverage, Spectrum, empty_spectrum
from ehlwave.surface.surface import Heights, Surface

WORKERS = 2
"""Threads of the Fourier transforms."""


def superposed(
    height: Heights, surface: Surface, conditions: Conditions, transfer: Transfer
) -> tuple[Heights, dict[str, Spectrum], Coverage, float | None]:
    """Return the sum of the components times their transfer, and the spectra on the way.

    Also the rise of the mean film over the smooth film, for Rq equal to the smooth film, if known.
    """
    nx, ny = height.shape
    # The half spectrum is along y but for traces along x.
    half = 0 if ny == 1 else 1
    spectrum = fft.rfftn(height, axes=(1 - half, half), workers=WORKERS)
    del height
    qx = _frequencies(nx, surface.step_x_m, half == 0)
    qy = _frequencies(ny, surface.step_y_m, half == 1)
    spectra = {"x": empty_spectrum(qx), "y": empty_spectrum(qy)}
    cover = Coverage(conditions, transfer)
    mean_square, rise = 0.0, 0.0
    rows = max(1, 2**16 // spectrum.shape[1])
    for first in range(0, spectrum.shape[0], rows):
        block = slice(first, min(first + rows, spectrum.shape[0]))
        part = spectrum[block]
        along, across = qx[block, None], qy[None, :]
        # The transfer is even in qy and depends on the sign of qx.
        ratio = transfer.ratio(along, across)
        power = part.real.astype(np.float64) ** 2 + part.imag.astype(np.float64) ** 2
        before = power * (_multiplicity(block, nx, ny, half) / (nx * ny) ** 2)
        after = before * np.abs(ratio) ** 2
        spectra["x"].add(block, before.sum(axis=1), after.sum(axis=1))
        spectra["y"].add(slice(None), before.sum(axis=0), after.sum(axis=0))
        if first == 0:
            before[0, 0] = after[0, 0] = 0  # the mean, which is no roughness
        cover.add(along, across, before, after)
        mean_square += before.sum()
        of_wave = transfer.rise(along, across)
        cover.bands.add(along, across, before, after, of_wave)
        # A wave of amplitude A has a mean square of A^2/2.
        rise += math.nan if of_wave is None else 2 * (of_wave * before).sum()
        part *= _real_at_nyquist(ratio, block, nx).astype(part.dtype)
    sizes = (nx, ny) if half == 1 else (ny, nx)
    deformed = fft.irfftn(
        spectrum, s=sizes, axes=(1 - half, half), workers=WORKERS, overwrite_x=True
    )
    known = rise / mean_square if mean_square > 0 else 0.0
    return deformed, spectra, cover, None if math.isnan(rise) else known


def _real_at_nyquist(ratio: NDArray[Any], block: slice, nx: int) -> NDArray[Any]:
    """Return the ratio, real for the shortest wave along x: it is its own conjugate."""
    if np.iscomplexobj(ratio) and nx % 2 == 0 and block.start <= nx // 2 < block.stop:
        ratio[nx // 2 - block.start].imag = 0
    return ratio


def _multiplicity(block: slice, nx: int, ny: int, half: int) -> NDArray[np.float64]:
    """Return how often each term of a block of the half spectrum occurs in the whole spectrum.

    Of two conjugate terms that both are in the half spectrum (no variation, or the shortest wave,
    along the halved direction) the first gets both, the other none.
    """
    full, halved = (ny, nx) if half == 0 else (nx, ny)
    index = np.arange(full)
    is_own = (index == 0) | (2 * index == full)
    first_of_two = np.where(is_own, 1.0, np.where(2 * index < full, 2.0, 0.0))
    halved_index = np.arange(halved // 2 + 1)
    is_shared = (halved_index == 0) | (2 * halved_index == halved)
    if half == 0:
        return np.where(is_shared[block, None], first_of_two[None, :], 2.0)
    return np.where(is_shared[None, :], first_of_two[block, None], 2.0)


def _frequencies(count: int, step_m: float, is_half: bool) -> NDArray[np.float64]:
    if count == 1:
        return np.zeros(1)
    return np.asarray(fft.rfftfreq(count, step_m) if is_half else fft.fftfreq(count, step_m))
