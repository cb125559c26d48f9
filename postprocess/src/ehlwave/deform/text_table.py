"""Columns of numbers in text files, whatever separates them."""

import io
import re
from pathlib import Path

import numpy as np

from ehlwave.deform.units import unit_in_heading
from ehlwave.errors import SurfaceError

_SEPARATORS = (";", "\t", ",", None)


def read_text_table(file: Path) -> tuple[np.ndarray, list[str | None]]:
    """Return a table of numbers and the unit of each column, None where the file has none.

    Lines that begin with ``#`` and empty lines are skipped. The first other line may hold headings,
    from which units are taken: ``x [um]``, ``height (nm)``, ``x/mm``, ``x_m``.

    Raises
    ------
    SurfaceError
        If a row has another length than the first, or a cell is not a number. Empty cells and
        ``nan`` are missing heights, not errors.
    """
    try:
        text = file.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        text = file.read_text(encoding="latin-1")
    first = next((line for line in text.splitlines() if line.strip() and line[0] != "#"), None)
    if first is None:
        raise SurfaceError(f"{file}: is empty")
    separator = next(s for s in _SEPARATORS if s is None or s in first)
    headings = [cell.strip().strip('"') for cell in first.split(separator)]
    has_headings = not any(_is_number(cell) for cell in headings)
    if has_headings:
        text = text[text.index(first) + len(first) :]
    if separator == ";" and "," in text and "." not in text:
        text = text.replace(",", ".")  # decimal commas
    if not text.strip():
        raise SurfaceError(f"{file}: has headings but no numbers")
    table = _numbers(file, text, separator)
    if table.shape[1] > 1 and np.isnan(table[:, -1]).all():
        table, headings = table[:, :-1], headings[: table.shape[1] - 1]  # separators end the rows
    if has_headings and len(headings) != table.shape[1]:
        raise SurfaceError(f"{file}: {len(headings)} headings for {table.shape[1]} columns")
    units = [unit_in_heading(heading) for heading in headings]
    return table, units if has_headings else [None] * table.shape[1]


def _numbers(file: Path, text: str, separator: str | None) -> np.ndarray:
    if separator is not None:
        gap = re.escape(separator)
        # Two separators in a row, or one at an end of a line, leave a height out.
        empty = rf"(?m)(?:(?<={gap})|^)[ ]*(?={gap})|(?<={gap})[ ]*(?=\r?$)"
        if re.search(empty, text):
            text = re.sub(empty, "nan", text)
    try:
        return np.loadtxt(io.StringIO(text), delimiter=separator, ndmin=2, comments="#")
    except ValueError as error:
        raise SurfaceError(f"{file}: {_plain(str(error))}") from error


def _plain(message: str) -> str:
    """Return NumPy's message without advice about its own arguments."""
    return re.split(r"; use `usecols`| ?\(?, at row", message)[0]


def _is_number(cell: str) -> bool:
    try:
        float(cell.replace(",", "."))
    except ValueError:
        return cell.strip() == ""
    return True
