"""The file of an atlas: its networks and its checksum."""

import hashlib
import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ehlwave.errors import ResultsError
from ehlwave.laws.atlas.committee import LAYERS, Committee
from ehlwave.laws.atlas.coordinates import Floats

STEP = "scale_factor"
"""Attribute of packed numbers: the step between them."""

AS_STORED: dict[str, Any] = {"mask_and_scale": False, "decode_times": False}
"""Options of xarray that leave numbers as they are in the file: versions unpack differently."""


@lru_cache(maxsize=8)
def read_stored(path: str | Path) -> xr.Dataset:
    """Return the data of a file, read once a process.

    Raises
    ------
    ResultsError
        If it cannot be read, or has a wrong checksum.
    """
    try:
        with xr.open_dataset(path, **AS_STORED) as opened:
            data = opened.load()
    except (OSError, ValueError, TypeError) as error:
        raise ResultsError(f"{path}: cannot be read as an atlas ({error})") from error
    if checksum(data) != data.attrs.get("checksum"):
        raise ResultsError(f"{path}: its checksum does not match its data: the file is damaged")
    return xr.Dataset({name: _unpacked(data[name]) for name in data}, attrs=data.attrs)


def _unpacked(stored: xr.DataArray) -> xr.Variable:
    """Return numbers times their step, in double precision whatever the version of xarray."""
    attrs = dict(stored.attrs)
    step = attrs.pop(STEP, None)
    values = _native(stored.values)
    if step is not None:
        values = values.astype(np.float64) * np.float64(step)
    return xr.Variable(stored.dims, values, attrs)


def committee_of(data: xr.Dataset, name: str) -> Committee:
    """Return networks by their name in an atlas."""
    layers = tuple(data[f"{name}_{part}"].values.astype(np.float32) for part in LAYERS)
    centre, scatter = (
        data[f"{name}_{part}"].values.astype(float) for part in ("centre", "scatter")
    )
    return Committee(centre, scatter, layers)


@dataclass(frozen=True)
class ErrorBars:
    """Finds error bars: networks of ln of the errors, times factors that make bars of them."""

    log_errors: Committee
    factors: Floats

    def __call__(self, places: Floats) -> Floats:
        """Return the bars at places, shape (n, inputs): shape (n, outputs)."""
        return np.asarray(self.factors * np.exp(self.log_errors(places)))


def errors_of(data: xr.Dataset, name: str) -> ErrorBars:
    """Return the function of error bars of this name."""
    return ErrorBars(
        committee_of(data, name), np.asarray(json.loads(data.attrs[f"{name}_factors"]))
    )


def checksum(data: xr.Dataset) -> str:
    """Return the SHA-256 digest of the stored data.

    The digest covers names, shapes, numbers in little-endian order and steps of all variables in
    alphabetical order, and of the texts among the attributes. It depends on no library.

    Parameters
    ----------
    data : xarray.Dataset
        Opened with :data:`AS_STORED`.
    """
    digest = hashlib.sha256()
    for name in sorted(str(name) for name in data.variables):
        values = data[name].values
        kind = f"{values.dtype.kind}{values.dtype.itemsize}"
        digest.update(f"{name} {kind} {values.shape} ".encode())
        digest.update(values.astype(values.dtype.newbyteorder("<")).tobytes())
        if STEP in data[name].attrs:
            digest.update(np.float64(data[name].attrs[STEP]).astype("<f8").tobytes())
    for key in sorted(map(str, data.attrs)):
        if key != "checksum" and isinstance(data.attrs[key], str):
            digest.update(f"{key}={data.attrs[key]}".encode())
    return digest.hexdigest()


def _native(values: np.ndarray) -> np.ndarray:
    return values.astype(values.dtype.newbyteorder("="))
