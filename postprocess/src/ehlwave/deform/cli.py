"""``ehlwave deform`` and ``ehlwave harmonics``."""

import argparse
import contextlib
import json
import sys
from dataclasses import fields
from pathlib import Path
from typing import Any

from ehlwave.command_line import add_ratio
from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_read import read_conditions
from ehlwave.deform.atlas_transfer import AtlasTransfer, with_atlas_film
from ehlwave.deform.coefficients import read_coefficients
from ehlwave.deform.decimals import DECIMALS
from ehlwave.deform.figures import deformed_figure, spectrum_figure
from ehlwave.deform.period import cut_period
from ehlwave.deform.predict import Deformed, deform_surface
from ehlwave.deform.prepare import FORMS, WINDOWS, remove_form
from ehlwave.deform.read import ReadOptions, read_surface
from ehlwave.deform.report import report_json, report_text, write_results
from ehlwave.deform.simulation import simulation_surface, write_simulation_surface
from ehlwave.deform.sliding import TwoWaveTransfer, second_conditions
from ehlwave.deform.table import TableTransfer
from ehlwave.deform.table_read import read_table
from ehlwave.deform.transfer import FormulaTransfer, RecommendedTransfer, Transfer
from ehlwave.deform.two_surfaces import FilmOfTwo, film_of_two
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.figures import write_figure
from ehlwave.writing import Writer

MOST_COMPARED = 2**20
"""Points of a surface that is judged by formulas besides, for comparison."""

DESCRIPTION = """\
Predict the shape of a surface inside the contact, without a simulation: decompose it into
harmonics, take each with amplitude and phase from the atlas of computed responses, and add them up
again. In place of the atlas: a harmonic table of your own, the recommended formula, or
Ad/Ai = 1/(1 + 0.15 f V + 0.015 (f V)^2) of Venner, Kaneta and Lubrecht (2000). The report says
which it was, how far it can be trusted, and what the others say."""

EPILOG = """\
Conditions are an input file of ehlwave-case, or KEY=VALUE with its keys, or both:
  --conditions contact.nml
  --conditions contact.nml mean_speed_m_per_s=0.1
  --conditions radius_x_m=12.5e-3 radius_y_m=12.5e-3 reduced_modulus_pa=1.17e11 load_n=39.2
               mean_speed_m_per_s=0.024 viscosity_pa_s=1.22 pressure_viscosity_per_pa=2.25e-8
  --conditions load_parameter_m=100 lubricant_parameter_l=10 radius_ratio_d=1
               semi_axis_a_m=0.2e-3 radius_x_m=12.5e-3
  --conditions radius_x_m=5e-3 reduced_modulus_pa=2.26e11 load_n_per_m=1.5e5     (a roller: line
               mean_speed_m_per_s=2 viscosity_pa_s=0.03     contact, traces along pure rolling)
The film thickness is that of the atlas, outside it that of a formula for smooth contacts (up to
25 % too thick, 35 % in line contacts); central_film_m=... replaces it.

Form removal: the radii are in the conditions, so they must not be in the roughness as well. 'plane'
removes the tilt of the specimen; 'quadratic' also the curvature of a ball or roller.

Ends: a Fourier series repeats the surface, and ends that do not match would add components.
'mirror' continues the surface by its mirror image; 'taper' fades the outer tenth at each end to
zero and leaves it out of the statistics; 'none' is for surfaces that repeat, such as synthetic
ones.

Examples:
  ehlwave deform trace.csv --conditions contact.nml --length-unit mm --height-unit um
  ehlwave deform map.sdf --conditions contact.nml --rolling-axis y --form quadratic
  ehlwave deform ball.csv --second disc.csv --conditions sliding.nml --formula two-waves
      --length-unit mm --height-unit um

Under slip (slip_parameter in the conditions, or --slide-to-roll-ratio) the atlas has Ree-Eyring
oils (eyring_stress_pa). For other oils, also Carreau ones (carreau_modulus_pa,
carreau_exponent), the law of the two waves holds. A harmonic table of this slip is better."""


SURFACE_DESCRIPTION = """\
Write a trace or map for the full simulation: remove its form, fade the outer tenth at each end to
zero so that nothing enters the contact as a step, and put it in metres, rolling direction first.

The input of ehlwave-case names the file:   &surface file = 'FILE.h5' /
ehlwave deform reads the same file, so that prediction and simulation stand side by side."""


