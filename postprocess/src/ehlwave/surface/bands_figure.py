"""Figure of the waves to remove first."""

from collections.abc import Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from ehlwave.surface.figures import STYLE, UM
from ehlwave.surface.removal import DIRECTIONS, Band

COLOURS = dict(zip(DIRECTIONS, ("#0072B2", "#E69F00", "#009E73"), strict=True))
HATCHES = dict(zip(DIRECTIONS, ("", "///", "..."), strict=True))


def removal_figure(bands: Sequence[Band]) -> Figure:
    """Draw d ln(lambda ratio)/d ln(amplitude) of the waves in each octave, by direction.

    Bars below 0: less of these waves raises lambda.

    Parameters
    ----------
    bands : sequence of Band
        :attr:`ehlwave.surface.Deformed.bands`, at least one.

    Returns
    -------
    matplotlib.figure.Figure
        Wavelengths in um.
    """
    edges = np.array(sorted({band.shortest_m for band in bands})) * UM
    with rc_context(STYLE):
        figure = Figure(figsize=(6.4, 3.2), layout="constrained")
        axes = figure.subplots()
        low = dict.fromkeys(edges, 0.0)
        high = dict(low)
        for direction in DIRECTIONS:
            own = [band for band in bands if band.direction == direction]
            if not own:
                continue
            left = np.array([band.shortest_m for band in own]) * UM
            height = np.array([band.gradient for band in own])
            base = []
            for edge, value in zip(left, height, strict=True):
                stack = low if value < 0 else high
                base.append(stack[edge])
                stack[edge] += value
            axes.bar(
                left,
                height,
                width=[(band.longest_m - band.shortest_m) * UM for band in own],
                bottom=base,
                align="edge",
                color=COLOURS[direction],
                hatch=HATCHES[direction],
                edgecolor="white",
                linewidth=0.5,
                label=direction,
            )
        axes.set_xscale("log")
        axes.axhline(0, color="0.2", linewidth=0.8)
        axes.set_xlabel(r"wavelength [$\mu$m]")
        axes.set_ylabel(r"$d\,\ln \Lambda\,/\,d\,\ln A$ of the waves")
        axes.legend(loc="lower right", bbox_to_anchor=(1, 1), frameon=False, ncols=3)
    return figure
