"""Read measured surfaces: CSV, NumPy, HDF5, and the formats of instruments."""

from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from ehlwave.choices import AXES, DECIMALS, Axis, Decimal, chosen
from ehlwave.errors import SurfaceError, printable
from ehlwave.quantities import is_quantity, number
from ehlwave.surface.files.by_content import raw_file
from ehlwave.surface.outliers import Gaps, without_gaps
from ehlwave.surface.raw_surface import (
    METRE,
    RawSurface,
    SurfaceSource,
    is_topography,
    numbers_of,
    raw_array,
    raw_topography,
)
from ehlwave.surface.surface import (
    Surface,
    map_surface,
    trace_surface,
    uniform_step,
)
from ehlwave.surface.units import metres

LARGEST_STEP_DIFFERENCE = 1e-3
"""Relative, between a given step and the file's."""

LONGEST_M, LONGEST_STEP_M, SMALLEST_STEP_M = 10.0, 0.01, 1e-12
"""Lengths that no measured surface exceeds, and the step that none falls below."""


@dataclass(frozen=True)
class ReadOptions:
    """Units and steps that a file does not state.

    Attributes
    ----------
    length_unit, height_unit : str or None
        Units of positions and steps, and of heights, where the file states none; a unit that
        contradicts the file is refused. With a `step`, ``length_unit`` is the unit of the step.
    step, step_across : float or None
        Sampling steps along the first and second axis of the file, in ``length_unit``, for files
        without positions; ``step_across`` is ``step`` if absent.
    rolling_axis : "x" or "y"
        Of the surface in the file. The rows of a map in a file are lines of constant y: ``x`` runs
        along a row. A trace along rolling is ``x``, a trace across it ``y``.
    fill_missing : bool
        Replace missing heights, and heights far outside all others, by their nearest neighbours:
        at most a tenth of them. The notes of the surface state their number.
    decimal : "point", "comma" or None
        Decimal mark of a text file, where the file does not decide it.
    channel : str or None
        The channel, or the heading of the column, of heights, where the file has several.
    """

    length_unit: str | None = None
    height_unit: str | None = None
    step: float | None = None
    step_across: float | None = None
    rolling_axis: Axis = "x"
    fill_missing: bool = False
    decimal: Decimal | None = None
    channel: str | None = None

    def __post_init__(self) -> None:
        """Check the words."""
        chosen(self.rolling_axis, "rolling_axis", AXES)
        if self.decimal is not None:
            chosen(self.decimal, "decimal", DECIMALS)


