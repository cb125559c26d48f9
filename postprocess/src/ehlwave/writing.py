"""The only module of this package that writes files: it never destroys files of others.

A file is written under a temporary name in its own folder and renamed when it is whole. Results are
listed in ``.ehlwave-results``in their folder, with the SHA-256 digest of each: a command may
replace them again. Everything else is left unchanged: files of others, results changed since,
links, folders, and the inputs of the command, by whatever name. Needs the standard library alone.
"""

from __future__ import annotations

import hashlib
import json
import os
import stat
import tempfile
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ehlwave.errors import OutputError, ResultsError
from ehlwave.extras import install

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.figure import Figure
    from PIL.Image import Image

LIST_NAME = ".ehlwave-results"
LIST_FORMAT = "ehlwave-list-of-results"
LARGEST_LIST = 2**24

Identity = tuple[int, int]
"""Device and inode: identity of a file under any name."""


class Writer:
    """Writes the files of a command.

    Parameters
    ----------
    inputs : iterable of path
        Inputs of the command: never replaced, not even by other names or links.
    overwrite : bool
        Whether files that are not results of ours are replaced too; links and inputs never are.
    """

    def __init__(self, inputs: Iterable[str | Path] = (), *, overwrite: bool = False) -> None:
        """Note the inputs."""
        self._inputs = {
            found: Path(path) for path in inputs if (found := _identity(Path(path))) is not None
        }
        self._overwrite = overwrite
        self._written: dict[Identity, Path] = {}

    def folder(self, path: str | Path) -> Path:
        """Return a folder, made if it is not there.

        Raises OutputError if there is something else of this name.
        """
        place = Path(path)
        for part in (place, *place.parents):
            if os.path.lexists(part) and not part.is_dir():
                raise OutputError(f"{part}: is not a folder: name another folder as output")
        place.mkdir(parents=True, exist_ok=True)
        return place

    def file(self, path: str | Path, write: Callable[[Path], object]) -> Path:
        """Let `write` make a file of the name it is given, and move that to its place.

        Raises OutputError if there is something of this name that must not be replaced; OSError if
        it cannot be written; then there is nothing of it.
        """
        place = Path(path)
        self.check(place)
        self.folder(place.parent)
        descriptor, name = tempfile.mkstemp(".part", ".ehlwave-", place.parent)
        os.close(descriptor)
        part = Path(name)
        try:
            write(part)
            part.chmod(0o666 & ~_file_mask())
            found = _digest(part)
            self.check(place)
            part.replace(place)
        except BaseException:
            part.unlink(missing_ok=True)
            raise
        self._written[_known_identity(place)] = place
        _remember(place, found)
        return place

    def check(self, place: Path) -> None:
        """Raise OutputError if a file of this name must not be written."""
        if place.name in ("", "..", LIST_NAME):
            raise OutputError(f"{place}: is no name for a file: name another file as output")
        try:
            there = place.lstat()
        except (FileNotFoundError, NotADirectoryError):
            return
        identity = there.st_dev, there.st_ino
        followed = _identity(place)
        for same in (identity, followed):
            if same in self._inputs:
                raise OutputError(
                    f"{place}: is the input {self._inputs[same]}, which would be lost: name "
                    "another file as output"
                )
        if stat.S_ISLNK(there.st_mode):
            raise OutputError(f"{place}: is a link, which is not followed: name a file as output")
        if not stat.S_ISREG(there.st_mode):
            raise OutputError(f"{place}: is not a file that can be replaced: name another file")
        if identity in self._written:
            raise OutputError(
                f"{place}: is {self._written[identity]}, just written: give outputs names of "
                "their own"
            )
        if not self._overwrite and not is_result(place):
            raise OutputError(
                f"{place}: exists and is not a result of ehlwave, or was changed since: name "
                "another file, move this one away, or replace it by overwrite=True"
            )

    def text(self, path: str | Path, text: str) -> Path:
        """Write text unchanged, in UTF-8; unencodable characters by their numbers."""
        return self.data(path, text.encode("utf-8", "backslashreplace"))

    def data(self, path: str | Path, data: bytes) -> Path:
        """Write bytes."""
        return self.file(path, lambda part: part.write_bytes(data))

    def table(self, path: str | Path, table: pd.DataFrame, **options: Any) -> Path:  # noqa: ANN401
        """Write a table as CSV; options as for :meth:`pandas.DataFrame.to_csv`."""
        return self.text(path, table.to_csv(None, **({"index": False} | options)))

    def parquet(self, path: str | Path, table: pd.DataFrame) -> Path:
        """Write a table as Parquet.

        Raises ResultsError if pyarrow is not installed.
        """
        try:
            import pyarrow  # noqa: F401
        except ImportError as error:
            raise ResultsError(
                f"{path}: Parquet needs pyarrow: {install('parquet')}, or write CSV"
            ) from error
        kept = table.rename(columns=str)
        return self.file(path, lambda part: kept.to_parquet(part, engine="pyarrow", index=False))

    def dataset(self, path: str | Path, data: xr.Dataset) -> Path:
        """Write a dataset as HDF5.

        Raises ResultsError if its content does not fit the format, such as a NUL in a text.
        """
        try:
            return self.file(path, lambda part: data.to_netcdf(part, engine="h5netcdf"))
        except (TypeError, ValueError) as error:
            said = " ".join(str(error).split())
            raise ResultsError(f"{path}: HDF5 cannot hold all of the data: {said}") from error

    def figure(self, path: str | Path, figure: Figure, **options: Any) -> Path:  # noqa: ANN401
        """Write a figure in the format that the name ends with."""
        kind = Path(path).suffix[1:]
        return self.file(path, lambda part: figure.savefig(part, format=kind, **options))

    def gif(self, path: str | Path, pictures: Sequence[Image], milliseconds: int) -> Path:
        """Write pictures as an animation that repeats, each for this time."""
        first, *rest = pictures
        how = {"save_all": True, "append_images": rest, "duration": milliseconds, "loop": 0}
        return self.file(path, lambda part: first.save(part, format="GIF", **how))


