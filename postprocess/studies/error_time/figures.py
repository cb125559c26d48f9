"""Figures: error against seconds, against counted work, and against the tolerance."""

from collections.abc import Sequence
from typing import NamedTuple

import pandas as pd
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from studies.error_time.errors import FILMS, RATIO, by_contact, with_defaults
from studies.error_time.runs import SMOOTH, TIGHT, WAVY, Contact

COSTS = {"seconds": "run time, s", "work": "counted work, FFT convolutions of 256 x 256 cells"}
QUANTITIES = {
    "central_film": "error of $H_c$",
    "minimum_film": r"error of $H_{\min}$",
    RATIO: "error of $A_d/A_i$",
}
_STYLE = {"font.size": 8.5, "axes.titlesize": 8.5, "legend.fontsize": 8}


class _Line(NamedTuple):
    label: str
    method: str
    deformation: str
    step: float
    marker: str
    colour: str


# Colours that stay apart for colour-blind readers (Okabe and Ito).
_LINES = (
    _Line("newton, FFT", "newton", "fft", 1.0, "o", "#0072B2"),
    _Line("newton, FFT, dT = 2 hX", "newton", "fft", 2.0, "s", "#56B4E9"),
    _Line("newton, FFT, dT = 4 hX", "newton", "fft", 4.0, "^", "#E69F00"),
    _Line("newton, MLMI", "newton", "mlmi", 1.0, "x", "#D55E00"),
    _Line("FAS, FFT", "fas", "fft", 1.0, "D", "#009E73"),
    _Line("PETSc, FFT", "petsc", "fft", 1.0, "+", "#CC79A7"),
)


def error_figure(errors: pd.DataFrame, cost: str, panels: Sequence[tuple[Contact, str]]) -> Figure:
    """Draw error against cost, a panel for each contact and quantity, a line for each method.

    Parameters
    ----------
    errors : pandas.DataFrame
        From :func:`studies.error_time.errors.error_rows`.
    cost : {"seconds", "work"}
        The abscissa. Work inside PETSc is not counted: no points in work.
    panels : sequence of (Contact, quantity)
        Quantities to draw; two panels per row.
    """
    with rc_context(_STYLE):
        rows = (len(panels) + 1) // 2
        figure = Figure(figsize=(7.2, 0.7 + 2.1 * rows), layout="constrained")
        axes = figure.subplots(rows, 2, squeeze=False)
        lines = {}
        members = dict(by_contact(errors))
        for panel, (contact, quantity) in zip(axes.flat, panels, strict=False):
            some = members.get(contact, errors[:0])
            lines.update(_draw_methods(panel, some[some["quantity"] == quantity], cost))
            panel.set_title(contact.title)
            panel.set_ylabel(QUANTITIES[quantity])
            _label_axes(panel)
            panel.grid(visible=True, which="major", linewidth=0.3)
        for panel in axes[-1]:
            panel.set_xlabel(COSTS[cost])
        figure.legend(lines.values(), lines, loc="outside upper center", ncols=3, frameon=False)
        figure.supxlabel("Numbers at the points: cells along X.", fontsize=8)
    return figure


def all_panels() -> dict[str, list[tuple[Contact, str]]]:
    """Return the panels of each figure by its name."""
    return {
        "ratio": [(contact, RATIO) for contact in WAVY],
        "film": [(contact, quantity) for contact in SMOOTH for quantity in FILMS],
    }


def short_panels() -> list[tuple[Contact, str]]:
    """Return the panels of the figure in the README."""
    return [(SMOOTH[0], FILMS[0]), (WAVY[0], RATIO)]


def tolerance_figure(errors: pd.DataFrame) -> Figure:
    """Draw the algebraic error of Ad/Ai against the step tolerance beside the whole error."""
    with rc_context(_STYLE):
        figure = Figure(figsize=(7.2, 3.2), layout="constrained")
        left, right = figure.subplots(1, 2, sharey=True)
        chosen = with_defaults(errors[errors["quantity"] == RATIO], "step_tolerance")
        members = dict(by_contact(chosen))
        for contact in WAVY:
            rows = members.get(contact, chosen[:0])
            cells = rows.loc[rows["step_tolerance"] == TIGHT, "cells"].max()
            if pd.isna(cells):
                continue
            rows = rows[rows["cells"] == cells].sort_values("step_tolerance")
            label = f"{contact.title.replace('transverse, ', '')}, {cells:.0f} cells"
            for panel, name in ((left, "algebraic_error"), (right, "error")):
                panel.plot(rows["step_tolerance"], rows[name], "o-", markersize=3, label=label)
        for panel, title in ((left, "of the iteration alone"), (right, "whole")):
            panel.set(xscale="log", yscale="log", xlabel="step_tolerance")
            panel.set_title(f"error of $A_d/A_i$, {title}")
            panel.grid(visible=True, which="major", linewidth=0.3)
        if left.lines:
            figure.legend(handles=left.lines, loc="outside lower center", ncols=2, frameon=False)
    return figure


def _label_axes(axes: Axes) -> None:
    """Label decades, and 2 and 5 between them where there are few decades."""
    for axis, limits in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        is_short = limits[1] < 50 * limits[0]
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if is_short else (1,)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())


def _draw_methods(axes: Axes, rows: pd.DataFrame, cost: str) -> dict[str, object]:
    axes.set(xscale="log", yscale="log")
    drawn = {}
    shown = with_defaults(rows[rows["error"] < 1], "method", "deformation", "time_step_over_cell")
    by_line = dict(list(shown.groupby(["method", "deformation", "time_step_over_cell"])))
    for line in _LINES:
        key = (line.method, line.deformation, line.step)
        if key not in by_line or (cost, line.method) == ("work", "petsc"):
            continue
        chosen = by_line[key].sort_values("cells")
        style = {"marker": line.marker, "color": line.colour, "markersize": 4, "linewidth": 0.9}
        (drawn[line.label],) = axes.plot(chosen[cost], chosen["error"], fillstyle="none", **style)
        if line is _LINES[0]:
            for cells, *place in chosen[["cells", cost, "error"]].to_numpy():
                style = {"textcoords": "offset points", "fontsize": 6.5}
                axes.annotate(f"{cells:.0f}", place, (3, 3), **style)
    return drawn
