"""Figures 1 and 2 of the paper: deformed amplitude against f(r) V2 and f(r) V."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
import xarray as xr
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter

from ehlwave.choices import chosen
from ehlwave.contact.formula import PAPER_C1, PAPER_C2, amplitude_ratio_formula
from ehlwave.results.colour_key import COLOURS, Colours, colours_of, draw_key
from ehlwave.results.fit import FitError, FormulaFit, fit_formula, point_weights
from ehlwave.results.points import VARIABLES, Variable, of_orientation, resolved_only
from ehlwave.results.schema import DIMENSION, ORIENTATIONS
from ehlwave.writing import Writer

X_LIMITS = (0.1, 100.0)
Y_LIMITS = (0.0, 1.08)
HIGHEST = 1.5
"""Largest extent of the axis where error bars are long."""
X_LABELS: dict[Variable, str] = {"f_v": r"$f(r)\,V$", "f_v2": r"$f(r)\,V_2$"}
FIGURE_NUMBERS: dict[Variable, int] = {"f_v2": 1, "f_v": 2}

# The paper's markers, by radius ratio D; "$\odot$" is a circled dot.
_PAPER_MARKERS = {1.0: "o", 0.35: "+", 0.12: r"$\odot$", 0.04: "x"}
_OTHER_MARKERS = ("s", "^", "v", "D", "<", ">", "p", "*")
_GREY = "0.6"
_STYLE: dict[Any, Any] = {
    "font.size": 8.5,
    "axes.labelsize": 9.5,
    "legend.fontsize": 8,
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
}


def collapse_figure(points: xr.Dataset, variable: Variable, color_by: str | None = None) -> Figure:
    """Draw Ad/Ai against f(r) V2 (Figure 1) or f(r) V (Figure 2).

    Parameters
    ----------
    points : xarray.Dataset
        From :func:`ehlwave.results.points.select_points`; unresolved points are drawn in grey.
    variable : {"f_v", "f_v2"}
        The abscissa, dimensionless.
    color_by : str, optional
        Column whose values colour the resolved points; without, D does.

    Returns
    -------
    matplotlib.figure.Figure
        Three panels: transverse, isotropic, longitudinal. Dashed: eq. (18) with the paper's
        coefficients. Bars: discretisation errors, where they are known. Solid: eq. (18) fitted to
        the resolved points of all orientations together, absent if they are too few; it spans the
        points it was fitted to.

    Examples
    --------
    >>> import ehlwave
    >>> grid = {"load_parameter_m": [10, 20, 50], "wavelength_over_a": [1, 2, 4]}
    >>> study = ehlwave.Study(grid, lubricant_parameter_l=5, radius_ratio_d=1,
    ...     cells_x=64, cells_y=64, orientation="transverse", response="harmonic")
    >>> results = study.run()
    >>> points = ehlwave.select_points(results, "harmonic")
    >>> figure = ehlwave.collapse_figure(points, "f_v")
    >>> len(figure.axes)
    3
    """
    chosen(variable, "variable", VARIABLES)
    colours = None if color_by is None else colours_of(points, color_by)
    refitted = _refitted(points, variable)
    resolved_x = resolved_only(points)[variable].values
    markers = _markers(points["radius_ratio_d"].values)
    with rc_context(_STYLE):
        figure = Figure(figsize=(7.6, 2.9), layout="constrained")
        panels = figure.subplots(1, len(ORIENTATIONS), sharex=True, sharey=True)
        for axes, orientation in zip(panels, ORIENTATIONS, strict=True):
            own = of_orientation(points, orientation)
            has_points = own["is_point_resolved"].values.any()
            _draw_curves(axes, refitted if has_points else None, resolved_x)
            _draw_points(axes, own, variable, markers, colours)
            _finish_panel(axes, orientation)
            axes.set_xlabel(X_LABELS[variable])
        panels[0].set_ylabel(r"$A_d/A_i$")
        panels[0].set_ylim(*y_limits(points))
        has_grey = not points["is_point_resolved"].values.all()
        handles = _point_handles(markers, has_grey, "" if colours is None else "black")
        panels[0].legend(handles=handles, loc="lower left", frameon=False)
        if colours is not None:
            draw_key(figure, panels, colours)
        panels[1].legend(handles=_curve_handles(refitted), loc="lower left", frameon=False)
    return figure


def write_figure(
    figure: Figure,
    directory: Path,
    name: str,
    dots_per_inch: int = 300,
    writer: Writer | None = None,
) -> list[Path]:
    """Save a figure as ``name``.png and ``name``.pdf; return the paths.

    The files hold no date, so equal input gives equal files.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Quantity to draw.
    directory : path
        Folder of the files.
    name : str
        Name of the files, without its ending.
    dots_per_inch : int
        Of the PNG file.
    writer : Writer, optional
        Axes to draw into; new axes by default.

    Raises
    ------
    OutputError
        If a file of the name is no result of ours, unless `writer` may replace it.

    Examples
    --------
    >>> from pathlib import Path
    >>> from matplotlib.figure import Figure
    >>> import ehlwave
    >>> [path.name for path in ehlwave.write_figure(Figure(), Path("."), "empty")]
    ['empty.png', 'empty.pdf']
    """
    chosen = writer or Writer()
    return [
        chosen.figure(directory / f"{name}.png", figure, dpi=dots_per_inch),
        chosen.figure(directory / f"{name}.pdf", figure, metadata={"CreationDate": None}),
    ]


def y_limits(points: xr.Dataset) -> tuple[float, float]:
    """Return the limits of Ad/Ai: as in the paper, higher where error bars need it."""
    tops = points["deformed_ratio"] + points["deformed_error"].fillna(0)
    inside = points["deformed_ratio"] <= Y_LIMITS[1]
    highest = float(tops.where(inside, 0).max()) if points.sizes[DIMENSION] else 0.0
    return Y_LIMITS[0], max(Y_LIMITS[1], min(highest + 0.02, HIGHEST))


def outside_axes(points: xr.Dataset, variable: Variable) -> int:
    """Return how many points of the three panels lie outside the axis limits."""
    shown = points.isel({DIMENSION: np.flatnonzero(points["orientation"].isin(ORIENTATIONS))})
    x, y = shown[variable].values, shown["deformed_ratio"].values
    low, high = y_limits(points)
    inside = (x >= X_LIMITS[0]) & (x <= X_LIMITS[1]) & (y >= low) & (y <= high)
    return int(np.sum(~inside))


def _refitted(points: xr.Dataset, variable: Variable) -> FormulaFit | None:
    resolved = resolved_only(points)
    try:
        x, ratio = resolved[variable].values, resolved["deformed_ratio"].values
        return fit_formula(x, ratio, weight=point_weights(x, ratio, resolved["deformed_error"]))
    except FitError:
        return None


def _markers(radius_ratios: np.ndarray) -> dict[float, tuple[str, str]]:
    """Return marker and colour of each D, largest D first; the paper's four keep theirs."""
    others = 0
    chosen: dict[float, tuple[str, str]] = {}
    for value in sorted({float(ratio) for ratio in radius_ratios}, reverse=True):
        known = [index for index, d in enumerate(_PAPER_MARKERS) if np.isclose(value, d)]
        if known:
            marker, colour = list(_PAPER_MARKERS.values())[known[0]], COLOURS[known[0]]
        else:
            marker = _OTHER_MARKERS[others % len(_OTHER_MARKERS)]
            colour = COLOURS[(len(_PAPER_MARKERS) + others) % len(COLOURS)]
            others += 1
        chosen[value] = (marker, colour)
    return chosen


