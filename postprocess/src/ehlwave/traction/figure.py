"""Figure of friction and temperatures over the slide-to-roll ratio."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from ehlwave.inputs.slip import RATIO
from ehlwave.traction.table import CURVES, Traction

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

RISES = {
    "rise_mid_film_k": "half-way across the film",
    "rise_wall_1_k": "surface 1",
    "rise_wall_2_k": "surface 2",
    "rise_surfaces_k": "surfaces, mean",
}
"""Labels of the columns of temperatures."""


def traction_figure(found: Traction) -> "Figure":
    """Draw friction, and with heat the rises of the temperature, over the slide-to-roll ratio.

    Parameters
    ----------
    found : Traction
        From :func:`traction`.
    """
    from matplotlib.figure import Figure

    from ehlwave.results.figures import COLOURS
    from ehlwave.results.scales_of_figures import COLUMN

    table = found.table
    has_heat = "thermal" in table
    figure = Figure(figsize=(COLUMN, 6.6 if has_heat else 3.4), layout="constrained")
    panels = np.atleast_1d(figure.subplots(2 if has_heat else 1, 1))
    left = panels[0]
    for name, label in CURVES.items():
        if name in table:
            colour = COLOURS[1 if name in ("thermal", "limited_thermal") else 0]
            style = "--" if "limited" in name else "-"
            left.plot(table[RATIO], table[name], style, marker=".", color=colour, label=label)
    if "friction_error" in table:
        value, error = table[found.curve], table["friction_error"].astype(float)
        colour = COLOURS[1 if has_heat else 0]
        ends = value * np.maximum(1 - error, 0), value * (1 + error)
        left.fill_between(table[RATIO], *ends, color=colour, alpha=0.15, lw=0, label="error")
    top = 1.3 * float(np.nanmax(table[[name for name in CURVES if name in table]].to_numpy()))
    if found.limit is not None and found.limit < top:
        left.axhline(found.limit, color="black", lw=0.7, ls=":", label="limit of the stress")
    left.set(ylabel="friction coefficient", ylim=(0, top))
    left.legend(frameon=False, fontsize=8, loc="center left", bbox_to_anchor=(0, 0.72))
    if has_heat:
        shown = (name for name in RISES if name in table)
        for name, colour, mark in zip(shown, COLOURS[2:], "os^v", strict=False):
            style = {"color": colour, "marker": mark, "ms": 3, "label": RISES[name]}
            panels[1].plot(table[RATIO], table[name], **style)
        panels[1].set(ylabel="largest temperature rise [K]", ylim=(0, None))
        panels[1].legend(frameon=False, fontsize=8)
    for axes in panels:
        axes.set(xscale="log", xlabel="slide-to-roll ratio")
    _name_regimes(left, table)
    return figure


def _name_regimes(axes: "Axes", table: pd.DataFrame) -> None:
    """Shade every other regime and write its name above."""
    ratio, names = table[RATIO].to_numpy(dtype=float), table["regime"].tolist()
    starts = [i for i, name in enumerate(names) if i == 0 or name != names[i - 1]]
    edges = [ratio[0], *(np.sqrt(ratio[i - 1] * ratio[i]) for i in starts[1:]), ratio[-1]]
    for k, start in enumerate(starts):
        if k % 2:
            axes.axvspan(edges[k], edges[k + 1], color="0.94", lw=0, zorder=0)
        middle = np.sqrt(edges[k] * edges[k + 1])
        axes.text(
            middle,
            0.98,
            names[start],
            transform=axes.get_xaxis_transform(),
            ha="center",
            va="top",
            fontsize=8,
            rotation=0 if edges[k + 1] > 3 * edges[k] else 90,
        )
