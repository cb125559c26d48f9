"""The way to the line contact: ever more slender ellipses, and the line contact itself (D = 0)."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from ehlwave_post.figures import COLOURS
from ehlwave_post.formula import amplitude_ratio_formula, recommended_ratio
from ehlwave_post.points import select_points
from ehlwave_post.schema import DIMENSION
from studies.paper.cases import PAPER_L, PUBLISHED_LINE
from studies.paper.data import read_stage
from studies.section import (
    COMPARISON,
    Cell,
    Picture,
    Section,
    Table,
    comparison_row,
)
from studies.validation.published import small_line_ratios

ELLIPTIC_FACTOR = math.sqrt(2 * math.pi**3 / 3)
"""Of V = factor (lambda/a) (alpha ph)^(3/2) L^(-2), eq. (17), for elliptical contacts."""

LINE_FACTOR = (2 * math.pi) ** 0.75
"""The same, strictly for a line contact."""


def section(folder: Path) -> Section:
    """Return the limit D -> 0 beside the line contact, and the line contact beside the paper's."""
    points = select_points(read_stage(folder, "line"))
    published = (points["radius_ratio_d"].values == 0) & np.isclose(
        points["lubricant_parameter_l"].values, PUBLISHED_LINE[1]
    )
    study = points.isel({DIMENSION: np.flatnonzero(~published)})
    known = points.isel({DIMENSION: np.flatnonzero(published)})
    limit, factors = limit_table(study), factor_table(study)
    return Section(
        "The line contact",
        _text(study, limit, factors.rows[-1]),
        [limit, published_table(known), factors],
        [
            Picture(
                "line_contact",
                "Transverse waves: Ad/Ai of elliptical contacts and of the line contact (D = 0) "
                "against V with the factor of elliptical contacts (left), and with (2 pi)^(3/4) "
                "for the line contact (right); dashed: (18)",
                line_figure(study),
            )
        ],
    )


def common_v(points: xr.Dataset) -> np.ndarray:
    """Return V from alpha ph, eq. (17), with the factor of elliptical contacts for all points."""
    alphabar = points["alphabar"].values
    lubricant = points["lubricant_parameter_l"].values
    return ELLIPTIC_FACTOR * points["wavelength_over_a"].values * alphabar**1.5 / lubricant**2


def limit_table(points: xr.Dataset) -> Table:
    """Return Ad/Ai by D at equal Hertz pressure, L and lambda/a, the line contact last."""
    ratios = sorted(set(points["radius_ratio_d"].values.tolist()), reverse=True)
    alphabars = sorted({float(f"{value:.5g}") for value in points["alphabar"].values})
    waves = sorted(set(points["wavelength_over_a"].values.tolist()))
    rows = []
    for alphabar in alphabars:
        for wave in waves:
            chosen = np.isclose(points["alphabar"].values, alphabar, rtol=1e-4) & (
                points["wavelength_over_a"].values == wave
            )
            members = points.isel({DIMENSION: np.flatnonzero(chosen)})
            by_d = dict(
                zip(
                    members["radius_ratio_d"].values.tolist(),
                    members["deformed_ratio"].values.tolist(),
                    strict=True,
                )
            )
            if not by_d:
                continue
            v = float(common_v(members)[0])
            formula = float(amplitude_ratio_formula(v))
            # gamma M of the elliptical contact with this alpha ph and L, eq. (3).
            gamma_m = (math.pi * alphabar / PAPER_L) ** 3 / 1.5
            better = float(recommended_ratio(gamma_m, PAPER_L, 1.0, wave, 0.0))
            rows.append((alphabar, wave, v, formula, better, *(by_d.get(d) for d in ratios)))
    names = [f"D = {d:g}" if d > 0 else "line contact" for d in ratios]
    return Table(
        "line_limit",
        "Ad/Ai of transverse waves at equal alpha ph, L = 12.05 and lambda/a",
        ("alpha ph", "lambda/a", "V", "paper (18)", "recommended", *names),
        rows,
    )


def published_table(points: xr.Dataset) -> Table:
    """Return this code's line contact beside the published one."""
    rows = []
    for wave, ratio in small_line_ratios().items():
        members = points.isel({DIMENSION: points["wavelength_over_a"].values == wave})
        if members.sizes[DIMENSION]:
            value = float(members["deformed_ratio"][0])
            error = float(members["deformed_error"][0])
            rows.append(comparison_row(f"Ad/Ai, lambda/a = {wave:g}", "1", ratio, value, error))
    return Table(
        "line_published",
        "Line contact, M = W (2U)^(-1/2) = 100, L = 11, pure rolling, beside Venner and others "
        "(1997). Their lubricant beyond L is not known; theirs is Ai = 10 % of the film, ours the "
        "limit of small Ai",
        COMPARISON,
        rows,
    )


def factor_table(points: xr.Dataset) -> Table:
    """Return by which factor V of the line contact must be taken to lie on the slender ellipses."""
    rows = []
    line = points.isel({DIMENSION: points["radius_ratio_d"].values == 0})
    for d in sorted(set(points["radius_ratio_d"].values.tolist()) - {0.0}, reverse=True):
        ellipse = points.isel({DIMENSION: points["radius_ratio_d"].values == d})
        rows.append((d, *_shift(ellipse, line)))
    return Table(
        "line_factor",
        "Factor on V of the line contact that lays it on elliptical contacts of equal alpha ph and "
        f"L; (2 pi)^(3/4) / (2 pi^3/3)^(1/2) = {LINE_FACTOR / ELLIPTIC_FACTOR:.3f}",
        ("D", "factor", "rms difference with this factor", "with 1", "with the paper's"),
        rows,
    )