def _draw_curves(axes: Axes, refitted: FormulaFit | None, resolved_x: np.ndarray) -> None:
    x = np.geomspace(*X_LIMITS, 400)
    axes.plot(x, amplitude_ratio_formula(x), "--", color="black", linewidth=1.1, zorder=2)
    if refitted is not None:
        # A negative c1 puts the curve above 1 up to here.
        one = -refitted.c1 / refitted.c2 if refitted.c2 > 0 else 0.0
        x = np.geomspace(max(resolved_x.min(), min(one, resolved_x.max())), resolved_x.max(), 400)
        fitted = amplitude_ratio_formula(x, refitted.c1, refitted.c2)
        axes.plot(x, fitted, "-", color="black", linewidth=0.7, zorder=2)


def _draw_points(
    axes: Axes,
    points: xr.Dataset,
    variable: Variable,
    markers: dict[float, tuple[str, str]],
    colours: Colours | None,
) -> None:
    x, y = points[variable].values, points["deformed_ratio"].values
    error = points["deformed_error"].values
    resolved = points["is_point_resolved"].values
    for ratio, (marker, colour) in markers.items():
        of_ratio = points["radius_ratio_d"].values == ratio
        for mask, shade, order in ((~resolved, _GREY, 1), (resolved, colour, 3)):
            chosen = of_ratio & mask
            if chosen.any():
                for part, own in _shades(points, chosen, shade, colours):
                    style = _marker_style(marker, own)
                    axes.plot(x[part], y[part], linestyle="none", zorder=order, **style)
                    has_bar = part & (error > 0)
                    bars = {"ecolor": own, "elinewidth": 0.5, "fmt": "none", "zorder": order}
                    axes.errorbar(x[has_bar], y[has_bar], error[has_bar], **bars)


