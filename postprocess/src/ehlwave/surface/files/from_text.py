"""Surfaces from tables of numbers: a trace, a map, or points of a map."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from ehlwave.choices import Decimal
from ehlwave.errors import SurfaceError
from ehlwave.surface.files.columns import chosen_columns
from ehlwave.surface.files.places import Numbers, Places, grid, placed, straight
from ehlwave.surface.files.text_table import TextTable, read_text_table
from ehlwave.surface.raw_surface import RawSurface
from ehlwave.surface.surface import is_uniform
from ehlwave.surface.units import metres

FEWEST_OF_MAP = 8
"""Columns of a matrix of heights; fewer columns need headings."""


def raw_text(file: Path, decimal: Decimal | None, channel: str | None = None) -> RawSurface:
    """Return the surface of a text file; `decimal` and `channel` are choices of the user.

    Raises SurfaceError if the file cannot be read, or can be read in two ways.
    """
    table = read_text_table(file, decimal)
    raw = _raw(file, table, channel)
    return replace(
        raw,
        has_decimal_commas=table.has_decimal_commas,
        notes=[*table.notes, *raw.notes],
    )


def _raw(file: Path, table: TextTable, channel: str | None) -> RawSurface:
    columns = table.numbers.shape[1]
    if columns == 1 and channel is None:
        return _one_column(file, table)
    chosen = chosen_columns(file, table.headings, channel)
    if chosen is not None:
        raw = _of_columns(file, table, chosen.positions, chosen.height)
        return replace(raw, notes=[chosen.note, *raw.notes])
    if channel is not None:
        raise SurfaceError(f"{file}: has no headings, and channel={channel!r} names one")
    if columns == 2:
        first, second = table.numbers.T
        if not is_uniform(first) and is_uniform(second):
            raise SurfaceError(
                f"{file}: positions are not equidistant in its first column but in its second: if "
                "they are swapped, put headings above them, such as z;x"
            )
        return _of_columns(file, table, (0,), 1)
    if columns == 3:
        x, y, z = table.numbers.T
        found = grid(x, y, z) or straight(x, y, z, is_oblique=False)
        if found is not None:
            return _of_places(table, found, table.stated.length_unit, table.stated.height_unit)
    if columns < FEWEST_OF_MAP:
        raise SurfaceError(
            f"{file}: has {columns} columns, and headings do not say which are positions and "
            "heights: put headings above them, such as x_um;z_um, or x_um;y_um;z_um"
        )
    return _matrix(file, table)


def _one_column(file: Path, table: TextTable) -> RawSurface:
    heading = table.headings[0] if table.headings else None
    if heading is not None and heading.role in ("x", "other"):
        raise SurfaceError(
            f"{file}: its only column, {heading.text!r}, holds no heights: put a heading such as "
            "z [um] above it if it does"
        )
    own = None if heading is None else heading.unit
    height = table.numbers[:, 0]
    return _with_step(RawSurface(height, height_unit=own or table.stated.height_unit), table)


def _of_columns(
    file: Path, table: TextTable, positions: tuple[int, ...], height: int
) -> RawSurface:
    """Return heights over one or two columns of positions, or none."""
    units = [one.unit for one in table.headings] or [None] * table.numbers.shape[1]
    z, height_unit = table.numbers[:, height], units[height] or table.stated.height_unit
    if not positions:
        return _with_step(RawSurface(z, height_unit=height_unit), table)
    length_unit = next((units[k] for k in positions if units[k]), table.stated.length_unit)
    if len(positions) == 1:
        x = table.numbers[:, positions[0]]
        return RawSurface(z, x=x, length_unit=length_unit, height_unit=height_unit)
    scaled = [
        table.numbers[:, k] * _ratio(file, units[k] or length_unit, length_unit) for k in positions
    ]
    return _of_places(table, placed(file, scaled[0], scaled[1], z), length_unit, height_unit)


def _ratio(file: Path, unit: str | None, other: str | None) -> float:
    if unit is None or other is None or unit == other:
        return 1.0
    return metres(unit, str(file)) / metres(other, str(file))


def _of_places(
    table: TextTable, found: Places, length_unit: str | None, height_unit: str | None
) -> RawSurface:
    return RawSurface(
        found.height,
        x=found.x,
        y=found.y,
        length_unit=length_unit,
        height_unit=height_unit,
        notes=[found.note],
    )


def _with_step(raw: RawSurface, table: TextTable) -> RawSurface:
    """Return heights with the step that the file states."""
    step, unit = table.stated.step or (None, None)
    return replace(raw, step=step, length_unit=unit or table.stated.length_unit)


def _matrix(file: Path, table: TextTable) -> RawSurface:
    """Return a matrix of heights with the steps or positions that the file has for it."""
    stated, numbers = table.stated, table.numbers
    raw = RawSurface(numbers, height_unit=stated.height_unit, length_unit=stated.length_unit)
    if table.across is not None:
        if not is_uniform(table.across) or not is_uniform(numbers[:, 0]):
            raise SurfaceError(
                f"{file}: numbers stand above the columns of its matrix, and they, or the first "
                "column, are not equidistant positions: remove them"
            )
        return replace(raw, height=numbers[:, 1:], x=table.across, y=numbers[:, 0])
    framed = _framed(file, raw)
    if framed is not None:
        return framed
    if set(stated.extent) == {"width", "height"}:
        rows, columns = numbers.shape
        (width, unit), (across, unit_across) = stated.extent["width"], stated.extent["height"]
        raw.step, raw.length_unit = width / columns, unit
        raw.step_across = across / rows * _ratio(file, unit_across, unit)
        return raw
    raw = _with_step(raw, table)
    if raw.step is not None and stated.step_across is not None:
        value, unit = stated.step_across
        raw.step_across = value * _ratio(file, unit, raw.length_unit)
    return raw


def _framed(file: Path, raw: RawSurface) -> RawSurface | None:
    """Return a matrix whose first row and column are positions; None if neither is.

    Raises SurfaceError if only one of them seems to be.
    """
    numbers = raw.height
    row = _is_frame(numbers[0, 1:], numbers[1:, 1:])
    column = _is_frame(numbers[1:, 0], numbers[1:, 1:].T)
    if row and column:
        return replace(raw, height=numbers[1:, 1:], x=numbers[0, 1:], y=numbers[1:, 0])
    whole_row, whole_column = (
        _is_frame(numbers[0], numbers[1:]),
        _is_frame(numbers[:, 0], numbers[:, 1:].T),
    )
    if whole_row or whole_column:
        name = "row" if whole_row else "column"
        raise SurfaceError(
            f"{file}: the first {name} of its matrix rises in equal steps, as positions do: remove "
            f"it if it holds none of the heights"
        )
    return None


def _is_frame(edge: Numbers, inside: Numbers) -> bool:
    """Return whether an edge of a matrix rises in equal steps, unlike the lines beside it."""
    if edge.size < FEWEST_OF_MAP or not np.all(np.isfinite(edge)):
        return False
    steps = np.diff(edge)
    if steps[0] == 0 or np.ptp(steps) > 2e-2 * abs(steps[0]):
        return False
    beside = np.diff(inside[: min(4, len(inside))], axis=1)
    spread = np.ptp(beside, axis=1)
    return bool(np.nanmax(spread, initial=0) > 2e-2 * np.nanmean(np.abs(beside)))