def read_surface(path: SurfaceSource | Surface, options: ReadOptions | None = None) -> Surface:
    """Read a trace or a map.

    Parameters
    ----------
    path : path, array, topography or Surface
        Text: numbers separated by commas, semicolons, tabs or blanks; columns of positions and
        heights by their headings, two columns (position, height), points x, y, z of a grid, a
        column of heights, or a matrix of heights. ``.npy``: one or two dimensions; ``.npz`` and
        HDF5: ``height`` and, if there, positions ``x`` and ``y``, in HDF5 with an attribute
        ``units``. Anything else (SDF, SUR, PLU, X3P, ...) is read by the package SurfaceTopography
        when that is installed. The content of a file decides, not its ending. Or an array, taken as
        in a ``.npy`` file but in metres by default, with the step in `options`; an object of
        SurfaceTopography; or a Surface, which is returned as it is and takes no options.
    options : ReadOptions, optional
        Data that the file lacks.

    Returns
    -------
    Surface
        In metres, rolling direction first.

    Raises
    ------
    SurfaceError
        If the file cannot be read, a unit or step is missing, steps are not uniform, or heights
        are missing.

    Examples
    --------
    A trace of two columns, position in mm and height in um:

    >>> import numpy as np
    >>> import ehlwave
    >>> x = np.arange(0, 2, 0.002)
    >>> height = 0.05 * np.cos(2 * np.pi * x / 0.1)
    >>> np.savetxt("trace.csv", np.column_stack([x, height]), delimiter=",")
    >>> units = ehlwave.surface.ReadOptions(length_unit="mm", height_unit="um")
    >>> trace = ehlwave.read_surface("trace.csv", units)
    >>> trace.is_trace, trace.height.shape
    (True, (1000, 1))

    The same from an array:

    >>> units = ehlwave.surface.ReadOptions(length_unit="mm", height_unit="um", step=0.002)
    >>> again = ehlwave.read_surface(height, units)
    >>> bool(np.allclose(again.height, trace.height, rtol=0, atol=1e-15))
    True
    """
    said = options or ReadOptions()
    if isinstance(path, Surface):
        _refuse_options(path, said)
        return path
    file, found = _found(path, said)
    raw = _without_single_line(found, file, said)
    if raw.height.ndim not in (1, 2):
        raise SurfaceError(f"{file}: heights have {raw.height.ndim} dimensions, not one or two")
    height_metres = _height_unit(file, raw, said.height_unit)
    # A single copy, without a double-precision copy of a large single-precision map.
    kind = raw.height.dtype if raw.height.dtype == np.float32 else np.float64
    height = np.array(raw.height, dtype=kind)
    place = str(file)
    gaps = Gaps(fill=said.fill_missing, unit=said.height_unit or raw.height_unit or "")
    height, notes = without_gaps(place, height, gaps)
    height *= height_metres
    along, across = _steps(file, raw, said)
    name = printable(file.name)
    if height.ndim == 1:
        axis = "y" if raw.is_across else said.rolling_axis
        surface = trace_surface(height, along, axis, name)
    elif said.rolling_axis == "x":
        surface = map_surface(height.T, along, across, name)
    else:
        surface = map_surface(height, across, along, name)
    return replace(surface, notes=tuple(filter(None, [*raw.notes, *notes])))


def _refuse_options(surface: Surface, options: ReadOptions) -> None:
    """Raise SurfaceError if there are options for a surface that has units, steps and axes."""
    for field in fields(options):
        if getattr(options, field.name) is not field.default:
            raise SurfaceError(
                f"{surface.name}: {field.name}= is for files and arrays, and a Surface has its "
                f"own: remove {field.name}=, or give the heights as an array"
            )


def _found(source: SurfaceSource, options: ReadOptions) -> tuple[Path, RawSurface]:
    """Return the content of a source, and its name for messages."""
    if isinstance(source, (str, Path)):
        return Path(source), raw_file(Path(source), options.decimal, options.channel)
    if is_topography(source):
        place = Path(str(getattr(source, "info", {}).get("name", "topography")))
        return place, raw_topography(source, place)
    place = Path("array")
    raw = raw_array(np.ma.asarray(source), place)
    raw.length_unit = METRE if options.length_unit is None else None
    raw.height_unit = METRE if options.height_unit is None else None
    return place, raw


def _without_single_line(raw: RawSurface, file: Path, options: ReadOptions) -> RawSurface:
    """Return a map of one row or one column as a trace.

    Raises SurfaceError for a column without positions or a step along it: nothing states whether
    the trace was measured along or across rolling.
    """
    if raw.height.ndim != 2 or 1 not in raw.height.shape:
        return raw
    if raw.height.shape[0] == 1:
        return replace(raw, height=raw.height.ravel(), y=None)
    if raw.y is None and raw.step_across is None and options.step_across is None:
        raise SurfaceError(
            f"{file}: heights of shape {raw.height.shape} are one column of unknown direction: "
            "give them one-dimensional (heights[:, 0]), with rolling_axis='x' for a trace along "
            "rolling, 'y' for one across"
        )
    return replace(
        raw, height=raw.height.ravel(), x=raw.y, y=None, step=raw.step_across, is_across=True
    )


def _height_unit(file: Path, raw: RawSurface, said: str | None) -> float:
    """Return the unit of heights, m: the file's, or the user's where it has none."""
    value = _unit(file, _first(raw.height_unit, said), "heights", "height_unit=")
    if said is None or raw.height_unit is None:
        return value
    given = metres(said, str(file))
    largest = float(np.nanmax(np.abs(raw.height), initial=0)) * value
    if given != value and largest > LONGEST_M:
        return given  # no surface is as high as the file states
    _refuse_contradiction(file, "height_unit=", said, given, raw.height_unit, value)
    return value