def _shades(
    points: xr.Dataset, chosen: np.ndarray, shade: str, colours: Colours | None
) -> list[tuple[np.ndarray, str]]:
    """Return the chosen points with their colour: one, or one per value of the column."""
    if colours is None or shade == _GREY:
        return [(chosen, shade)]
    values = points[colours.column].values
    parts = [(chosen & (values == value), own) for value, own in colours.by_value.items()]
    return [(part, own) for part, own in parts if part.any()]


def _finish_panel(axes: Axes, orientation: str) -> None:
    axes.set_xscale("log")
    axes.set_xlim(*X_LIMITS)
    axes.set_yticks(np.arange(0, 1.01, 0.2))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.tick_params(which="both", direction="in", top=True, right=True)
    axes.text(0.95, 0.90, orientation, transform=axes.transAxes, ha="right", va="top")


def _marker_style(marker: str, colour: str) -> dict[str, Any]:
    is_glyph = marker.startswith("$")
    return {
        "marker": marker,
        "markersize": 6.0 if is_glyph else 4.5,
        "markeredgecolor": colour,
        "markeredgewidth": 0.3 if is_glyph else 0.9,
        "markerfacecolor": colour if is_glyph else "none",
    }


def _point_handles(
    markers: dict[float, tuple[str, str]], has_grey: bool, colour: str
) -> Sequence[Line2D]:
    handles = [
        Line2D(
            [],
            [],
            linestyle="none",
            label=f"$D = {ratio:g}$",
            **_marker_style(marker, colour or own),
        )
        for ratio, (marker, own) in markers.items()
    ]
    if has_grey:
        style = _marker_style("o", _GREY)
        handles.append(Line2D([], [], linestyle="none", label="grey: unresolved", **style))
    return handles


def _curve_handles(refitted: FormulaFit | None) -> Sequence[Line2D]:
    def curve(name: str, c1: float, c2: float, line: Literal["--", "-"], width: float) -> Line2D:
        label = f"{name}\n$c_1={c1:.3g}$\n$c_2={c2:.3g}$"
        return Line2D([], [], linestyle=line, color="black", linewidth=width, label=label)

    handles = [curve("Venner et al.", PAPER_C1, PAPER_C2, "--", 1.1)]
    if refitted is not None:
        handles.append(curve("refitted", refitted.c1, refitted.c2, "-", 0.7))
    return handles
