"""Files of instruments, as SurfaceTopography reads them: its reader is chosen by their content."""

import io
import math
import re
import zipfile
from pathlib import Path
from typing import Any

from ehlwave.errors import SurfaceError, printable
from ehlwave.extras import install
from ehlwave.hdf5 import DATA_PER_BYTE, check_is_file, reason
from ehlwave.surface.files.channels import chosen_channel
from ehlwave.surface.raw_surface import MOST_POINTS, RawSurface, raw_topography, refuse_large

_SDF = re.compile(rb"([ab])[A-Z]{2,4}-\d(?:\.\d)?")
_TEXTS = (
    *(b"fileformat = bcr", b"WSxM file", b"Wyko ASCII Data File Format", b"\\*File list"),
    *(b"# File Format = ASCII", b"Zygo ASCII Data File", b"NT-MDT"),
)
"""Beginnings of texts with a format of their own."""

ENDINGS = (
    *(".sdf", ".spm", ".001", ".002", ".003", ".004", ".005", ".mat", ".mdt", ".opd", ".opdx"),
    *(".x3p", ".ibw", ".mi", ".xlsx", ".datx", ".tif", ".tiff", ".sur", ".tmd", ".vk3", ".vk4"),
    *(".vk6", ".vk7", ".zmg", ".zon", ".os3d", ".al3d", ".ezd", ".nid", ".bcr", ".bcrf", ".gwy"),
    *(".plu", ".apx", ".frt", ".lext", ".oir", ".poir", ".cur", ".stp", ".tom", ".top", ".plux"),
    *(".jpk", ".mnt", ".qep", ".zip", ".nms", ".hgt"),
)
"""Endings of files that are no plain tables of numbers, even where they begin as text."""

_BY_CHANCE = ("hgt", "nms", "xyz", "asc")
"""Readers that take whatever has their size, or any numbers: for files with their ending alone."""


def is_instrument_text(head: bytes) -> bool:
    """Return whether a text that begins so has a format of an instrument."""
    head = head.removeprefix(b"\xef\xbb\xbf").lstrip()
    return _SDF.match(head) is not None or head.startswith(_TEXTS)


def raw_instrument(file: Path, head: bytes, channel: str | None = None) -> RawSurface:
    """Return a file of an instrument, as SurfaceTopography reads it.

    Parameters
    ----------
    file : path
        Of any known format.
    head : bytes
        First bytes of the file.
    channel : str or None
        The channel of heights, where there are several.

    Raises
    ------
    SurfaceError
        If it is not installed, or cannot read the file; the reason comes from the reader of this
        format.
    """
    try:
        import SurfaceTopography  # optional, and slow to import
    except ImportError as error:
        raise SurfaceError(
            f"{file}: this format is read by SurfaceTopography, which is not installed: "
            f"{install('instruments')} (CSV, NumPy and HDF5 need nothing)"
        ) from error
    check_is_file(file)
    reader = _reader(file, head, SurfaceTopography)
    try:
        # Its readers raise whatever a damaged file makes them stumble into.
        found = chosen_channel(file, reader.channels, channel)
        points = math.prod(found.nb_grid_pts)
        refuse_large(file, points)
        if points > DATA_PER_BYTE * file.stat().st_size:
            raise SurfaceError(f"{file}: claims {points} numbers that it cannot hold")
        sizes = {} if found.physical_sizes else {"physical_sizes": found.nb_grid_pts}
        raw = raw_topography(found.topography(**sizes), file)
        if sizes:
            raw.step = raw.step_across = None  # the file has no lateral calibration
    except SurfaceError:
        raise
    except Exception as error:
        raise SurfaceError(_cannot(file, reader, error)) from error
    name = printable(str(found.name))[:60]
    raw.notes.append(f"read as {_kind(reader)}, channel {name!r}")
    return raw


