"""The coefficients of the paper's formula, refitted: by orientation, grid, L and rheology."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from ehlwave_post.formula import PAPER_C1, PAPER_C2
from ehlwave_post.points import resolved_only, select_points
from ehlwave_post.refit import RefitRow, RefitSettings, refit_groups
from ehlwave_post.schema import DIMENSION, ORIENTATIONS
from studies.paper.data import read_stage
from studies.section import COMPARISON, Picture, Section, Table, comparison_row

RHEOLOGIES = {
    "rheology-default": "Roelands z = 0.68, Dowson-Higginson, alpha = 22 /GPa",
    "rheology-barus": "Barus",
    "rheology-incompressible": "incompressible",
    "rheology-index": "Roelands z = 0.4",
    "rheology-alpha": "alpha = 11 /GPa: twice the Hertz pressure",
}
MAIN = "resolved, L = 12.05"


@dataclass(frozen=True)
class Refit:
    """The refit of one set of points: what varies, its name, and the rows of its groups."""

    varied: str
    name: str
    rows: list[RefitRow]


def section(folder: Path, settings: RefitSettings | None = None) -> Section:
    """Return c1 and c2 with bootstrap intervals by condition, and what they are sensitive to."""
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


def study_refits(folder: Path, settings: RefitSettings) -> list[Refit]:
    """Fit every set of points of the study on f(r) V."""
    resolved = select_points(read_stage(folder, "resolved"))
    coarse = select_points(read_stage(folder, "paper_grid"), include_unresolved=True)
    dense = select_points(read_stage(folder, "dense"))
    dense = dense.isel(
        {DIMENSION: np.flatnonzero(np.isin(dense["orientation"].values, ORIENTATIONS))}
    )
    sets = [
        ("grid", MAIN, resolved),
        ("grid", "paper's grid, points it resolves", resolved_only(coarse)),
        ("grid", "paper's grid, all points", coarse),
    ]
    lubricants = dense["lubricant_parameter_l"].values
    for value in sorted(set(lubricants.tolist())):
        members = dense.isel({DIMENSION: np.flatnonzero(lubricants == value)})
        sets.append(("L", f"L = {value:g}", members))
    for stage, name in RHEOLOGIES.items():
        sets.append(("rheology", name, select_points(read_stage(folder, stage))))
    return [
        Refit(
            varied,
            name,
            [row for row in refit_groups(points, settings) if row.variable == "f_v"],
        )
        for varied, name, points in sets
    ]


def refit_table(refits: list[Refit]) -> Table:
    """Return a row per set of points and orientation; intervals are 95 %."""
    rows: list[tuple[str | float | int | None, ...]] = [
        ("", "the paper", "all", None, None, PAPER_C1, None, None, PAPER_C2, None, None, None, None)
    ]
    for refit in refits:
        for row in refit.rows:
            rows.append(
                (
                    refit.varied,
                    refit.name,
                    row.group,
                    row.points,
                    row.conditions,
                    row.c1,
                    *row.c1_bootstrap,
                    row.c2,
                    *row.c2_bootstrap,
                    row.rms_paper,
                    row.rms_refit,
                )
            )
    return Table(
        "refits",
        "c1 and c2 on f V, bootstrap by operating condition (M, L, D)",
        (
            "varied",
            "points",
            "orientation",
            "number",
            "conditions",
            "c1",
            "from",
            "to",
            "c2",
            "from",
            "to",
            "rms of (18)",
            "rms refitted",
        ),
        rows,
    )


def coefficient_table(refits: list[Refit]) -> Table:
    """Return c1 and c2 of the resolved points beside the paper's, by orientation."""
    main = next(refit for refit in refits if refit.name == MAIN)
    rows = []
    for name, paper in (("c1", PAPER_C1), ("c2", PAPER_C2)):
        for row in main.rows:
            low, high = getattr(row, f"{name}_bootstrap")
            rows.append(
                comparison_row(
                    f"{name} of (18), {row.group}", "1", paper, getattr(row, name), (high - low) / 2
                )
            )
    caption = (
        "Coefficients of (18) at the resolved points, L = 12.05; error bar: half of the 95 % "
        "bootstrap interval. The paper has one pair for all orientations"
    )
    return Table("coefficients", caption, COMPARISON, rows)


def coefficient_figure(refits: list[Refit]) -> Figure:
    """Draw c1 and c2 with their intervals, one line per set of points."""
    entries = [
        (refit.name if row.group == "all" else row.group, row)
        for refit in refits
        for row in refit.rows
        if row.group == "all" or refit.name == MAIN
    ]
    figure = Figure(figsize=(9.0, 0.28 * len(entries) + 1.2), layout="constrained")
    panels = figure.subplots(1, 2, sharey=True)
    place = np.arange(len(entries))[::-1]
    for axes, name, paper in zip(panels, ("c1", "c2"), (PAPER_C1, PAPER_C2), strict=True):
        for y, (_, row) in zip(place, entries, strict=True):
            value = getattr(row, name)
            low, high = getattr(row, f"{name}_bootstrap")
            axes.plot([low, high], [y, y], color="#0072B2", linewidth=1.5)
            axes.plot([value], [y], "o", color="#0072B2", markersize=4)
        axes.axvline(paper, color="black", linestyle=":", linewidth=0.9)
        axes.set_xlabel(name)
        axes.grid(axis="x", linewidth=0.3)
    panels[0].set_yticks(place, [name for name, _ in entries], fontsize=8)
    return figure


def _text(refits: list[Refit]) -> list[str]:
    def all_of(name: str) -> RefitRow:
        return next(refit.rows[0] for refit in refits if refit.name == name)

    main = all_of(MAIN)
    by_l = [refit.rows[0] for refit in refits if refit.varied == "L"]
    by_rheology = [refit.rows[0] for refit in refits if refit.varied == "rheology"]
    return [
        "Form (18) with free coefficients, fitted to points weighted by their error bars. Points "
        "at one operating condition share its errors, so whole conditions are drawn in the "
        "bootstrap.",
        f"Resolved points of the paper's sweep: c1 = {main.c1:.3g}, c2 = {main.c2:.3g} against "
        f"0.15 and 0.015; rms {main.rms_refit:.3g} against {main.rms_paper:.3g} for (18) as it "
        "stands. The three orientations do not share one curve within their intervals.",
        f"L = 2.5 to 20 moves c1 between {min(row.c1 for row in by_l):.3g} and "
        f"{max(row.c1 for row in by_l):.3g} and c2 between {min(row.c2 for row in by_l):.3g} and "
        f"{max(row.c2 for row in by_l):.3g}; the rheologies tried, c1 between "
        f"{min(row.c1 for row in by_rheology):.3g} and {max(row.c1 for row in by_rheology):.3g}, "
        f"c2 between {min(row.c2 for row in by_rheology):.3g} and "
        f"{max(row.c2 for row in by_rheology):.3g}.",
    ]
