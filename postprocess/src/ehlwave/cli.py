"""The command ``ehlwave``."""

import argparse
import os
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import xarray as xr
from matplotlib.figure import Figure

from ehlwave import figures, tables
from ehlwave.app.cli import add_app_command
from ehlwave.case_figures import case_figure
from ehlwave.case_file import contact_figure, read_contact
from ehlwave.command_line import Parser, as_options, with_ratio
from ehlwave.deform.cli import add_commands, add_overwrite
from ehlwave.deform.harmonics import write_harmonic_table
from ehlwave.errors import ResultsError, printable
from ehlwave.points import RATIO_COLUMNS, VARIABLES, remarks, resolved_only, select_points
from ehlwave.read import read_results
from ehlwave.refit import RefitSettings, refit_groups
from ehlwave.schema import EDGES
from ehlwave.stress.cli import add_stress_command
from ehlwave.terminal import plain_text_only
from ehlwave.writing import Writer

COLLAPSE_COLUMNS = (
    "case_id",
    "source_file",
    "orientation",
    "load_parameter_m",
    "lubricant_parameter_l",
    "radius_ratio_d",
    "slip_parameter",
    "edges",
    "wavelength_over_a",
    "wavelength_x_over_a",
    "wavelength_y_over_a",
    "f_r",
    "v",
    "v2",
    "f_v",
    "f_v2",
    "amplitude_ratio",
    "amplitude_ratio_fit",
    "deformed_ratio",
    "deformed_error",
    "status",
    "is_resolved",
)


OUTPUTS = ("output", "csv")
"""Options that name what is written; every other path is an input."""

BAD_INPUT = 2
NOT_WRITTEN = 3
"""Exit statuses, as of the programs."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Returns
    -------
    int
        0; with a message on standard error 2 for what cannot be used or must not be replaced, 3 for
        output that cannot be written.
    """
    with plain_text_only():
        options = _parser().parse_args(arguments)
        try:
            options.writer = Writer(
                _inputs(options), overwrite=getattr(options, "overwrite", False)
            )
            with_ratio(options)
            options.run(options)
            sys.stdout.flush()
        except ResultsError as error:
            return _fail(as_options(str(error), options), BAD_INPUT)
        except MemoryError:
            return _fail("not enough memory for what the files hold", BAD_INPUT)
        except BrokenPipeError:
            # The reader of our output has gone; keep Python from saying so again at exit.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return 1
        except OSError as error:
            return _fail(f"{error.filename or 'output'}: {error.strerror or error}", NOT_WRITTEN)
    return 0


def _inputs(options: argparse.Namespace) -> Iterator[str | Path]:
    """Return every word of the command line that can name a file, but the outputs."""
    for name, value in vars(options).items():
        if name not in OUTPUTS:
            if isinstance(value, list):
                yield from (word for word in value if isinstance(word, (str, Path)))
            elif isinstance(value, Path):
                yield value


def _collapse(options: argparse.Namespace) -> None:
    results = read_results(options.results)
    points = select_points(
        results,
        options.ratio,
        include_unresolved=options.include_unresolved,
        include_inaccurate=options.include_inaccurate,
        edges=options.edges,
    )
    _print_remarks(points)
    table = options.output / "collapse.csv"
    tables.write_dataset_csv(table, points, COLLAPSE_COLUMNS, options.writer)
    written = [table]
    for variable in VARIABLES:
        name = f"figure{figures.FIGURE_NUMBERS[variable]}"
        if hidden := figures.outside_axes(points, variable):
            _note(f"{hidden} point(s) lie outside the axes of {name}")
        figure = figures.collapse_figure(points, variable)
        written += figures.write_figure(figure, options.output, name, writer=options.writer)
    resolved = int(points["is_point_resolved"].sum())
    print(f"{resolved} resolved and {points.sizes['case'] - resolved} unresolved points")
    print("\n".join(str(path) for path in sorted(written)))


def _refit(options: argparse.Namespace) -> None:
    points = select_points(
        read_results(options.results),
        options.ratio,
        include_inaccurate=options.include_inaccurate,
        edges=options.edges,
    )
    _print_remarks(points)
    settings = RefitSettings(replicates=options.replicates, seed=options.seed)
    rows = refit_groups(points, settings)
    document = tables.refit_json(rows, settings, points, options.ratio)
    tables.write_refit_csv(options.output / "refit.csv", rows, options.writer)
    options.writer.text(options.output / "refit.json", document + "\n")
    print(document if options.json else tables.refit_text(rows, settings))


