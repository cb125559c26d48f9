"""The report on a full study: an HTML page, tables as CSV, figures as PDF and PNG."""

import os
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import pandas as pd

from studies import experiment, html
from studies.paper import (
    better_formula,
    companion,
    line_contact,
    paper_points,
    provenance,
    refitted,
)
from studies.section import COMPARISON, Parts, Section, Table, make_sections, write_section
from studies.two_waves import section as two_waves

TITLE = "Waviness in elliptical EHL contacts: the study of Venner, Kaneta and Lubrecht (2000) again"
SWEEPS = ["paper_grid", "resolved", "companion", "dense", "fresh", *refitted.RHEOLOGIES, "line"]
SWEEPS += ["two_waves", "two_waves_fresh"]

PARTS: Parts = (
    ("Figures 1 and 2", paper_points.section),
    ("companion", companion.section),
    ("refit", refitted.section),
    ("better formula", better_formula.section),
    ("line contact", line_contact.section),
    ("experiment", experiment.section),
    ("two waves", two_waves.section),
    ("provenance", partial(provenance.section, sweeps=SWEEPS)),
)


def write_report(
    folder: Path, output: Path, note: Callable[[str], None] = print, parts: Parts = PARTS
) -> list[Path]:
    """Write the report on the study in ``folder`` into ``output``; return the files.

    Parameters
    ----------
    folder : Path
        Folder written by ``scripts/reproduce --full``.
    output : Path
        Is made if it does not exist: ``report.html``, ``tables/*.csv``, ``figures/*.pdf, *.png``.
    note : callable
        Receives progress messages.
    parts : sequence of (name, function)
        Functions of the sections, in order.

    Raises
    ------
    ResultsError
        If a stage of the study is missing or not finished.
    """
    sections = make_sections(parts, folder, output, note, processes=len(os.sched_getaffinity(0)))
    first = write_section(summary(sections), output)
    return html.write_page(output, "report", TITLE, [first, *sections])


def summary(sections: Sequence[Section]) -> Section:
    """Return the first section: every number of the paper in a table, with its source."""
    found = [
        table.data.assign(part=section.title)
        for section in sections
        for table in section.tables
        if tuple(table.data.columns) == COMPARISON
    ]
    caption = "Every number printed in the paper that this study computes"
    table = Table("paper_and_this_code", caption, pd.concat(found)[["part", *COMPARISON]])
    text = [
        "The paper's sweep of waviness through elliptical contacts, its formula, and its "
        "experiment, computed anew. Each part below says what was asked, what came out, and how "
        "far off it may be. Tables are beside this page as CSV files, figures as PDF."
    ]
    return Section("The paper beside this code", text, [table])
