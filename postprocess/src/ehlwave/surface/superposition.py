"""A surface as the sum of its components: each times its transfer, and their sum."""

import copy
import math
from collections.abc import Iterator
from typing import Any, Protocol

import numpy as np
import scipy
from numpy.typing import NDArray

from ehlwave.choices import Window
from ehlwave.contact.conditions import Conditions
from ehlwave.laws.transfer import Transfer
from ehlwave.surface.prepare import extended, judged_part
from ehlwave.surface.sampled import Sampled
from ehlwave.surface.spectrum import Coverage, Floats, Spectrum, empty_spectrum
from ehlwave.surface.surface import Heights, Surface

WORKERS = 2
"""Threads of the Fourier transforms."""

BLOCK = 2**15
"""Components that are judged at a time."""

MOST_KEPT = 2**22
"""Components up to which the height of the highest point is parted among them."""


class _Components(Protocol):
    """Components of heights, shape (waves along x, waves along y)."""

    qx: Floats
    qy: Floats

    def mean_squares(self, block: slice) -> Floats:
        """Return mean squares of rows, m^2."""

    def multiply(self, block: slice, ratio: NDArray[Any]) -> None:
        """Multiply rows by their transfer."""

    def heights_at(self, block: slice, node: tuple[int, int]) -> Floats:
        """Return the heights of rows at a node, m."""

    def total(self) -> Heights:
        """Return the sum of the components: heights, m."""


def superposed(
    height: Heights, surface: Surface, conditions: Conditions, transfer: Transfer, window: Window
) -> tuple[Heights, dict[str, Spectrum], Coverage, float | None]:
    """Return the sum of the components times their transfer, and the spectra on the way.

    Also the rise of the mean film over the smooth film, for Rq equal to the smooth film, if known.
    """
    parts = components_of(height, surface, window)
    del height
    is_large = parts.qx.size * parts.qy.size > MOST_KEPT
    if is_large and parts.qy[-1] > transfer.smooth_from:
        transfer = Sampled(transfer, parts.qy)
    spectra = {"x": empty_spectrum(parts.qx), "y": empty_spectrum(parts.qy)}
    cover = Coverage(conditions, transfer)
    mean_square, rise = 0.0, 0.0
    for block in blocks_of(parts):
        along, across = parts.qx[block, None], parts.qy[None, :]
        # The transfer is even in qy and depends on the sign of qx.
        ratio = transfer.ratio(along, across)
        before = parts.mean_squares(block)
        after = before * (ratio.real**2 + ratio.imag**2)
        spectra["x"].add(block, before.sum(axis=1), after.sum(axis=1))
        spectra["y"].add(slice(None), before.sum(axis=0), after.sum(axis=0))
        if block.start == 0:
            before[0, 0] = after[0, 0] = 0  # the mean, which is no roughness
        cover.add(along, across, before, after)
        mean_square += before.sum()
        of_wave = transfer.rise(along, across)
        # A wave of amplitude A has a mean square of A^2/2.
        risen = np.zeros_like(before) if of_wave is None else 2 * of_wave * before
        rise += math.nan if of_wave is None else risen.sum()
        cover.bands.add(along, across, before, after, risen)
        parts.multiply(block, ratio)
    known = rise / mean_square if mean_square > 0 else 0.0
    kept = copy.deepcopy(parts) if parts.qx.size * parts.qy.size <= MOST_KEPT else None
    found = parts.total()
    if kept is not None:
        _add_peak(found, kept, cover, window)
    return found, spectra, cover, None if math.isnan(rise) else known


def components_of(height: Heights, surface: Surface, window: Window) -> _Components:
    """Return the components of heights."""
    if window == "mirror":
        return _Cosines(height, surface)
    return _Waves(extended(height, window), surface)