def _refuse_contradiction(
    file: Path, option: str, said: str, given: float, own: str, value: float
) -> None:
    if given != value:
        raise SurfaceError(
            f"{file}: {option}{said} contradicts the file, whose unit is {own}: leave it out"
        )


def _steps(file: Path, raw: RawSurface, options: ReadOptions) -> tuple[float, float]:
    """Return the steps along x and y of the file, m."""
    length = _unit(file, _first(options.length_unit, raw.length_unit), "lengths", "length_unit=")
    own = length if raw.length_unit is None else metres(raw.length_unit, str(file))
    step, across = raw.step, raw.step_across
    if raw.x is not None:
        step = uniform_step(_positions(file, raw.x, raw.height.shape[-1], "x"), f"{file}: x")
    if raw.y is not None and raw.height.ndim == 2:
        across = uniform_step(_positions(file, raw.y, raw.height.shape[0], "y"), f"{file}: y")
    step, across = (None if value is None else value * own / length for value in (step, across))
    said = _said(file, "step", options.step, length)
    said_across = _said(file, "step_across", options.step_across, length)
    if raw.height.ndim == 1 and said_across is not None:
        if not raw.is_across:
            raise SurfaceError(
                f"{file}: step_across={options.step_across} is of a map, and this is a trace: "
                "remove it"
            )
        said, said_across = said_across, None
    if said is None and said_across is None and options.length_unit is not None and raw.length_unit:
        _refuse_contradiction(
            file, "length_unit=", options.length_unit, length, raw.length_unit, own
        )
    if _is_impossible(raw, step, across, length):
        if said is None:
            size = f"a step of {(step or 0) * length * 1e6:.4g} um"
            raise SurfaceError(
                f"{file}: states {size} over {raw.height.shape[-1]} points, a size that no surface "
                "has: give the right step by step= and length_unit=, which replace it"
            )
        step = across = None
    step = _agreed(file, "step=", said, step)
    across = _agreed(file, "step_across=", said_across, across)
    if step is None:
        hint = "; commas were taken as decimal ones" if raw.has_decimal_commas else ""
        raise SurfaceError(f"{file}: has no positions: give the sampling step by step={hint}")
    return step * length, (step if across is None else across) * length


def _is_impossible(
    raw: RawSurface, step: float | None, across: float | None, length: float
) -> bool:
    """Return whether the file states a size that no surface has."""
    counts = raw.height.shape[::-1]
    return any(
        value is not None
        and not (
            SMALLEST_STEP_M <= value * length <= LONGEST_STEP_M
            and value * length * count <= LONGEST_M
        )
        for value, count in zip((step, across), counts, strict=False)
    )


def _said(file: Path, name: str, step: Any, length: float) -> float | None:  # noqa: ANN401
    """Return a step given by the user, in the unit of lengths, m, where it has none itself."""
    if is_quantity(step):
        return number(step, f"{name}_m", str(file)) / length
    return None if step is None else number(step, name, str(file))


def _agreed(file: Path, option: str, said: float | None, own: float | None) -> float | None:
    """Return the step from the user or the file; both only where they agree."""
    if said is None or own is None:
        return own if said is None else said
    if not abs(said - own) <= LARGEST_STEP_DIFFERENCE * abs(own):
        raise SurfaceError(
            f"{file}: {option}{said:g} contradicts the file, whose step is {own:.6g}: leave it "
            "out, or give a file of the heights alone"
        )
    return own


def _positions(file: Path, positions: np.ndarray, count: int, name: str) -> np.ndarray:
    values = numbers_of(file, positions).astype(np.float64)
    if values.shape != (count,):
        raise SurfaceError(
            f"{file}: {values.size} positions along {name} for {count} heights; they must match"
        )
    return values


def _first(said: str | None, own: str | None) -> str | None:
    return own if said is None else said


def _unit(file: Path, unit: str | None, what: str, option: str) -> float:
    if unit is None:
        raise SurfaceError(f"{file}: states no unit of its {what}: set {option} (m, mm, um, nm)")
    return metres(unit, str(file))
