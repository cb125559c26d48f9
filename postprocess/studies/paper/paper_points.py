"""Figures 1 and 2: on the paper's grid, and again where wave and inlet are resolved."""

from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure

from ehlwave.contact.formula import amplitude_ratio_formula
from ehlwave.results.figures import COLOURS, FIGURE_NUMBERS, collapse_figure, outside_axes
from ehlwave.results.points import count_by_status, select_points
from ehlwave.results.schema import ORIENTATIONS
from studies.section import Picture, Section, Table
from studies.stages import by_point, read_stage


def section(folder: Path) -> Section:
    """Return Figures 1 and 2 of the paper twice, with the errors of points on the paper's grid."""
    coarse = select_points(read_stage(folder, "paper_grid"), include_unresolved=True)
    fine = select_points(read_stage(folder, "resolved"))
    both = side_by_side(coarse, fine)
    pictures = []
    for points, name, where in (
        (coarse, "paper_grid", "on the paper's grid: 257 x 257 nodes, dT = hX, Ai = 20 %"),
        (fine, "resolved", "resolved: linear responses with error bars from two grids"),
    ):
        for variable, number in FIGURE_NUMBERS.items():
            hidden = outside_axes(points, variable)
            caption = f"Figure {number} of the paper, {where}"
            caption += f"; {hidden} point(s) lie outside the axes" if hidden else ""
            picture = collapse_figure(points, variable)
            pictures.append(Picture(f"figure{number}_{name}", caption, picture))
    pictures.append(
        Picture(
            "grid_error",
            "What the paper's grid adds: Ad/Ai there less the resolved value, against points per "
            "wave (the fewer of X and Y); bars: error of the resolved value",
            grid_error_figure(both),
        )
    )
    return Section(
        "Figures 1 and 2",
        _text(coarse, fine, both),
        [unresolved_table(both), error_table(both), point_table(both)],
        pictures,
    )


def side_by_side(coarse: xr.Dataset, fine: xr.Dataset) -> pd.DataFrame:
    """Return the points of the paper's grid with the recomputed values.

    Added are ``resolved_ratio`` and ``resolved_error``, NaN where there is no resolved point;
    ``grid_error``, Ad/Ai on the paper's grid less that; and ``per_wave``, the smaller number of
    points per wave of X and Y.
    """
    names = {"deformed_ratio": "resolved_ratio", "deformed_error": "resolved_error"}
    both = by_point(coarse).join(by_point(fine)[list(names)].rename(columns=names))
    both["grid_error"] = both["deformed_ratio"] - both["resolved_ratio"]
    per_wave = both[["points_per_wave_x", "points_per_wave_y"]]
    both["per_wave"] = per_wave.where(per_wave > 0, np.inf).min(axis=1)
    return both.reset_index(drop=True)


def unresolved_table(both: pd.DataFrame) -> Table:
    """Return which of the paper's points its grid could not resolve, and by how much it was off."""
    rows = []
    ratios = sorted(both["radius_ratio_d"].unique(), reverse=True)
    for orientation, d in product(ORIENTATIONS, ratios):
        chosen = both[(both["orientation"] == orientation) & (both["radius_ratio_d"] == d)]
        bad = chosen[~chosen["is_point_resolved"]]
        row = {
            "orientation": orientation,
            "D": d,
            "points": len(chosen),
            "not resolved": len(bad),
            "longest lambda/a of them": bad["wavelength_over_a"].max(),
            "fewest points per wave": bad["per_wave"].min(),
            "largest error of Ad/Ai where known": bad["grid_error"].abs().max(),
        }
        rows.append(row)
    caption = (
        "Points that the paper's grid could not resolve: fewer than 8 points per wave in X or Y, "
        "or too coarse for the inlet"
    )
    return Table("unresolved_on_paper_grid", caption, pd.DataFrame(rows))


def error_table(both: pd.DataFrame) -> Table:
    """Return quantiles of Ad/Ai on the paper's grid less the resolved value."""
    known = both[both["grid_error"].notna()]
    resolved, m = known["is_point_resolved"], known["load_parameter_m"]
    groups = {
        "resolved on the paper's grid": resolved,
        "of them M up to 200": resolved & (m <= 200),
        "of them M from 500": resolved & (m >= 500),
        "not resolved there": ~resolved,
    }
    shares = {"median": 0.5, "90 %": 0.9, "largest": 1.0}
    rows = []
    for name, chosen in groups.items():
        if chosen.any():
            difference = known.loc[chosen, "grid_error"].abs()
            quantiles = {heading: difference.quantile(share) for heading, share in shares.items()}
            rows.append({"points": name, "number": len(difference), **quantiles})
    caption = "Difference between the paper's grid and the resolved Ad/Ai, absolute value"
    return Table("paper_grid_error", caption, pd.DataFrame(rows))