def add_commands(commands: Any) -> None:  # noqa: ANN401 - argparse does not name this type
    """Add the commands of this package to the parsers of ``ehlwave``."""
    deform = commands.add_parser(
        "deform",
        help="predict the shape of a measured surface inside the contact",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    deform.add_argument(
        "surface",
        type=Path,
        metavar="PROFILE",
        help="trace or map: CSV, NumPy, HDF5, SDF, X3P, ...",
    )
    deform.add_argument(
        "--conditions", nargs="+", required=True, metavar="FILE|KEY=VALUE", help="see below"
    )
    add_ratio(deform)
    add_reading(deform)
    deform.add_argument(
        "--ends", choices=WINDOWS, default="mirror", help="what is done about the ends; see below"
    )
    deform.add_argument(
        "--cutoff",
        type=float,
        metavar="UM",
        help="lambda_c of a Gaussian filter (ISO 16610), um: longer waves are left out as waviness",
    )
    deform.add_argument(
        "--short-cutoff",
        type=float,
        metavar="UM",
        help="lambda_s, um: shorter waves are left out as noise",
    )
    source = deform.add_mutually_exclusive_group()
    source.add_argument(
        "--refit", type=Path, metavar="FILE", help="coefficients from refit.csv or refit.json"
    )
    source.add_argument(
        "--formula",
        choices=("paper", "recommended", "two-waves"),
        help="in place of the atlas: (18) as printed; the formula with a quarter of its error; the "
        "law of the two waves, with phase, by which slip is judged where the atlas has none",
    )
    source.add_argument(
        "--table", type=Path, metavar="FILE", help="harmonic table to use in place of the formula"
    )
    deform.add_argument(
        "--second",
        type=Path,
        metavar="PROFILE",
        help="the other surface, read alike, which moves with 2 - S",
    )
    deform.add_argument("--output", type=Path, metavar="DIR", help="write files and figures there")
    add_overwrite(deform)
    deform.add_argument("--json", action="store_true", help="print JSON instead of text")
    deform.set_defaults(run=_deform)
    surface = commands.add_parser(
        "surface",
        help="write a measured surface for ehlwave-case",
        description=SURFACE_DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    surface.add_argument("surface", type=Path, metavar="PROFILE", help="as for deform")
    add_reading(surface)
    surface.add_argument(
        "--period",
        type=float,
        metavar="UM",
        help="cut out one wave of this length, um, from the middle of a trace, so that copies of "
        "it join without a jump",
    )
    surface.add_argument(
        "--period-start",
        type=float,
        metavar="UM",
        help="where that wave begins, um from the first point of the trace",
    )
    surface.add_argument(
        "--repeat",
        type=int,
        default=1,
        metavar="N",
        help="so many copies along the rolling direction",
    )
    surface.add_argument(
        "--output", type=Path, required=True, metavar="FILE.h5", help="file to write"
    )
    add_overwrite(surface)
    surface.set_defaults(run=_surface)


def add_overwrite(parser: argparse.ArgumentParser) -> None:
    """Add the option that lets outputs replace files that are not results of ours."""
    text = "replace files that are not results of ehlwave; what is read is never replaced"
    parser.add_argument("--overwrite", action="store_true", help=text)


def add_reading(parser: argparse.ArgumentParser) -> None:
    """Add the options that say what a surface file does not."""
    parser.add_argument(
        "--length-unit", metavar="UNIT", help="of positions and steps: m, mm, um, nm"
    )
    parser.add_argument("--height-unit", metavar="UNIT", help="of heights: m, mm, um, nm")
    parser.add_argument(
        "--step", type=float, metavar="LENGTH", help="sampling step, for files without positions"
    )
    parser.add_argument(
        "--step-across", type=float, metavar="LENGTH", help="of a map's rows; default: --step"
    )
    parser.add_argument(
        "--decimal",
        choices=DECIMALS,
        help="what decimals of a text file begin with, where the file does not decide it",
    )
    parser.add_argument(
        "--rolling-axis",
        choices=("x", "y"),
        default="x",
        help="rolling direction of a map: x along its rows, y across; of a trace: x if it was "
        "measured along rolling, y if across (longitudinal ridges)",
    )
    parser.add_argument(
        "--fill-missing", action="store_true", help="give missing heights their neighbour's"
    )
    parser.add_argument(
        "--form",
        choices=tuple(FORMS),
        default="plane",
        help="polynomial to remove: nothing, offset, tilt (default), tilt and curvature",
    )


def read_options(options: argparse.Namespace) -> ReadOptions:
    """Return the reader's options of a parsed command line."""
    names = (field.name for field in fields(ReadOptions))
    return ReadOptions(**{name: getattr(options, name) for name in names})


def _deform(options: argparse.Namespace) -> None:
    conditions = _with_film(read_conditions(options.conditions))
    results = [_predicted(options, options.surface, conditions)]
    both = None
    if options.second is not None:
        results.append(_predicted(options, options.second, second_conditions(conditions)))
        both = film_of_two(*results)
    print(_json_text(results, both) if options.json else _text(results, both, options))
    if options.output is not None:
        written = []
        if both is not None:
            written.append(both.write(options.output / "film.csv", options.writer))
        for result, folder in zip(results, ("", "second"), strict=False):
            written += _write(result, options.output / folder, options.writer)
        listing = sys.stderr if options.json else sys.stdout
        print("\n".join(str(path) for path in written), file=listing)


def _predicted(options: argparse.Namespace, path: Path, conditions: Conditions) -> Deformed:
    transfer = _transfer(options, conditions)
    surface = read_surface(path, read_options(options))
    cutoffs = _metres(options.cutoff), _metres(options.short_cutoff)
    return deform_surface(surface, conditions, transfer, options.form, options.ends, cutoffs)


def _metres(length_um: float | None) -> float | None:
    return None if length_um is None else length_um * 1e-6


def _text(results: list[Deformed], both: FilmOfTwo | None, options: argparse.Namespace) -> str:
    reports = [report_text(result, _others(result, options)) for result in results]
    return "\n".join([*reports, *([] if both is None else [both.text()])])


def _json_text(results: list[Deformed], both: FilmOfTwo | None) -> str:
    if both is None:
        return report_json(results[0])
    first, second = (json.loads(report_json(result)) for result in results)
    return json.dumps({"first": first, "second": second, "film": both.summary()}, indent=2)


def _write(result: Deformed, folder: Path, writer: Writer) -> list[Path]:
    written = write_results(result, folder, writer)
    written += write_figure(deformed_figure(result), folder, "deformed", writer=writer)
    return written + write_figure(spectrum_figure(result), folder, "spectrum", writer=writer)


def _surface(options: argparse.Namespace) -> None:
    surface, form = read_surface(options.surface, read_options(options)), options.form
    start = options.period_start
    if options.period is not None:
        start_m = None if start is None else start * 1e-6
        # The form is that of the whole trace: one wave of it has a tilt of its own.
        surface = cut_period(remove_form(surface, form), options.period * 1e-6, start_m)
        form = "none"
    elif start is not None:
        raise SurfaceError(f"--period-start {start:g} without --period: say how long the wave is")
    prepared = simulation_surface(surface, form, options.repeat)
    write_simulation_surface(prepared, options.output, options.writer)
    nx, ny = prepared.height.shape
    print(f"{options.output}: {nx} x {ny} points, {(nx - 1) * prepared.step_x_m * 1e6:.5g} um long")


def _transfer(options: argparse.Namespace, conditions: Conditions) -> Transfer:
    if options.table is not None:
        return TableTransfer(conditions, read_table(options.table), options.table.name)
    if options.refit is not None:
        c1, c2 = read_coefficients(options.refit)
        name = f"formula (18), c1 = {c1:.4g} and c2 = {c2:.4g} of {options.refit.name}"
        return FormulaTransfer(conditions, c1, c2, name)
    if options.formula == "recommended":
        return RecommendedTransfer(conditions)
    if options.formula == "paper":
        return FormulaTransfer(conditions)
    if options.formula == "two-waves" or not conditions.has_atlas:
        return TwoWaveTransfer(conditions)
    try:
        return AtlasTransfer(conditions)
    except RangeError as error:
        name = "recommended" if conditions.slip_parameter == 1 else "two-waves"
        raise SurfaceError(f"{error}. A formula is used when named: --formula {name}") from error


def _others(result: Deformed, options: argparse.Namespace) -> list[Deformed]:
    """Return what else can judge the components, for comparison."""
    conditions = result.conditions
    if result.height.size > MOST_COMPARED:
        return []
    every: list[Transfer] = (
        [RecommendedTransfer(conditions), FormulaTransfer(conditions)]
        if conditions.slip_parameter == 1
        else [TwoWaveTransfer(conditions)]
    )
    with contextlib.suppress(RangeError):
        every.insert(0, AtlasTransfer(conditions))
    return [
        deform_surface(result.surface, conditions, other, "none", options.ends)
        for other in every
        if other.name != result.transfer_name
    ]


def _with_film(conditions: Conditions) -> Conditions:
    """Return conditions with the film of the atlas, or with that of the formula outside it."""
    try:
        return with_atlas_film(conditions)
    except RangeError:
        return conditions