def _table(options: argparse.Namespace) -> None:
    print(tables.summary_text(read_results(options.results)))


def _export(options: argparse.Namespace) -> None:
    results = read_results(options.results)
    tables.write_dataset_csv(options.csv, results, writer=options.writer)
    print(f"{options.csv}: {results.sizes['case']} cases")


def _contact(options: argparse.Namespace) -> None:
    figure = contact_figure(read_contact(options.case))
    _write_picture(options, figure, options.case.stem)


def _plot(options: argparse.Namespace) -> None:
    figure = case_figure(read_contact(options.case))
    _write_picture(options, figure, f"{options.case.stem}-case")


def _write_picture(options: argparse.Namespace, figure: Figure, name: str) -> None:
    written = figures.write_figure(figure, options.output, name, writer=options.writer)
    print("\n".join(str(path) for path in written))


def _harmonics(options: argparse.Namespace) -> None:
    points = select_points(read_results(options.results), edges=options.edges)
    count = write_harmonic_table(options.csv, points, options.writer)
    print(f"{options.csv}: {count} waves")


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog="ehlwave",
        description="Figures, fits and tables from ehlwave-sweep results; deformed surfaces.",
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    def command(name: str, run: object, text: str) -> argparse.ArgumentParser:
        added = commands.add_parser(name, help=text, description=text)
        added.add_argument("results", nargs="+", type=Path, metavar="RESULTS", help="HDF5 file")
        added.set_defaults(run=run)
        return added

    def add_output(added: argparse.ArgumentParser) -> None:
        added.add_argument(
            "--output", type=Path, default=Path(), metavar="DIR", help="default: this directory"
        )
        add_overwrite(added)

    def add_csv(added: argparse.ArgumentParser) -> None:
        added.add_argument("--csv", type=Path, required=True, metavar="FILE", help="file to write")
        add_overwrite(added)

    def add_edges(added: argparse.ArgumentParser) -> None:
        text = "only cases with these edges of the domain"
        added.add_argument("--edges", choices=EDGES, help=text)

    def add_common(added: argparse.ArgumentParser) -> None:
        add_output(added)
        add_edges(added)
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

    collapse = command("collapse", _collapse, "draw Ad/Ai against f(r) V2 and f(r) V")
    add_common(collapse)
    collapse.add_argument(
        "--include-unresolved", action="store_true", help="show unresolved points too, in grey"
    )
    refitting = command("refit", _refit, "fit the coefficients of the amplitude formula")
    add_common(refitting)
    refitting.add_argument("--json", action="store_true", help="print JSON instead of a table")
    defaults = RefitSettings()
    refitting.add_argument(
        "--replicates", type=_count, default=defaults.replicates, help="bootstrap samples"
    )
    refitting.add_argument(
        "--seed", type=_count, default=defaults.seed, help="of the bootstrap's random numbers"
    )
    command("table", _table, "count cases by status and list the failed ones")
    add_csv(command("export", _export, "write all columns to a CSV file"))
    text = "write a harmonic table for deform --table from resolved cases"
    harmonics = command("harmonics", _harmonics, text)
    add_csv(harmonics)
    add_edges(harmonics)
    text = "draw film and pressure of one case"
    contact = commands.add_parser("contact", help=text, description=text)
    contact.add_argument(
        "case", type=Path, metavar="FILE", help="HDF5 file of ehlwave-case --output"
    )
    add_output(contact)
    contact.set_defaults(run=_contact)
    text = "draw one case in um, GPa and us: maps, midplanes, film at the centre in time"
    plot = commands.add_parser("plot", help=text, description=text)
    plot.add_argument("case", type=Path, metavar="FILE", help="HDF5 file of ehlwave-case --output")
    add_output(plot)
    plot.set_defaults(run=_plot)
    add_commands(commands)
    add_stress_command(commands)
    add_app_command(commands)
    return parser


def _count(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of 0 or more")
    return int(text)


def _print_remarks(points: xr.Dataset) -> None:
    for remark in remarks(resolved_only(points)):
        _note(remark)


def _note(text: str) -> None:
    print(f"ehlwave: note: {text}", file=sys.stderr)


def _fail(text: str, status: int) -> int:
    print(f"ehlwave: error: {printable(text)}", file=sys.stderr)
    return status
