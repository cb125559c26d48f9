"""The file of an atlas: networks, steps of packed numbers, checksum."""

from pathlib import Path

import numpy as np
import xarray as xr

from ehlwave.laws.atlas.committee import Committee
from ehlwave.laws.atlas.stored import checksum, read_packed
from ehlwave.writing import Writer

PARTS = {
    "centre": (("input",), "mean of the inputs that the networks were fitted to"),
    "scatter": (("input",), "scatter of these inputs"),
    "w1": (("network", "input", "hidden"), "weights of the first layer"),
    "b1": (("network", "one", "hidden"), "biases of the first layer"),
    "w2": (("network", "hidden", "second"), "weights of the second layer"),
    "b2": (("network", "one", "second"), "biases of the second layer"),
    "w3": (("network", "second", "output"), "weights of the outputs"),
    "b3": (("network", "one", "output"), "biases of the outputs"),
}
"""Content of the file for each committee of networks: dimensions and description."""

MOST_STEPS = 32767
"""Steps of weights, which are kept in two bytes each."""


def variables_of(name: str, committee: Committee) -> dict[str, xr.Variable]:
    """Return the variables of a committee by their names in an atlas."""
    values, found = (committee.centre, committee.scatter, *committee.layers), {}
    for (part, (sides, said)), value in zip(PARTS.items(), values, strict=True):
        attributes = {"long_name": f"{said}, {name.replace('_', ' ')}", "units": "1"}
        sides = [f"{name}_{side}" for side in sides]
        found[f"{name}_{part}"] = xr.Variable(sides, value, attributes)
    return found


def write_atlas(data: xr.Dataset, path: Path) -> None:
    """Write an atlas as classic NetCDF, a third as large as HDF5, with its checksum."""
    written = xr.Dataset({name: _packed(data[name]) for name in data}, attrs=data.attrs)
    for _ in range(2):  # the checksum covers the numbers as stored
        data = bytes(written.to_netcdf(engine="scipy", format="NETCDF3_CLASSIC"))
        written.attrs["checksum"] = checksum(*read_packed(data))
    Writer().data(path, data)


def _packed(weights: xr.DataArray) -> xr.DataArray:
    """Return weights in two bytes each and the step between them; the scaling of inputs stays."""
    if weights.ndim == 1:
        return weights
    step = float(np.abs(weights).max()) / MOST_STEPS
    packed = np.rint(weights / step).astype(np.int16)
    return packed.assign_attrs(weights.attrs, scale_factor=step)
