"""The block of numbers in a text: its begin and end, and the separator of its cells."""

import codecs
import contextlib
import csv
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from ehlwave.errors import SurfaceError, printable
from ehlwave.surface.files.words import SHIFT_JIS_WORDS

SEPARATORS = (";", "\t", "|", ",", None)
FEWEST_ROWS = 3
"""Rows of numbers, one below the other, that are taken for a table."""

_LONGEST_CELL = 60
_NUMBER = re.compile(
    r"[-+]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eEdD][-+]?\d+)?$"
    r"|[-+]?\d{1,3}(?:,\d{3})+(?:\.\d*)?$|[-+]?\d{1,3}(?:\.\d{3})+(?:,\d*)?$"  # thousands
)
_DECIMAL_COMMA = re.compile(r"[-+]?\d*,\d+(?:[eEdD][-+]?\d+)?$|[-+]?\d+$")
MISSING = {
    *("nan", "+nan", "-nan", "bad", "n/a", "na", "#n/a", "null", "none", "invalid", "void"),
    *("1.#qnan", "-1.#ind", "1.#ind", "-1.#qnan", "missing", "inf", "-inf", "+inf", "infinity"),
}
DASHES = {"-", "--", "---", "----", "*", "**", "***", "****", "*****"}
"""Cells of heights that were not measured."""

_QUOTED_NUMBER = re.compile(r'"\s*[-+]?[\d.,]+(?:[eEdD][-+]?\d+)?\s*"')
_MARKS = tuple("#%!*/")
_EXPONENT = re.compile(r"(?<=[\d.])[dD](?=[-+]?\d)")


@dataclass
class Rows:
    """The block of numbers of a text.

    Attributes
    ----------
    above : list of str
        Lines above it, without marks of comments.
    body : list of str
        Its lines.
    separator : str or None
        Separator of cells; None: blanks.
    """

    above: list[str]
    body: list[str]
    separator: str | None


def rows_of(file: Path) -> Rows:
    """Return the block of numbers of a text file.

    The block begins with the first of three lines with equally many numbers, after any header.
    Empty lines, and lines within it that begin with ``#``, are skipped; text below it is left out.

    Raises SurfaceError if there is none.
    """
    lines = [line for line in re.split(r"\r\n|\r|\n", _text(file)) if line.strip(" \t\ufeff\x1a\0")]
    if not lines:
        raise SurfaceError(f"{file}: is empty")
    content = unquoted([_plain_signs(line) for line in lines])
    found = _first_numbers(content)
    if found is None:
        if any(map(is_number, re.split(r"[;,\t ]+", content[-1][:10_000].strip()))):
            raise SurfaceError(f"{file}: {_row_advice(content[-1])}")
        raise SurfaceError(
            f"{file}: holds no numbers; write positions and heights as two columns with headings "
            "such as x_um;z_um"
        )
    start, separator = found
    start = _with_missing(content, start, separator)
    above = [_without_mark(line) for line in content[:start]]
    body = [line for line in content[start:] if not line.lstrip().startswith("#")]
    while len(body) > 1 and not _is_cell(split(body[-1], separator)[0]):
        body.pop()  # the text below
    while separator is not None and len(body) > 1 and all(map(_ends(separator), body)):
        body = [line.rstrip(" ")[:-1] for line in body]  # separators end the rows
    return Rows(above, body, separator)


def split(line: str, separator: str | None) -> list[str]:
    """Return the cells of a line."""
    cells = line.strip(" ").split(separator) if separator else line.split()
    return [cell.strip().strip('"').strip() for cell in cells] or [""]


def is_number(cell: str) -> bool:
    """Return whether a cell is a number, whatever its decimals begin with."""
    return len(cell) <= _LONGEST_CELL and _NUMBER.match(cell) is not None


def is_missing(cell: str) -> bool:
    """Return whether a cell is a height that was not measured."""
    return len(cell) <= _LONGEST_CELL and (cell.lower() in MISSING or cell in DASHES)


def in_numerals(line: str, separator: str | None) -> str:
    """Return a line whose exponents begin with e, and whose missing heights are nan."""
    line = _EXPONENT.sub("e", line)
    cells = split(line, separator)
    if any(map(is_missing, cells)):
        gap = " " if separator is None else separator
        return gap.join("nan" if is_missing(cell) else cell for cell in cells)
    return line


def unquoted(lines: Sequence[str]) -> list[str]:
    """Return lines with quoted numbers without the quotes; others unchanged."""
    if not any('"' in line and _QUOTED_NUMBER.search(line) for line in lines):
        return list(lines)
    body = [line for line in lines if _QUOTED_NUMBER.search(line)]
    mark = next(
        (m for m in ";\t," if any(f'"{m}' in line or f'{m}"' in line for line in body)), ";"
    )
    cells = [next(csv.reader([line], delimiter=mark), []) for line in lines]
    has_commas = mark == "," and any(
        "," in cell for row in cells for cell in row if _NUMBER.match(cell)
    )
    return [(";" if has_commas else mark).join(row) for row in cells]


