"""The file of an atlas: its networks and its checksum."""

import hashlib
import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
import xarray as xr

from ehlwave.errors import ResultsError
from ehlwave.laws.atlas.committee import LAYERS, Committee
from ehlwave.laws.atlas.coordinates import Floats


@lru_cache(maxsize=8)
def read_stored(path: str | Path) -> xr.Dataset:
    """Return the data of a file, read once a process.

    Raises
    ------
    ResultsError
        If it cannot be read, or its checksum is not that of its data.
    """
    try:
        with xr.open_dataset(path) as opened:
            data = opened.load()
    except (OSError, ValueError) as error:
        raise ResultsError(f"{path}: cannot be read as an atlas ({error})") from error
    if checksum(data) != data.attrs.get("checksum"):
        raise ResultsError(f"{path}: its checksum is not that of its data: the file is damaged")
    return data


def committee_of(data: xr.Dataset, name: str) -> Committee:
    """Return networks by their name in an atlas."""
    layers = tuple(data[f"{name}_{part}"].values.astype(np.float32) for part in LAYERS)
    centre, scatter = (
        data[f"{name}_{part}"].values.astype(float) for part in ("centre", "scatter")
    )
    return Committee(centre, scatter, layers)


@dataclass(frozen=True)
class ErrorBars:
    """Finds error bars: networks of ln of the errors, times what makes bars of them."""

    log_errors: Committee
    factors: Floats

    def __call__(self, places: Floats) -> Floats:
        """Return the bars at places, shape (n, inputs): shape (n, outputs)."""
        return np.asarray(self.factors * np.exp(self.log_errors(places)))


def errors_of(data: xr.Dataset, name: str) -> ErrorBars:
    """Return what finds the error bars of this name."""
    return ErrorBars(
        committee_of(data, name), np.asarray(json.loads(data.attrs[f"{name}_factors"]))
    )


def checksum(data: xr.Dataset) -> str:
    """Return the SHA-256 digest of all values, variables in alphabetical order."""
    digest = hashlib.sha256()
    for name in sorted(str(name) for name in data.variables):
        digest.update(name.encode() + np.ascontiguousarray(data[name].values).tobytes())
    return digest.hexdigest()
