"""Columns of numbers in text files, whatever separates them."""

import codecs
import contextlib
import io
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ehlwave.errors import SurfaceError
from ehlwave.surface.decimals import Decimal, settled, unquoted
from ehlwave.surface.units import METRES, unit_in_heading

_SEPARATORS = (";", "\t", ",", None)


_NUMBER = re.compile(
    r"[-+]?(\d+([.,]\d*)?|[.,]\d+)([eE][-+]?\d+)?$|nan$"
    r"|[-+]?\d{1,3}(,\d{3})+(\.\d*)?$|[-+]?\d{1,3}(\.\d{3})+(,\d*)?$",  # marks of thousands
    re.IGNORECASE,
)
_DECIMAL_COMMA = re.compile(r"[-+]?\d*,\d+([eE][-+]?\d+)?$|[-+]?\d+$")
_POSITION = re.compile(r"(x|pos|length|distance|traverse|lateral|path|weg)", re.IGNORECASE)
_HEIGHT = re.compile(r"(z|height|profil|amplitude|level|h(oe|\u00f6)he|roughness)", re.IGNORECASE)
_QUANTITY = r"\s*[:=;,\t ]\s*([-+\d.,eE]+)[;,\t ]*[\[(]?([a-zA-Z\u00b5\u03bc]*)"
_UNIT = r"[ _-]*units?\s*[:=;,\t ]+[\[(]?([a-zA-Z\u00b5\u03bc]+)"
_STEP = re.compile(
    r"^\W*(?:x[ _-]?)?(?:step|spacing|pitch|increment|sampling (?:interval|step|distance)|dx)"
    r"(?: size)?(?: in)?" + _QUANTITY,
    re.IGNORECASE | re.MULTILINE,
)
_EXTENT = re.compile(rf"^\W*(width|height)\b{_QUANTITY}", re.IGNORECASE | re.MULTILINE)
_HEIGHT_UNIT = re.compile(
    rf"^\W*(?:z|y|height|vertical|profile|amplitude|data|value)?{_UNIT}",
    re.IGNORECASE | re.MULTILINE,
)
_FEWEST_ROWS = 3


@dataclass
class TextTable:
    """Numbers of a text file and what stands above them.

    Attributes
    ----------
    numbers : ndarray, shape (rows, columns)
        Columns of a trace, or a map.
    units : list of str or None
        Of each column, where the file says so.
    names : list of str
        Headings, or none.
    has_decimal_commas : bool
        Whether commas were taken as decimal ones.
    step, length_unit, height_unit
        From lines such as ``Spacing: 0.5 um`` and ``Z-Unit: nm``; None if there are none.
    extent : dict
        Length of a map along its rows (``width``) and across (``height``) with its unit.
    """

    numbers: np.ndarray
    units: list[str | None]
    names: list[str]
    has_decimal_commas: bool = False
    step: float | None = None
    length_unit: str | None = None
    height_unit: str | None = None
    extent: dict[str, tuple[float, str]] = field(default_factory=dict)


def read_text_table(file: Path, decimal: Decimal | None = None) -> TextTable:
    """Return a table of numbers, and the units and steps that the file states.

    Lines that begin with ``#`` and empty lines are skipped. Numbers begin with the first of three
    lines that have as many of them; above them may stand anything, the last lines of it headings,
    from which units are taken (``x [um]``, ``height (nm)``, ``x/mm``, ``x_m``), or a row of units.
    Numbers may have decimal commas; what commas mean is found by :mod:`ehlwave.surface.decimals`,
    or said by `decimal`.

    Raises SurfaceError if a row has another length than the first, or a cell is not a number. Empty
    cells and ``nan`` are missing heights, not errors.
    """
    lines = _text(file).splitlines()
    content = [line for line in lines if line.strip() and not line.lstrip().startswith("#")]
    if not content:
        raise SurfaceError(f"{file}: is empty")
    content = unquoted(content)
    cells = (cell for line in content for cell in re.split(r"[;,\t ]+", line.strip()))
    if not any(map(_NUMBER.match, cells)):
        raise SurfaceError(
            f"{file}: holds no numbers; write positions and heights as two columns with headings "
            "such as x_um;z_um"
        )
    start, separator = _first_numbers(content)
    above, body = content[:start], content[start:]
    while len(body) > 1 and not any(_is_number(cell) for cell in body[-1].split(separator)):
        body.pop()  # what stands below
    if not body or (start == 0 and not any(_is_number(cell) for cell in body[0].split(separator))):
        raise SurfaceError(f"{file}: has headings but no numbers")
    headings = len(above[-1].split(",")) if above else 0
    body, separator, has_decimal_commas = settled(file, body, separator, headings, decimal)
    numbers = _numbers(file, "\n".join(body), separator)
    ends_rows = numbers.shape[1] > 1 and np.isnan(numbers[:, -1]).all()
    if ends_rows:
        numbers = numbers[:, :-1]  # separators end the rows
    names, units = _headings(file, above, separator, numbers.shape[1])
    said = "\n".join([*above, *(line for line in lines if line.lstrip().startswith("#"))])
    return TextTable(numbers, units, names, has_decimal_commas, **_stated(said))


