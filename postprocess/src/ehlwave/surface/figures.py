"""Figures of a prediction: heights before and after, and their spectra."""

from typing import Any, Protocol

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlwave.choices import Window
from ehlwave.contact.conditions import Conditions
from ehlwave.results.scales_of_figures import COLUMN, aspect_note, readable_aspect
from ehlwave.surface.prepare import judged_part
from ehlwave.surface.spectrum import Spectrum
from ehlwave.surface.surface import Heights, Surface

UM = 1e6
BEFORE, AFTER = "0.55", "#0072B2"
MOST_PIXELS = 1024
STYLE: dict[Any, Any] = {"font.size": 8.5, "axes.labelsize": 9, "legend.fontsize": 8}


class Drawn(Protocol):
    """A prediction, as :class:`ehlwave.surface.Deformed`."""

    @property
    def surface(self) -> Surface:
        """As made."""

    @property
    def height(self) -> Heights:
        """In the contact, m."""

    @property
    def conditions(self) -> Conditions:
        """Unit of the contact."""

    @property
    def window(self) -> Window:
        """Treatment of the ends."""

    @property
    def spectra(self) -> dict[str, Spectrum]:
        """Before and after, along x and y."""


def deformed_figure(result: Drawn) -> Figure:
    """Draw a trace, or a map with its centre line, before and after; the contact to scale.

    The difference is the flattening in the contact: height as made less height in the contact.

    Returns
    -------
    matplotlib.figure.Figure
        Lengths and heights in um.
    """
    with rc_context(STYLE):
        if result.surface.is_trace:
            figure = Figure(figsize=(COLUMN, 3.8), layout="constrained")
            whole, detail = figure.subplots(2, 1)
            _draw_line(whole, result, None)
            _draw_line(detail, result, 1.0)
            whole.legend(loc="lower right", bbox_to_anchor=(1, 1), frameon=False, ncols=3)
            return figure
        figure = Figure(figsize=(8.4, 5.0), layout="constrained")
        maps = ["before", "after", "difference"]
        axes = figure.subplot_mosaic([maps, ["line"] * 3], height_ratios=[1, 1])
        _draw_maps(figure, [axes[name] for name in maps], result)
        _draw_line(axes["line"], result, 2.0)
        axes["line"].legend(loc="lower right", bbox_to_anchor=(1, 1), frameon=False, ncols=3)
    return figure


def spectrum_figure(result: Drawn) -> Figure:
    """Draw the mean square of the components before and after against their wavelength.

    Neighbouring waves are collected in 24 bands per decade. Shaded: longer than the contact in this
    direction; components that are so in both directions cannot be judged.
    """
    spectra, conditions = result.spectra, result.conditions
    panels = [
        (letter, text, spectra[letter], semi_axis)
        for letter, text, semi_axis in (
            ("x", "along rolling", conditions.semi_axis_a_m),
            ("y", "across rolling", conditions.semi_axis_b_m),
        )
        if spectra[letter].waves.size > 1
    ]
    with rc_context(STYLE):
        figure = Figure(figsize=(3.4 * len(panels) + 0.4, 3.2), layout="constrained")
        all_axes = figure.subplots(1, len(panels), squeeze=False, sharey=True)[0]
        for axes, (letter, text, spectrum, semi_axis) in zip(all_axes, panels, strict=True):
            parts = (spectrum.waves[1:], spectrum.before[1:], spectrum.after[1:])
            wavelength, squares = _bands(*parts)
            draw = axes.loglog if (squares > 0).any() else axes.semilogx  # a smooth surface has 0
            draw(wavelength * UM, squares[0] * UM**2, ".-", color=BEFORE, label="before")
            draw(wavelength * UM, squares[1] * UM**2, ".-", color=AFTER, label="after")
            limit = 2 * semi_axis * UM
            if wavelength.max() * UM > limit:
                end, name = axes.get_xlim()[1], "longer than the contact"
                axes.axvspan(limit, end, color="0.9", lw=0, zorder=0, label=name)
                axes.set_xlim(right=end)
            axes.set_xlabel(rf"$\lambda_{letter}$ [$\mu$m], {text}")
        all_axes[0].set_ylabel(r"mean square per band [$\mu$m$^2$]")
        # Eight decades at most: rounding errors of absent components mean nothing.
        low, high = all_axes[0].get_ylim()
        all_axes[0].set_ylim(max(low, high * 1e-8), high)
        found = max(
            (axes.get_legend_handles_labels() for axes in all_axes), key=lambda h: len(h[0])
        )
        close = {"columnspacing": 1.0, "handlelength": 1.4, "frameon": False}
        figure.legend(*found, loc="outside upper center", ncols=3, **close)
    return figure


