"""The only point for which the literature prints a computed Ad/Ai of an elliptical contact."""

from pathlib import Path

from ehlwave.contact.formula import amplitude_ratio_formula
from ehlwave.results.points import select_points
from studies.section import Section, comparison, comparison_row
from studies.stages import read_stage

PRINTED, PRINTED_FORMULA = 0.739, 0.704


def section(folder: Path) -> Section:
    """Return the point M = 1007.6, L = 12.05, D = 1, lambda = 0.25 a beside the printed values."""
    points = select_points(read_stage(folder, "companion"), include_unresolved=True)
    rows = []
    for point in points.to_dataframe().itertuples():
        linear, name = point.harmonic_extrapolated, f"Ad/Ai, {point.orientation}"
        coarse, formula = point.amplitude_ratio, float(amplitude_ratio_formula(point.f_v))
        on_grid = f"{name}, on 257 x 257 nodes", "1", PRINTED, coarse
        limit = f"{name}, extrapolated", "1", PRINTED, linear
        by_formula = f"Ad/Ai by (18), {point.orientation}", "1", PRINTED_FORMULA, formula
        remark = "error bar: this grid less the extrapolated value"
        rows += [
            comparison_row(*on_grid, abs(point.harmonic_ratio - linear), remark),
            comparison_row(*limit, linear * point.harmonic_error, "small waves"),
            comparison_row(*by_formula, remark="f(r) as in eq. (15)"),
        ]
    return Section(
        "A printed value",
        [
            "The paper's Figures 1 and 2 show symbols, not numbers. Its companion on circular "
            "contacts (Venner and Lubrecht 1999) prints one value computed for M = 1007.6, "
            "L = 12.05, lambda/a = 0.25: Ad/Ai = 0.739, where (18) gives 0.704. Which orientation "
            "it is for is told by f(r) = 1: transverse or isotropic."
        ],
        [comparison("companion", "Ad/Ai at M = 1007.6, lambda/a = 0.25", rows)],
    )
