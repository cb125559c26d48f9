"""Figures 4, 6 and 8, 9 and 10 of the paper: the trace, and films along the centre line."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlwave.results.figures import COLOURS
from studies.experiment.measure import CENTRAL_WAVES, Solved
from studies.experiment.paper import PRINTED
from studies.experiment.trace import AMPLITUDE_UM, WAVELENGTH_UM, Floats, Sinusoid

STYLE: dict[Any, Any] = {
    "font.size": 9,
    "axes.labelsize": 9.5,
    "axes.titlesize": 9.5,
    "legend.fontsize": 8,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
}
PAPER, MEASURED = COLOURS[:2]
GREY = "0.55"
X_LIMITS_MM = (-0.3, 0.3)


def trace_figure(x_um: Floats, height_um: Floats, fit: Sinusoid, wave_um: Floats) -> Figure:
    """Draw the trace with the fitted sinusoid (Figure 4), and the wave that was cut out of it.

    ``wave_um`` holds the heights of a wave, equidistant, its end left out.
    """
    with rc_context(STYLE):
        figure = Figure(figsize=(7.2, 4.6), layout="constrained")
        above, below = figure.subplots(2, 1)
        angle = 2 * np.pi * x_um / fit.wavelength + fit.phase
        sinusoid = fit.level + fit.amplitude * np.cos(angle)
        above.plot(x_um / 1e3, height_um, color="black", linewidth=1.1, label="synthetic trace")
        label = f"least squares: {fit.wavelength:.1f} um, {fit.amplitude:.3f} um"
        above.plot(x_um / 1e3, sinusoid, "--", color=PAPER, linewidth=0.8, label=label)
        above.set(xlim=X_LIMITS_MM, ylim=(9.2, 9.88), xlabel="x [mm]", ylabel="h [um]")
        above.legend(loc="upper right", ncols=2, frameon=False)
        count = wave_um.size
        x = np.arange(4 * count + 1) * WAVELENGTH_UM / count
        repeated = np.append(np.tile(wave_um, 4), wave_um[0])
        below.plot(x, repeated, color="black", linewidth=1.1)
        for joint in range(1, 4):
            below.axvline(joint * WAVELENGTH_UM, color=GREY, linewidth=0.7, linestyle=":")
        below.set(xlim=(0, x[-1]), ylim=(-0.22, 0.22), xlabel="x [um]", ylabel="height [um]")
        below.set_title("one wave from the middle of the trace, repeated (dotted: joints)")
    return figure


def line_figure(shown: Sequence[tuple[Solved, Solved]]) -> Figure:
    """Draw films along the centre line, a panel for each speed (Figures 8 and 10).

    The contact with waves and the smooth contact at each speed. The paper's measured films (Figures
    6 and 9) exist in print only: its measured mean and amplitude are a line and a band.
    """
    with rc_context(STYLE):
        figure = Figure(figsize=(7.2, 3.5 * len(shown)), layout="constrained")
        panels = figure.subplots(len(shown), 1, squeeze=False)[:, 0]
        for axes, (wavy, smooth) in zip(panels, shown, strict=True):
            _draw_line(axes, wavy, smooth)
    return figure


def _draw_line(axes: Axes, wavy: Solved, smooth: Solved) -> None:
    speed = wavy.run.speed
    printed = PRINTED[speed]
    half_mm = 0.5 * CENTRAL_WAVES * WAVELENGTH_UM / 1e3
    amplitude = printed.measured_amplitude or AMPLITUDE_UM
    about = f"{amplitude:.2f}" if printed.measured_amplitude else "about 0.14"
    mean, computed = printed.measured_mean, printed.computed_mean
    label = f"measured by the paper: {mean:.2f} um (line), amplitude {about} um (band)"
    ends, band = (-half_mm, half_mm), {"color": MEASURED, "alpha": 0.15, "linewidth": 0}
    axes.fill_between(ends, mean - amplitude, mean + amplitude, label=label, **band)
    axes.hlines(mean, *ends, color=MEASURED, linewidth=1.2)
    label = f"mean computed by the paper: {computed:.2f} um"
    axes.hlines(computed, *ends, color=PAPER, linewidth=1.2, linestyle="--", label=label)
    label = "smooth surfaces, this code"
    axes.plot(smooth.line_x_um / 1e3, smooth.line_um, color=GREY, linewidth=1, label=label)
    label = "waves, this code"
    axes.plot(wavy.line_x_um / 1e3, wavy.line_um, color="black", linewidth=1.3, label=label)
    axes.set(xlim=X_LIMITS_MM, ylim=(0, 1.5), xlabel="x [mm]", ylabel="h [um]")
    axes.set_title(f"mean speed {speed:g} m/s")
    axes.legend(loc="upper center", frameon=False)
