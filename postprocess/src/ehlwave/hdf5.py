"""The only module of this package that opens HDF5 files from elsewhere.

A file must be complete in itself: links into other files, data kept in others and views of others
are refused, not followed. So are sizes that the file has no data for, before memory is asked for.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5py
import xarray as xr

from ehlwave.errors import ResultsError, printable

LARGEST_BYTES = 2**32
"""Size of all datasets of a file."""

DATA_PER_BYTE = 1100
"""Most bytes of data per byte of a file: the best that deflate does is 1032."""

NEVER_DOUBTED = 2**20
"""Bytes of a dataset that are taken to be there."""

_PURE_DIMENSION = b"This is a netCDF dimension but not a netCDF variable"


@contextmanager
def opened(path: str | Path) -> Iterator[h5py.File]:
    """Open a file for reading and check it.

    Raises ResultsError if it is not there, not HDF5, damaged, not complete by itself, or claims too
    much; also for whatever its damage makes those who read it inside stumble into.
    """
    file = Path(path)
    check_is_file(file)
    try:
        with h5py.File(file, "r") as inside:
            _check(file, inside)
            yield inside
    except ResultsError:
        raise
    except MemoryError:
        raise
    except OSError as error:
        if "unable to lock" in str(error):
            raise ResultsError(
                f"{file}: another program holds it open for writing, or its file system refuses "
                f"locks ({reason(error)}): close it there, or set HDF5_USE_FILE_LOCKING=FALSE"
            ) from error
        why = "" if "signature not found" in str(error) else f" ({reason(error)})"
        raise ResultsError(
            f"{file}: cannot be read as HDF5{why}: give a file that ehlwave-sweep, "
            "ehlwave-case --output or ehlwave surface wrote"
        ) from error
    except Exception as error:
        # A damaged file makes its readers stumble into whatever there is.
        raise ResultsError(
            f"{file}: damaged or not written as expected ({reason(error)})"
        ) from error


def read_dataset(path: str | Path, **options: Any) -> xr.Dataset:  # noqa: ANN401
    """Return all of a file as a dataset; options as for :func:`xarray.open_dataset`.

    Raises ResultsError as :func:`opened`.
    """
    with (
        opened(path),
        xr.open_dataset(path, engine="h5netcdf", decode_times=False, **options) as dataset,
    ):
        return _renamed(dataset.load())


OLD_NAMES = {
    "length_a_m": "semi_axis_a_m",
    "length_b_m": "semi_axis_b_m",
    "length_c_m": "hertz_approach_c_m",
}
"""Names in files of earlier versions, and their successors."""


def _renamed(dataset: xr.Dataset) -> xr.Dataset:
    """Return a dataset with today's names; continued sweeps have both, each in its own rows."""
    for old, new in OLD_NAMES.items():
        if old in dataset and new in dataset:
            whole = dataset[new].fillna(dataset[old]).assign_attrs(dataset[new].attrs)
            dataset = dataset.drop_vars(old).assign({new: whole})
        elif old in dataset:
            dataset = dataset.rename_vars({old: new})
    return dataset


def check_is_file(file: Path) -> None:
    """Raise ResultsError unless there is a file of this name."""
    if file.is_dir():
        raise ResultsError(f"{file}: is a directory, not a file")
    if not file.exists():
        raise ResultsError(f"{file}: no such file")
    if not file.is_file():
        raise ResultsError(f"{file}: is not a regular file")


def reason(error: BaseException) -> str:
    """Return the message of a library, in a line of at most 200 characters."""
    said = str(error.strerror) if isinstance(error, OSError) and error.strerror else str(error)
    name = "" if isinstance(error, OSError) else f"{type(error).__name__}: "
    return printable(" ".join(f"{name}{said}".split()))[:200]


def _check(file: Path, inside: h5py.File) -> None:
    """Refuse data outside the file, and more data than it can hold."""
    seen: set[Any] = set()
    total, waiting = 0, [("", inside)]
    while waiting:
        place, group = waiting.pop()
        for name in group:
            full = f"{place}/{name}"
            link = group.get(name, getlink=True)
            if isinstance(link, h5py.ExternalLink):
                raise ResultsError(
                    f"{file}: {printable(full)} is a link into the file "
                    f"{printable(link.filename)}, which is not followed"
                )
            if isinstance(link, h5py.SoftLink):
                continue
            found = group[name]
            key = h5py.h5o.get_info(found.id)
            if (key.fileno, key.addr) in seen:
                continue
            seen.add((key.fileno, key.addr))
            if isinstance(found, h5py.Group):
                waiting.append((full, found))
            elif isinstance(found, h5py.Dataset):
                total += _claimed(f"{file}: {printable(full)}", found)
    if total > LARGEST_BYTES:
        raise ResultsError(f"{file}: claims {total} bytes of data, more than {LARGEST_BYTES}")


def _claimed(place: str, dataset: h5py.Dataset) -> int:
    """Return the bytes of a dataset that is all in its file."""
    made = dataset.id.get_create_plist()
    if made.get_layout() == h5py.h5d.VIRTUAL:
        raise ResultsError(f"{place} is a view of other files (virtual), which is not followed")
    if made.get_external_count() > 0:
        raise ResultsError(f"{place} has its data in another file, which is not followed")
    if _PURE_DIMENSION in bytes(str(dataset.attrs.get("NAME", "")), "utf-8", "replace"):
        return 0
    if dataset.shape is None:
        return 0
    claimed = dataset.size * dataset.id.get_type().get_size()
    stored = dataset.id.get_storage_size()
    if claimed > max(NEVER_DOUBTED, DATA_PER_BYTE * stored):
        raise ResultsError(
            f"{place} claims {dataset.size} numbers, of which the file holds {stored} bytes"
        )
    return int(claimed)
