"""Figures 1 and 2: on the paper's grid, and again where wave and inlet are resolved."""

from collections import Counter
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from ehlwave_post.figures import COLOURS, collapse_figure, outside_axes
from ehlwave_post.formula import amplitude_ratio_formula
from ehlwave_post.points import of_orientation, resolved_only, select_points
from ehlwave_post.schema import DIMENSION, ORIENTATIONS
from studies.paper.data import matched, point_keys, read_stage
from studies.section import Picture, Section, Table


def section(folder: Path) -> Section:
    """Return Figures 1 and 2 of the paper twice, and what the paper's grid made of each point."""
    coarse = select_points(read_stage(folder, "paper_grid"), include_unresolved=True)
    fine = select_points(read_stage(folder, "resolved"))
    resolved_here = resolved_only(coarse)
    pair = matched(coarse, fine)
    pictures = []
    for points, name, where in (
        (coarse, "paper_grid", "on the paper's grid: 257 x 257 nodes, dT = hX, Ai = 20 %"),
        (fine, "resolved", "resolved: linear responses with error bars from two grids"),
    ):
        for number, variable in ((1, "f_v2"), (2, "f_v")):
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
            grid_error_figure(*pair),
        )
    )
    return Section(
        "Figures 1 and 2",
        _text(coarse, fine, resolved_here, pair),
        [unresolved_table(coarse, fine), error_table(*pair), point_table(coarse, fine)],
        pictures,
    )


def unresolved_table(coarse: xr.Dataset, fine: xr.Dataset) -> Table:
    """Return which of the paper's points its grid could not resolve, and by how much it was off."""
    rows = []
    resolved_values = dict(zip(point_keys(fine), fine["deformed_ratio"].values, strict=True))
    keys = point_keys(coarse)
    for orientation in ORIENTATIONS:
        for d in sorted(set(coarse["radius_ratio_d"].values.tolist()), reverse=True):
            chosen = (coarse["orientation"].values == orientation) & (
                coarse["radius_ratio_d"].values == d
            )
            bad = chosen & ~coarse["is_point_resolved"].values
            waves = coarse["wavelength_over_a"].values[bad]
            per_wave = points_per_wave(coarse)[bad]
            off = [
                coarse["deformed_ratio"].values[index] - resolved_values[keys[index]]
                for index in np.flatnonzero(bad)
                if keys[index] in resolved_values
            ]
            rows.append(
                (
                    orientation,
                    d,
                    int(chosen.sum()),
                    int(bad.sum()),
                    float(waves.max()) if bad.any() else None,
                    float(per_wave.min()) if bad.any() else None,
                    float(np.max(np.abs(off))) if off else None,
                )
            )
    return Table(
        "unresolved_on_paper_grid",
        "Points that the paper's grid could not resolve: fewer than 8 points per wave in X or Y, "
        "or too coarse for the inlet",
        (
            "orientation",
            "D",
            "points",
            "not resolved",
            "longest lambda/a of them",
            "fewest points per wave",
            "largest error of Ad/Ai where known",
        ),
        rows,
    )


def error_table(coarse: xr.Dataset, fine: xr.Dataset) -> Table:
    """Return quantiles of Ad/Ai on the paper's grid less the resolved value."""
    difference = np.abs(coarse["deformed_ratio"].values - fine["deformed_ratio"].values)
    resolved = coarse["is_point_resolved"].values
    m = coarse["load_parameter_m"].values
    groups = {
        "resolved on the paper's grid": resolved,
        "of them M up to 200": resolved & (m <= 200),
        "of them M from 500": resolved & (m >= 500),
        "not resolved there": ~resolved,
    }
    rows = []
    for name, chosen in groups.items():
        if chosen.any():
            quantiles = np.quantile(difference[chosen], [0.5, 0.9, 1.0])
            rows.append((name, int(chosen.sum()), *(float(value) for value in quantiles)))
    return Table(
        "paper_grid_error",
        "Difference between the paper's grid and the resolved Ad/Ai, absolute value",
        ("points", "number", "median", "90 %", "largest"),
        rows,
    )


