"""The surfaces that are predicted and simulated."""

import numpy as np
from numpy.typing import NDArray

from ehlwave.surface import Surface, map_surface, trace_surface

Floats = NDArray[np.float64]


def surfaces(a_m: float) -> dict[str, Surface]:
    """Return the four surfaces: heights of 6 a length; maps are wider than the domain, 4.4 a."""
    step = a_m / 64
    x = np.arange(385) * step
    middle = x[-1] / 2
    y = (np.arange(283) - 141) * step
    ridge = 50e-9 * np.exp(-(((x - middle) / (0.2 * a_m)) ** 2))
    # a dent pressed into a flat: displaced material stands around it
    radius2 = ((x - middle)[:, None] ** 2 + y[None, :] ** 2) / (0.3 * a_m) ** 2
    dent = -60e-9 * (1 - 0.8 * radius2) * np.exp(-radius2)
    # amplitude 0.13 to 0.16 um along the trace (Figure 4 and its text)
    amplitude = (0.145 + 0.015 * np.cos(2 * np.pi * x / (3 * a_m))) * 1e-6
    sputtered = amplitude * np.cos(2 * np.pi * x / 60e-6)
    return {
        "ground": map_surface(ground(x.size, y.size, step, a_m), step, step, "ground"),
        "dent": map_surface(dent, step, step, "dent"),
        "ridge": trace_surface(ridge, step, name="ridge"),
        "sputtered": trace_surface(sputtered, step, name="sputtered"),
    }


def ground(nx: int, ny: int, step: float, a_m: float) -> Floats:
    """Return Gaussian heights, m, shape (nx, ny): Rq 30 nm, lay along rolling.

    They are three times as long as wide, without waves below 0.3 a.
    """
    noise = np.random.default_rng(1999).standard_normal((2 * nx, 2 * ny))
    qx, qy = np.fft.fftfreq(2 * nx, step)[:, None], np.fft.fftfreq(2 * ny, step)[None, :]
    spectrum = np.fft.fft2(noise) * np.exp(-((qx * 0.6 * a_m) ** 2 + (qy * 0.2 * a_m) ** 2))
    spectrum[np.maximum(np.abs(qx), np.abs(qy)) > 1 / (0.3 * a_m)] = 0
    heights = np.fft.ifft2(spectrum).real[:nx, :ny]
    heights -= heights.mean()
    return np.asarray(30e-9 * heights / heights.std())


def amplitude_of(surface: Surface) -> float:
    """Return the height or depth of a dent or ridge, m; of a rough surface sqrt(2) Rq."""
    if surface.name in ("dent", "ridge"):
        return float(np.abs(surface.height).max())
    end = surface.height.shape[0] // 5
    return float(np.sqrt(2) * np.std(surface.height[end:-end]))
