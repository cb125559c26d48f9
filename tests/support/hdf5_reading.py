"""Result files as numpy arrays; leaves the test as skipped when h5py is missing."""

import sys

from ehlwave_program import SKIPPED

try:
    import h5py
except ImportError:
    print("SKIPPED: h5py is not installed for this Python")
    sys.exit(SKIPPED)


def read(path):
    """Attributes and datasets of a file; texts are str."""

    def text(value):
        return value.decode() if isinstance(value, bytes) else value

    with h5py.File(path) as file:
        attributes = {name: text(value) for name, value in file.attrs.items()}
        datasets = {}
        for name, dataset in file.items():
            values = dataset[()]
            datasets[name] = [text(one) for one in values] if values.dtype.kind in "SO" else values
    return attributes, datasets


def dimensions(path, name):
    """Names of the dimension scales of a dataset."""
    with h5py.File(path) as file:
        return [scale.keys()[0] if len(scale) else "" for scale in file[name].dims]
