"""The report on a full study: one HTML page, tables as CSV, figures as PDF and PNG."""

from collections.abc import Callable, Sequence
from pathlib import Path

from studies import experiment
from studies.paper import (
    better_formula,
    html,
    line_contact,
    paper_points,
    provenance,
    refitted,
)
from studies.paper.companion import section as companion_section
from studies.paper.refitted import RHEOLOGIES
from studies.section import COMPARISON, Section, Table

TITLE = "Waviness in elliptical EHL contacts: the study of Venner, Kaneta and Lubrecht (2000) again"
SWEEPS = ["paper_grid", "resolved", "companion", "dense", "fresh", *RHEOLOGIES, "line"]

PARTS: Sequence[tuple[str, Callable[[Path], Section]]] = (
    ("Figures 1 and 2", paper_points.section),
    ("companion", companion_section),
    ("refit", refitted.section),
    ("better formula", better_formula.section),
    ("line contact", line_contact.section),
    ("experiment", experiment.section),
    ("provenance", lambda folder: provenance.section(folder, SWEEPS)),
)


def write_report(
    folder: Path,
    output: Path,
    note: Callable[[str], None] = print,
    parts: Sequence[tuple[str, Callable[[Path], Section]]] = PARTS,
) -> list[Path]:
    """Write the report on the study in ``folder`` into ``output``; return the files.

    Parameters
    ----------
    folder : Path
        What ``scripts/reproduce --full`` wrote.
    output : Path
        Is made if it does not exist: ``report.html``, ``tables/*.csv``, ``figures/*.pdf, *.png``.
    note : callable
        Is told what is being done.
    parts : sequence of (name, function)
        What makes the sections, in their order.

    Raises
    ------
    ResultsError
        If a stage of the study is missing or not finished.
    """
    sections = []
    for name, make in parts:
        note(f"{name} ...")
        sections.append(make(folder))
    sections.insert(0, summary(sections))
    return html.write_page(output, "report", TITLE, sections)


def summary(sections: Sequence[Section]) -> Section:
    """Return the first section: every number of the paper in one table, and where it is from."""
    rows = [
        (section.title, *row)
        for section in sections
        for table in section.tables
        if tuple(table.columns) == COMPARISON
        for row in table.rows
    ]
    table = Table(
        "paper_and_this_code",
        "Every number printed in the paper that this study computes",
        ("part", *COMPARISON),
        rows,
    )
    text = [
        "The paper's sweep of waviness through elliptical contacts, its formula, and its "
        "experiment, computed anew. Each part below says what was asked, what came out, and how "
        "far off it may be. Tables are beside this page as CSV files, figures as PDF.",
    ]
    return Section("The paper beside this code", text, [table])
