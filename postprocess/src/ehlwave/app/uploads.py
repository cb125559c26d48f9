"""Traces and maps that a browser sends: sizes are limited, names are not trusted."""

import tempfile
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any

import h5py

from ehlwave.errors import ResultsError, SurfaceError, printable
from ehlwave.hdf5 import opened
from ehlwave.laws.table import HarmonicTable
from ehlwave.laws.table_read import read_table
from ehlwave.surface.read import ReadOptions, read_surface
from ehlwave.surface.surface import Surface
from ehlwave.writing import Writer

LARGEST_MB = 16
LARGEST_BYTES = LARGEST_MB * 10**6
"""Limit of a file."""

UNPACKED_MB = 64
"""Limit of the content of a packed file."""

MOST_POINTS = 2**22
"""Limit of a surface on the page; the command line takes larger surfaces."""

LONGEST_NAME = 100


@dataclass(frozen=True)
class Upload:
    """A file as the browser sent it."""

    name: str
    data: bytes = b""


def file_name(name: str) -> str:
    """Return the last part of a name, as a safe file name."""
    last = PurePosixPath(printable(name).replace("\\", "/")).name
    return last.lstrip(".")[-LONGEST_NAME:].lstrip() or "trace"


def read_upload(upload: Upload, options: ReadOptions) -> Surface:
    """Return the surface of a file, by the reader of the command line, from a private folder.

    Raises SurfaceError as :func:`ehlwave.read_surface`; or the file is too large for the page.
    """
    name = file_name(upload.name)
    surface: Surface = _read(upload, lambda path: read_surface(path, options))
    if surface.height.size > MOST_POINTS:
        raise SurfaceError(
            f"{name}: {surface.height.size} points, more than the {MOST_POINTS} that the page "
            "takes: use the command, ehlwave deform"
        )
    return surface


def read_table_upload(upload: Upload) -> HarmonicTable:
    """Return the harmonic table of a file, by the reader of the command line.

    Raises SurfaceError as :func:`ehlwave.surface.read_table`; or the file is too large.
    """
    return HarmonicTable(_read(upload, read_table), file_name(upload.name))


def _read(upload: Upload, reader: Callable[[Path], Any]) -> Any:  # noqa: ANN401 - of any reader
    """Return the contents of a file, by a reader of the command line, from a private folder."""
    name = file_name(upload.name)
    if len(upload.data) > LARGEST_BYTES:
        raise SurfaceError(f"{name}: {too_large(len(upload.data))}")
    with tempfile.TemporaryDirectory(prefix="ehlwave-app-") as folder:
        path = Writer().data(Path(folder) / name, upload.data)
        try:
            _refuse_unpacked(path)
            return reader(path)
        except ResultsError as error:
            # The command line also shows the given name.
            raise SurfaceError(str(error).replace(f"{folder}/", "")) from None


def too_large(size: int, most_mb: int = LARGEST_MB) -> str:
    """Return why a file of this size, in bytes, is refused."""
    return (
        f"{size / 1e6:.1f} MB, more than the {most_mb} MB that the page takes: cut the surface "
        "or use the command, ehlwave deform"
    )


def _refuse_unpacked(path: Path) -> None:
    size = 0
    if zipfile.is_zipfile(path):
        with zipfile.ZipFile(path) as archive:
            size = sum(entry.file_size for entry in archive.infolist())
    elif h5py.is_hdf5(path):
        with opened(path) as inside:
            size = sum(item.nbytes for item in inside.values() if hasattr(item, "nbytes"))
    if size > UNPACKED_MB * 10**6:
        raise SurfaceError(f"{path}: unpacked {too_large(size, UNPACKED_MB)}")
