"""Arguments of ``ehlwave replenish``."""

import argparse
from typing import Any

from ehlwave.cli.arguments.shared import CONTACT, add_drawn_output, add_overwrite, later

DESCRIPTION = """\
Film over overrollings and time of a starved track to which no oil comes back, as in a bearing with
grease. Two losses: oil that the inlet pushes aside at every overrolling, and oil that the pressure
in the contact drives to the sides. Computed contacts one behind another follow both together
within 7 %."""

EPILOG = """\
Conditions are dimensional, as for ehlwave deform, with oil_over_flooded, r: the oil that the first
overrolling finds over the oil that the flooded contact passes.

Track: the length of the tracks of both bodies together that belong to one contact. A ball on a
disc: both circumferences. A bearing: twice the circumference of a race over the number of balls is
a first estimate.

Example:
  ehlwave replenish --conditions contact.nml oil_over_flooded=0.5 --track-length 0.3
      --overrollings 1e6 --output track

Errors: g of the law within 15 %, times of the side flow within a factor of two, as measured decays
are. Films below 0.2 of the flooded one are extrapolated (is_inside = False)."""


def add_replenish_command(commands: Any) -> None:  # noqa: ANN401 - argparse does not name this type
    """Add the command to the parsers of ``ehlwave``."""
    parser = commands.add_parser(
        "replenish",
        help="compute the film over time of a track that no oil comes back to",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--conditions", nargs="+", required=True, metavar="FILE|KEY=VALUE", help=CONTACT
    )
    parser.add_argument(
        "--track-length", type=float, required=True, metavar="M", help="of both tracks together, m"
    )
    parser.add_argument(
        "--overrollings",
        type=float,
        default=1e6,
        metavar="N",
        help="number of overrollings (default: 1e6)",
    )
    add_drawn_output(parser, "write table and figure there")
    add_overwrite(parser)
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    parser.set_defaults(run=later("ehlwave.cli.replenish", "run_replenish"))