def line_figure(points: xr.Dataset) -> Figure:
    """Draw Ad/Ai against V, with either factor for the line contact."""
    figure = Figure(figsize=(9.0, 3.8), layout="constrained")
    panels = figure.subplots(1, 2, sharey=True)
    ratios = sorted(set(points["radius_ratio_d"].values.tolist()), reverse=True)
    colours = [*COLOURS, "#999999"]
    x = np.geomspace(0.2, 60, 200)
    for axes, factor in zip(panels, (1.0, LINE_FACTOR / ELLIPTIC_FACTOR), strict=True):
        for index, d in enumerate(ratios):
            members = points.isel({DIMENSION: points["radius_ratio_d"].values == d})
            v = common_v(members) * (factor if d == 0 else 1.0)
            style = (
                {"marker": "s", "color": "black", "markerfacecolor": "none", "markersize": 6}
                if d == 0
                else {"marker": "o", "color": colours[index % len(colours)], "markersize": 3}
            )
            label = "line contact" if d == 0 else f"D = {d:g}"
            axes.plot(v, members["deformed_ratio"].values, linestyle="none", label=label, **style)
        axes.plot(x, amplitude_ratio_formula(x), "--", color="black", linewidth=1)
        axes.set_xscale("log")
        axes.set_xlabel("V")
    panels[0].set_title("one factor for all", fontsize=10)
    panels[1].set_title("(2 pi)^(3/4) for the line contact", fontsize=10)
    panels[0].set_ylabel("Ad/Ai")
    panels[0].legend(fontsize=8, frameon=False)
    return figure


def _rms(limit: Table, column: int) -> float:
    """Return the rms of a column of formula values less the line contact, the last column."""
    pairs = [(row[column], row[-1]) for row in limit.rows if row[-1] is not None]
    return float(np.sqrt(np.mean([(float(a) - float(b)) ** 2 for a, b in pairs])))  # type: ignore[arg-type]


def _shift(ellipse: xr.Dataset, line: xr.Dataset) -> tuple[float, float, float, float]:
    """Return the best factor on V of the line contact and the rms differences."""
    factors = np.geomspace(0.6, 1.6, 401)
    rms = [_difference(ellipse, line, factor) for factor in factors]
    best = int(np.argmin(rms))
    return (
        float(factors[best]),
        rms[best],
        _difference(ellipse, line, 1.0),
        _difference(ellipse, line, LINE_FACTOR / ELLIPTIC_FACTOR),
    )


def _difference(ellipse: xr.Dataset, line: xr.Dataset, factor: float) -> float:
    """Return the rms of Ad/Ai less the line contact's, read at the same V by alpha ph."""
    squares = []
    for alphabar in sorted({float(f"{value:.5g}") for value in line["alphabar"].values}):
        a = ellipse.isel({DIMENSION: np.isclose(ellipse["alphabar"].values, alphabar, rtol=1e-4)})
        b = line.isel({DIMENSION: np.isclose(line["alphabar"].values, alphabar, rtol=1e-4)})
        if not a.sizes[DIMENSION] or not b.sizes[DIMENSION]:
            continue
        order = np.argsort(common_v(b))
        x, y = np.log(common_v(b)[order] * factor), b["deformed_ratio"].values[order]
        at = np.log(common_v(a))
        inside = (at >= x[0] - 1e-9) & (at <= x[-1] + 1e-9)
        squares += ((a["deformed_ratio"].values - np.interp(at, x, y))[inside] ** 2).tolist()
    return float(np.sqrt(np.mean(squares))) if squares else math.nan


def _text(points: xr.Dataset, limit: Table, slenderest: Sequence[Cell]) -> list[str]:
    smallest = min(d for d in points["radius_ratio_d"].values.tolist() if d > 0)
    pairs = [
        (row[-1], row[-2]) for row in limit.rows if row[-1] is not None and row[-2] is not None
    ]
    off = max(abs(float(line) - float(slender)) for line, slender in pairs) if pairs else math.nan
    return [
        "Elliptical contacts of equal alpha ph and L, from circular to D = "
        f"{smallest:g}, and a line contact on the same discrete operators. At equal lambda/a the "
        f"slenderest ellipse and the line contact differ by at most {off:.2g} in Ad/Ai.",
        "The paper takes sqrt(2 pi^3/3) for elliptical contacts and, strictly, (2 pi)^(3/4) for "
        "line contacts, whose M is defined per length. The last table says by which factor on the "
        f"first V the computed line contact lies on the ellipses: {float(slenderest[1]):.2f} for "
        f"the slenderest, where the paper's is {LINE_FACTOR / ELLIPTIC_FACTOR:.2f}; the rms "
        f"difference is {float(slenderest[3]):.2g} with the factor of elliptical contacts for both "
        f"and {float(slenderest[4]):.2g} with the paper's.",
        f"With gamma M by alpha ph, the recommended formula has an rms error of "
        f"{_rms(limit, 4):.2g} for the line contact, and (18) has {_rms(limit, 3):.2g}.",
    ]
