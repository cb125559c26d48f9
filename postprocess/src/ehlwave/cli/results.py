"""Actions of the commands on results files and files of cases."""

import argparse
import sys
from typing import TYPE_CHECKING

import xarray as xr

from ehlwave.extras import load
from ehlwave.results import tables
from ehlwave.results.case_file import contact_figure, read_contact
from ehlwave.results.export import export
from ehlwave.results.points import VARIABLES, remarks, resolved_only, select_points
from ehlwave.results.read import read_results
from ehlwave.results.refit import RefitSettings, refit_groups, refit_warnings
from ehlwave.surface.harmonics import write_harmonic_table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLLAPSE_COLUMNS = (
    "case",
    "label",
    "case_id",
    "source_file",
    "orientation",
    "load_parameter_m",
    "lubricant_parameter_l",
    "radius_ratio_d",
    "slip_parameter",
    "edges",
    "wavelength_over_a",
    "wavelength_x_over_a",
    "wavelength_y_over_a",
    "f_r",
    "v",
    "v2",
    "f_v",
    "f_v2",
    "amplitude_ratio",
    "amplitude_ratio_fit",
    "deformed_ratio",
    "deformed_error",
    "status",
    "is_resolved",
)


def run_collapse(options: argparse.Namespace) -> None:
    """Draw Ad/Ai against f(r) V2 and f(r) V, and write the points."""
    figures = load("ehlwave.results.figures")
    results = read_results(options.results)
    points = select_points(
        results,
        options.ratio,
        include_unresolved=options.include_unresolved,
        include_inaccurate=options.include_inaccurate,
        edges=options.edges,
    )
    _print_remarks(points)
    table = options.output / "collapse.csv"
    tables.write_dataset_csv(table, points, COLLAPSE_COLUMNS, options.writer)
    written = [table]
    for variable in VARIABLES:
        name = f"figure{figures.FIGURE_NUMBERS[variable]}"
        if hidden := figures.outside_axes(points, variable):
            _note(f"{hidden} point(s) lie outside the axes of {name}")
        figure = figures.collapse_figure(points, variable, options.color_by)
        written += figures.write_figure(figure, options.output, name, writer=options.writer)
    resolved = int(points["is_point_resolved"].sum())
    print(f"{resolved} resolved and {points.sizes['case'] - resolved} unresolved points")
    print("\n".join(str(path) for path in sorted(written)))


def run_refit(options: argparse.Namespace) -> None:
    """Fit the coefficients of the amplitude formula, and write them."""
    points = select_points(
        read_results(options.results),
        options.ratio,
        include_inaccurate=options.include_inaccurate,
        edges=options.edges,
    )
    _print_remarks(points)
    settings = RefitSettings(replicates=options.replicates, seed=options.seed)
    rows = refit_groups(points, settings)
    for warning in refit_warnings(rows):
        _note(warning)
    document = tables.refit_json(rows, settings, points, options.ratio)
    tables.write_refit_csv(options.output / "refit.csv", rows, options.writer)
    options.writer.text(options.output / "refit.json", document + "\n")
    print(document if options.json else tables.refit_text(rows, settings))


def run_table(options: argparse.Namespace) -> None:
    """Count cases by status and list the failed cases."""
    print(tables.summary_text(read_results(options.results)))


def run_export(options: argparse.Namespace) -> None:
    """Write results, or fields of a case, for other programs."""
    kinds = ("csv", "parquet", "netcdf", "vtk")
    targets = {kind: getattr(options, kind) for kind in kinds if getattr(options, kind)}
    print("\n".join(export(options.results, targets, options.writer)))


def run_contact(options: argparse.Namespace) -> None:
    """Draw film and pressure of a case."""
    figure = contact_figure(read_contact(options.case))
    _write_picture(options, figure, options.case.stem)


def run_plot(options: argparse.Namespace) -> None:
    """Draw a case in um, GPa and us."""
    draw = load("ehlwave.results.case_figures").case_figure
    _write_picture(
        options, draw(read_contact(options.case), options.time), f"{options.case.stem}-case"
    )


def run_animate(options: argparse.Namespace) -> None:
    """Draw film and pressure of a march in motion."""
    draw = load("ehlwave.results.animation").write_animation
    target = options.output / f"{options.case.stem}.{options.format}"
    case = read_contact(options.case)
    print(draw(case, target, options.writer, options.frames_per_second))


def _write_picture(options: argparse.Namespace, figure: "Figure", name: str) -> None:
    written = load("ehlwave.results.figures").write_figure(
        figure, options.output, name, writer=options.writer
    )
    print("\n".join(str(path) for path in written))


def run_harmonics(options: argparse.Namespace) -> None:
    """Write a harmonic table."""
    points = select_points(read_results(options.results), edges=options.edges)
    count = write_harmonic_table(options.csv, points, options.writer)
    print(f"{options.csv}: {count} waves")


def _print_remarks(points: xr.Dataset) -> None:
    for remark in remarks(resolved_only(points)):
        _note(remark)


def _note(text: str) -> None:
    print(f"ehlwave: note: {text}", file=sys.stderr)
