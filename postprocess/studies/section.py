"""What the parts of the study hand to the report: sections of text, tables and figures."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from ehlwave.figures import write_figure

Cell = str | float | int | None

COMPARISON = ("quantity", "unit", "paper", "this code", "difference", "error bar", "remark")


@dataclass(frozen=True)
class Table:
    """A table of the report, also written as ``<name>.csv``.

    The columns of ``data`` are its headings. Numbers stay numbers: the report rounds them to four
    digits, the CSV file keeps all. None and NaN are empty cells. ``is_long`` tables are folded in
    the report.
    """

    name: str
    caption: str
    data: pd.DataFrame
    is_long: bool = False


@dataclass(frozen=True)
class Picture:
    """A figure of the report, also written as ``<name>.pdf`` and ``<name>.png``."""

    name: str
    caption: str
    figure: Figure


@dataclass
class Section:
    """One part of the report: paragraphs of plain text, then tables, then figures."""

    title: str
    text: list[str] = field(default_factory=list)
    tables: list[Table] = field(default_factory=list)
    pictures: list[Picture] = field(default_factory=list)


Parts = Sequence[tuple[str, Callable[[Path], Section]]]
"""Names of the parts of a report, and what makes each of the files in a folder."""


def make_sections(parts: Parts, folder: Path, note: Callable[[str], None]) -> list[Section]:
    """Return the section of every part; `note` is told what is being made."""
    sections = []
    for name, make in parts:
        note(f"{name} ...")
        sections.append(make(folder))
    return sections


def comparison_row(
    quantity: str,
    unit: str,
    paper: float | None,
    ours: float,
    error: float | None = None,
    remark: str = "",
) -> tuple[Cell, ...]:
    """Return a row of a table with the columns ``COMPARISON``.

    The difference is this code less the paper; ``error`` is the error bar of this code's value, in
    the same unit.
    """
    difference = None if paper is None else ours - paper
    return (quantity, unit, paper, ours, difference, error, remark)


def comparison(name: str, caption: str, rows: Iterable[Sequence[Cell]]) -> Table:
    """Return the table of rows from :func:`comparison_row`."""
    return Table(name, caption, pd.DataFrame(rows, columns=COMPARISON))


def write_parts(section: Section, tables: Path, figures: Path) -> list[Path]:
    """Write the tables, as CSV with all digits, and the figures, as PDF and PNG; return paths."""
    written = []
    for table in section.tables:
        written.append(tables / f"{table.name}.csv")
        table.data.to_csv(written[-1], index=False, lineterminator="\n")
    for picture in section.pictures:
        written += write_figure(picture.figure, figures, picture.name, dots_per_inch=150)
    return written
