"""The way to the line contact: ever more slender ellipses, and the line contact itself (D = 0)."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from ehlwave.contact.formula import amplitude_ratio_formula, recommended_ratio
from ehlwave.results.figures import COLOURS
from ehlwave.results.points import select_points
from studies.paper.cases import PAPER_L, PUBLISHED_LINE
from studies.published.values import small_line_ratios
from studies.section import Picture, Section, Table, comparison, comparison_row
from studies.stages import read_stage

ELLIPTIC_FACTOR = math.sqrt(2 * math.pi**3 / 3)
"""Factor of V = factor (lambda/a) (alpha ph)^(3/2) L^(-2), eq. (17), for elliptical contacts."""

LINE_FACTOR = (2 * math.pi) ** 0.75
"""Factor of a line contact, exactly."""


def section(folder: Path) -> Section:
    """Return the limit D -> 0 beside the line contact, and the line contact beside the paper's."""
    points = with_common_v(select_points(read_stage(folder, "line")).to_dataframe())
    published = (points["radius_ratio_d"] == 0) & np.isclose(
        points["lubricant_parameter_l"], PUBLISHED_LINE[1]
    )
    study = points[~published]
    limit, factors = limit_table(study), factor_table(study)
    return Section(
        "The line contact",
        _text(study, limit.data, factors.data.iloc[-1]),
        [limit, published_table(points[published]), factors],
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


def with_common_v(points: pd.DataFrame) -> pd.DataFrame:
    """Return points with ``alpha ph``, rounded, by which contacts of different D belong together.

    ``V``, eq. (17), is made of alpha ph with the factor of elliptical contacts for all points.
    """
    ratio = points["alphabar"] ** 1.5 / points["lubricant_parameter_l"] ** 2
    return points.assign(
        **{"alpha ph": points["alphabar"].map("{:.5g}".format).astype(float)},
        **{"V": ELLIPTIC_FACTOR * points["wavelength_over_a"] * ratio},
    )


def limit_table(points: pd.DataFrame) -> Table:
    """Return Ad/Ai by D at equal Hertz pressure, L and lambda/a, the line contact last."""
    groups = points.groupby(["alpha ph", "wavelength_over_a"])
    table = groups[["V"]].first()
    table["paper (18)"] = amplitude_ratio_formula(table["V"])
    alphabar, wave = (table.index.get_level_values(level) for level in (0, 1))
    # gamma M of the elliptical contact with this alpha ph and L, eq. (3).
    gamma_m = (math.pi * alphabar / PAPER_L) ** 3 / 1.5
    table["recommended"] = recommended_ratio(gamma_m, PAPER_L, 1.0, wave, 0.0)
    by_d = points.pivot(index=groups.keys, columns="radius_ratio_d", values="deformed_ratio")
    names = {d: f"D = {d:g}" if d > 0 else "line contact" for d in by_d}
    table = table.join(by_d.iloc[:, ::-1].rename(columns=names))
    caption = "Ad/Ai of transverse waves at equal alpha ph, L = 12.05 and lambda/a"
    return Table("line_limit", caption, table.rename_axis(["alpha ph", "lambda/a"]).reset_index())


def published_table(points: pd.DataFrame) -> Table:
    """Return this code's line contact beside the published result."""
    by_wave = points.set_index("wavelength_over_a")
    rows = []
    for wave, ratio in small_line_ratios().items():
        if wave in by_wave.index:
            value, error = by_wave.loc[wave, ["deformed_ratio", "deformed_error"]]
            rows.append(comparison_row(f"Ad/Ai, lambda/a = {wave:g}", "1", ratio, value, error))
    caption = (
        "Line contact, M = W (2U)^(-1/2) = 100, L = 11, pure rolling, beside Venner and others "
        "(1997). Their lubricant beyond L is not known; theirs is Ai = 10 % of the film, ours the "
        "limit of small Ai"
    )
    return comparison("line_published", caption, rows)


def factor_table(points: pd.DataFrame) -> Table:
    """Return by which factor V of the line contact must be taken to lie on the slender ellipses."""
    by_d = dict(list(points.groupby("radius_ratio_d")))
    line = by_d.pop(0.0)
    factors = np.geomspace(0.6, 1.6, 401)
    rows = []
    for d, ellipse in reversed(by_d.items()):
        rms = [_difference(ellipse, line, factor) for factor in factors]
        best = int(np.argmin(rms))
        row = {
            "D": d,
            "factor": factors[best],
            "rms difference with this factor": rms[best],
            "with 1": _difference(ellipse, line, 1.0),
            "with the paper's": _difference(ellipse, line, LINE_FACTOR / ELLIPTIC_FACTOR),
        }
        rows.append(row)
    caption = (
        "Factor on V of the line contact that lays it on elliptical contacts of equal alpha ph and "
        f"L; (2 pi)^(3/4) / (2 pi^3/3)^(1/2) = {LINE_FACTOR / ELLIPTIC_FACTOR:.3f}"
    )
    return Table("line_factor", caption, pd.DataFrame(rows))


def line_figure(points: pd.DataFrame) -> Figure:
    """Draw Ad/Ai against V, with either factor for the line contact."""
    figure = Figure(figsize=(9.0, 3.8), layout="constrained")
    panels = figure.subplots(1, 2, sharey=True)
    ratios = sorted(points["radius_ratio_d"].unique(), reverse=True)
    colours = [*COLOURS, "#999999"]
    x = np.geomspace(0.2, 60, 200)
    for axes, factor in zip(panels, (1.0, LINE_FACTOR / ELLIPTIC_FACTOR), strict=True):
        for index, d in enumerate(ratios):
            members = points[points["radius_ratio_d"] == d]
            v, label = members["V"], f"D = {d:g}"
            style = {"marker": "o", "color": colours[index % len(colours)], "markersize": 3}
            if d == 0:
                v, label = v * factor, "line contact"
                style = {"marker": "s", "color": "black", "mfc": "none", "markersize": 6}
            axes.plot(v, members["deformed_ratio"], linestyle="none", label=label, **style)
        axes.plot(x, amplitude_ratio_formula(x), "--", color="black", linewidth=1)
        axes.set(xscale="log", xlabel="V")
    panels[0].set_title("one factor for all", fontsize=10)
    panels[1].set_title("(2 pi)^(3/4) for the line contact", fontsize=10)
    panels[0].set_ylabel("Ad/Ai")
    panels[0].legend(fontsize=8, frameon=False)
    return figure


def _difference(ellipse: pd.DataFrame, line: pd.DataFrame, factor: float) -> float:
    """Return the rms of Ad/Ai less the line contact's, read at the same V by alpha ph."""
    squares = []
    for alphabar, known in line.sort_values("V").groupby("alpha ph"):
        some = ellipse[ellipse["alpha ph"] == alphabar]
        x, at = np.log(known["V"].to_numpy() * factor), np.log(some["V"].to_numpy())
        inside = (at >= x[0] - 1e-9) & (at <= x[-1] + 1e-9)
        off = some["deformed_ratio"] - np.interp(at, x, known["deformed_ratio"])
        squares += (off[inside] ** 2).tolist()
    return float(np.sqrt(np.mean(squares))) if squares else math.nan


def _text(points: pd.DataFrame, limit: pd.DataFrame, slenderest: pd.Series) -> list[str]:
    ratio = points["radius_ratio_d"]
    line = limit["line contact"]
    paper_rms = slenderest["with the paper's"]
    off = (line - limit.iloc[:, -2]).abs().max()
    errors = {
        name: float(np.sqrt(((limit[name] - line) ** 2).mean()))
        for name in ("recommended", "paper (18)")
    }
    return [
        "Elliptical contacts of equal alpha ph and L, from circular to D = "
        f"{ratio[ratio > 0].min():g}, and a line contact on the same discrete operators. At equal "
        f"lambda/a the slenderest ellipse and the line contact differ by at most {off:.2g} in "
        "Ad/Ai.",
        "The paper takes sqrt(2 pi^3/3) for elliptical contacts and, strictly, (2 pi)^(3/4) for "
        "line contacts, whose M is defined per length. The last table says by which factor on the "
        f"first V the computed line contact lies on the ellipses: {slenderest['factor']:.2f} for "
        f"the slenderest, where the paper's is {LINE_FACTOR / ELLIPTIC_FACTOR:.2f}; the rms "
        f"difference is {slenderest['with 1']:.2g} with the factor of elliptical contacts for both "
        f"and {paper_rms:.2g} with the paper's.",
        f"With gamma M by alpha ph, the recommended formula has an rms error of "
        f"{errors['recommended']:.2g} for the line contact, and (18) has "
        f"{errors['paper (18)']:.2g}.",
    ]
