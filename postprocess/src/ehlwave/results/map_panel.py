"""Common parts of maps of a contact: the colour bar beside the map, and the arrow along rolling."""

from typing import Any

from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.patheffects import withStroke


def bar_beside(
    axes: Axes,
    mesh: ScalarMappable,
    label: str = "",
    *,
    capped: bool = False,
    ticks: Any = None,  # noqa: ANN401 - as matplotlib has it
) -> None:
    """Draw a colour bar at the right side of a map, as tall as the map.

    Parameters
    ----------
    axes : Axes
        Panel of the map.
    mesh : ScalarMappable
        The map.
    label : str
        Quantity and unit.
    capped : bool
        Whether larger values have the last colour: the bar then ends in a tip.
    ticks : sequence of float, optional
        Labelled values; by default as many as there is room for.
    """
    place = axes.inset_axes((1.03, 0, 0.045, 1))
    extend: Any = "max" if capped else "neither"
    axes.figure.colorbar(mesh, cax=place, label=label, extend=extend, ticks=ticks)


def rolling_arrow(axes: Axes) -> None:
    """Draw an arrow along rolling into the lower left corner of a map."""
    outline = [withStroke(linewidth=2.2, foreground="black")]
    arrow = axes.annotate(
        "",
        xy=(0.24, 0.055),
        xytext=(0.05, 0.055),
        xycoords="axes fraction",
        arrowprops={"arrowstyle": "-|>", "color": "white", "lw": 1.2, "path_effects": outline},
    )
    arrow.set_in_layout(False)
    place = {"transform": axes.transAxes, "va": "center", "color": "white", "fontsize": 8}
    shade = {"facecolor": (0, 0, 0, 0.55), "linewidth": 0, "boxstyle": "round,pad=0.15"}
    axes.text(0.27, 0.055, "rolling", bbox=shade, **place)
