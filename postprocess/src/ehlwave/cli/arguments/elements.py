"""Arguments of ``ehlwave bearing``, ``gear``, ``cam`` and ``rig``."""

import argparse
from pathlib import Path
from typing import Any

from ehlwave.cli.arguments.shared import add_drawn_output, add_overwrite, later

COMMANDS = {
    "bearing": "compute films, roughness and stresses over the load zone of a rolling bearing",
    "gear": "compute films, roughness, friction and stresses along the path of contact of gears",
    "cam": "compute films, roughness, friction and stresses over one turn of a cam",
    "rig": "compute films, roughness, friction and stresses of a test rig over its speed",
}
EPILOG = """\
FILE is a TOML file: element = "...", [dimensions], [conditions], [oil] and, for roughness,
[surface]; heat = true for films and friction with heat. A file to start from:

{example}

Other elements and their names: the page of machine elements in the manual.

With --output DIR it writes report.html (one file, figures inside), report.json, table.csv, and
cases.csv with sweep.nml for ehlwave-sweep. Places without an answer have a reason.

Example:
  ehlwave {name} {name}.toml --output report"""

_EXAMPLES = {
    "bearing": """
    element = "DeepGrooveBallBearing"
    [dimensions]
    bore_m = 0.04
    outside_m = 0.08
    width_m = 0.018
    [conditions]
    radial_load_n = 3000
    inner_speed_rpm = 3000""",
    "gear": """
    element = "SpurGearPair"
    [dimensions]
    module_m = 0.003
    teeth = [20, 40]
    face_width_m = 0.03
    [conditions]
    pinion_torque_n_m = 150
    pinion_speed_rpm = 1500""",
    "cam": """
    element = "CamFollower"
    [dimensions]
    base_radius_m = 0.018
    width_m = 0.012
    roller_radius_m = 0.009
    preload_n = 250
    spring_rate_n_per_m = 40000
    mass_kg = 0.12
    lift_file = "lift.csv"     # columns: angle in degrees, lift in m
    [conditions]
    cam_speed_rpm = 1000""",
    "rig": """
    element = "BallOnDisc"
    [dimensions]
    ball_diameter_m = 0.01905
    [conditions]
    load_n = 20
    mean_speeds_m_per_s = [0.1, 1]""",
}
_OIL = """
    [oil]
    iso_vg = 68
    temperature_k = 333.15
    eyring_stress_pa = 5e6"""
EXAMPLES = {name: text.strip("\n") + _OIL for name, text in _EXAMPLES.items()}
"""Input files of each command; a test reads them."""


def add_element_commands(commands: Any) -> None:  # noqa: ANN401 - argparse does not name this type
    """Add the commands to the parsers of ``ehlwave``."""
    for name, text in COMMANDS.items():
        parser = commands.add_parser(
            name,
            help=text,
            description=f"{text[0].upper()}{text[1:]}.",
            epilog=EPILOG.replace("{name}", name).replace("{example}", EXAMPLES[name]),
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        parser.add_argument(
            "file", type=Path, metavar="FILE", help="the element as a TOML file; see below"
        )
        add_drawn_output(parser, "write the report there")
        add_overwrite(parser)
        parser.add_argument("--json", action="store_true", help="print JSON instead of text")
        parser.set_defaults(run=later("ehlwave.cli.elements", "run_element"), kind=name)
