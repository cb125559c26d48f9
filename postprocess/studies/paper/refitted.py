"""The coefficients of the paper's formula, refitted: by orientation, grid, L and rheology."""

from dataclasses import asdict
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from ehlwave.contact.formula import PAPER_C1, PAPER_C2
from ehlwave.results.points import resolved_only, select_points
from ehlwave.results.refit import RefitSettings, refit_groups
from ehlwave.results.schema import DIMENSION, ORIENTATIONS
from studies.section import Picture, Section, Table, comparison, comparison_row
from studies.stages import read_stage

PAPER = {"c1": PAPER_C1, "c2": PAPER_C2}
RHEOLOGIES = {
    "rheology-default": "Roelands z = 0.68, Dowson-Higginson, alpha = 22 /GPa",
    "rheology-barus": "Barus",
    "rheology-incompressible": "incompressible",
    "rheology-index": "Roelands z = 0.4",
    "rheology-alpha": "alpha = 11 /GPa: twice the Hertz pressure",
}
MAIN = "resolved, L = 12.05"


HEADINGS = {
    "varied": "varied",
    "name": "points",
    "group": "orientation",
    "points": "number",
    "conditions": "conditions",
    "c1": "c1",
    "c1_low": "c1 from",
    "c1_high": "c1 to",
    "c2": "c2",
    "c2_low": "c2 from",
    "c2_high": "c2 to",
    "rms_paper": "rms of (18)",
    "rms_refit": "rms refitted",
}
"""Columns of the table of all refits, by their names in :func:`study_refits`."""


def section(folder: Path, settings: RefitSettings | None = None) -> Section:
    """Return c1 and c2 with bootstrap intervals by condition, and their sensitivities."""
    refits = study_refits(folder, settings or RefitSettings(replicates=500))
    return Section(
        "The paper's formula, refitted",
        _text(refits),
        [coefficient_table(refits), refit_table(refits)],
        [
            Picture(
                "coefficients",
                "c1 and c2 of Ad/Ai = 1/(1 + c1 f V + c2 (f V)^2), with 95 % bootstrap intervals "
                "by operating condition; dotted: the paper's 0.15 and 0.015",
                coefficient_figure(refits),
            )
        ],
    )


def study_refits(folder: Path, settings: RefitSettings) -> pd.DataFrame:
    """Fit every set of points of the study on f(r) V.

    A row for each set and group of points in it: ``varied`` is the quantity that varies between
    sets, ``name`` is the name of the set; the others are from
    :class:`ehlwave.results.refit.RefitRow`, with the ends of the bootstrap intervals.
    """
    resolved = select_points(read_stage(folder, "resolved"))
    coarse = select_points(read_stage(folder, "paper_grid"), include_unresolved=True)
    dense = select_points(read_stage(folder, "dense"))
    dense = dense.isel({DIMENSION: np.isin(dense["orientation"], ORIENTATIONS)})
    sets = [
        ("grid", MAIN, resolved),
        ("grid", "paper's grid, points it resolves", resolved_only(coarse)),
        ("grid", "paper's grid, all points", coarse),
        *(("L", f"L = {value:g}", part) for value, part in dense.groupby("lubricant_parameter_l")),
    ]
    for stage, name in RHEOLOGIES.items():
        sets.append(("rheology", name, select_points(read_stage(folder, stage))))
    refits = pd.DataFrame(
        {"varied": varied, "name": name, **asdict(row)}
        for varied, name, points in sets
        for row in refit_groups(points, settings, ("f_v",))
    )
    for name in PAPER:
        refits[[f"{name}_low", f"{name}_high"]] = refits[f"{name}_bootstrap"].tolist()
    return refits


def refit_table(refits: pd.DataFrame) -> Table:
    """Return a row per set of points and orientation; intervals are 95 %."""
    paper = {"varied": "", "name": "the paper", "group": "all", **PAPER}
    rows = pd.DataFrame([paper, *refits.to_dict("records")], dtype=object)
    caption = "c1 and c2 on f V, bootstrap by operating condition (M, L, D)"
    return Table("refits", caption, rows[list(HEADINGS)].rename(columns=HEADINGS))


def coefficient_table(refits: pd.DataFrame) -> Table:
    """Return c1 and c2 of the resolved points beside the paper's, by orientation."""
    rows = []
    for name, paper in PAPER.items():
        for _, row in refits[refits["name"] == MAIN].iterrows():
            error = (row[f"{name}_high"] - row[f"{name}_low"]) / 2
            rows.append(
                comparison_row(f"{name} of (18), {row.group}", "1", paper, row[name], error)
            )
    caption = (
        "Coefficients of (18) at the resolved points, L = 12.05; error bar: half of the 95 % "
        "bootstrap interval. The paper has one pair for all orientations"
    )
    return comparison("coefficients", caption, rows)


def coefficient_figure(refits: pd.DataFrame) -> Figure:
    """Draw c1 and c2 with their intervals, a line per set of points."""
    is_all = refits["group"] == "all"
    shown = refits[is_all | (refits["name"] == MAIN)]
    figure = Figure(figsize=(9.0, 0.28 * len(shown) + 1.2), layout="constrained")
    panels = figure.subplots(1, 2, sharey=True)
    place = np.arange(len(shown))[::-1]
    for axes, (name, paper) in zip(panels, PAPER.items(), strict=True):
        style = {"color": "#0072B2", "linewidth": 1.5}
        axes.hlines(place, shown[f"{name}_low"], shown[f"{name}_high"], **style)
        axes.plot(shown[name], place, "o", color="#0072B2", markersize=4)
        axes.axvline(paper, color="black", linestyle=":", linewidth=0.9)
        axes.set_xlabel(name)
        axes.grid(axis="x", linewidth=0.3)
    panels[0].set_yticks(place, shown["name"].where(is_all, shown["group"]), fontsize=8)
    return figure


def _text(refits: pd.DataFrame) -> list[str]:
    every = refits[refits["group"] == "all"]
    main = every.set_index("name").loc[MAIN]

    def extent(varied: str, name: str) -> str:
        values = every.loc[every["varied"] == varied, name]
        return f"{values.min():.3g} and {values.max():.3g}"

    return [
        "Form (18) with free coefficients, fitted to points weighted by their error bars. Points "
        "at one operating condition share its errors, so whole conditions are drawn in the "
        "bootstrap.",
        f"Resolved points of the paper's sweep: c1 = {main.c1:.3g}, c2 = {main.c2:.3g} against "
        f"0.15 and 0.015; rms {main.rms_refit:.3g} against {main.rms_paper:.3g} for (18) as it "
        "stands. The three orientations do not share one curve within their intervals.",
        f"L = 2.5 to 20 moves c1 between {extent('L', 'c1')} and c2 between {extent('L', 'c2')}; "
        f"the rheologies tried, c1 between {extent('rheology', 'c1')}, c2 between "
        f"{extent('rheology', 'c2')}.",
    ]
