"""Attributes of the Climate and Forecast conventions, by which other programs label NetCDF files.

The conventions name no quantities of lubrication; there are units and long names, and no
``standard_name``.
"""

import numpy as np
import xarray as xr

from ehlwave.extras import version

CONVENTIONS = "CF-1.8"

UNITS = {
    "": "1",
    "N/m": "N m-1",
    "m/s": "m s-1",
    "1/Pa": "Pa-1",
    "1/K": "K-1",
    "Pa^2": "Pa2",
    "MiB": "1048576 byte",
}
"""Units of UDUNITS, where our files have others."""

_TYPES = (str, bytes, int, float, np.integer, np.floating, np.ndarray)


def with_cf(data: xr.Dataset, title: str) -> xr.Dataset:
    """Return a dataset with units, long names and global attributes as CF requires.

    Logical values become 0 and 1 with their meanings, and attributes that no file can hold are left
    out.
    """
    found = data.copy()
    for name in found.variables:
        if found[name].dtype == bool:
            flags = {"flag_values": np.array([0, 1], np.int8), "flag_meanings": "no yes"}
            found[name] = found[name].astype(np.int8).assign_attrs({**found[name].attrs, **flags})
        if found[name].dtype == np.int64 and np.abs(found[name].values).max(initial=0) < 2**31:
            found[name] = found[name].astype(np.int32, keep_attrs=True)  # CF has no longer units
        attributes = {
            key: value for key, value in found[name].attrs.items() if isinstance(value, _TYPES)
        }
        attributes.setdefault("long_name", str(name).replace("_", " "))
        if found[name].dtype.kind in "fiu" and "flag_values" not in attributes:
            unit = str(attributes.get("units", "1"))
            attributes["units"] = UNITS.get(unit, unit)
        else:
            attributes.pop("units", None)
        found[name].attrs = attributes
    for name in found.coords:
        found[name].encoding["_FillValue"] = None
    kept = {str(key): value for key, value in data.attrs.items() if isinstance(value, _TYPES)}
    found.attrs = {**kept, "Conventions": CONVENTIONS, "title": title}
    found.attrs.setdefault("source", "ehlwave")
    found.attrs.setdefault("history", f"written by ehlwave {version()}")
    return found
