"""Figure of a Stribeck curve."""

from typing import TYPE_CHECKING

import numpy as np

from ehlwave.stribeck.curve import SHARE, SPEED, Stribeck

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def stribeck_figure(found: Stribeck) -> "Figure":
    """Draw friction with its parts, share of the solids and film over the speed, with error bands.

    Parameters
    ----------
    found : Stribeck
        From :func:`stribeck`.
    """
    from matplotlib.figure import Figure

    from ehlwave.results.figures import COLOURS
    from ehlwave.results.scales_of_figures import COLUMN, plain_numbers

    table = found.table.dropna(subset=[SPEED, SHARE])
    speed = table[SPEED].to_numpy(dtype=float)
    width = speed * table["speed_error"].fillna(0).to_numpy(dtype=float)
    friction = table["friction_coefficient"].abs().to_numpy(dtype=float)
    figure = Figure(figsize=(COLUMN, 6.0), layout="constrained")
    top, middle, bottom = figure.subplots(3, 1, sharex=True, height_ratios=(2, 1, 1))
    error = friction * table["friction_error"].fillna(0).to_numpy(dtype=float)
    top.fill_between(speed, friction - error, friction + error, color=COLOURS[0], alpha=0.2, lw=0)
    top.errorbar(speed, friction, xerr=width, fmt=".-", color=COLOURS[0], label="both")
    for name, label, style in (
        ("oil_friction_coefficient", "oil", "--"),
        ("solid_friction_coefficient", "solids", ":"),
    ):
        top.plot(speed, table[name].abs(), style, color=COLOURS[1], label=label)
    top.set(ylabel="friction coefficient", ylim=(0, None))
    top.legend(frameon=False, fontsize=8, loc="center right")
    share = table[SHARE].to_numpy(dtype=float)
    band = table["touching_share_error"].fillna(0).to_numpy(dtype=float)
    low, high = np.clip(share - band, 0, 1), np.clip(share + band, 0, 1)
    middle.fill_between(speed, low, high, color=COLOURS[0], alpha=0.2, lw=0)
    middle.errorbar(speed, share, xerr=width, fmt=".-", color=COLOURS[0])
    middle.set(ylabel="share of the load\non the solids", ylim=(-0.03, 1.03))
    bottom.plot(speed, 1000 * table["mean_film_um"], ".-", color=COLOURS[0])
    bottom.set(ylabel="mean film [nm]", xscale="log", yscale="log", xlabel="mean speed [m/s]")
    for axis in (bottom.yaxis, bottom.xaxis):
        plain_numbers(axis)
    return figure
