"""Where linear ends: amplitude of the transient over that of the linear response.

``python -m studies.linearity RESULTS --output DIR`` is what ``scripts/study linearity`` ends with.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib import rc_context
from matplotlib.figure import Figure

from ehlwave.errors import ResultsError
from ehlwave.results.figures import COLOURS, write_figure
from ehlwave.results.read import read_results
from ehlwave.results.schema import CONVERGED, DIMENSION, UNRESOLVED
from ehlwave.results.tables import write_dataset_csv
from studies.command import maps
from studies.command.options import step_parser
from studies.sweeps import run_command

COLUMNS = (
    "load_parameter_m",
    "radius_ratio_d",
    "orientation",
    "wavelength_over_a",
    "amplitude_over_film",
    "harmonic_ratio",
    "amplitude_ratio",
    "amplitude_ratio_fit",
    "fit_over_linear",
    "range_over_linear",
    "phase_difference",
)
"""Formats of the table of :func:`linearity_points`."""

_PATTERN = ("load_parameter_m", "radius_ratio_d", "orientation", "wavelength_over_a")
_STYLE = {"font.size": 8.5, "axes.labelsize": 9.5, "legend.fontsize": 8}
_FEWEST = 3


def linearity_points(results: xr.Dataset) -> xr.Dataset:
    """Return the cases run both ways, with the ratios of the transient to the linear response.

    Parameters
    ----------
    results : xarray.Dataset
        From :func:`ehlwave.results.read.read_results`, of cases with ``response = 'both'``.

    Returns
    -------
    xarray.Dataset
        Over ``case``, dimensionless: ``fit_over_linear``, Ad/Ai of the harmonic fit over that of
        the linear response; ``range_over_linear``, the same of eq. (14), which counts the higher
        harmonics too; ``phase_difference`` in radian, NaN for longitudinal waviness.

    Raises
    ------
    ResultsError
        If no case has both.
    """
    if "harmonic_ratio" not in results:
        raise ResultsError("no linear responses in these results: run with response = 'both'")
    has_both = np.isfinite(results["harmonic_ratio"]) & np.isfinite(results["amplitude_ratio_fit"])
    has_both &= results["status"].isin((CONVERGED, UNRESOLVED))
    if not has_both.any():
        raise ResultsError("no case has a transient and a linear response: run response = 'both'")
    chosen = results.isel({DIMENSION: np.flatnonzero(has_both)})
    linear = chosen["harmonic_ratio"]
    turn = chosen["phase_fit"] - chosen["harmonic_phase"]
    return chosen.assign(
        fit_over_linear=chosen["amplitude_ratio_fit"] / linear,
        range_over_linear=chosen["amplitude_ratio"] / linear,
        phase_difference=(turn + np.pi) % (2 * np.pi) - np.pi,
    )


def linearity_text(points: xr.Dataset) -> str:
    """Return, for each Ai over the film, the largest deviations from linear."""
    lines = ["Ai/Hc   cases   largest deviation of Ad/Ai: fit, range; of the phase in rad"]
    for amplitude, part in points.groupby("amplitude_over_film"):
        fit, extent = (
            100 * float(abs(part[name] - 1).max())
            for name in ("fit_over_linear", "range_over_linear")
        )
        turn = float(abs(part["phase_difference"]).max())
        phase = f"{turn:.4f}" if np.isfinite(turn) else "-"
        count = part.sizes[DIMENSION]
        lines.append(f"{amplitude:<8g}{count:5d}   {fit:8.2f} % {extent:8.2f} %   {phase}")
    return "\n".join(lines)


def linearity_figure(points: xr.Dataset) -> Figure:
    """Draw Ad/Ai over that of the linear response against Ai over the film.

    Patterns with fewer than three amplitudes are left out. Solid: harmonic fit; dashed: half the
    range of the film, eq. (14).
    """
    groups = points.to_dataframe().groupby(list(_PATTERN), sort=False)
    patterns = [(key, members) for key, members in groups if len(members) >= _FEWEST]
    with rc_context(_STYLE):
        figure = Figure(figsize=(4.4, 3.4), layout="constrained")
        axes = figure.subplots()
        for index, (key, members) in enumerate(patterns):
            shown = members.sort_values("amplitude_over_film")
            load, radius_ratio, orientation, wave = key
            label = rf"{orientation}, $M={load:g}$, $D={radius_ratio:g}$, $\lambda/a={wave:g}$"
            colour = COLOURS[index % len(COLOURS)]
            x = shown["amplitude_over_film"]
            axes.plot(x, shown["fit_over_linear"], "o-", color=colour, label=label, markersize=3)
            axes.plot(x, shown["range_over_linear"], "--", color=colour, linewidth=0.8)
        axes.axhline(1, color="black", linewidth=0.6)
        axes.set_xlabel(r"$A_i/H_c$")
        axes.set_ylabel(r"$(A_d/A_i)\,/\,$linear")
        how = "solid: harmonic fit; dashed: range of the film"
        axes.legend(frameon=False, loc="best", title=how, title_fontsize=8, alignment="left")
    return figure


def main(arguments: Sequence[str] | None = None) -> int:
    """Write table and figure, print the deviations; return 0, or 1 with a message."""
    parser = step_parser(maps.linearity, __doc__)
    parser.add_argument("results", nargs="+", type=Path, metavar="RESULTS", help="HDF5 file")
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> None:
    points = linearity_points(read_results(options.results))
    table = options.output / "linearity.csv"
    write_dataset_csv(table, points, COLUMNS)
    written = [table, *write_figure(linearity_figure(points), options.output, "linearity")]
    print(linearity_text(points))
    print("\n".join(str(path) for path in sorted(written)))


if __name__ == "__main__":
    sys.exit(main())
