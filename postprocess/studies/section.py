"""Sections of the report: text, tables and figures."""

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field, replace
from functools import partial
from multiprocessing import get_context
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from ehlwave.results.figures import write_figure
from ehlwave.writing import Writer

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

    def __post_init__(self) -> None:
        """Raise ValueError if two columns share a heading: readers would confuse them."""
        if not self.data.columns.is_unique:
            raise ValueError(f"{self.name}: {list(self.data.columns)}")


@dataclass(frozen=True)
class Picture:
    """A figure of the report, None once it is written as ``<name>.pdf`` and ``<name>.png``."""

    name: str
    caption: str
    figure: Figure | None


@dataclass
class Section:
    """A part of the report: paragraphs of plain text, then tables, then figures."""

    title: str
    text: list[str] = field(default_factory=list)
    tables: list[Table] = field(default_factory=list)
    pictures: list[Picture] = field(default_factory=list)
    files: list[Path] = field(default_factory=list)
    """Files that :func:`write_section` wrote."""


Parts = Sequence[tuple[str, Callable[[Path], Section]]]
"""Names of the parts of a report, and the function that makes each of the files in a folder."""


def make_sections(
    parts: Parts, folder: Path, output: Path, note: Callable[[str], None], processes: int = 1
) -> list[Section]:
    """Return the section of every part, written to `output`; `note` receives progress messages.

    Parts that only read may be made in several processes, side by side.
    """
    work = partial(_make, folder=folder, output=output)
    with ProcessPoolExecutor(processes, mp_context=get_context("fork")) as pool:
        made = (map if processes == 1 else pool.map)(work, [make for _, make in parts])
        sections = []
        for name, _ in parts:
            note(f"{name} ...")
            sections.append(next(made))
    return sections


def _make(make: Callable[[Path], Section], folder: Path, output: Path) -> Section:
    return write_section(make(folder), output)


def write_section(section: Section, output: Path) -> Section:
    """Write ``tables/*.csv`` and ``figures/*`` into `output`; return the rest of a section."""
    tables, figures = output / "tables", output / "figures"
    files = write_parts(section, tables, figures)
    pictures = [replace(picture, figure=None) for picture in section.pictures]
    return replace(section, pictures=pictures, files=files)


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
    written, writer = [], Writer()
    for table in section.tables:
        path = tables / f"{table.name}.csv"
        written.append(writer.table(path, table.data, lineterminator="\n"))
    for picture in section.pictures:
        assert picture.figure is not None
        written += write_figure(picture.figure, figures, picture.name, dots_per_inch=150)
    return written
