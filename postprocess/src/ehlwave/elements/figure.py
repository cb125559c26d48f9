"""Figures of the table of an element: film, roughness, friction, temperature and stress."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import xarray as xr

from ehlwave.elements.table import ERRORS
from ehlwave.extras import load

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D


class Curve(NamedTuple):
    """A column of a panel."""

    name: str
    factor: float
    label: str
    style: str = "-"


PANELS: dict[str, tuple[Curve, ...]] = {
    "film [um]": (
        Curve("central_film_m", 1e6, "central"),
        Curve("minimum_film_m", 1e6, "smallest", "--"),
        Curve("isothermal_central_film_m", 1e6, "central, without heat", ":"),
    ),
    "lambda ratio": (
        Curve("lambda_ratio", 1, "deformed roughness"),
        Curve("lambda_ratio_before", 1, "roughness as made", "--"),
        Curve("isothermal_lambda_ratio", 1, "deformed, without heat", ":"),
    ),
    "friction coefficient": (Curve("friction", 1, "friction"),),
    "temperature rise [K]": (
        Curve("rise_mid_film_k", 1, "mid-film"),
        Curve("rise_surfaces_k", 1, "surfaces", "--"),
    ),
    "stress [GPa]": (
        Curve("hertz_pressure_pa", 1e-9, "Hertz pressure"),
        Curve("largest_shear_pa", 1e-9, "largest shear stress", "--"),
    ),
    "Dang Van's factor": (Curve("dang_van", 1, "largest"),),
}
"""Panels by their labels; one without known numbers is left out."""

LEGEND: dict[str, Any] = {"frameon": False, "fontsize": 7.5, "columnspacing": 1.2}
WIDTH, HEIGHT = 7.2, 2.7
"""Width of the figure and height of a row, inches; legends are above their panels."""

DEGREES = (1, 1.5, 3, 4.5, 6, 9, 10)
"""Steps of ticks of angles, by a power of ten."""

AXES = {
    "angle_deg": ("angle [degrees]", 1.0),
    "distance_m": ("distance along the line of action [mm]", 1e3),
    "speed_m_per_s": ("mean speed [m/s]", 1.0),
}
MARKERS = ("o", "s")
"""Marks of the rings, apart from their colours."""


def element_figure(table: xr.Dataset) -> Figure:
    """Draw the table of an element; bands are errors of the solid curves.

    Parameters
    ----------
    table : xarray.Dataset
        From ``over_load_zone``, ``along_path``, ``over_cycle`` or ``over_speeds``.

    Examples
    --------
    >>> import ehlwave
    >>> from ehlwave.elements import SpurGearPair, element_figure
    >>> oil = ehlwave.Oil.from_grade(iso_vg=220, viscosity_index=95, temperature_k=343.15,
    ...     eyring_stress_pa=5e6)
    >>> gears = SpurGearPair(module_m=0.003, teeth=(20, 40), face_width_m=0.03)
    >>> figure = element_figure(gears.along_path(pinion_torque_n_m=150, pinion_speed_rpm=1500,
    ...     oil=oil, points=5))
    >>> [axes.get_ylabel() for axes in figure.axes][:2]
    ['film [um]', 'friction coefficient']
    """
    load("matplotlib.figure")  # names the extra where it is missing
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D
    from matplotlib.ticker import MaxNLocator

    shown = {label: curves for label, curves in PANELS.items() if _is_known(table, curves)}
    rows = (len(shown) + 1) // 2
    figure = Figure(figsize=(WIDTH, HEIGHT * rows), layout="constrained")
    grid = np.atleast_1d(figure.subplots(rows, 2, sharex=True)).ravel()
    coordinate = next(name for name in AXES if name in table.dims)
    name, factor = AXES[coordinate]
    for axes, (label, curves) in zip(grid, shown.items(), strict=False):
        _draw(axes, table, coordinate, factor, curves)
        axes.set(ylabel=label)
        axes.set_ylim(bottom=0)
        _shade_unanswered(axes, table, coordinate, factor, curves)
        place = (0.5, 1.08 if coordinate == "distance_m" else 1.0)  # above the letters
        handles, names = axes.get_legend_handles_labels()
        lines: dict[str, Artist] = dict(zip(names, handles, strict=True))
        if "ring" in table.dims:  # line styles; the key of the figure has the rings
            styles = {str(one.get_label()): one.get_linestyle() for one in axes.get_lines()}
            lines |= {k: Line2D([], [], color="0.3", ls=style) for k, style in styles.items()}
        shape = {"loc": "lower center", "bbox_to_anchor": place, "ncols": 2}
        axes.legend(list(lines.values()), list(lines), **shape, **LEGEND)
    for axes in grid[len(shown) :]:
        axes.set_axis_off()
    for axes in grid[:2] if rows == 1 else grid[-2:]:
        axes.set_xlabel(name)
        axes.tick_params(labelbottom=True)
        if coordinate == "angle_deg":
            axes.xaxis.set_major_locator(MaxNLocator(7, steps=DEGREES))
    if len(shown) % 2 and rows > 1:
        grid[-3].set_xlabel(name)
        grid[-3].tick_params(labelbottom=True)
    if "ring" in table.dims:
        names = [f"{ring} ring" for ring in table["ring"].values]
        figure.legend(_marks(names), names, loc="outside upper center", ncols=2, **LEGEND)
    if coordinate == "distance_m" and "named_points_mm" in table.attrs:
        _name_points(grid[: len(shown)], str(table.attrs["named_points_mm"]))
    return figure


def _is_known(table: xr.Dataset, curves: tuple[Curve, ...]) -> bool:
    """Return whether any number of a panel is known and not 0 everywhere."""
    found = [table[curve.name].values for curve in curves if curve.name in table]
    return any(np.isfinite(one).any() and np.nanmax(np.abs(one)) > 0 for one in found)


def _shade_unanswered(
    axes: Axes, table: xr.Dataset, coordinate: str, factor: float, curves: tuple[Curve, ...]
) -> None:
    """Shade the places where no curve of a panel has a number."""
    x = table[coordinate].values * factor
    others = [name for name in table.dims if name != coordinate]
    known = [np.isfinite(table[one.name]).any(others).values for one in curves if one.name in table]
    unanswered = ~np.any(known, axis=0)
    edges = np.concatenate([x[:1], (x[1:] + x[:-1]) / 2, x[-1:]])
    label = "no answer"
    for low, high, is_left_out in zip(edges[:-1], edges[1:], unanswered, strict=True):
        if is_left_out:
            axes.axvspan(low, high, color="0.93", lw=0, zorder=0, label=label)
            label = ""


def _draw(
    axes: Axes, table: xr.Dataset, coordinate: str, factor: float, curves: tuple[Curve, ...]
) -> None:
    """Draw the curves of a panel, each ring in its colour and with its mark."""
    from ehlwave.results.colour_key import COLOURS

    x = table[coordinate].values * factor
    rings = table["ring"].values.tolist() if "ring" in table.dims else [None]
    for ring, colour, marker in zip(rings, COLOURS, MARKERS, strict=False):
        part = table if ring is None else table.sel(ring=ring)
        for curve in curves:
            if curve.name not in part or not np.isfinite(part[curve.name].values).any():
                continue
            y = part[curve.name].values * curve.factor
            axes.plot(
                x, y, curve.style, color=colour, marker=marker, ms=2.5, lw=1.2, label=curve.label
            )
            error = part.get(ERRORS.get(curve.name, ""))
            if error is not None and curve.style == "-":
                low = y * np.maximum(1 - error.values, 0)
                axes.fill_between(x, low, y * (1 + error.values), color=colour, alpha=0.15, lw=0)


def _marks(names: list[str]) -> list[Line2D]:
    """Return the mark of each ring, for the key of the figure."""
    from matplotlib.lines import Line2D

    from ehlwave.results.colour_key import COLOURS

    pairs = zip(names, COLOURS, MARKERS, strict=False)
    return [Line2D([], [], color=colour, marker=marker, ls="") for _, colour, marker in pairs]


def _name_points(grid: np.ndarray, text: str) -> None:
    """Mark A to E of a path of contact."""
    for word in text.split(", "):
        letter, place = word.split()
        for axes in grid:
            axes.axvline(float(place), color="0.8", lw=0.7, zorder=0)
            axes.text(
                *(float(place), 1.0, letter),
                transform=axes.get_xaxis_transform(),
                ha="center",
                va="bottom",
                fontsize=7,
            )
