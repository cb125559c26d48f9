"""``ehlwave stress``."""

import argparse
import json
import sys
from dataclasses import fields
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from ehlwave.command_line import add_ratio
from ehlwave.contact.conditions_read import read_conditions, read_keys
from ehlwave.deform.cli import add_overwrite, add_reading
from ehlwave.deform.prepare import WINDOWS
from ehlwave.deform.read import ReadOptions
from ehlwave.errors import StressError
from ehlwave.figures import write_figure
from ehlwave.operating_point import Contact
from ehlwave.stress.case_report import case_section, case_text, judge_case
from ehlwave.stress.figures import depth_figure, predicted_section, ripple_figure
from ehlwave.stress.report import plain, stress_dataset, stress_json, stress_text

DESCRIPTION = """\
Stresses below a lubricated contact, and what they do to its life: von Mises, largest and orthogonal
shear with depth and place, Dang Van's factor over the passage of material points of both bodies,
the life ratio of Ioannides and Harris. FILE is the HDF5 file of ehlwave-case --output, or, with
--conditions, a measured trace or map whose pressure is predicted as ehlwave deform predicts its
shape."""

EPILOG = """\
Bodies: the first has the slip parameter S of the conditions and carries FILE, the second 2 - S and
the surface of --second, if there is one. Friction drags the faster one back.

Dang Van's factor: 1 or more means that cracks begin within --cycles in bearing steel. It needs a
history: of files, that of a march with &output fields_every = N / .

Examples:
  ehlwave stress case.h5
  ehlwave stress trace.csv --conditions contact.nml --length-unit mm --height-unit um --output out
  ehlwave stress trace.csv --conditions contact.nml slip_parameter=1.1 eyring_stress_pa=5e6
      --cycles 1e7 --json

Not to be trusted: where amplitudes are above 0.3 of the film, where asperities touch, and at the
edge of the contact with its pressure spike. The report says which of them it is."""


def add_stress_command(commands: Any) -> None:  # noqa: ANN401 - argparse does not name this type
    """Add the command to the parsers of ``ehlwave``."""
    parser = commands.add_parser(
        "stress",
        help="stresses below a contact, Dang Van's factor and life",
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
        "--cycles", type=float, default=1e8, metavar="N", help="of Dang Van's criterion; 1e8"
    )
    parser.add_argument(
        "--poisson-ratio", type=float, default=0.3, metavar="NU", help="of both bodies; 0.3"
    )
    parser.add_argument(
        "--depths",
        nargs="+",
        type=float,
        metavar="UM",
        help="depths, um (of files without lengths: in units of a)",
    )
    parser.add_argument(
        "--body", type=int, choices=(1, 2), default=1, help="whose stress is drawn and written"
    )
    add_reading(parser)
    parser.add_argument(
        "--ends", choices=WINDOWS, default="mirror", help="what is done about the ends of FILE"
    )
    parser.add_argument("--output", type=Path, metavar="DIR", help="write files and figures there")
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    add_overwrite(parser)
    parser.set_defaults(run=_stress)


def _stress(options: argparse.Namespace) -> None:
    depths = None if options.depths is None else np.array(options.depths)
    written = (
        _of_case(options, depths) if options.conditions is None else _of_surface(options, depths)
    )
    listing = sys.stderr if options.json else sys.stdout
    if written:
        print("\n".join(str(path) for path in written), file=listing)


def _of_case(options: argparse.Namespace, depths: Any) -> list[Path]:  # noqa: ANN401
    """Judge a file of ``ehlwave-case``; return what was written."""
    if not _is_hdf5(options.file):
        raise StressError(
            f"{options.file}: not a file of ehlwave-case --output; of a measured surface say what "
            "contact it is in: --conditions"
        )
    document, stresses = judge_case(options.file, depths, options.cycles, options.poisson_ratio)
    text = json.dumps(plain(document), indent=2, allow_nan=False)
    print(text if options.json else case_text(document))
    if options.output is None:
        return []
    stress = stresses[options.body - 1]
    figures = {"section": case_section(options.file, stress)}
    return _write(options, text, stress, figures)


def _of_surface(options: argparse.Namespace, depths: Any) -> list[Path]:  # noqa: ANN401
    """Judge a measured surface; return what was written."""
    contact = Contact(**read_keys(options.conditions).keys)
    contact.conditions = read_conditions(options.conditions)
    reading = {field.name: getattr(options, field.name) for field in fields(ReadOptions)}
    result = contact.stress(
        options.file,
        options.second,
        friction=options.friction,
        cycles=options.cycles,
        poisson_ratio=options.poisson_ratio,
        depths_m=None if depths is None else depths * 1e-6,
        smooth=options.smooth,
        form=options.form,
        ends=options.ends,
        **reading,
    )
    print(stress_json(result) if options.json else stress_text(result))
    if options.output is None:
        return []
    figures = {
        "section": predicted_section(result),
        "depth": depth_figure(result),
        "ripple": ripple_figure(result),
    }
    return _write(options, stress_json(result), stress_dataset(result), figures)


def _write(
    options: argparse.Namespace,
    text: str,
    data: Any,  # noqa: ANN401
    figures: dict[str, Any],
) -> list[Path]:
    """Write ``stress.json``, ``stress.h5`` and the figures; return the paths."""
    folder, writer = options.writer.folder(options.output), options.writer
    paths = [
        writer.text(folder / "stress.json", text + "\n"),
        writer.dataset(folder / "stress.h5", data),
    ]
    for name, figure in figures.items():
        paths += write_figure(figure, folder, name, writer=writer)
    return paths


def _is_hdf5(path: Path) -> bool:
    if not path.is_file():
        raise StressError(f"{path}: no such file")
    return bool(h5py.is_hdf5(path))
