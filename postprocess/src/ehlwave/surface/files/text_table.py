"""Columns of numbers in text files, whatever separates them."""

import io
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ehlwave.choices import Decimal
from ehlwave.errors import SurfaceError, printable
from ehlwave.surface.files.decimals import settled
from ehlwave.surface.files.rows import Rows, in_numerals, is_missing, is_number, rows_of, split
from ehlwave.surface.files.statements import Statements, statements_of
from ehlwave.surface.files.words import Heading, heading_of
from ehlwave.surface.units import known_unit

Numbers = NDArray[np.float64]

_HEADING_LINES = 4
"""Lines above the numbers among which headings are looked for."""

_UNUSUAL = re.compile(r"[dD*]|[a-zA-Z/#]{2}|--|-\s|-$")
"""Marks of lines that are put into plain numerals before they are read."""


@dataclass
class TextTable:
    """Numbers of a text file and the text above them.

    Attributes
    ----------
    numbers : ndarray, shape (rows, columns)
        Columns of a trace, or a map.
    headings : list of Heading
        Of each column, or none.
    has_decimal_commas : bool
        Whether commas were read as decimal commas.
    stated : Statements
        Steps, extents and units.
    across : ndarray or None
        Numbers above the columns of a matrix whose first heading is none: positions.
    notes : list of str
        Parts left out.
    """

    numbers: Numbers
    headings: list[Heading]
    has_decimal_commas: bool = False
    stated: Statements = field(default_factory=Statements)
    across: Numbers | None = None
    notes: list[str] = field(default_factory=list)


def read_text_table(file: Path, decimal: Decimal | None = None) -> TextTable:
    """Return a table of numbers, and the units and steps that the file states.

    Headings give roles and units (``x [um]``, ``height (nm)``, ``x/mm``, ``x_m``); a row of units
    may follow them. Numbers may have decimal commas; the meaning of commas is found by
    :mod:`ehlwave.surface.files.decimals`, or given by `decimal`. Columns without any number are
    left out.

    Raises SurfaceError if a row has another length than the first, or a cell is not a number. Empty
    cells and words such as ``nan`` are missing heights, not errors.
    """
    rows = rows_of(file)
    names = len(rows.above[-1].strip(" ").rstrip(",").split(",")) if rows.above else 0
    body = [
        in_numerals(line, rows.separator) if _UNUSUAL.search(line) else line for line in rows.body
    ]
    body, separator, has_commas = settled(file, body, rows.separator, names, decimal)
    numbers = _numbers(file, body, separator)
    cells = _heading_cells(rows, numbers.shape[1])
    _refuse_other_count(file, rows, cells, numbers.shape[1])
    held = ~np.isnan(numbers).all(axis=0)
    if held.any() and not held.all():
        numbers = numbers[:, held]
        cells = [cell for cell, kept in zip(cells, held, strict=False) if kept]
    notes = []
    numbers, dropped = _without_counts(numbers)
    if dropped:
        notes.append(f"left out above the heights: {dropped}")
    stated = statements_of(file, rows.above)
    across = _positions_above(cells)
    headings = [] if across is not None else [heading_of(cell) for cell in cells]
    return TextTable(numbers, headings, has_commas, stated, across, notes)


def _heading_cells(rows: Rows, columns: int) -> list[str]:
    """Return headings of the columns from the lines above the numbers, with units; or none."""
    units: list[str] | None = None
    for line in islice(reversed(rows.above), _HEADING_LINES):
        cells = _cells_of(line, rows.separator, columns)
        if cells is None:
            if set(line) <= set("-=_*+| \t;,") or line.strip(" []<>$\"'").lower() in _BEGINNINGS:
                continue
            break
        if all(set(cell) <= set("-=_*+") for cell in cells):
            continue
        bare = [cell.strip("[](){} ") for cell in cells]
        if units is None and any(map(known_unit, bare)) and _are_units(bare):
            units = bare
            continue
        if columns > 1 and len(set(cells)) == 1:
            continue  # a row of comments, which identifies no column
        if columns == 1 and heading_of(cells[0]).unit is None and heading_of(cells[0]).role is None:
            return [] if units is None else [f"[{units[0]}]"]
        if units is not None:
            return [
                f"{cell} [{unit}]" if unit else cell
                for cell, unit in zip(cells, units, strict=True)
            ]
        return cells
    return [] if units is None else [f"[{unit}]" for unit in units]


_BEGINNINGS = ("data", "daten", "données", "scan data", "profile data", "values", "begin", "start")
_BEGINNINGS += ("messwerte", "profildaten", "mesures", "データ", "measurement data", "raw data")
"""Lines between headings and numbers."""


def _are_units(cells: Sequence[str]) -> bool:
    """Return whether cells are units: of length, of anything else, or empty."""
    units = (known_unit(cell) or heading_of(f"[{cell}]").role == "other" for cell in cells if cell)
    return all(units)


