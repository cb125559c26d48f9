"""Read measured surfaces: CSV, NumPy, HDF5, and the formats of instruments."""

from dataclasses import fields, replace
from pathlib import Path

import numpy as np

from ehlwave.errors import SurfaceError, printable
from ehlwave.surface.files.by_content import raw_file
from ehlwave.surface.outliers import Gaps, without_gaps
from ehlwave.surface.raw_surface import (
    METRE,
    RawSurface,
    SurfaceSource,
    is_topography,
    raw_array,
    raw_topography,
)
from ehlwave.surface.read_options import ReadOptions
from ehlwave.surface.steps import height_unit, steps
from ehlwave.surface.surface import (
    Surface,
    map_surface,
    trace_surface,
)


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
    height_metres = height_unit(file, raw, said.height_unit)
    # A single copy, without a double-precision copy of a large single-precision map.
    kind = raw.height.dtype if raw.height.dtype == np.float32 else np.float64
    height = np.array(raw.height, dtype=kind)
    place = str(file)
    gaps = Gaps(fill=said.fill_missing, unit=said.height_unit or raw.height_unit or "")
    height, notes = without_gaps(place, height, gaps)
    height *= height_metres
    along, across = steps(file, raw, said)
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
