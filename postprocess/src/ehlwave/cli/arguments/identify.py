"""Arguments of ``ehlwave identify``."""

import argparse
from pathlib import Path
from typing import Any

from ehlwave.choices import FILM_BY
from ehlwave.cli.arguments.shared import BY, add_drawn_output, add_overwrite, later

DESCRIPTION = """\
Parameters of an oil that measured films, frictions or amplitude ratios imply: least squares with
derivatives from the laws, or from ehlwave-case where no law holds. Intervals are at 95 %.
Parameters that the measurements do not determine are named."""

EPILOG = """\
MEASUREMENTS is a CSV table. Columns are keys that vary (mean_speed_m_per_s, load_n,
slide_to_roll_ratio, wavelength_over_a, ...), temperature_c or temperature_k, and measured results:
central_film_um, minimum_film_um (or _nm, _m), friction_coefficient, harmonic_ratio (Ad/Ai).
Headings of rigs are read, too: Entrainment speed (mm/s), SRR (%), Load (N), Temperature (C),
Film thickness (nm), Minimum film thickness (nm), Traction coefficient.
A column such as central_film_error has relative standard errors. An empty cell of a key takes the
value of CASE.

Parameters: alpha, viscosity, eyring_stress, carreau_modulus, roelands, modulus,
viscosity_temperature, or any key with a number. With several temperatures the viscosity is that at
temperature_k of the conditions (else at their mean) and falls as exp(-viscosity_temperature
(T - T0)).

Examples:
  ehlwave identify films.csv --conditions ball.nml --fit alpha
  ehlwave identify films.csv --conditions ball.nml --fit alpha viscosity viscosity_temperature
  ehlwave identify traction.csv --conditions discs.nml --fit eyring_stress --error 0.02 --json"""


def add_identify_command(commands: Any) -> None:  # noqa: ANN401 - argparse does not name this type
    """Add the command to the parsers of ``ehlwave``."""
    parser = commands.add_parser(
        "identify",
        help="fit parameters of an oil to measured films, friction or Ad/Ai",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "measurements", type=Path, metavar="MEASUREMENTS", help="CSV table; see below"
    )
    parser.add_argument(
        "--conditions",
        dest="case",
        type=Path,
        required=True,
        metavar="CASE",
        help="input file of ehlwave-case: the contact, and values from which the fit begins",
    )
    parser.add_argument(
        "--fit", nargs="+", required=True, metavar="PARAMETER", help="parameters to fit; see below"
    )
    parser.add_argument(
        "--error",
        type=float,
        metavar="SHARE",
        help="relative standard error of the measurements; by default by the residuals",
    )
    parser.add_argument("--by", choices=FILM_BY, help=BY)
    add_drawn_output(parser, "write table and figure there")
    add_overwrite(parser)
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    parser.set_defaults(run=later("ehlwave.cli.identify", "run_identify"))
