"""Reads classic NetCDF files of fixed size, as atlases: scipy's takes 0.2 s to import."""

from dataclasses import dataclass
from typing import Any

import numpy as np

KINDS = {1: "b", 2: "c", 3: ">i2", 4: ">i4", 5: ">f4", 6: ">f8"}
DIMENSIONS, VARIABLES, ATTRIBUTES = 10, 11, 12


@dataclass
class Classic:
    """Bytes of a file, and the place that is read next."""

    data: bytes
    place: int = 0

    def take(self, count: int) -> bytes:
        """Return the next bytes; the next item begins at a multiple of four bytes."""
        start, end = self.place, self.place + count
        if end > len(self.data):
            raise EOFError("it ends too early")
        self.place = start + -(-count // 4) * 4
        return self.data[start:end]

    def whole(self, count: int = 4) -> int:
        """Return the next whole number, of so many bytes."""
        return int.from_bytes(self.take(count), "big")

    def name(self) -> str:
        """Return the next name."""
        return self.take(self.whole()).decode()

    def length(self, tag: int) -> int:
        """Return the length of a list that begins here, 0 where there is none."""
        if self.whole() not in (0, tag):
            raise ValueError("its lists are in another order")
        return self.whole()

    def attributes(self) -> dict[str, Any]:
        """Return attributes: texts, numbers, and arrays."""
        found: dict[str, Any] = {}
        for _ in range(self.length(ATTRIBUTES)):
            name, kind = self.name(), KINDS[self.whole()]
            count = self.whole()
            values = self.take(count * np.dtype(kind).itemsize)
            if kind == "c":
                found[name] = values.decode()
            else:
                array = np.frombuffer(values, kind)
                found[name] = array if count > 1 else array[0]
        return found


def read_classic(
    data: bytes,
) -> tuple[dict[str, tuple[np.ndarray, dict[str, Any]]], dict[str, Any]]:
    """Return the arrays of a file with their attributes, and the attributes of the file."""
    if data[:3] != b"CDF" or data[3:4] not in (b"\x01", b"\x02"):
        raise ValueError("it is no classic NetCDF file")
    file = Classic(data, 8)
    sizes = [(file.name(), file.whole())[1] for _ in range(file.length(DIMENSIONS))]
    attributes = file.attributes()
    arrays = {}
    for _ in range(file.length(VARIABLES)):
        name = file.name()
        shape = [sizes[file.whole()] for _ in range(file.whole())]
        own, kind = file.attributes(), KINDS[file.whole()]
        file.whole()
        start = Classic(data, file.whole(4 * data[3]))
        values = start.take(int(np.prod(shape)) * np.dtype(kind).itemsize)
        arrays[name] = np.frombuffer(values, kind).reshape(shape), own
    return arrays, attributes
