"""What the parts of the study hand to the report: sections of text, tables and figures."""

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from matplotlib.figure import Figure

from ehlwave_post.figures import write_figure

Cell = str | float | int | None

COMPARISON = ("quantity", "unit", "paper", "this code", "difference", "error bar", "remark")


@dataclass(frozen=True)
class Table:
    """A table of the report, also written as ``<name>.csv``.

    Numbers stay numbers: the report rounds them to four digits, the CSV file keeps all. None and
    NaN are empty cells. ``is_long`` tables are folded in the report.
    """

    name: str
    caption: str
    columns: Sequence[str]
    rows: Sequence[Sequence[Cell]]
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


def write_table(table: Table, folder: Path) -> Path:
    """Write a table as CSV with all digits; return its path."""
    path = folder / f"{table.name}.csv"
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(table.columns)
        writer.writerows([[_plain(cell) for cell in row] for row in table.rows])
    return path


def write_picture(picture: Picture, folder: Path) -> list[Path]:
    """Write a figure as PDF and PNG; return the paths."""
    return write_figure(picture.figure, folder, picture.name, dots_per_inch=150)


def _plain(cell: Cell) -> Cell:
    return "" if cell is None or (isinstance(cell, float) and math.isnan(cell)) else cell
