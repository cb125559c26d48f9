"""Files of measured surfaces, format by format, as they are: CSV, NumPy, HDF5, instruments."""

import math
import zipfile
from pathlib import Path
from typing import IO, Any

import h5py
import numpy as np

from ehlwave.choices import Decimal
from ehlwave.errors import ResultsError, SurfaceError
from ehlwave.hdf5 import check_is_file, opened, reason
from ehlwave.surface.raw_surface import RawSurface, raw_instrument, refuse_large
from ehlwave.surface.surface import is_uniform
from ehlwave.surface.text_table import TextTable, position_and_height, read_text_table
from ehlwave.surface.units import METRES

_TEXT = {".csv", ".txt", ".dat", ".prf", ".asc", ".tsv"}
_HDF5 = {".h5", ".hdf5", ".nc"}

_OWN = {*_TEXT, *_HDF5, ".npy", ".npz"}
ARRAYS = ("height", "x", "y")


def raw_file(file: Path, decimal: Decimal | None) -> RawSurface:
    """Return what a file holds; `decimal` is what decimals of a text begin with, if it is said.

    Raises SurfaceError if the file cannot be read.
    """
    suffix = file.suffix.lower()
    try:
        check_is_file(file)
        if suffix in _TEXT:
            refuse_large(file, file.stat().st_size // 2)
            return _from_text(file, decimal)
        if suffix == ".npy":
            return RawSurface(numbers_of(file, np.load(file, mmap_mode="r", allow_pickle=False)))
        if suffix == ".npz":
            return _from_archive(file)
        if suffix in _HDF5:
            with opened(file) as inside:
                return _from_hdf5(file, inside)
        return raw_instrument(file)
    except SurfaceError:
        raise
    except ResultsError as error:
        raise SurfaceError(str(error)) from error
    except Exception as error:
        # The readers raise whatever a damaged file makes them stumble into.
        kind = f"as {suffix[1:]} " if suffix in _OWN else ""
        said = f"{type(error).__name__}: {reason(error)}"
        raise SurfaceError(f"{file}: cannot be read {kind}({said})") from error


def _from_archive(file: Path) -> RawSurface:
    """Return the arrays of an archive that are known, once their sizes are those of its data."""
    with zipfile.ZipFile(file) as archive:
        sizes = {entry.filename: entry.file_size for entry in archive.infolist()}
        for name in (f"{name}.npy" for name in ARRAYS):
            if name in sizes:
                refuse_large(file, sizes[name] // 8)
                with archive.open(name) as entry:
                    points = _claimed_points(entry)
                if points > sizes[name]:
                    raise SurfaceError(f"{file}: {name} claims {points} numbers it does not hold")
    with np.load(file, allow_pickle=False) as arrays:
        if "height" not in arrays:
            return _from_arrays(file, dict.fromkeys(arrays), {})
        return _from_arrays(file, {name: arrays[name] for name in ARRAYS if name in arrays}, {})


def _claimed_points(entry: IO[bytes]) -> int:
    """Return how many numbers the head of an array says that there are."""
    version = np.lib.format.read_magic(entry)
    if version == (1, 0):
        shape = np.lib.format.read_array_header_1_0(entry)[0]
    else:
        shape = np.lib.format.read_array_header_2_0(entry)[0]
    return math.prod(shape)


def _from_text(file: Path, decimal: Decimal | None) -> RawSurface:
    table = read_text_table(file, decimal)
    numbers, units = table.numbers, table.units
    stated = {"length_unit": table.length_unit, "height_unit": table.height_unit}
    if numbers.shape[1] == 1:
        height_unit = units[0] or table.height_unit
        return RawSurface(
            numbers[:, 0],
            length_unit=table.length_unit,
            height_unit=height_unit,
            step=table.step,
            has_decimal_commas=table.has_decimal_commas,
        )
    columns = position_and_height(table)
    if columns is None and numbers.shape[1] == 2:
        columns = 0, 1
        if not is_uniform(numbers[:, 0]) and is_uniform(numbers[:, 1]):
            raise SurfaceError(
                f"{file}: positions are not equidistant in its first column but in its second: if "
                "they are swapped, put headings above them, such as z;x"
            )
    if columns is not None:
        x, z = columns
        return RawSurface(
            numbers[:, z],
            x=numbers[:, x],
            length_unit=units[x] or stated["length_unit"],
            height_unit=units[z] or stated["height_unit"],
        )
    return _stated_map(table)


def _stated_map(table: TextTable) -> RawSurface:
    """Return a matrix of heights with the steps that its preamble states."""
    raw = RawSurface(table.numbers, height_unit=table.height_unit, length_unit=table.length_unit)
    raw.step = table.step
    if set(table.extent) == {"width", "height"}:
        rows, columns = table.numbers.shape
        (width, unit), (across, unit_across) = table.extent["width"], table.extent["height"]
        raw.step, raw.length_unit = width / columns, unit
        raw.step_across = across / rows * METRES[unit_across] / METRES[unit]
    return raw


def _from_arrays(file: Path, arrays: dict[str, Any], units: dict[str, str]) -> RawSurface:
    if "height" not in arrays:
        there = ", ".join(sorted(arrays)) or "nothing"
        raise SurfaceError(f"{file}: has no array named height (there is: {there})")
    length = units.get("x") or units.get("y")
    return RawSurface(
        numbers_of(file, arrays["height"]),
        arrays.get("x"),
        arrays.get("y"),
        length,
        units.get("height"),
    )


def _from_hdf5(file: Path, inside: h5py.File) -> RawSurface:
    arrays, units = {}, {}
    for name in ARRAYS:
        if name in inside:
            refuse_large(file, inside[name].size)
            arrays[name] = inside[name][()]
            unit = inside[name].attrs.get("units", "")
            units[name] = unit.decode() if isinstance(unit, bytes) else str(unit)
    if not arrays:
        arrays = {name: None for name in inside if name != "height"}
    raw = _from_arrays(file, arrays, {name: unit for name, unit in units.items() if unit})
    # Files of `ehlwave deform` hold (x, y): dimension scales say which is which.
    if raw.height.ndim == 2 and "x" in inside["height"].dims[0].keys():  # noqa: SIM118
        raw.height = raw.height.T
    return raw


def numbers_of(file: Path, values: Any) -> np.ndarray:  # noqa: ANN401
    """Return an array of real numbers, SurfaceError if it is none."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise SurfaceError(f"{file}: holds {array.dtype} where real numbers are expected")
    return array
