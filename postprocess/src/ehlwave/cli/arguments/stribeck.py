"""Arguments of ``ehlwave stribeck``."""

import argparse
from pathlib import Path
from typing import Any

from ehlwave.choices import STRIBECK_FACTORS, STRIBECK_SHARES
from ehlwave.cli.arguments.shared import add_drawn_output, add_overwrite, later

DESCRIPTION = """\
Stribeck curve of a line contact in mixed lubrication: friction, share of the load on the solids,
area and film over the speed, with errors by the mesh."""

EPILOG = """\
CASE is an input file of ehlwave-case with &touching film_m, in a steady state: smooth surfaces, or
waves at rest. Through the transition, where the speed hardly changes, the share is given and the
speed is found; its mean_speed_m_per_s is where that begins, its share is replaced.

Examples:
  ehlwave stribeck touching_line.nml --output stribeck
  ehlwave stribeck touching_line.nml --shares 0.1 0.5 0.9 --factors 1.2 2 --json"""


def add_stribeck_command(commands: Any) -> None:  # noqa: ANN401 - argparse does not name this type
    """Add the command to the parsers of ``ehlwave``."""
    parser = commands.add_parser(
        "stribeck",
        help="compute friction, touching and film over the speed in mixed lubrication",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("case", type=Path, metavar="CASE", help="input file; see below")
    parser.add_argument(
        "--shares",
        nargs="+",
        type=float,
        default=STRIBECK_SHARES,
        metavar="SHARE",
        help="shares of the load on the solids; default: 0.02 to 0.95",
    )
    parser.add_argument(
        "--factors",
        nargs="*",
        type=float,
        default=STRIBECK_FACTORS,
        metavar="FACTOR",
        help="speeds over that at the smallest share; default: 1.1 to 10",
    )
    parser.add_argument("--ranks", type=int, default=1, metavar="N", help="MPI ranks; 1")
    add_drawn_output(parser, "write table and figure there")
    add_overwrite(parser)
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    parser.set_defaults(run=later("ehlwave.cli.stribeck", "run_stribeck"))
