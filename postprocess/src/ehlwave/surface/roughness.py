"""Roughness as standards name it: the Gaussian filter of ISO 16610, parameters of ISO 21920, 25178.

The filter is ISO 16610-21 for profiles; along each direction of a map it is the areal filter ISO
16610-61. A surface is continued by its mirror image at its ends (ISO 16610-28).
"""

import math
from dataclasses import replace

import numpy as np
import scipy

from ehlwave.errors import SurfaceError
from ehlwave.surface.surface import Heights, Surface

ALPHA = math.sqrt(math.log(2) / math.pi)
"""Half of a wave as long as the cut-off is transmitted."""

SECTIONS = 5
"""Sections of the evaluation length, where no cut-off sets their length."""

NOTHING_M = 1e-15
"""Heights that differ by less are equal but for rounding: a hundred thousandth of an atom."""


def gaussian_filtered(
    surface: Surface, cutoff_m: float | None = None, short_cutoff_m: float | None = None
) -> Surface:
    """Return the roughness: without waves above a cut-off and below another, by Gaussian filters.

    Parameters
    ----------
    surface : Surface
        Its form removed.
    cutoff_m : float, optional
        lambda_c, or the L-filter's nesting index of a map: longer waves are waviness.
    short_cutoff_m : float, optional
        lambda_s, or the S-filter's nesting index: shorter waves are noise.

    Raises
    ------
    SurfaceError
        If a cut-off does not lie between the step and the length of the surface, or lambda_s is
        not below lambda_c.
    """
    height = surface.height.astype(np.float64)
    for cutoff in (short_cutoff_m, cutoff_m):
        if cutoff is not None:
            _check_cutoff(surface, cutoff)
    if cutoff_m is not None and short_cutoff_m is not None and short_cutoff_m >= cutoff_m:
        raise SurfaceError(
            f"{surface.name}: the short cut-off, {short_cutoff_m * 1e6:g} um, must lie below the "
            f"long one, {cutoff_m * 1e6:g} um"
        )
    if short_cutoff_m is not None:
        height = _mean_line(surface, height, short_cutoff_m)
    if cutoff_m is not None:
        height = height - _mean_line(surface, height, cutoff_m)
    return replace(surface, height=height)


def roughness_parameters(
    height: Heights, is_trace: bool, section: int | None = None
) -> dict[str, float]:
    """Return height parameters by name, lengths in m.

    Of a trace Ra, Rq, Rsk, Rku, Rp, Rv, Rz and Rt of ISO 21920-2: Rp, Rv and Rz are means over
    sections of the evaluation length, Rt is of all of it. Of a map Sa, Sq, Ssk, Sku, Sp, Sv and Sz
    of ISO 25178-2.

    Parameters
    ----------
    height : ndarray
        Heights about any level, m.
    is_trace : bool
        Whether they are a profile.
    section : int, optional
        Points of a section, as many as in a cut-off; a fifth of the length if absent.
    """
    z = height.ravel() - np.mean(height, dtype=np.float64)
    if np.ptp(z) < NOTHING_M:
        z = np.zeros_like(z)
    rq = float(np.sqrt(np.mean(z**2)))
    skewness, kurtosis = (float(np.mean(z**k) / rq**k) if rq > 0 else math.nan for k in (3, 4))
    shape = [float(np.mean(np.abs(z))), rq, skewness, kurtosis]
    if not is_trace:
        extremes = [float(z.max()), float(-z.min()), float(np.ptp(z))]
        return dict(
            zip(("Sa", "Sq", "Ssk", "Sku", "Sp", "Sv", "Sz"), shape + extremes, strict=True)
        )
    count = SECTIONS if section is None else max(1, z.size // section)
    parts = np.array_split(z, min(count, z.size))
    peak, pit = (float(np.mean([sign * (sign * part).max() for part in parts])) for sign in (1, -1))
    extremes = [peak, -pit, peak - pit, float(np.ptp(z))]
    names = ("Ra", "Rq", "Rsk", "Rku", "Rp", "Rv", "Rz", "Rt")
    return dict(zip(names, shape + extremes, strict=True))


def _mean_line(surface: Surface, height: Heights, cutoff_m: float) -> Heights:
    """Return the waves that a Gaussian filter of this cut-off transmits, exp(-pi (alpha c/l)^2)."""
    for axis, step in enumerate((surface.step_x_m, surface.step_y_m)):
        count = height.shape[axis]
        if count == 1:
            continue
        # A cosine transform equals the transform of the surface with its mirror image.
        per_length = np.arange(count) / (2 * count * step)
        share = np.exp(-np.pi * (ALPHA * cutoff_m * per_length) ** 2)
        spectrum = scipy.fft.dct(height, axis=axis)
        height = scipy.fft.idct(spectrum * np.expand_dims(share, 1 - axis), axis=axis)
    return height


def _check_cutoff(surface: Surface, cutoff_m: float) -> None:
    for count, step in zip(surface.height.shape, (surface.step_x_m, surface.step_y_m), strict=True):
        if count > 1 and not 2 * step <= cutoff_m <= count * step:
            raise SurfaceError(
                f"{surface.name}: a cut-off of {cutoff_m * 1e6:g} um does not lie between two "
                f"steps, {2 * step * 1e6:.4g} um, and the length, {count * step * 1e6:.4g} um"
            )