def _text(file: Path) -> str:
    """Return what a file says in UTF-8, in UTF-16 with its mark, or in Latin-1."""
    data = file.read_bytes()
    marked = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    for encoding in ("utf-16",) if marked else ("utf-8-sig", "latin-1"):
        with contextlib.suppress(UnicodeDecodeError):
            return data.decode(encoding)
    raise SurfaceError(f"{file}: begins as UTF-16 text and is none")


def _first_numbers(lines: list[str]) -> tuple[int, str | None]:
    """Return the line in which the numbers begin, and what separates them."""
    for start in range(max(1, len(lines) - _FEWEST_ROWS + 1)):
        first = lines[start : start + _FEWEST_ROWS]
        for separator in _SEPARATORS:
            if separator is not None and separator not in first[0]:
                continue
            blank = first[0].split()
            if separator == "," and len(blank) > 1 and all(map(_DECIMAL_COMMA.match, blank)):
                continue
            rows = [[cell.strip() for cell in line.strip().split(separator)] for line in first]
            are_numbers = all(_is_number(cell) for row in rows for cell in row)
            if are_numbers and len({len(row) for row in rows}) == 1 and any(rows[0]):
                return start, separator
            break
    separator = next(s for s in _SEPARATORS if s is None or s in lines[0])
    return int(not any(_is_number(cell) for cell in lines[0].split(separator))), separator


def _headings(
    file: Path, above: list[str], separator: str | None, columns: int
) -> tuple[list[str], list[str | None]]:
    """Return names and units of the columns from the two lines above the numbers."""
    names, units, last = [], [None] * columns, 0
    for line in reversed(above[-2:]):
        cells = [cell.strip().strip('"') for cell in line.split(separator)]
        if separator is None and len(cells) != columns:
            cells = [cell for cell in re.split(r"\s{2,}|\t", line.strip()) if cell]
        last = last or len(cells)
        if len(cells) == columns + 1 and not cells[-1]:
            cells.pop()
        if len(cells) != columns:
            break
        bare = [cell.strip("[]() ") for cell in cells]
        if any(bare) and all(not cell or cell in METRES for cell in bare) and not names:
            units = [cell or None for cell in bare]
            continue
        names = cells
        if not any(units):
            units = [unit_in_heading(cell) for cell in cells]
        break
    if len(above) == 1 and last != columns and columns > 1 and separator in (above[0]):
        raise SurfaceError(f"{file}: {last} headings for {columns} columns")
    return names, units


def _stated(said: str) -> dict[str, Any]:
    """Return step, units and extent from lines of a preamble."""
    found: dict[str, Any] = {}
    if match := _STEP.search(said):
        found["step"] = float(match[1].replace(",", "."))
        found["length_unit"] = match[2] or None
    if match := _HEIGHT_UNIT.search(said):
        found["height_unit"] = match[1]
    for match in _EXTENT.finditer(said):
        if match[3] in METRES:
            value = float(match[2].replace(",", "."))
            found.setdefault("extent", {})[match[1].lower()] = (value, match[3])
    return found


def position_and_height(table: TextTable) -> tuple[int, int] | None:
    """Return which columns are positions and heights by their headings, None if they do not say."""
    position = [k for k, name in enumerate(table.names) if _POSITION.match(name)]
    height = [k for k, name in enumerate(table.names) if _HEIGHT.match(name)]
    if not position or not height:
        return None
    return position[0], height[0]


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
    return not cell.strip() or _NUMBER.match(cell.strip()) is not None