def _cells_of(line: str, separator: str | None, columns: int) -> list[str] | None:
    """Return a line as headings of so many columns; None if it is none."""
    if columns == 1:
        is_statement = re.search(r"[:=]|(?:^|[\s;,])[-+]?\d", line)
        return None if is_statement else [line.strip().strip('";,\t')]
    closed = re.sub(r"(?<=[\])}])\s+(?=\S)", "\t", line.strip())
    if separator is not None and separator in line.rstrip(f" {separator}"):
        ways = [line.split(separator)]
    else:
        ways = [line.split(mark) for mark in (";", "\t", ",", "|")]
        ways += [re.split(r"[ \t]{2,}", line.strip()), closed.split("\t"), line.split()]
    for cells in ways:
        cells = [cell.strip().strip('"').strip() for cell in cells]
        while len(cells) > columns and not cells[-1]:
            cells.pop()
        numbers = sum(map(is_number, cells))
        is_text = not any(cell[:1].isdigit() or _VALUE.search(cell) for cell in cells)
        units = [known_unit(cell.strip("[](){} ")) for cell in cells]
        is_cut = any(units) and not _are_units([cell.strip("[](){} ") for cell in cells])
        if (
            len(cells) == columns
            and cells[-1]
            and not (is_cut and len(ways) > 1)
            and (is_text or numbers >= columns - 1 > 2)
        ):
            return cells
    return None


_VALUE = re.compile(r"(?i)[:=]|\b(?:no|nr|n°|version|v)\b\.?\s*\d")
"""Marks of a statement such as ``Specimen No. 12``, which is no heading."""


def _refuse_other_count(file: Path, rows: Rows, cells: Sequence[str], columns: int) -> None:
    """Raise SurfaceError if the last line above the numbers has headings for other columns."""
    if cells or not rows.above:
        return
    separators = [mark for mark in (rows.separator, ";", "\t") if mark and mark in rows.above[-1]]
    if not separators:
        return
    found = split(rows.above[-1], separators[0])
    while len(found) > 1 and not found[-1]:
        found.pop()
    ones = [heading_of(cell) for cell in found]
    names_columns = any(one.unit or one.role in ("x", "y", "z") for one in ones)
    if len(found) > 1 and names_columns and all(one.unit or one.role for one in ones):
        raise SurfaceError(f"{file}: {len(found)} headings for {columns} columns")


def _positions_above(cells: Sequence[str]) -> Numbers | None:
    """Return numbers above the columns of a matrix, whose corner holds none."""
    if len(cells) < 4:
        return None
    try:
        values = np.array([float(cell.replace(",", ".")) for cell in cells[1:]])
    except ValueError:
        return None
    return values


def _without_counts(numbers: Numbers) -> tuple[Numbers, str]:
    """Return a column without the count of its heights above them, and the parts left out."""
    if numbers.shape[1] != 1:
        return numbers, ""
    for place in range(min(4, len(numbers) - 8)):
        if numbers[place, 0] == len(numbers) - place - 1:
            said = ", ".join(f"{value:g}" for value in numbers[: place + 1, 0])
            return numbers[place + 1 :], f"{said} (the last of them is the count of heights)"
    return numbers, ""


def _numbers(file: Path, body: Sequence[str], separator: str | None) -> Numbers:
    text = "\n".join(body)
    if separator is not None:
        gap = re.escape(separator)
        # Two separators in a row, or a separator at the end of a line, leave a height out.
        empty = rf"(?m)(?:(?<={gap})|^)[ ]*(?={gap})|(?<={gap})[ ]*(?=\r?$)"
        if re.search(empty, text):
            text = re.sub(empty, "nan", text)
    try:
        return np.loadtxt(io.StringIO(text), delimiter=separator, ndmin=2, comments=None)
    except ValueError as error:
        raise SurfaceError(f"{file}: {_fault(body, separator, str(error))}") from error


def _fault(body: Sequence[str], separator: str | None, message: str) -> str:
    """Return which row of numbers is none."""
    count = len(split(body[0], separator))
    for place, line in enumerate(body, 1):
        cells = split(line, separator)
        odd = next(
            (cell for cell in cells if cell and not is_missing(cell) and not _reads(cell)), ""
        )
        if odd or len(cells) != count:
            shown = printable(line.strip())[:60]
            if odd:
                return (
                    f"could not convert string '{printable(odd)[:40]}' to a number in row {place} "
                    f"of the numbers, '{shown}': keep one table, and text above or below it"
                )
            return (
                f"the number of columns changed from {count} to {len(cells)} in row {place} of the "
                f"numbers, '{shown}'"
            )
    return re.split(r"; use `usecols`| ?\(?, at row", message)[0]


def _reads(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
