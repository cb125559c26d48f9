"""Arguments of ``ehlwave stress``."""

import argparse
from pathlib import Path
from typing import Any

from ehlwave.choices import POISSON_RATIO, WINDOWS
from ehlwave.cli.arguments.shared import (
    add_drawn_output,
    add_laws,
    add_overwrite,
    add_reading,
    later,
)
from ehlwave.cli.command_line import add_ratio

DESCRIPTION = """\
Stresses below a lubricated contact, and their effect on its life: von Mises, largest and orthogonal
shear with depth and place, Dang Van's factor over the passage of material points of both bodies,
the life ratio of Ioannides and Harris. FILE is the HDF5 file of ehlwave-case --output, or, with
--conditions, a measured trace or map whose pressure is predicted as ehlwave deform predicts its
shape."""

EPILOG = """\
Bodies: the first has the slip parameter S of the conditions and carries FILE, the second 2 - S and
the surface of --second, if given. Friction drags the faster body back.

Dang Van's factor: 1 or more means that cracks begin within --cycles in bearing steel. It needs a
history: of files, the fields of a march with &output fields_every = N / .

Examples:
  ehlwave stress case.h5
  ehlwave stress trace.csv --conditions contact.nml --length-unit mm --height-unit um --output out
  ehlwave stress trace.csv --conditions contact.nml slip_parameter=1.1 eyring_stress_pa=5e6
      --cycles 1e7 --json

Not to be trusted: where amplitudes are above 0.3 of the film, where asperities touch, and at the
edge of the contact with its pressure spike. The report names the cause."""


def add_stress_command(commands: Any) -> None:  # noqa: ANN401 - argparse does not name this type
    """Add the command to the parsers of ``ehlwave``."""
    parser = commands.add_parser(
        "stress",
        help="compute stresses below a contact, Dang Van's factor and life",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "file", type=Path, metavar="FILE", help="file of ehlwave-case --output, or a surface"
    )
    parser.add_argument(
        "--conditions", nargs="+", metavar="FILE|KEY=VALUE", help="as for deform: FILE is a surface"
    )
    add_ratio(parser)
    parser.add_argument("--second", type=Path, metavar="PROFILE", help="surface of the other body")
    parser.add_argument(
        "--smooth",
        type=Path,
        metavar="FILE",
        help="ehlwave-case --output of the smooth contact, in place of Hertz' pressure",
    )
    parser.add_argument(
        "--friction", type=float, metavar="MU", help="traction over pressure; default: the atlas'"
    )
    parser.add_argument(
        "--cycles",
        type=float,
        default=1e8,
        metavar="N",
        help="load cycles of Dang Van's criterion (default: 1e8)",
    )
    parser.add_argument(
        "--poisson-ratio",
        type=float,
        default=POISSON_RATIO,
        metavar="NU",
        help="Poisson's ratio of both bodies (default: 0.3)",
    )
    parser.add_argument(
        "--depths",
        nargs="+",
        type=float,
        metavar="UM",
        help="depths, um (of files without lengths: in units of a)",
    )
    parser.add_argument(
        "--body",
        type=int,
        choices=(1, 2),
        help="body whose stress is drawn and written, of a case (default: 1)",
    )
    add_laws(parser)
    add_reading(parser)
    parser.add_argument(
        "--ends", choices=WINDOWS, default=WINDOWS[0], help="treatment of the ends of FILE"
    )
    add_drawn_output(parser, "write files and figures there")
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    add_overwrite(parser)
    parser.set_defaults(run=later("ehlwave.cli.stress", "run_stress"))
