"""The meaning of commas in a text table: columns, decimals or thousands.

``-14,0`` is a position and a height, or a single height; ``1,234`` is slightly above 1, or above
1000. The table itself decides where it can; otherwise an error names both readings, and
``--decimal`` decides.
"""

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ehlwave.choices import Decimal
from ehlwave.errors import SurfaceError, printable

_PAIR = re.compile(r"([-+]?\d+)\s*,\s*(\d+)$")
_WHOLE = re.compile(r"[-+]?\d+$")
_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2}(,\d{3})+$")
_SMALL = re.compile(r"[-+]?\d{1,3}$")


def settled(
    file: Path, body: Sequence[str], separator: str | None, names: int, decimal: Decimal | None
) -> tuple[list[str], str | None, bool]:
    """Return lines with decimal points, the separator of their numbers, and whether it was commas.

    Parameters
    ----------
    file : path
        Begins every message.
    body : sequence of str
        The lines with numbers.
    separator : str or None
        Apparent separator; None: blanks.
    names : int
        Headings above them, as many as commas separate; 0 if there are none.
    decimal : {"point", "comma"} or None
        Choice of the user.

    Raises
    ------
    SurfaceError
        If there are two readings and the user chose none.
    """
    has_points = any("." in line for line in body)
    if not any("," in line for line in body) and not (decimal == "comma" and has_points):
        return list(body), separator, False
    if separator == "," and names < 2 and _is_one_column_of_thousands(body):
        separator = None
    if separator == ",":
        if _is_decimal(file, body, names, decimal):
            return [_joined(file, line) for line in body], ",", True
        return list(body), ",", False
    return [*_without_commas(file, body, separator, decimal)], separator, True


def _is_decimal(file: Path, body: Sequence[str], names: int, decimal: Decimal | None) -> bool:
    """Return whether each second comma of a table separated by commas is a decimal comma."""
    if decimal is not None:
        return decimal == "comma"
    if any("." in line for line in body):
        return False
    rows = [[cell.strip() for cell in line.split(",")] for line in body]
    count = max(map(len, rows))
    if names == count:
        return False
    one_column = all(_PAIR.match(line.strip()) or _WHOLE.match(line.strip()) for line in body)
    if one_column and min(map(len, rows)) < count:
        return True  # '12' among '12,5'
    if count % 2 or not all(len(row) == count for row in rows):
        return False
    if not all(_WHOLE.match(cell) and cell[0] not in "+-" for row in rows for cell in row[1::2]):
        return False
    if not all(_WHOLE.match(cell) for row in rows for cell in row[::2]):
        return False
    if count == 2:
        if not _is_equidistant([int(row[0]) for row in rows]):
            return True
    elif names != count // 2 and not _looks_like_decimals(rows):
        return False
    first = ",".join(rows[0][:2])
    columns = "a position and a height" if count == 2 else f"two of {count} heights in a row"
    raise SurfaceError(
        f"{file}: its numbers can be read in two ways: '{first}' is {columns}, or one number "
        f"({first.replace(',', '.')}): say which: decimal='point' (commas separate columns) or "
        "decimal='comma'"
    )


def _is_one_column_of_thousands(body: Sequence[str]) -> bool:
    """Return whether all lines are numbers with marks of thousands, none a position and height."""
    cells = [line.strip() for line in body]
    if not all(_THOUSANDS.match(cell) or _SMALL.match(cell) for cell in cells):
        return False
    pairs = [cell.split(",") for cell in cells]
    is_pair = all(len(pair) == 2 for pair in pairs)
    return not (is_pair and _is_equidistant([int(pair[0]) for pair in pairs]))


def _is_equidistant(positions: Sequence[int]) -> bool:
    steps = np.unique(np.diff(np.array(positions, dtype=float)))
    return len(positions) < 2 or (steps.size == 1 and steps[0] != 0)


def _looks_like_decimals(rows: Sequence[Sequence[str]]) -> bool:
    """Return whether every second number has as many digits, unlike those between them."""
    seconds = {len(cell) for row in rows for cell in row[1::2]}
    firsts = [cell for row in rows for cell in row[::2]]
    if len(seconds) != 1:
        return False
    digits = seconds.pop()
    if digits > 1:
        return any(cell[0] == "0" for row in rows for cell in row[1::2])
    return any(cell[0] in "+-" or len(cell) != digits for cell in firsts)


def _joined(file: Path, line: str) -> str:
    """Return a line separated by commas with each pair of its cells as a number."""
    cells = [cell.strip() for cell in line.split(",")]
    if len(cells) == 1:
        return cells[0]
    if len(cells) % 2:
        raise SurfaceError(
            f"{file}: '{printable(line.strip())[:60]}' has {len(cells)} parts between commas, "
            "which are not pairs about decimal commas: separate columns by semicolons"
        )
    return ",".join(f"{a}.{b}" for a, b in zip(cells[::2], cells[1::2], strict=True))


def _without_commas(
    file: Path, body: Sequence[str], separator: str | None, decimal: Decimal | None
) -> list[str]:
    """Return lines, whose columns are not separated by commas, with decimal points."""
    if decimal is not None:
        return [_as_said(file, line, separator, decimal) for line in body]
    cells = [cell.strip() for line in body for cell in line.split(separator) if "," in cell]
    if any("." in line for line in body):
        raise SurfaceError(
            f"{file}: has points and commas in its numbers, as in '{printable(cells[0])[:40]}': "
            "say decimal='point' (commas between thousands) or decimal='comma' (points "
            "between them)"
        )
    if all(_THOUSANDS.match(cell) for cell in cells):
        raise SurfaceError(
            f"{file}: '{cells[0]}' is {cells[0].replace(',', '.')}, or "
            f"{cells[0].replace(',', '')} with a comma between thousands: say which: "
            "decimal='comma' or decimal='point'"
        )
    return [line.replace(",", ".") for line in body]


def _as_said(file: Path, line: str, separator: str | None, decimal: Decimal) -> str:
    """Return a line without its marks between thousands, with decimal points."""
    between, mark = (",", ".") if decimal == "point" else (".", ",")
    grouped = re.compile(rf"[-+]?\d{{1,3}}({re.escape(between)}\d{{3}})+({re.escape(mark)}\d*)?$")
    for cell in line.split(separator):
        if between in cell and not grouped.match(cell.strip()):
            raise SurfaceError(
                f"{file}: '{printable(cell.strip())[:40]}' is no number with a decimal {decimal}: "
                f"decimal='{decimal}' contradicts the file"
            )
    return line.replace(between, "").replace(mark, ".")