def point_table(coarse: xr.Dataset, fine: xr.Dataset) -> Table:
    """Return every point: formula, paper's grid, resolved value with error bar."""
    place = {key: index for index, key in enumerate(point_keys(fine))}
    rows = []
    per_wave = points_per_wave(coarse)
    for index, key in enumerate(point_keys(coarse)):
        here = coarse.isel({DIMENSION: index})
        there = fine.isel({DIMENSION: place[key]}) if key in place else None
        value, error = (
            (float(there["deformed_ratio"]), float(there["deformed_error"]))
            if there is not None
            else (None, None)
        )
        ours = float(here["deformed_ratio"])
        formula = float(amplitude_ratio_formula(float(here["f_v"])))
        rows.append(
            (
                str(here["orientation"].item()),
                float(here["load_parameter_m"]),
                float(here["lubricant_parameter_l"]),
                float(here["radius_ratio_d"]),
                float(here["wavelength_over_a"]),
                float(here["f_v2"]),
                float(here["f_v"]),
                formula,
                float(here["amplitude_ratio"]),
                ours,
                value,
                None if value is None else value - formula,
                error,
                None if value is None else ours - value,
                float(per_wave[index]),
                "yes" if here["is_point_resolved"].item() else "no",
            )
        )
    return Table(
        "points",
        "Every point of Figures 1 and 2. The paper's own points are only printed as symbols; its "
        "formula (18) stands for them",
        (
            "orientation",
            "M",
            "L",
            "D",
            "lambda/a",
            "f V2",
            "f V",
            "paper (18)",
            "paper's grid, eq. (14)",
            "paper's grid, harmonic fit",
            "resolved",
            "difference to (18)",
            "error bar",
            "grid error",
            "points per wave",
            "resolved on the paper's grid",
        ),
        rows,
        is_long=True,
    )


def points_per_wave(points: xr.Dataset) -> np.ndarray:
    """Return the smaller number of points per wave of X and Y; a direction without waves has 0."""
    both = np.stack([points[f"points_per_wave_{axis}"].values.astype(float) for axis in "xy"])
    both = np.where(both > 0, both, np.inf)
    return np.min(both, axis=0)


def grid_error_figure(coarse: xr.Dataset, fine: xr.Dataset) -> Figure:
    """Draw the error of the paper's grid against points per wave, a panel per orientation."""
    figure = Figure(figsize=(9.0, 3.2), layout="constrained")
    panels = figure.subplots(1, len(ORIENTATIONS), sharey=True)
    both = coarse.assign(
        fine_ratio=(DIMENSION, fine["deformed_ratio"].values),
        fine_error=(DIMENSION, fine["deformed_error"].values),
        per_wave=(DIMENSION, points_per_wave(coarse)),
    )
    for axes, orientation in zip(panels, ORIENTATIONS, strict=True):
        members = of_orientation(both, orientation)
        for d, colour in zip((1.0, 0.35, 0.12, 0.04), COLOURS, strict=False):
            chosen = members.isel({DIMENSION: members["radius_ratio_d"].values == d})
            axes.errorbar(
                chosen["per_wave"],
                chosen["deformed_ratio"] - chosen["fine_ratio"],
                chosen["fine_error"],
                fmt=".",
                color=colour,
                markersize=4,
                elinewidth=0.5,
                label=f"D = {d:g}",
            )
        axes.axhline(0, color="black", linewidth=0.6)
        axes.axvline(8, color="0.5", linewidth=0.8, linestyle=":")
        axes.set_xscale("log")
        axes.set_title(orientation, fontsize=10)
        axes.set_xlabel("points per wave")
    panels[0].set_ylabel("Ad/Ai, paper's grid less resolved")
    panels[0].legend(fontsize=8, frameon=False)
    return figure


def _text(
    coarse: xr.Dataset,
    fine: xr.Dataset,
    resolved_here: xr.Dataset,
    pair: tuple[xr.Dataset, xr.Dataset],
) -> list[str]:
    statuses = Counter(coarse["status"].values.tolist())
    kinds = ", ".join(f"{count} {name}" for name, count in statuses.items())
    f_v = coarse["f_v"].values
    difference = pair[0]["deformed_ratio"].values - pair[1]["deformed_ratio"].values
    rms = float(np.sqrt(np.mean(difference[pair[0]["is_point_resolved"].values] ** 2)))
    error = fine["deformed_error"].values
    known = error[np.isfinite(error)]
    without = "" if known.size == error.size else f"; {error.size - known.size} have none"
    return [
        f"The paper's sweep has {coarse.sizes[DIMENSION]} points here ({kinds}), f V from "
        f"{f_v.min():.2g} to {f_v.max():.3g}, marched in time on the paper's grid (longitudinal "
        "waves from two steady states). Points that this grid cannot resolve are grey.",
        f"{resolved_here.sizes[DIMENSION]} of them have at least 8 points per wave and an inlet "
        "that is resolved. The paper draws its points without saying which of them its grid could "
        "resolve: the first table does.",
        f"{fine.sizes[DIMENSION]} points were computed again by the linear response on grids that "
        f"resolve wave and inlet; half of the error bars are below {np.median(known):.2g}, the "
        f"largest is {known.max():.2g}{without}. Where the paper's grid resolves a point, its rms "
        f"difference to the resolved value is {rms:.2g}. Part of that is not the grid: the marched "
        "waves have 20 % of the film, the linear response is that of small ones.",
    ]
