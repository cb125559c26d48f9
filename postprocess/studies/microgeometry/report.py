"""Comparisons as a table and as a figure."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from ehlwave.results.figures import COLOURS
from ehlwave.writing import Writer
from studies.microgeometry.compare import Comparison

LINES = {
    "undeformed": {"label": "undeformed", "color": "0.75", "linewidth": 1.6},
    "simulated": {"label": "simulated", "color": "black", "linewidth": 1.6},
    "formula": {"label": "by formula (18)", "color": COLOURS[1], "linestyle": "--", "linewidth": 1},
    "table": {"label": "by harmonic table", "color": COLOURS[0], "linewidth": 1},
    "default": {"label": "by the atlas", "color": COLOURS[2], "linestyle": ":", "linewidth": 1.4},
}
PREDICTIONS = ("formula", "amplitudes", "linear", "table", "default")


def comparison_table(comparisons: Sequence[Comparison]) -> pd.DataFrame:
    """Return one row for each surface and condition."""
    return pd.DataFrame(
        {
            "surface": one.surface,
            "speed_m_per_s": f"{one.speed:g}",
            "amplitude_over_film": f"{one.amplitude_over_film:.3f}",
            **{f"rq_{name}_nm": f"{1e9 * one.rq(name):.2f}" for name in LINES},
            **{f"error_{name}_over_rq": f"{one.error(name):.3f}" for name in PREDICTIONS},
            "mean_shift_over_rq": f"{one.mean_shift('linear'):.3f}",
            "mean_shift_left_over_rq": f"{one.mean_shift('table'):.3f}",
            "mean_shift_default_over_rq": f"{one.mean_shift('default'):.3f}",
            "film_default_over_simulated": f"{one.film_over_simulated:.4f}",
            "simulation_s": f"{one.simulation_seconds:.2f}",
            "prediction_s": f"{one.prediction_seconds:.4f}",
            "time_ratio": f"{one.simulation_seconds / one.prediction_seconds:.0f}",
        }
        for one in comparisons
    )


def write_report(comparisons: Sequence[Comparison], folder: Path) -> str:
    """Write table.csv, table.txt and profiles.png; return the text of the table."""
    table = comparison_table(comparisons)
    writer = Writer()
    writer.table(folder / "table.csv", table)
    text = table.to_string(index=False)
    writer.text(folder / "table.txt", text + "\n")
    writer.figure(folder / "profiles.png", profiles_figure(comparisons), dpi=150)
    return text


def profiles_figure(comparisons: Sequence[Comparison]) -> Figure:
    """Draw overlaid profiles: rows are surfaces, columns speeds."""
    names = list(dict.fromkeys(one.surface for one in comparisons))
    speeds = list(dict.fromkeys(one.speed for one in comparisons))
    figure = Figure(figsize=(9.5, 2.1 * len(names)), layout="constrained")
    axes = figure.subplots(len(names), len(speeds), sharex=True, squeeze=False)
    for one in comparisons:
        axis = axes[names.index(one.surface), speeds.index(one.speed)]
        for name, style in LINES.items():
            axis.plot(one.position, 1e9 * one.heights[name], **style)
        formula, default = (100 * one.error(name) for name in ("formula", "default"))
        errors = f"error {formula:.0f} % of Rq by formula, {default:.0f} % by the atlas"
        axis.set_title(f"{one.surface}, {one.speed:g} m/s: {errors}", fontsize=8)
        axis.tick_params(labelsize=8)
    for row in axes:
        row[0].set_ylabel("height [nm]", fontsize=8)
    for axis in axes[-1]:
        axis.set_xlabel("$x/a$ on the surface, the leading end on the right", fontsize=8)
    lines = axes[0, 0].get_legend_handles_labels()
    figure.legend(*lines, loc="outside upper center", fontsize=8, ncols=len(LINES), frameon=False)
    return figure
