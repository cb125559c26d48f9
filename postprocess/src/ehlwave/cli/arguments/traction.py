"""Arguments of ``ehlwave traction``."""

import argparse
from pathlib import Path
from typing import Any

from ehlwave.choices import FILM_BY, TRACTION_RATIOS
from ehlwave.cli.arguments.shared import BY, add_drawn_output, add_overwrite, later

DESCRIPTION = """\
Friction over the slide-to-roll ratio of a smooth contact, and its temperatures: isothermal, with
heat where the input has &heat, and with a limit of the stress where it has
shear_limit_over_pressure. The laws answer where they hold, with errors; ehlwave-sweep elsewhere,
for limits, and for inputs that name a grid or an accuracy."""

EPILOG = """\
CASE is an input file of ehlwave-case with dimensional conditions; its slide-to-roll ratio is
replaced by each of the ratios.

Regimes: linear, friction is proportional to the ratio within a tenth; nonlinear, the oil thins;
thermal or limited, heat or the limit takes more than a tenth of it, whichever takes more. Warnings
of the program appear once, with the ratio from which they hold.

Examples:
  ehlwave traction rollers.nml --output traction
  ehlwave traction rollers.nml --ratios 0.01 0.03 0.1 0.3 1 --ranks 2 --json"""


def add_traction_command(commands: Any) -> None:  # noqa: ANN401 - argparse does not name this type
    """Add the command to the parsers of ``ehlwave``."""
    parser = commands.add_parser(
        "traction",
        help="compute friction and temperatures over the slide-to-roll ratio",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("case", type=Path, metavar="CASE", help="input file; see below")
    parser.add_argument(
        "--ratios",
        nargs="+",
        type=float,
        default=TRACTION_RATIOS,
        metavar="RATIO",
        help="slide-to-roll ratios; default: 0.0002 to 1.8",
    )
    parser.add_argument("--by", choices=FILM_BY, help=BY)
    parser.add_argument("--ranks", type=int, default=1, metavar="N", help="MPI ranks; 1")
    add_drawn_output(parser, "write table and figure there")
    add_overwrite(parser)
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    parser.set_defaults(run=later("ehlwave.cli.traction", "run_traction"))
