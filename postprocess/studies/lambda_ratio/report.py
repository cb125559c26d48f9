"""Tables and figure of the study."""

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlwave.results.figures import COLOURS
from ehlwave.surface.amplitude import lowest_film
from ehlwave.writing import Writer
from studies.lambda_ratio.judge import (
    OILS,
    factors,
    fitted_width,
    lowest_table,
    touching,
    trusted_table,
    with_errors,
)
from studies.lambda_ratio.simulate import HELD_OUT, SMALL

MARKS = {"isotropic": "o", "longitudinal": "^", "transverse": "s"}


def write_report(compared: pd.DataFrame, folder: Path) -> str:
    """Write marches.csv, trusted.csv, factors.csv, lowest.csv, touching.csv and lambda.png.

    Returns the tables as text.
    """
    writer, said = Writer(overwrite=True), []
    rounded = compared.copy()
    for name in rounded.select_dtypes("float"):
        rounded[name] = rounded[name].map(lambda one: f"{one:.4g}", na_action="ignore")
    writer.table(folder / "marches.csv", rounded)
    for name, table in (
        ("trusted", trusted_table(compared)),
        ("factors", factors(compared)),
        ("lowest", lowest_table(compared)),
        ("touching", touching(compared)),
    ):
        writer.table(folder / f"{name}.csv", table)
        said.append(table.to_string(index=False))
    writer.figure(folder / "lambda.png", lambda_figure(compared), dpi=150)
    return "\n\n".join(said)


def lambda_figure(compared: pd.DataFrame) -> Figure:
    """Draw errors of lambda ratio and mean film over the roughness, and the lowest films."""
    table = with_errors(compared)
    table = table[table["level"] > SMALL]
    figure = Figure(figsize=(10.5, 4.2), layout="constrained")
    ratio, mean, lowest = figure.subplots(1, 3)
    for axis, name in ((ratio, "lambda_error"), (mean, "mean_error")):
        _points(axis, table, "rq_over_film", 100 * table[name])
        axis.axhline(0, color="0.7", linewidth=0.8, zorder=0)
        axis.set_xlabel("Rq of the map over the smooth film")
    ratio.set_ylabel("error of the lambda ratio [%]")
    mean.set_ylabel("error of the mean film [%]")
    _points(lowest, table, "lowest_predicted", table["lowest_marched"])
    linear = np.linspace(table["lowest_predicted"].min() - 0.05, 1, 100)
    width = fitted_width(compared)
    curve = [lowest_film(one, width) for one in linear]
    lines = lowest.plot(linear, curve, color="black", linewidth=1, label=f"width {width:.2f}")
    lines += lowest.plot(linear, linear, color="0.7", linewidth=0.8, zorder=0, label="linear")
    lowest.set(ylim=(0, 1), xlabel="lowest film over the smooth one, linear")
    lowest.set_ylabel("lowest film over the smooth one, marched")
    lowest.legend(handles=lines, fontsize=8, frameon=False)
    handles, labels = ratio.get_legend_handles_labels()
    found = dict(zip(labels, handles, strict=True))
    figure.legend(
        found.values(), found.keys(), loc="outside upper center", fontsize=8, ncols=3, frameon=False
    )
    return figure


def _points(axis: Axes, table: pd.DataFrame, x: str, y: pd.Series) -> None:
    """Draw one point for each march: colour by motion and oil, mark by lay."""
    for colour, oil in zip(COLOURS, OILS.values(), strict=False):
        for lay, mark in MARKS.items():
            chosen = ((table["oil"] == oil) & (table["lay"] == lay)).to_numpy()
            is_held_out = (table["contact"] == HELD_OUT).to_numpy()
            for part, face in ((chosen & ~is_held_out, colour), (chosen & is_held_out, "none")):
                label = f"{oil}, {lay}" if face != "none" else None
                axis.scatter(
                    table[x][part], y[part], 20, marker=mark, ec=colour, fc=face, label=label
                )