def write_new_text(path: Path, text: str) -> None:
    """Write text into a folder of our own; FileExistsError if there is a file of this name."""
    with path.open("x", encoding="utf-8", newline="") as file:
        file.write(text)


def keep_own_file(path: Path, data: bytes) -> None:
    """Write, or replace, a file in a folder that is ours alone, such as the cache.

    Other processes see the whole old or the whole new file. Raises OSError.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    descriptor, name = tempfile.mkstemp(".part", ".ehlwave-", path.parent)
    part = Path(name)
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(data)
        part.replace(path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def remove_own_file(path: Path) -> bool:
    """Remove a file of a folder that is ours alone; return whether it was there."""
    try:
        path.unlink()
    except FileNotFoundError:
        return False
    return True


def is_result(path: Path) -> bool:
    """Return whether a file was written here, is unchanged, and may be replaced."""
    digest = _listed(path.parent).get(path.name)
    if digest is None or not path.stat().st_mode & stat.S_IWUSR:
        return False
    return digest == _digest(path)


def _remember(path: Path, digest: str) -> None:
    """Note a result in the list of its folder, unless something else has the name of the list."""
    place = path.parent / LIST_NAME
    if os.path.lexists(place) and not _is_list(place):
        return
    listed = _listed(path.parent) | {path.name: digest}
    there = {name: listed[name] for name in sorted(listed) if os.path.lexists(path.parent / name)}
    document = {"format": LIST_FORMAT, "files": there}
    descriptor, name = tempfile.mkstemp(".part", ".ehlwave-", path.parent)
    with os.fdopen(descriptor, "w", encoding="utf-8") as file:
        file.write(json.dumps(document, indent=1) + "\n")
    part = Path(name)
    part.chmod(0o666 & ~_file_mask())
    part.replace(place)


def _listed(folder: Path) -> dict[str, str]:
    """Return the digests of the results in a folder, by their names."""
    return _read_list(folder / LIST_NAME) or {}


def _is_list(place: Path) -> bool:
    return _read_list(place) is not None


def _read_list(place: Path) -> dict[str, str] | None:
    """Return the content of a list of results; None if it is not one."""
    try:
        there = place.lstat()
        if not stat.S_ISREG(there.st_mode) or there.st_size > LARGEST_LIST:
            return None
        document = json.loads(place.read_text(encoding="utf-8"))
        if document["format"] != LIST_FORMAT:
            return None
        return {str(name): str(digest) for name, digest in document["files"].items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None


def _digest(path: Path) -> str:
    digest = hashlib.sha256()
    with path.open("rb") as file:
        while block := file.read(2**20):
            digest.update(block)
    return digest.hexdigest()


def _identity(path: Path) -> Identity | None:
    """Return the target of a name, None if there is none."""
    try:
        found = path.stat()
    except (OSError, ValueError):
        return None
    return found.st_dev, found.st_ino


def _known_identity(path: Path) -> Identity:
    found = path.lstat()
    return found.st_dev, found.st_ino


def _file_mask() -> int:
    mask = os.umask(0o077)
    os.umask(mask)
    return mask
