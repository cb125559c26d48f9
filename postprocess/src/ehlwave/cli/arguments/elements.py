"""Arguments of ``ehlwave bearing``, ``gear``, ``cam`` and ``rig``."""

import argparse
from pathlib import Path
from typing import Any

from ehlwave.cli.arguments.shared import add_overwrite, later

COMMANDS = {
    "bearing": "films, roughness and stresses over the load zone of a rolling bearing",
    "gear": "films, roughness, friction and stresses along the path of contact of a gear pair",
    "cam": "films, roughness, friction and stresses over one turn of a cam",
    "rig": "films, roughness, friction and stresses of a test rig over its speed",
}
EPILOG = """\
FILE is a TOML file: element = "...", [dimensions], [conditions], [oil] and, for roughness,
[surface]; heat = true for films and friction with heat. Names are those of ehlwave.elements;
examples are in postprocess/examples/elements.

With --output DIR it writes report.html (one file, figures inside), report.json, table.csv, and
cases.csv with sweep.nml for ehlwave-sweep. Places without an answer have a reason.

Example:
  ehlwave {name} {name}.toml --output report"""


def add_element_commands(commands: Any) -> None:  # noqa: ANN401 - argparse does not name this type
    """Add the commands to the parsers of ``ehlwave``."""
    for name, text in COMMANDS.items():
        parser = commands.add_parser(
            name,
            help=text,
            description=f"{text[0].upper()}{text[1:]}.",
            epilog=EPILOG.replace("{name}", name),
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        parser.add_argument("file", type=Path, metavar="FILE", help="see below")
        parser.add_argument("--output", type=Path, metavar="DIR", help="write the report there")
        add_overwrite(parser)
        parser.add_argument("--json", action="store_true", help="print JSON instead of text")
        parser.set_defaults(run=later("ehlwave.cli.elements", "run_element"), kind=name)
