"""Read the results files of ``ehlwave-sweep`` into a labelled dataset."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import xarray as xr

from ehlwave.errors import ResultsError
from ehlwave.hdf5 import opened, read_dataset
from ehlwave.results.labels import LABEL, labels
from ehlwave.results.schema import (
    DIMENSION,
    EDGES_BEFORE,
    FORMAT_NAME,
    FORMAT_VERSION,
    PROVENANCE_ATTRIBUTES,
    REQUIRED_COLUMNS,
)


def read_results(paths: str | Path | Sequence[str | Path]) -> xr.Dataset:
    """Read results files and join their cases.

    Parameters
    ----------
    paths : path, or sequence of path
        HDF5 files written by ``ehlwave-sweep``.

    Returns
    -------
    xarray.Dataset
        Every per-case dataset of the files as a variable over ``case``, with its ``units`` and
        ``long_name``; text as stripped strings. ``case`` counts from 1 over all files, as
        logs and ``--plan`` do; ``label`` lists the varying keys. The coordinates ``source_file``,
        ``case_in_file``, ``program_version``, ``git_revision`` and ``compiler`` hold the origin of
        each case. Scalars are repeated for every case of their file; datasets of other shapes are
        left out. A column that only some files have is NaN for the others. A ``smallest_film`` that
        is not above 0, as early versions stored it, is NaN, and ``surfaces_touch`` of its case 1.

    Raises
    ------
    ResultsError
        If a file is missing, given twice, unreadable, not a results file, of a newer format, or
        lacks a dataset that is needed.

    Examples
    --------
    >>> import ehlwave
    >>> study = ehlwave.Study({"load_parameter_m": [10, 20]}, lubricant_parameter_l=5,
    ...     radius_ratio_d=1, cells_x=64, cells_y=64)
    >>> _ = study.run("results.h5")
    >>> results = ehlwave.read_results("results.h5")
    >>> results["status"].values.tolist()
    ['converged', 'converged']
    >>> results["central_film"].attrs["long_name"]
    'smooth central film thickness H(0,0)'
    """
    if isinstance(paths, (str, Path)):
        paths = [paths]
    if not paths:
        raise ResultsError("no results file given")
    files = [Path(path) for path in paths]
    seen: set[Path] = set()
    for file in files:
        if file.resolve() in seen:
            raise ResultsError(f"{file}: given twice; its cases would count double")
        seen.add(file.resolve())
    parts = [_read_file(file) for file in files]
    joined = xr.concat(
        parts, dim=DIMENSION, data_vars="all", coords="all", compat="equals", join="outer"
    )
    cases = np.arange(1, joined.sizes[DIMENSION] + 1)
    named = (DIMENSION, np.array(labels(joined), dtype=np.str_))
    return joined.assign_coords({DIMENSION: cases, LABEL: named})


def _read_file(path: Path) -> xr.Dataset:
    """Check a file and return its cases, without an index on ``case``."""
    with opened(path) as file:
        _check_format(path, file)
        _check_columns(path, file)
        # A dataset without a dimension scale is no obstacle to reading the others.
        return _labelled(path, read_dataset(path, phony_dims="access"))


def _check_format(path: Path, file: h5py.File) -> None:
    name = _text(file.attrs.get("format", ""))
    if name != FORMAT_NAME:
        found = f"its format is {name!r}" if name else "it has no attribute 'format'"
        raise ResultsError(f"{path}: not a results file of ehlwave-sweep ({found})")
    try:
        version = int(_text(file.attrs["format_version"]))
    except (KeyError, ValueError) as error:
        raise ResultsError(f"{path}: its attribute 'format_version' is not a number") from error
    if version > FORMAT_VERSION:
        raise ResultsError(
            f"{path}: format version {version} is newer than this version of ehlwave reads "
            f"({FORMAT_VERSION}); update ehlwave"
        )
    if version < 1:
        raise ResultsError(f"{path}: unknown format version {version}")


def _check_columns(path: Path, file: h5py.File) -> None:
    missing = [name for name in (DIMENSION, *REQUIRED_COLUMNS) if name not in file]
    if missing:
        raise ResultsError(f"{path}: missing dataset {', '.join(missing)}")
    if not file[DIMENSION].is_scale:
        raise ResultsError(f"{path}: dataset {DIMENSION} is not a dimension scale")
    cases = file[DIMENSION].shape
    wrong = [name for name in REQUIRED_COLUMNS if file[name].shape != cases]
    if wrong:
        raise ResultsError(f"{path}: dataset {', '.join(wrong)} does not have one value per case")


def _labelled(path: Path, data: xr.Dataset) -> xr.Dataset:
    """Return the per-case variables with decoded text and the origin of each case."""
    size = data.sizes[DIMENSION]
    columns = {}
    extra = [str(name) for name in data.data_vars if name not in REQUIRED_COLUMNS]
    for name in (*REQUIRED_COLUMNS, *extra):
        variable = data[name]
        if set(variable.dims) - {DIMENSION}:
            continue
        values = np.broadcast_to(_decoded(variable.values), (size,)).copy()
        attributes = {key: _plain(value) for key, value in variable.attrs.items()}
        columns[name] = ((DIMENSION,), values, attributes)
    if "edges" not in columns:
        columns["edges"] = ((DIMENSION,), np.full(size, EDGES_BEFORE), {})
    _flag_touching(columns, size)
    origin = {key: _text(data.attrs.get(key, "")) for key in PROVENANCE_ATTRIBUTES}
    origin["source_file"] = str(path)
    coordinates = {key: ((DIMENSION,), np.full(size, text)) for key, text in origin.items()}
    # Assign each case the version of the program that computed it.
    for key in PROVENANCE_ATTRIBUTES:
        if key in columns:
            own = columns.pop(key)[1].astype(str)
            coordinates[key] = ((DIMENSION,), np.where(own == "", origin[key], own))
    coordinates["case_in_file"] = ((DIMENSION,), data[DIMENSION].values)
    return xr.Dataset(columns, coords=coordinates)


def _flag_touching(columns: dict[str, Any], size: int) -> None:
    """Remove invalid smallest films, which early versions stored, with a reason."""
    if "smallest_film" not in columns:
        return
    dims, films, attributes = columns["smallest_film"]
    is_none = films <= 0
    if not is_none.any():
        return
    columns["smallest_film"] = (dims, np.where(is_none, np.nan, films), attributes)
    _, touch, attributes = columns.get("surfaces_touch", (dims, np.zeros(size, np.int32), {}))
    columns["surfaces_touch"] = (dims, np.where(is_none, 1, touch).astype(touch.dtype), attributes)


def _decoded(values: np.ndarray) -> np.ndarray:
    """Return an array with fixed- or variable-length text decoded and stripped of padding."""
    if values.dtype.kind not in "SUO":
        return values
    texts = [_text(value) for value in values.ravel()]
    return np.array(texts, dtype=np.str_).reshape(values.shape)


def _text(value: Any) -> str:  # noqa: ANN401 - HDF5 attributes come in many types
    """Return text of an HDF5 string in any of its forms, without padding."""
    item = np.asarray(value).ravel()
    first = item[0] if item.size else ""
    decoded = first.decode("utf-8", errors="replace") if isinstance(first, bytes) else str(first)
    return decoded.strip(" \0")


def _plain(value: Any) -> Any:  # noqa: ANN401
    """Return an attribute with text decoded; anything else as it is."""
    is_text = isinstance(value, (bytes, str)) or np.asarray(value).dtype.kind in "SUO"
    return _text(value) if is_text else value