def point_table(both: pd.DataFrame) -> Table:
    """Return every point: formula, paper's grid, resolved value with error bar."""
    formula = amplitude_ratio_formula(both["f_v"])
    columns = {
        "orientation": both["orientation"],
        "M": both["load_parameter_m"],
        "L": both["lubricant_parameter_l"],
        "D": both["radius_ratio_d"],
        "lambda/a": both["wavelength_over_a"],
        "f V2": both["f_v2"],
        "f V": both["f_v"],
        "paper (18)": formula,
        "paper's grid, eq. (14)": both["amplitude_ratio"],
        "paper's grid, harmonic fit": both["deformed_ratio"],
        "resolved": both["resolved_ratio"],
        "difference to (18)": both["resolved_ratio"] - formula,
        "error bar": both["resolved_error"],
        "grid error": both["grid_error"],
        "points per wave": both["per_wave"],
        "resolved on the paper's grid": both["is_point_resolved"].map({True: "yes", False: "no"}),
    }
    caption = (
        "Every point of Figures 1 and 2. The paper's own points are only printed as symbols; its "
        "formula (18) stands for them"
    )
    return Table("points", caption, pd.DataFrame(columns), is_long=True)


def grid_error_figure(both: pd.DataFrame) -> Figure:
    """Draw the error of the paper's grid against points per wave, a panel per orientation."""
    figure = Figure(figsize=(9.0, 3.2), layout="constrained")
    panels = figure.subplots(1, len(ORIENTATIONS), sharey=True)
    bars = {"fmt": ".", "markersize": 4, "elinewidth": 0.5}
    for axes, orientation in zip(panels, ORIENTATIONS, strict=True):
        members = both[both["orientation"] == orientation]
        for d, colour in zip((1.0, 0.35, 0.12, 0.04), COLOURS, strict=False):
            some = members[members["radius_ratio_d"] == d]
            x, y, error = some["per_wave"], some["grid_error"], some["resolved_error"]
            axes.errorbar(x, y, error, color=colour, label=f"D = {d:g}", **bars)
        axes.axhline(0, color="black", linewidth=0.6)
        axes.axvline(8, color="0.5", linewidth=0.8, linestyle=":")
        axes.set(xscale="log", xlabel="points per wave")
        axes.set_title(orientation, fontsize=10)
    panels[0].set_ylabel("Ad/Ai, paper's grid less resolved")
    panels[0].legend(fontsize=8, frameon=False)
    return figure


def _text(coarse: xr.Dataset, fine: xr.Dataset, both: pd.DataFrame) -> list[str]:
    kinds = ", ".join(f"{count} {name}" for name, count in count_by_status(coarse).items())
    f_v, resolved = both["f_v"], both["is_point_resolved"]
    rms = float(np.sqrt((both.loc[resolved, "grid_error"] ** 2).mean()))
    error = fine["deformed_error"].values
    known = error[np.isfinite(error)]
    without = "" if known.size == error.size else f"; {error.size - known.size} have none"
    return [
        f"The paper's sweep has {len(both)} points here ({kinds}), f V from "
        f"{f_v.min():.2g} to {f_v.max():.3g}, marched in time on the paper's grid (longitudinal "
        "waves from two steady states). Points that this grid cannot resolve are grey.",
        f"{resolved.sum()} of them have at least 8 points per wave and an inlet "
        "that is resolved. The paper draws its points without saying which of them its grid could "
        "resolve: the first table does.",
        f"{error.size} points were computed again by the linear response on grids that "
        f"resolve wave and inlet; half of the error bars are below {np.median(known):.2g}, the "
        f"largest is {known.max():.2g}{without}. Where the paper's grid resolves a point, its rms "
        f"difference to the resolved value is {rms:.2g}. Part of that is not the grid: the marched "
        "waves have 20 % of the film, the linear response is that of small ones.",
    ]
