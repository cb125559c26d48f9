"""Files of measured surfaces, read by their content: text, NumPy, HDF5, instruments."""

import math
import zipfile
from pathlib import Path
from typing import IO, Any

import h5py
import numpy as np

from ehlwave.choices import Decimal
from ehlwave.errors import ResultsError, SurfaceError
from ehlwave.hdf5 import check_is_file, opened, reason
from ehlwave.surface.files.from_text import raw_text
from ehlwave.surface.files.instruments import ENDINGS, is_instrument_text, raw_instrument
from ehlwave.surface.files.rows import utf16_order
from ehlwave.surface.raw_surface import RawSurface, numbers_of, refuse_large

_OWN = {".csv", ".txt", ".asc", ".tsv", ".prf", ".h5", ".hdf5", ".nc", ".npy", ".npz"}
ARRAYS = ("height", "x", "y")
_HEAD = 4096
"""Bytes that distinguish text from other data."""


def raw_file(file: Path, decimal: Decimal | None, channel: str | None = None) -> RawSurface:
    """Return the content of a file.

    Parameters
    ----------
    file : path
        Its content decides how it is read, not its ending.
    decimal : {"point", "comma"} or None
        Decimal mark of a text, if given.
    channel : str or None
        The channel or column of heights, if given.

    Raises
    ------
    SurfaceError
        If the file cannot be read.
    """
    suffix = file.suffix.lower()
    try:
        check_is_file(file)
        with file.open("rb") as opened_file:
            head = opened_file.read(_HEAD)
        if head.startswith(b"\x93NUMPY") or suffix == ".npy":
            return RawSurface(numbers_of(file, np.load(file, mmap_mode="r", allow_pickle=False)))
        if suffix == ".npz":
            return _from_archive(file)
        if h5py.is_hdf5(file) or (suffix in (".h5", ".hdf5") and not _is_text(head)):
            with opened(file) as inside:
                if any(name in inside for name in ARRAYS) or suffix in (".h5", ".hdf5"):
                    return _from_hdf5(file, inside)
        elif suffix in (".h5", ".hdf5"):
            with opened(file):
                pass  # which refuses it
        elif _is_text(head) and suffix not in ENDINGS and not is_instrument_text(head):
            refuse_large(file, file.stat().st_size // 2)
            return raw_text(file, decimal, channel)
        return raw_instrument(file, head, channel)
    except SurfaceError:
        raise
    except ResultsError as error:
        raise SurfaceError(str(error)) from error
    except Exception as error:
        # The readers raise whatever a damaged file makes them stumble into.
        kind = f"as {suffix[1:]} " if suffix in _OWN else ""
        said = f"{type(error).__name__}: {reason(error)}"
        raise SurfaceError(f"{file}: cannot be read {kind}({said})") from error


def _is_text(head: bytes) -> bool:
    """Return whether a file that begins so is text, in UTF-16 or in an encoding of bytes."""
    if head.startswith((b"\xff\xfe", b"\xfe\xff")) or not head:
        return True
    if utf16_order(head):
        return True
    return not any(head.count(byte) for byte in (*range(9), *range(14, 26), 27))


def _from_archive(file: Path) -> RawSurface:
    """Return the known arrays of an archive, after a check of their sizes."""
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
    """Return the number of values that the head of an array declares."""
    version = np.lib.format.read_magic(entry)
    if version == (1, 0):
        shape = np.lib.format.read_array_header_1_0(entry)[0]
    else:
        shape = np.lib.format.read_array_header_2_0(entry)[0]
    return math.prod(shape)


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
    # Files of `ehlwave deform` hold (x, y): dimension scales identify them.
    if raw.height.ndim == 2 and "x" in inside["height"].dims[0].keys():  # noqa: SIM118
        raw.height = raw.height.T
    return raw
