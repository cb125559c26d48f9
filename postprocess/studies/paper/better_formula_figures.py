"""Figures on the better formula: collapse, f(r), residuals."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlwave.contact.formula import (
    RECOMMENDED_L_EXPONENT,
    RECOMMENDED_SHARPNESS,
    amplitude_ratio_formula,
    f_of_r,
    power_ratio,
    recommended_parameter,
    wave_and_direction,
)
from ehlwave.results.figures import COLOURS
from studies.paper.cases import DIRECTIONS
from studies.paper.fit_points import Floats, Points

MARKERS = {"transverse, r < 0.3": "o", "oblique": "^", "longitudinal, r > 3": "s"}


def collapse_figure(points: Points) -> Figure:
    """Draw all points on f(r) V with (18) and on the recommended parameter with its curves."""
    figure = Figure(figsize=(9.5, 4.4), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    x = recommended_parameter(
        points.load_m, points.lubricant, points.gamma, points.wave_x, points.wave_y
    )
    grid = np.geomspace(0.02, 60, 400)
    levels = np.unique(points.lubricant)
    base, slope = RECOMMENDED_SHARPNESS
    for colour, lubricant in zip(COLOURS, levels, strict=False):
        at = points.lubricant == lubricant
        for marker, chosen in zip(MARKERS.values(), _classes(points), strict=True):
            style = {"marker": marker, "s": 9, "linewidths": 0.5, "facecolors": "none"}
            for axes, values in ((left, points.f_v), (right, x)):
                both = at & chosen
                axes.scatter(values[both], points.ratio[both], edgecolors=colour, **style)
        curve = power_ratio(grid, base + slope / lubricant)
        right.plot(grid, curve, "-", color=colour, linewidth=1.2, label=f"L = {lubricant:g}")
    left.plot(grid, amplitude_ratio_formula(grid), "k--", linewidth=1.3, label="formula (18)")
    for name, marker in MARKERS.items():
        left.scatter([], [], marker=marker, s=14, facecolors="none", edgecolors="k", label=name)
    left.set_xlabel(r"$f(r)\,V$")
    right.set_xlabel(r"$x = 0.263\,(\lambda_n/a)\,(\gamma M)^{1/2}\,L^{-\cos^2\theta/3}$")
    left.set_ylabel(r"$A_d/A_i$")
    for axes, limits in ((left, (0.08, 80)), (right, (0.03, 40))):
        axes.set_xscale("log")
        axes.set_xlim(*limits)
        axes.set_ylim(0, 1.15)
        axes.legend(frameon=False, loc="lower left", fontsize=8)
    right.set_title(r"colours: $L$; curves: $(1+x^n)^{-1/n}$, $n = 1.5 + 10/L$", fontsize=9)
    left.set_title("same points, colours and markers on both sides", fontsize=9)
    return figure


def factor_figure(factors: Mapping[float, tuple[Floats, Floats]]) -> Figure:
    """Draw f(r) fitted at each r and L, with eq. (15) and the recommended formula's f."""
    figure = Figure(figsize=(6.4, 4.2), layout="constrained")
    axes = figure.subplots()
    angle = np.degrees(np.arctan(DIRECTIONS))
    smooth = np.linspace(0, 90, 361)
    r = np.tan(np.radians(smooth))
    for colour, (lubricant, (value, interval)) in zip(COLOURS, factors.items(), strict=False):
        bars = np.abs(interval - value)
        style = {"fmt": "o", "markersize": 4, "capsize": 2, "linewidth": 0.9}
        axes.errorbar(angle, value, bars, color=colour, label=f"L = {lubricant:g}", **style)
        axes.plot(smooth, implied_factor(r, lubricant), "-", color=colour, linewidth=1)
    axes.plot(smooth, f_of_r(r), "k--", linewidth=1.3, label="eq. (15)")
    axes.plot([], [], "-", color="0.4", label="recommended formula")
    axes.set_xlabel(r"$\arctan r$ in degrees (0: transverse, 45: isotropic, 90: longitudinal)")
    axes.set_ylabel(r"$f(r)$, 1 for transverse waves")
    axes.legend(frameon=False)
    return figure


def implied_factor(r: Floats, lubricant: float) -> Floats:
    """Return f(r) of the recommended formula, relative to transverse waves of equal min(lambda)."""
    with np.errstate(divide="ignore"):
        wave, along = wave_and_direction(np.maximum(r, 1.0), np.maximum(1 / r, 1.0))
    # Infinite wavelengths are given as infinity here, which has wave number 0, too.
    return np.asarray(wave * lubricant ** (RECOMMENDED_L_EXPONENT * (1 - along)))


def residual_figure(points: Points, residual: Floats, old: Floats) -> Figure:
    """Draw residuals (formula less computed) of both formulas over L, D, r and wavelength."""
    figure = Figure(figsize=(9.5, 6.2), layout="constrained")
    panels = figure.subplots(2, 2, sharey=True).ravel()
    labels = [f"{r:g}" for r in DIRECTIONS]
    _boxes(panels[0], points.lubricant, residual, old, "L")
    _boxes(panels[1], points.radius_ratio, residual, old, "D")
    _boxes(panels[2], points.direction, residual, old, "r", labels)
    style = {"s": 5, "linewidths": 0}
    panels[3].scatter(points.wave, old, color="0.7", label="formula (18)", **style)
    panels[3].scatter(points.wave, residual, color=COLOURS[0], label="recommended", **style)
    panels[3].set_xscale("log")
    panels[3].set_xlabel(r"$\lambda_n/a$")
    panels[3].legend(loc="lower right", markerscale=3)
    for axes in panels:
        axes.axhline(0, color="k", linewidth=0.6)
    for axes in panels[::2]:
        axes.set_ylabel(r"formula less computed $A_d/A_i$")
    return figure


def _boxes(
    axes: Axes,
    values: np.ndarray,
    residual: Floats,
    old: Floats,
    name: str,
    labels: list[str] | None = None,
) -> None:
    levels = np.unique(values)
    place = np.arange(levels.size)
    for shift, numbers, colour in ((-0.18, old, "0.6"), (0.18, residual, COLOURS[0])):
        parts = axes.boxplot(
            [numbers[values == level] for level in levels],
            positions=place + shift,
            widths=0.3,
            whis=(2.5, 97.5),
            showfliers=False,
        )
        for line in (line for kind in parts.values() for line in kind):
            line.set_color(colour)
    ticks = labels or [f"{level:g}" for level in levels]
    axes.set_xticks(place, [ticks[int(level)] for level in levels] if labels else ticks)
    axes.set_xlabel(name)


def _classes(points: Points) -> list[np.ndarray]:
    r = np.array(DIRECTIONS)[points.direction]
    return [r < 0.3, (r >= 0.3) & (r <= 3), r > 3]
