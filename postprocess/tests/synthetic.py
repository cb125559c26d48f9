"""Synthetic cases, and a writer of results files in the format of ``ehlwave-sweep``."""

from pathlib import Path
from typing import Any

import h5py
import numpy as np

from ehlwave.contact.formula import amplitude_ratio_formula, f_of_r, v, v2, wavelength_ratio
from ehlwave.writing import LIST_NAME

Columns = dict[str, np.ndarray]

LUBRICANT_L = 12.05
# gamma of eq. (3) for the paper's four D, and a load M for each.
CONDITIONS = {
    (100.0, 1.0): 1.0,
    (200.0, 0.35): 0.38264526,
    (500.0, 0.12): 0.16793439,
    (1000.0, 0.04): 0.080165487,
}
WAVELENGTHS = (0.15, 0.25, 0.5, 1.0, 2.0)
WAVES = {"transverse": (1, 0), "isotropic": (1, 1), "longitudinal": (0, 1)}


def make_columns(
    c1: float = 0.2,
    c2: float = 0.03,
    conditions: dict[tuple[float, float], float] | None = None,
    wavelengths: tuple[float, ...] = WAVELENGTHS,
) -> Columns:
    """Return converged, resolved cases whose Ad/Ai is eq. (18) of f(r) V, without noise."""
    rows: list[dict[str, Any]] = []
    for (load, radius_ratio), gamma in (conditions or CONDITIONS).items():
        for orientation, (along, across) in WAVES.items():
            for wave in wavelengths:
                factor = float(f_of_r(wavelength_ratio(along * wave, across * wave)))
                row = {
                    "case_id": f"case{len(rows):04d}",
                    "load_parameter_m": load,
                    "lubricant_parameter_l": LUBRICANT_L,
                    "radius_ratio_d": radius_ratio,
                    "slip_parameter": 1.0,
                    "orientation": orientation,
                    "wavelength_over_a": wave,
                    "wavelength_x_over_a": along * wave,
                    "wavelength_y_over_a": across * wave,
                    "amplitude_over_film": 0.2,
                    "gamma": gamma,
                    "v": float(v(wave, load, LUBRICANT_L, gamma)),
                    "v2": float(v2(wave, load, LUBRICANT_L)),
                    "f_r": factor,
                    "status": "converged",
                    "is_resolved": 1,
                    "cells_x": 256,
                    "seconds": 1.5,
                    "host": "h",
                    "effective_input": "&case\n  load = 1.0,\n/",
                }
                ratio = float(amplitude_ratio_formula(factor * row["v"], c1, c2))
                row["amplitude_ratio_fit"] = ratio
                row["amplitude_ratio"] = 0.99 * ratio
                rows.append(row)
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def concatenated(*parts: Columns) -> Columns:
    """Return the cases of several sets of columns in turn."""
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}


def taken(columns: Columns, chosen: np.ndarray) -> Columns:
    """Return the chosen cases (a mask or indices)."""
    return {name: values[chosen] for name, values in columns.items()}


def write_results(
    path: Path, columns: Columns, *, pad: str = "null", **attributes: str | int | None
) -> Path:
    """Write a results file; text as fixed-length bytes padded with ``pad`` ("null" or "space").

    ``attributes`` replace root attributes; None removes an attribute.
    """
    root = {
        "format": "ehlwave-results",
        "format_version": 1,
        "program_version": "0.1.0",
        "git_revision": "abc1234",
        "compiler": "GNU 12.2",
    } | attributes
    with h5py.File(path, "w") as file:
        for name, value in root.items():
            if value is not None:
                file.attrs[name] = np.bytes_(value) if isinstance(value, str) else value
        size = len(next(iter(columns.values())))
        scale = file.create_dataset("case", data=np.arange(1, size + 1, dtype=np.int32))
        scale.make_scale("case")
        for name, values in columns.items():
            dataset = _create(file, name, values, pad)
            dataset.dims[0].attach_scale(scale)
            dataset.attrs["units"] = np.bytes_("seconds" if name == "seconds" else "1")
            dataset.attrs["long_name"] = np.bytes_(name.replace("_", " "))
    return path


def written_names(folder: Path) -> set[str]:
    """Return the names in a folder except the list of results."""
    return {path.name for path in folder.iterdir()} - {LIST_NAME}


def _create(file: h5py.File, name: str, values: np.ndarray, pad: str) -> h5py.Dataset:
    if values.dtype.kind != "U":
        return file.create_dataset(name, data=values)
    encoded = np.char.encode(values, "utf-8")
    width = encoded.dtype.itemsize + (0 if name == "host" else 8)
    kind = h5py.h5t.C_S1.copy()
    kind.set_size(width)
    kind.set_strpad(h5py.h5t.STR_SPACEPAD if pad == "space" else h5py.h5t.STR_NULLPAD)
    if pad == "space":
        encoded = np.char.ljust(encoded, width)
    space = h5py.h5s.create_simple(values.shape)
    identifier = h5py.h5d.create(file.id, name.encode(), kind, space)
    identifier.write(h5py.h5s.ALL, h5py.h5s.ALL, np.ascontiguousarray(encoded.astype(f"S{width}")))
    return h5py.Dataset(identifier)
