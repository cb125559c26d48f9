"""Arguments of the commands on results files and files of cases."""

import argparse
from pathlib import Path
from typing import Any

from ehlwave.choices import RATIO_COLUMNS, REPLICATES, SEED
from ehlwave.cli.arguments.shared import Run, add_output, add_overwrite, later
from ehlwave.results.schema import EDGES

EXPORT = """\
Write results for other programs. RESULTS are files of ehlwave-sweep, whose columns become a table,
or the file of one case, ehlwave-case --output, whose fields become a grid."""

EXPORT_EXAMPLES = """\
Examples:
  ehlwave export results.h5 --csv results.csv
  ehlwave export results.h5 --parquet results.parquet     (needs pyarrow)
  ehlwave export results.h5 --netcdf results.nc
  ehlwave export contact.h5 --vtk contact.vtr             (film and pressure, for ParaView)
  ehlwave export contact.h5 --netcdf contact.nc"""


def add_results_commands(commands: Any) -> None:  # noqa: ANN401 - argparse does not name this type
    """Add the commands to the parsers of ``ehlwave``."""

    def command(name: str, text: str, **options: Any) -> argparse.ArgumentParser:  # noqa: ANN401
        added = commands.add_parser(name, help=text, **({"description": text} | options))
        added.add_argument(
            "results", nargs="+", type=Path, metavar="RESULTS", help="results of ehlwave-sweep"
        )
        added.set_defaults(run=_runs(name))
        return added

    def of_case(name: str, text: str) -> argparse.ArgumentParser:
        added = commands.add_parser(name, help=text, description=text)
        added.add_argument(
            "case", type=Path, metavar="FILE", help="HDF5 file of ehlwave-case --output"
        )
        add_output(added)
        added.set_defaults(run=_runs(name))
        return added

    collapse = command("collapse", "draw Ad/Ai against f(r) V2 and f(r) V")
    _add_common(collapse)
    collapse.add_argument(
        "--include-unresolved", action="store_true", help="show unresolved points too, in grey"
    )
    collapse.add_argument(
        "--color-by",
        metavar="KEY",
        help="colour points by a column, such as load_parameter_m or slip_parameter",
    )
    refit = command("refit", "fit the coefficients of the amplitude formula")
    _add_common(refit)
    refit.add_argument("--json", action="store_true", help="print JSON instead of a table")
    refit.add_argument(
        "--replicates", type=_count, default=REPLICATES, help="number of bootstrap samples"
    )
    refit.add_argument(
        "--seed", type=_count, default=SEED, help="seed of the bootstrap's random numbers"
    )
    command("table", "count cases by status and list failed cases")
    export = command(
        "export",
        "write results as CSV, Parquet, NetCDF or VTK",
        description=EXPORT,
        epilog=EXPORT_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_formats(export)
    harmonics = command(
        "harmonics", "write a harmonic table for deform --table from resolved cases"
    )
    harmonics.add_argument("--csv", type=Path, required=True, metavar="FILE", help="file to write")
    add_overwrite(harmonics)
    _add_edges(harmonics)
    of_case("contact", "draw film and pressure of one case")
    plot = of_case(
        "plot", "draw one case in um, GPa and us: maps, midplanes, film at the centre in time"
    )
    plot.add_argument(
        "--time",
        type=float,
        metavar="TIME",
        help="instant to draw, of a march with &output fields_every = N /: in us, or T of a case "
        "without dimensions (default: the last one)",
    )
    animate = of_case(
        "animate", "draw a march in motion, as GIF or MP4; it needs &output fields_every = N /"
    )
    animate.add_argument(
        "--format", choices=("gif", "mp4"), default="gif", help="gif (default), or mp4 by ffmpeg"
    )
    animate.add_argument(
        "--frames-per-second", type=float, default=10.0, metavar="N", help="default 10"
    )


def _runs(name: str) -> Run:
    return later("ehlwave.cli.results", f"run_{name}")


def _add_formats(export: argparse.ArgumentParser) -> None:
    formats = {
        "csv": "table as CSV",
        "parquet": "table as Parquet; needs pyarrow",
        "netcdf": "table, or fields of one case, as NetCDF with CF attributes",
        "vtk": "fields of one case as a VTK rectilinear grid, .vtr",
    }
    for name, text in formats.items():
        export.add_argument(f"--{name}", type=Path, metavar="FILE", help=text)
    add_overwrite(export)


def _add_edges(added: argparse.ArgumentParser) -> None:
    text = "only cases with these edges of the domain"
    added.add_argument("--edges", choices=EDGES, help=text)


def _add_common(added: argparse.ArgumentParser) -> None:
    add_output(added)
    _add_edges(added)
    added.add_argument(
        "--ratio",
        choices=tuple(RATIO_COLUMNS),
        default="fit",
        help="Ad/Ai from the harmonic fit (default), extreme samples, or linear response",
    )
    added.add_argument(
        "--include-inaccurate",
        action="store_true",
        help="take points whose error is above the accuracy asked for, too",
    )


def _count(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of 0 or more")
    return int(text)