def _reader(file: Path, head: bytes, package: Any) -> Any:  # noqa: ANN401 - has no types
    """Return the reader that opens a file: by its first bytes, by its ending, or any that does."""
    source = _source(file, head)
    certain, named, others = _by_likelihood(file, head, package)
    first: tuple[Any, Exception] | None = None
    for kind in (*certain, *named, *([] if certain else others)):
        try:
            return kind(source() if callable(source) else source)
        except Exception as error:
            if first is None and (kind in certain or kind in named):
                first = kind, error
    if first is not None:
        raise SurfaceError(_cannot(file, *first)) from first[1]
    raise SurfaceError(
        f"{file}: SurfaceTopography cannot read it: no reader knows its content or the ending "
        f"'{printable(file.suffix)}'; export it from the instrument's software as SUR, SDF, X3P or "
        "text"
    )


def _by_likelihood(file: Path, head: bytes, package: Any) -> tuple[list[Any], list[Any], list[Any]]:  # noqa: ANN401
    """Return readers that match the first bytes, readers of the ending, and others."""
    certain, named, others = [], [], []
    suffix = file.suffix.lower().removeprefix(".")
    for kind in package.IO.readers:
        says = (
            str(getattr(kind.can_read(head[:512]), "value", "maybe"))
            if hasattr(kind, "can_read")
            else "maybe"
        )
        is_sdf = kind.format() == "sdf" and _SDF.match(head) is not None
        if says == "no" and not is_sdf:
            continue
        endings = [*(kind.file_extensions() or ()), kind.format()]
        if says == "yes" or is_sdf:
            certain.append(kind)
        elif suffix in endings:
            named.append(kind)
        elif kind.format() not in _BY_CHANCE:
            others.append(kind)
    if is_instrument_text(head):
        others += [kind for kind in package.IO.readers if kind.format() == "asc"]
    if head.startswith(b"PK\x03\x04") and b"main.xml" in head:
        named.sort(key=lambda kind: kind.format() != "x3p")
    return certain, named, others


def _source(file: Path, head: bytes) -> Any:  # noqa: ANN401
    """Return the input of readers: the path, or a copy in memory that they can read."""
    if (found := _SDF.match(head)) and head[:8] not in (b"aISO-1.0", b"bISO-1.0"):
        data = file.read_bytes()
        rest = data[8:] if found[1] == b"b" else data[found.end() :]
        return lambda: io.BytesIO(found[1] + b"ISO-1.0" + rest)
    if head.startswith(b"PK\x03\x04") and zipfile.is_zipfile(file):
        with zipfile.ZipFile(file) as archive:
            names = [_plain_name(name) for name in archive.namelist()]
            inner = [name for name in names if f"/{name}".endswith("/main.xml")]
            if len(inner) == 1 and (inner[0] != "main.xml" or names != archive.namelist()):
                data = _without_folder(file, archive, inner[0].removesuffix("main.xml"))
                return lambda: io.BytesIO(data)
    return str(file)


def _plain_name(name: str) -> str:
    """Return the name of an X3P's part as the format has it; none for additions of macOS."""
    name = name.replace("\\", "/").removeprefix("./").lstrip("/")
    if name.startswith("__MACOSX/"):
        return ""
    return re.sub(r"(?i)(?<![^/])main\.xml$", "main.xml", name)


def _without_folder(file: Path, archive: zipfile.ZipFile, folder: str) -> bytes:
    """Return an archive with the files of a folder at its top."""
    named = [(_plain_name(one.filename), one) for one in archive.infolist()]
    entries = [(name, one) for name, one in named if name.startswith(folder)]
    if sum(one.file_size for _, one in entries) > min(
        8 * MOST_POINTS, max(2**24, DATA_PER_BYTE * file.stat().st_size)
    ):
        raise SurfaceError(f"{file}: its archive claims more than it can hold")
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as copy:
        for place, one in entries:
            if name := place.removeprefix(folder):
                copy.writestr(name, archive.read(one))
    return made.getvalue()


def _kind(reader: Any) -> str:  # noqa: ANN401
    """Return the name of a format."""
    return f"{reader.name()} ({reader.format()})"


def _cannot(file: Path, reader: Any, error: Exception) -> str:  # noqa: ANN401
    return f"{file}: SurfaceTopography cannot read it as {_kind(reader)}: {reason(error)}"
