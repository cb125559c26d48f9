"""The one point for which the literature prints a computed Ad/Ai of an elliptical contact."""

from pathlib import Path

from ehlwave_post.formula import amplitude_ratio_formula
from ehlwave_post.points import select_points
from ehlwave_post.schema import DIMENSION
from studies.paper.data import read_stage
from studies.section import COMPARISON, Section, Table, comparison_row

PRINTED, PRINTED_FORMULA = 0.739, 0.704


def section(folder: Path) -> Section:
    """Return the point M = 1007.6, L = 12.05, D = 1, lambda = 0.25 a beside the printed values."""
    points = select_points(read_stage(folder, "companion"), include_unresolved=True)
    rows = []
    for index in range(points.sizes[DIMENSION]):
        point = points.isel({DIMENSION: index})
        linear = float(point["harmonic_extrapolated"])
        orientation = str(point["orientation"].item())
        error = linear * float(point["harmonic_error"])
        rows += [
            comparison_row(
                f"Ad/Ai, {orientation}, on 257 x 257 nodes",
                "1",
                PRINTED,
                float(point["amplitude_ratio"]),
                abs(float(point["harmonic_ratio"]) - linear),
                "error bar: this grid less the extrapolated value",
            ),
            comparison_row(
                f"Ad/Ai, {orientation}, extrapolated", "1", PRINTED, linear, error, "small waves"
            ),
            comparison_row(
                f"Ad/Ai by (18), {orientation}",
                "1",
                PRINTED_FORMULA,
                float(amplitude_ratio_formula(float(point["f_v"]))),
                None,
                "f(r) as in eq. (15)",
            ),
        ]
    return Section(
        "A printed value",
        [
            "The paper's Figures 1 and 2 show symbols, not numbers. Its companion on circular "
            "contacts (Venner and Lubrecht 1999) prints one value computed for M = 1007.6, "
            "L = 12.05, lambda/a = 0.25: Ad/Ai = 0.739, where (18) gives 0.704. Which orientation "
            "it is for is told by f(r) = 1: transverse or isotropic.",
        ],
        [Table("companion", "Ad/Ai at M = 1007.6, lambda/a = 0.25", COMPARISON, rows)],
    )
