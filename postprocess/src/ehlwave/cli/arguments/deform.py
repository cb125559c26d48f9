"""Arguments of ``ehlwave deform``, ``lambda`` and ``surface``."""

import argparse
from pathlib import Path
from typing import Any

from ehlwave.choices import WINDOWS
from ehlwave.cli.arguments.shared import (
    CONTACT,
    add_drawn_output,
    add_laws,
    add_overwrite,
    add_reading,
    later,
)
from ehlwave.cli.command_line import add_ratio

DESCRIPTION = """\
Predict the shape of a surface inside the contact, without a simulation: decompose it into
harmonics, take each with amplitude and phase from the atlas of computed responses, and add them up
again. In place of the atlas: a harmonic table of your own, the recommended formula, or
Ad/Ai = 1/(1 + 0.15 f V + 0.015 (f V)^2) of Venner, Kaneta and Lubrecht (2000). The report names
the law, its reliability, and the results of the others."""

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
The first law that holds gives the film thickness, with &heat the film with heat; where none holds
ehlwave-case computes it. Without that program it is the film of a formula for smooth contacts (up
to 25 % too thick, 35 % in line contacts). central_film_m=... replaces it. Keys of a file that
would change the answer and are not used are refused, or warned of.

Form removal: the radii are in the conditions, so they must not be in the roughness as well. 'plane'
removes the tilt of the specimen; 'quadratic' also the curvature of a ball or roller.

Ends: a Fourier series repeats the surface, and ends that do not match would add components.
'mirror' continues the surface by its mirror image; 'taper' fades the outer tenth at each end to
zero and leaves it out of the statistics; 'none' is for surfaces that repeat, such as synthetic
surfaces.

Examples:
  ehlwave deform trace.csv --conditions contact.nml --length-unit mm --height-unit um
  ehlwave deform map.sdf --conditions contact.nml --rolling-axis y --form quadratic
  ehlwave deform ball.csv --second disc.csv --conditions sliding.nml --formula two-waves
      --length-unit mm --height-unit um

Under slip (slip_parameter in the conditions, or --slide-to-roll-ratio) the atlas has Ree-Eyring
oils (eyring_stress_pa). For other oils, also Carreau oils (carreau_modulus_pa,
carreau_exponent), the law of the two waves holds. A harmonic table of this slip is better."""


LAMBDA_DESCRIPTION = """\
Report whether a film separates rough surfaces: the mean film over the Rq of the surface inside
the contact, its error, and its meaning. Takes the input of ehlwave deform, which reports more.
The limits, boundary below 1 and full film from 3, come from Hamrock, Schmid and Jacobson
(2004); they were made for the roughness of both surfaces as made."""


SURFACE_DESCRIPTION = """\
Write a trace or map for the full simulation: remove its form, fade the outer tenth at each end to
zero so that nothing enters the contact as a step, and put it in metres, rolling direction first.

The input of ehlwave-case names the file:   &surface file = 'FILE.h5' /
ehlwave deform reads the same file, so that prediction and simulation stand side by side."""


def add_deform_commands(commands: Any) -> None:  # noqa: ANN401 - argparse does not name this type
    """Add the commands of this package to the parsers of ``ehlwave``."""
    deform = commands.add_parser(
        "deform",
        help="predict the shape of a measured surface inside the contact",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_prediction(deform)
    deform.set_defaults(run=later("ehlwave.cli.deform", "run_deform"), brief=False)
    ratio = commands.add_parser(
        "lambda",
        help="print the lambda ratio of a measured surface inside the contact",
        description=LAMBDA_DESCRIPTION,
        epilog=EPILOG.replace("ehlwave deform", "ehlwave lambda"),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_prediction(ratio)
    ratio.set_defaults(run=later("ehlwave.cli.deform", "run_deform"), brief=True)
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
        help="number of copies along the rolling direction",
    )
    surface.add_argument(
        "--output", type=Path, required=True, metavar="FILE.h5", help="file to write"
    )
    add_overwrite(surface)
    surface.set_defaults(run=later("ehlwave.cli.deform", "run_surface"))


def _add_prediction(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of predictions."""
    parser.add_argument(
        "surface",
        type=Path,
        metavar="PROFILE",
        help="trace or map: CSV, NumPy, HDF5, SDF, X3P, ...",
    )
    parser.add_argument(
        "--conditions", nargs="+", required=True, metavar="FILE|KEY=VALUE", help=CONTACT
    )
    add_ratio(parser)
    add_reading(parser)
    parser.add_argument(
        "--ends", choices=WINDOWS, default=WINDOWS[0], help="treatment of the ends; see below"
    )
    parser.add_argument(
        "--cutoff",
        type=float,
        metavar="UM",
        help="lambda_c of a Gaussian filter (ISO 16610), um: longer waves are left out as waviness",
    )
    parser.add_argument(
        "--short-cutoff",
        type=float,
        metavar="UM",
        help="lambda_s, um: shorter waves are left out as noise",
    )
    parser.add_argument(
        "--boundary-film",
        type=float,
        metavar="UM",
        help="film at which solids begin to bear, um: in rolling, whether the surfaces touch",
    )
    source = add_laws(parser, "--formula")
    source.add_argument(
        "--refit", type=Path, metavar="FILE", help="coefficients from refit.csv or refit.json"
    )
    parser.add_argument(
        "--second",
        type=Path,
        metavar="PROFILE",
        help="the other surface, read alike, which moves with 2 - S",
    )
    add_drawn_output(parser, "write files and figures there")
    add_overwrite(parser)
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