def blocks_of(parts: _Components) -> Iterator[slice]:
    """Return rows of components that are judged at a time, one block after another."""
    rows = max(1, BLOCK // parts.qy.size)
    for first in range(0, parts.qx.size, rows):
        yield slice(first, min(first + rows, parts.qx.size))


def _add_peak(found: Heights, parts: _Components, cover: Coverage, window: Window) -> None:
    """Add what each band has of the height of the highest point in the contact."""
    part = judged_part((found.shape[0], found.shape[1]), window)
    chosen = found[part]
    place = np.unravel_index(int(np.argmax(chosen)), chosen.shape)
    node = [int(i) + (cut.start or 0) for i, cut in zip(place, part, strict=True)]
    for block in blocks_of(parts):
        heights = parts.heights_at(block, (node[0], node[1]))
        cover.bands.add_heights(parts.qx[block, None], parts.qy[None, :], heights)


class _Cosines:
    """Components of a surface followed by its mirror image: cosines, without the image itself.

    The transfer Z of exp(i k x) turns cos(k x) into Re(Z) cos(k x) - Im(Z) sin(k x).
    """

    def __init__(self, height: Heights, surface: Surface) -> None:
        self._axes = tuple(axis for axis in (0, 1) if height.shape[axis] > 1)
        is_own = not np.may_share_memory(height, surface.height)
        self._cosines = scipy.fft.dctn(height, axes=self._axes, workers=WORKERS, overwrite_x=is_own)
        self._sines: Heights | None = None
        steps = surface.step_x_m, surface.step_y_m
        self.qx, self.qy = (
            np.arange(n) / (2 * n * step) if n > 1 else np.zeros(1)
            for n, step in zip(height.shape, steps, strict=True)
        )
        self._weights = [_mean_square_of_cosines(n) for n in height.shape]

    def mean_squares(self, block: slice) -> Floats:
        along, across = self._weights
        return self._cosines[block].astype(np.float64) ** 2 * (along[block, None] * across)

    def multiply(self, block: slice, ratio: NDArray[Any]) -> None:
        part = self._cosines[block]
        if 0 in self._axes and np.iscomplexobj(ratio):
            if self._sines is None:
                self._sines = np.zeros(self._cosines.shape, part.dtype)
            first = max(block.start, 1)  # the transform of sines begins with the first wave
            imaginary = ratio.imag[first - block.start :].astype(part.dtype)
            self._sines[first - 1 : block.stop - 1] = self._cosines[first : block.stop] * imaginary
        part *= ratio.real.astype(part.dtype)

    def heights_at(self, block: slice, node: tuple[int, int]) -> Floats:
        nx, ny = self._cosines.shape
        weight = np.ones(nx)
        weight[0] = 0.5
        across = np.ones(ny)
        if ny > 1:
            across = np.cos(np.pi * np.arange(ny) * (2 * node[1] + 1) / (2 * ny)) / ny
            across[0] = 0.5 / ny
        turn = np.pi * np.arange(nx)[block] * (2 * node[0] + 1) / (2 * nx)
        along = weight[block] * np.cos(turn) / nx if nx > 1 else np.ones(1)
        found = along[:, None] * self._cosines[block]
        if self._sines is not None:
            first = max(block.start, 1)
            sine = np.sin(turn[first - block.start :]) / nx
            if block.stop == nx:
                sine[-1] /= 2
            found[first - block.start :] -= sine[:, None] * self._sines[first - 1 : block.stop - 1]
        return np.asarray(found * across, dtype=float)

    def total(self) -> Heights:
        found = self._cosines
        for axis in self._axes:
            found = scipy.fft.idct(found, axis=axis, workers=WORKERS, overwrite_x=True)
            if axis == 0 and self._sines is not None:
                lag, self._sines = self._sines, None
                found -= scipy.fft.idst(lag, axis=0, workers=WORKERS, overwrite_x=True)
        return np.asarray(found)


def _mean_square_of_cosines(count: int) -> Floats:
    """Return the mean square of each cosine over the square of its coefficient."""
    weights = np.full(count, 0.5 / count**2)
    weights[0] = 0.25 / count**2 if count > 1 else 1.0
    return weights


class _Waves:
    """Components of a surface that repeats: waves, half of the conjugate pairs."""

    def __init__(self, height: Heights, surface: Surface) -> None:
        nx, ny = self._shape = height.shape
        # The half spectrum is along y but for traces along x.
        self._half = 0 if ny == 1 else 1
        axes = (1 - self._half, self._half)
        self._spectrum = scipy.fft.rfftn(height, axes=axes, workers=WORKERS)
        self.qx = _frequencies(nx, surface.step_x_m, self._half == 0)
        self.qy = _frequencies(ny, surface.step_y_m, self._half == 1)

    def mean_squares(self, block: slice) -> Floats:
        nx, ny = self._shape
        part = self._spectrum[block]
        power = part.real.astype(np.float64) ** 2 + part.imag.astype(np.float64) ** 2
        return power * (_multiplicity(block, nx, ny, self._half) / (nx * ny) ** 2)

    def multiply(self, block: slice, ratio: NDArray[Any]) -> None:
        part = self._spectrum[block]
        part *= _real_at_nyquist(ratio, block, self._shape[0]).astype(part.dtype)

    def heights_at(self, block: slice, node: tuple[int, int]) -> Floats:
        nx, ny = self._shape
        rows, columns = self._spectrum.shape
        along = np.exp(2j * np.pi * np.arange(rows)[block] * node[0] / nx)
        across = np.exp(2j * np.pi * np.arange(columns) * node[1] / ny)
        times = _multiplicity(block, nx, ny, self._half) / (nx * ny)
        return np.asarray((self._spectrum[block] * along[:, None] * across).real * times, float)

    def total(self) -> Heights:
        axes = (1 - self._half, self._half)
        sizes = [self._shape[axis] for axis in axes]
        return np.asarray(
            scipy.fft.irfftn(self._spectrum, s=sizes, axes=axes, workers=WORKERS, overwrite_x=True)
        )


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
    return np.asarray(
        scipy.fft.rfftfreq(count, step_m) if is_half else scipy.fft.fftfreq(count, step_m)
    )
