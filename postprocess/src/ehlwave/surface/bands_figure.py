"""Figure of the waves to remove first."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlwave.results.scales_of_figures import COLUMN
from ehlwave.surface.figures import STYLE, UM
from ehlwave.surface.removal import DIRECTIONS, Band, Waves

COLOURS = dict(zip(DIRECTIONS, ("#0072B2", "#E69F00", "#009E73"), strict=True))
HATCHES = dict(zip(DIRECTIONS, ("", "///", "..."), strict=True))


def removal_figure(bands: Sequence[Band]) -> Figure:
    """Draw the exponents of lambda ratio and smallest film in the amplitude of the waves.

    A bar for each octave of the wavelength, by direction. Bars below 0: less of these waves raises
    the lambda ratio, or the smallest film.

    Parameters
    ----------
    bands : sequence of Band
        :attr:`ehlwave.surface.Deformed.bands`, at least one.

    Returns
    -------
    matplotlib.figure.Figure
        Wavelengths in um.
    """
    panels: dict[str, list[tuple[Waves, float]]] = {
        "lambda ratio": [(band, band.gradient) for band in bands]
    }
    if films := [(b, b.film_gradient) for b in bands if b.film_gradient is not None]:
        panels["smallest film"] = [*films]
    return bars_figure(panels)


def bars_figure(panels: Mapping[str, Sequence[tuple[Waves, float]]]) -> Figure:
    """Draw the exponents of results, by name, in the amplitude of the waves: a panel for each."""
    with rc_context(STYLE):
        figure = Figure(figsize=(COLUMN, 0.8 + 1.6 * len(panels)), layout="constrained")
        all_axes = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
        for axes, (name, values) in zip(all_axes, panels.items(), strict=True):
            _draw_bars(axes, values)
            axes.set_ylabel(f"{name},\n% per 1 % of amplitude")
        all_axes[-1].set_xscale("log")
        all_axes[-1].set_xlabel(r"wavelength [$\mu$m]")
        found = all_axes[0].get_legend_handles_labels()
        figure.legend(*found, loc="outside upper center", ncols=3, frameon=False)
    return figure


def _draw_bars(axes: Axes, values: Sequence[tuple[Waves, float]]) -> None:
    """Draw values, stacked over the directions of an octave."""
    ends: dict[tuple[float, bool], float] = {}
    for direction in DIRECTIONS:
        own = [(band, value) for band, value in values if band.direction == direction]
        base = []
        for band, value in own:
            place = band.shortest_m, value < 0
            base.append(ends.get(place, 0.0))
            ends[place] = base[-1] + value
        if own:
            axes.bar(
                np.array([band.shortest_m for band, _ in own]) * UM,
                [value for _, value in own],
                width=[(band.longest_m - band.shortest_m) * UM for band, _ in own],
                bottom=base,
                align="edge",
                color=COLOURS[direction],
                hatch=HATCHES[direction],
                edgecolor="white",
                linewidth=0.5,
                label=direction,
            )
    axes.axhline(0, color="0.2", linewidth=0.8)
