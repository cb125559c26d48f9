"""Actions of ``ehlwave deform`` and ``ehlwave surface``."""

import argparse
import json
import sys
import warnings
from dataclasses import asdict, fields
from pathlib import Path

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_read import read_given
from ehlwave.errors import ExtrapolationWarning, SurfaceError
from ehlwave.laws.asked import Asked
from ehlwave.laws.law_list import others_of, transfer_for
from ehlwave.laws.transfer import Transfer
from ehlwave.operating_point import Contact, contact_of
from ehlwave.results.coefficients import read_coefficients
from ehlwave.surface.answer import answer_of_two
from ehlwave.surface.pair import DeformedPair
from ehlwave.surface.period import cut_period
from ehlwave.surface.predict import Deformed, deform_surface
from ehlwave.surface.prepare import remove_form
from ehlwave.surface.read import ReadOptions, read_surface
from ehlwave.surface.report import (
    ANSWER,
    brief_text,
    pair_text,
    plain,
    report_json,
    report_text,
    write_results,
)
from ehlwave.surface.simulation import simulation_surface, write_simulation_surface
from ehlwave.writing import Writer

MOST_COMPARED = 2**20
"""Points of a surface that is judged by formulas besides, for comparison."""


def read_options(options: argparse.Namespace) -> ReadOptions:
    """Return the reader's options of a parsed command line."""
    names = (field.name for field in fields(ReadOptions))
    return ReadOptions(**{name: getattr(options, name) for name in names})


def run_deform(options: argparse.Namespace) -> None:
    """Predict the shape of a surface, or two, inside the contact; print and write it."""
    given = read_given(options.conditions)
    contact = contact_of(given, options.table)
    results = [_predicted(options, options.surface, contact)]
    results[0].warnings.extend(given.notices)
    pair = None
    if options.second is not None:
        results.append(_predicted(options, options.second, contact.exchanged()))
        pair = DeformedPair(*results)
    print(_json_text(results, pair) if options.json else _text(results, pair, options))
    if options.output is not None:
        written = []
        if pair is not None:
            written.append(pair.film.write(options.output / "film.csv", options.writer))
        for result, folder in zip(results, ("", "second"), strict=False):
            written += _write(result, options.output / folder, options.writer)
        listing = sys.stderr if options.json else sys.stdout
        print("\n".join(str(path) for path in written), file=listing)


def _predicted(options: argparse.Namespace, path: Path, contact: Contact) -> Deformed:
    with warnings.catch_warnings():  # the report prints them
        warnings.simplefilter("ignore", ExtrapolationWarning)
        return contact.deform(
            read_surface(path, read_options(options)),
            options.by,
            options.form,
            options.ends,
            (_metres(options.cutoff), _metres(options.short_cutoff)),
            _transfer(options, contact.conditions),
            _metres(options.boundary_film),
        )


def _metres(length_um: float | None) -> float | None:
    return None if length_um is None else length_um * 1e-6


def _text(results: list[Deformed], pair: DeformedPair | None, options: argparse.Namespace) -> str:
    reports = [
        brief_text(result) if options.brief else report_text(result, _others(result, options))
        for result in results
    ]
    if pair is None:
        return reports[0]
    answer = f"{ANSWER}both surfaces: {answer_of_two(pair.statistics).text()}"
    alone = [
        report.replace(ANSWER, f"{ANSWER}surface {number} alone: ", 1)
        for number, report in enumerate(reports, 1)
    ]
    return "\n".join([answer, *alone, pair_text(pair.statistics), pair.film.text()])


def _json_text(results: list[Deformed], pair: DeformedPair | None) -> str:
    if pair is None:
        return report_json(results[0])
    first, second = (json.loads(report_json(result)) for result in results)
    document = {
        "answer": answer_of_two(pair.statistics).summary(),
        "first": first,
        "second": second,
        "both": asdict(pair.statistics),
        "film": pair.film.summary(),
    }
    return json.dumps(plain(document), indent=2, allow_nan=False)


def _write(result: Deformed, folder: Path, writer: Writer) -> list[Path]:
    from ehlwave.results.figures import write_figure
    from ehlwave.surface.bands_figure import removal_figure
    from ehlwave.surface.figures import deformed_figure, spectrum_figure

    written = write_results(result, folder, writer)
    written += write_figure(deformed_figure(result), folder, "deformed", writer=writer)
    written += write_figure(spectrum_figure(result), folder, "spectrum", writer=writer)
    if result.bands:
        written += write_figure(removal_figure(result.bands), folder, "remove", writer=writer)
    return written


def run_surface(options: argparse.Namespace) -> None:
    """Write a surface for the full simulation."""
    surface, form = read_surface(options.surface, read_options(options)), options.form
    print("".join(f"{surface.name}: {note}\n" for note in surface.notes), end="")
    start = options.period_start
    if options.period is not None:
        start_m = None if start is None else start * 1e-6
        # The form belongs to the whole trace: a single wave of it has a tilt of its own.
        surface = cut_period(remove_form(surface, form), options.period * 1e-6, start_m)
        form = "none"
    elif start is not None:
        raise SurfaceError(
            f"--period-start {start:g} without --period: give the length of the wave"
        )
    prepared = simulation_surface(surface, form, options.repeat)
    write_simulation_surface(prepared, options.output, options.writer)
    nx, ny = prepared.height.shape
    print(f"{options.output}: {nx} x {ny} points, {(nx - 1) * prepared.step_x_m * 1e6:.5g} um long")


def _transfer(options: argparse.Namespace, conditions: Conditions) -> Transfer | None:
    """Return the transfer of a file that the user names; None: the list of laws has it."""
    if options.refit is None:
        return None
    own = (*read_coefficients(options.refit), options.refit.name)
    return transfer_for(Asked(conditions, coefficients=own), "paper")


def _others(result: Deformed, options: argparse.Namespace) -> list[Deformed]:
    """Return the same surface by the other laws, for comparison."""
    conditions = result.conditions
    if result.height.size > MOST_COMPARED:
        return []
    return [
        deform_surface(result.surface, conditions, other, "none", options.ends)
        for other in others_of(conditions)
        if other.name != result.transfer_name
    ]
