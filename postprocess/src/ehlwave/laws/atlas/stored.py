"""The file of an atlas: its networks and its checksum."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ehlwave.errors import ResultsError
from ehlwave.laws.atlas.classic import read_classic
from ehlwave.laws.atlas.committee import LAYERS, Committee
from ehlwave.laws.atlas.coordinates import Floats


@dataclass(frozen=True)
class Packed:
    """A variable as a file has it."""

    values: np.ndarray
    step: float | None = None
    """Factor of whole numbers (`scale_factor`); none for numbers that are not packed."""

    def unpacked(self) -> np.ndarray:
        """Return the numbers, in the byte order of the machine."""
        values = self.values.astype(self.values.dtype.newbyteorder("="))
        return values if self.step is None else values.astype(np.float64) * np.float64(self.step)


@dataclass(frozen=True)
class Stored:
    """The content of a file: arrays by name, and attributes."""

    arrays: Mapping[str, np.ndarray]
    attrs: Mapping[str, Any]


@lru_cache(maxsize=8)
def read_stored(path: str | Path) -> Stored:
    """Return the data of a file, read once a process.

    Raises
    ------
    ResultsError
        If it cannot be read, or has a wrong checksum.
    """
    try:
        packed, attrs = read_packed(Path(path).read_bytes())
    except (OSError, ValueError, TypeError, LookupError, EOFError) as error:
        raise ResultsError(f"{path}: cannot be read as an atlas ({error})") from error
    if checksum(packed, attrs) != attrs.get("checksum"):
        raise ResultsError(f"{path}: its checksum does not match its data: the file is damaged")
    return Stored({name: variable.unpacked() for name, variable in packed.items()}, attrs)


def read_packed(data: bytes) -> tuple[dict[str, Packed], dict[str, Any]]:
    """Return variables and attributes of a classic NetCDF file, by its bytes."""
    arrays, attrs = read_classic(data)
    packed = {
        name: Packed(values, own.get("scale_factor")) for name, (values, own) in arrays.items()
    }
    return packed, attrs


def committee_of(data: Stored, name: str) -> Committee:
    """Return networks by their name in an atlas."""
    layers = tuple(data.arrays[f"{name}_{part}"].astype(np.float32) for part in LAYERS)
    centre, scatter = (
        data.arrays[f"{name}_{part}"].astype(float) for part in ("centre", "scatter")
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


def errors_of(data: Stored, name: str) -> ErrorBars:
    """Return the function of error bars of this name."""
    return ErrorBars(
        committee_of(data, name), np.asarray(json.loads(data.attrs[f"{name}_factors"]))
    )


def checksum(packed: Mapping[str, Packed], attrs: Mapping[str, Any]) -> str:
    """Return the SHA-256 digest of the stored data.

    The digest covers names, shapes, numbers in little-endian order and steps of all variables in
    alphabetical order, and of the texts among the attributes. It depends on no library.
    """
    digest = hashlib.sha256()
    for name in sorted(packed):
        values, step = packed[name].values, packed[name].step
        kind = f"{values.dtype.kind}{values.dtype.itemsize}"
        digest.update(f"{name} {kind} {values.shape} ".encode())
        digest.update(values.astype(values.dtype.newbyteorder("<")).tobytes())
        if step is not None:
            digest.update(np.float64(step).astype("<f8").tobytes())
    for key in sorted(attrs):
        if key != "checksum" and isinstance(attrs[key], str):
            digest.update(f"{key}={attrs[key]}".encode())
    return digest.hexdigest()