def _draw_line(axes: Axes, result: Drawn, half_width: float | None) -> None:
    """Draw a trace, or the line y = middle of a map; ``half_width`` semi-axes about the middle."""
    surface = result.surface
    along_x = not surface.is_trace or surface.trace_axis == "x"
    c = result.conditions
    semi_axis = c.semi_axis_a_m if along_x else c.semi_axis_b_m
    step = surface.step_x_m if along_x else surface.step_y_m
    pick = (slice(None), surface.height.shape[1] // 2) if along_x else (0, slice(None))
    before, after = surface.height[pick] * UM, result.height[pick] * UM
    position = np.arange(before.size) * step
    middle = position[-1] / 2
    shown = slice(None)
    if half_width is not None:
        low, high = np.searchsorted(position, middle + half_width * semi_axis * np.array([-1, 1]))
        shown = slice(low, high)
    axes.plot(position[shown] * UM, before[shown], color=BEFORE, linewidth=1, label="before")
    axes.plot(position[shown] * UM, after[shown], color=AFTER, linewidth=1, label="in the contact")
    inside = middle + semi_axis * np.array([-1, 1])
    letter, axis = ("x", "2a") if along_x else ("y", "2b")
    axes.margins(x=0)
    axes.set_xlabel(rf"${letter}$ [$\mu$m]")
    if not surface.is_trace:
        across = surface.step_y_m * (surface.height.shape[1] // 2) * UM
        axes.set_xlabel(rf"$x$ [$\mu$m], at $y$ = {across:.4g} $\mu$m")
    if half_width == 1.0:
        axes.set_xlabel(rf"${letter}$ [$\mu$m], over the contact alone, ${axis}$")
    elif inside[0] >= position[0] and inside[1] <= position[-1]:
        name = f"contact, ${axis}$"
        axes.axvspan(*(inside * UM), color="0.92", lw=0, zorder=0, label=name)
    axes.set_ylabel(r"height [$\mu$m]")


def _draw_maps(figure: Figure, panels: list[Axes], result: Drawn) -> None:
    surface = result.surface
    stride = tuple(max(1, count // MOST_PIXELS) for count in surface.height.shape)
    pick = (slice(None, None, stride[0]), slice(None, None, stride[1]))
    nx, ny = surface.height.shape
    lengths = nx * surface.step_x_m * UM, ny * surface.step_y_m * UM
    part = judged_part((nx, ny), result.window)
    before, after = surface.height[pick] * UM, result.height[pick] * UM
    left = before - after
    limits = [np.percentile(surface.height[part][pick], [0.1, 99.9]) * UM] * 2
    largest = float(np.percentile(np.abs((surface.height - result.height)[part]), 99.9)) * UM
    limits.append(np.array([-1, 1]) * (largest or 1.0))
    titles = "as made", "in the contact", "difference"
    images = []
    for axes, height, title, ends in zip(
        panels, (before, after, left), titles, limits, strict=True
    ):
        images.append(
            axes.imshow(
                height.T,
                origin="lower",
                extent=(0.0, lengths[0], 0.0, lengths[1]),
                vmin=ends[0],
                vmax=ends[1],
                cmap="RdBu_r" if title == "difference" else "viridis",
                aspect=readable_aspect(*lengths),
            )
        )
        axes.set_title(title, fontsize=9)
        axes.set_xlabel(r"$x$, rolling [$\mu$m]")
    panels[0].set_ylabel(r"$y$ [$\mu$m]" + aspect_note(*lengths))
    below: dict[str, Any] = {"location": "bottom", "aspect": 30}
    figure.colorbar(images[1], ax=panels[:2], label=r"height [$\mu$m]", shrink=0.5, **below)
    label = r"as made $-$ in the contact [$\mu$m]"
    figure.colorbar(images[2], ax=panels[2], label=label, **below)


def _bands(waves: np.ndarray, *squares: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return wavelengths, m, and the sums of squares in bands of equal width on a log scale."""
    band = np.floor(24 * np.log10(waves)).astype(int)
    names, index = np.unique(band, return_inverse=True)
    wavelength = 10 ** (-(names + 0.5) / 24)
    sums = [np.bincount(index, weights=square) for square in squares]
    return wavelength, np.array(sums)