def utf16_order(head: bytes) -> str | None:
    """Return the order of bytes of a text in UTF-16 that begins so, without a mark; else None."""
    for low, order in ((0, "le"), (1, "be")):
        high = head[1 - low :: 2]
        if len(high) > 9 and high.count(0) > 0.8 * len(high):
            return None if any(head[low::2].count(byte) for byte in (0, 1, 2)) else order
    return None


def _text(file: Path) -> str:
    """Return the text of a file in UTF-8, UTF-16, Shift-JIS or Latin-1."""
    data = file.read_bytes()
    marked = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    if not marked and (order := utf16_order(data[:4096])):
        return data.decode(f"utf-16-{order}", errors="replace")
    for encoding in ("utf-16",) if marked else ("utf-8-sig",):
        with contextlib.suppress(UnicodeDecodeError):
            return data.decode(encoding)
    if marked:
        raise SurfaceError(f"{file}: begins as UTF-16 text and is none")
    with contextlib.suppress(UnicodeDecodeError):
        text = data.decode("cp932")
        if any(word in text for word in SHIFT_JIS_WORDS):
            return text
    return data.decode("latin-1")


def _plain_signs(line: str) -> str:
    """Return a line with ASCII signs and spaces."""
    if line.isascii():
        return line
    return (
        re.sub("\u2212|\u2013(?=[\\d.,])", "-", line)
        .replace("\u00a0", " ")
        .replace("\u202f", " ")
        .lstrip("\ufeff")
    )


def _without_mark(line: str) -> str:
    """Return a line without the mark of a comment."""
    bare = line.strip(" ")
    if not bare.startswith(_MARKS):
        return bare
    found = re.match(r"(?:[#%!*]+|//)(?=[ \t]|[^\W_]|[\[(\-])", bare)
    return bare if found is None else bare[found.end() :].strip(" ")


def _ends(separator: str) -> Callable[[str], bool]:
    """Return whether a line ends with a separator after another separator or a number."""
    return lambda line: line.rstrip(" ").endswith(separator)


def _is_cell(cell: str) -> bool:
    return not cell or is_number(cell) or is_missing(cell)


@lru_cache(maxsize=64)  # a line is counted for the lines above, too
def _count(line: str, separator: str | None) -> int:
    """Return how many numbers a line has, 0 if it has something else or none."""
    if separator is not None and separator not in line:
        return int(is_number(line.strip()))
    cells = split(line, separator)
    count = 0
    for cell in cells:
        if is_number(cell):
            count += 1
        elif cell and not is_missing(cell):
            return 0
    return len(cells) if count else 0


@lru_cache(maxsize=64)
def _cells(line: str, separator: str | None) -> int:
    """Return how many cells a line has, whatever they hold."""
    return len(line.split()) if separator is None else line.count(separator) + 1


@lru_cache(maxsize=64)
def _separator(line: str) -> str | None:
    """Return the separator of the numbers of a line."""
    for separator in SEPARATORS:
        if separator is not None and separator not in line:
            continue
        blank = line.split()
        if separator == "," and len(blank) > 1 and all(map(_DECIMAL_COMMA.match, blank)):
            continue
        return separator
    return None


def _first_numbers(lines: Sequence[str]) -> tuple[int, str | None] | None:
    """Return the line in which the numbers begin, and their separator."""
    first = None
    for start, line in enumerate(lines):
        head = line.lstrip(" \t;,|")[:1]
        if not (head.isdecimal() or head in "+-.nN*bB" or not head):
            continue
        separator = _separator(line)
        rows = lines[start + 1 : start + FEWEST_ROWS]
        cells = _cells(line, separator)
        is_uneven = any(_cells(row, separator) != cells for row in rows)
        if is_uneven and separator != "," and len(lines) - start > FEWEST_ROWS:
            continue
        count = _count(line, separator)
        if not count:
            continue
        names = split(lines[start - 1], ",") if start and separator == "," and count == 2 else ()
        if separator == "," and count == 2 and len(names) != 2:
            is_one = all(_count(row, None) == 1 for row in [line, *rows])
            if is_one and any("," not in row for row in rows):
                separator, count = None, 1  # '12' among '12,5'
        if all(_cells(row, separator) == count == _count(row, separator) for row in rows):
            if len(rows) == FEWEST_ROWS - 1:
                return start, separator
            first = first or (start, separator)
        elif first is None and len(lines) - start <= FEWEST_ROWS:
            first = start, separator
    return first


def _with_missing(lines: Sequence[str], start: int, separator: str | None) -> int:
    """Return the line in which the numbers begin, rows without any measured height included."""
    count = len(split(lines[start], separator))
    while start and count > 1:
        cells = split(lines[start - 1], separator)
        if len(cells) != count or not all(cell.lower() in MISSING or not cell for cell in cells):
            break
        start -= 1
    return start


def _row_advice(line: str) -> str:
    return (
        f"has no {FEWEST_ROWS} rows of as many numbers below each other; the last line is "
        f"'{printable(line.strip())[:60]}'"
    )
