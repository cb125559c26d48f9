"""Results for other programs: tables as CSV and Parquet, NetCDF with CF attributes, VTK grids."""

import base64
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np
import xarray as xr

from ehlwave.errors import ResultsError
from ehlwave.hdf5 import opened
from ehlwave.results.case_file import FORMAT_NAME, number, read_contact
from ehlwave.results.cf import with_cf
from ehlwave.results.read import read_results
from ehlwave.results.tables import dataset_table, write_dataset_csv
from ehlwave.writing import Writer

OF_FIELDS = {
    "film": ("hertz_approach_c_m", "m", "film thickness h"),
    "pressure": ("hertz_pressure_pa", "Pa", "pressure p"),
}
"""Units of fields: the new unit and name."""


def export(paths: list[Path], targets: dict[str, Path], writer: Writer) -> list[str]:
    """Write files of the formats ``csv``, ``parquet``, ``netcdf`` and ``vtk``; report them.

    Raises ResultsError if a format cannot store the content of the files.
    """
    if not targets:
        raise ResultsError("name a file to write: --csv, --parquet, --netcdf or --vtk")
    if len(paths) == 1 and _is_case(paths[0]):
        return _export_case(paths[0], targets, writer)
    if "vtk" in targets:
        raise ResultsError(
            f"{paths[0]}: --vtk takes the file of one case, of ehlwave-case --output"
        )
    results = read_results(paths)
    said = []
    for kind, target in targets.items():
        if kind == "csv":
            write_dataset_csv(target, results, writer=writer)
        elif kind == "parquet":
            writer.parquet(target, dataset_table(results))
        else:
            writer.dataset(target, with_cf(results, "ehlwave: cases of a sweep"))
        said.append(f"{target}: {results.sizes['case']} cases")
    return said


def _export_case(path: Path, targets: dict[str, Path], writer: Writer) -> list[str]:
    wrong = sorted(set(targets) - {"netcdf", "vtk"})
    if wrong:
        raise ResultsError(
            f"{path}: --{wrong[0]} takes results of ehlwave-sweep; of one case give --netcdf or "
            "--vtk"
        )
    case = read_contact(path)
    fields = fields_of(case)
    if "netcdf" in targets:
        writer.dataset(targets["netcdf"], with_cf(fields, "ehlwave: one contact"))
    if "vtk" in targets:
        writer.text(targets["vtk"], vtk_text(fields))
    size = f"{fields.sizes['x']} x {fields.sizes['y']} points"
    return [f"{target}: {size}" for target in targets.values()]


def _is_case(path: Path) -> bool:
    with opened(path) as file:
        name = file.attrs.get("format", "")
        return (name.decode() if isinstance(name, bytes) else str(name)) == FORMAT_NAME


def fields_of(case: xr.Dataset) -> xr.Dataset:
    """Return a case with film, pressure and places in m and Pa where it has dimensions.

    Otherwise they stay in units of a, b, c and ph.
    """
    if "semi_axis_a_m" not in case:
        return case
    a = number(case, "semi_axis_a_m")
    b = number(case, "semi_axis_b_m") if "semi_axis_b_m" in case else a
    scaled = case.assign_coords(
        x=("x", case["x"].values * a, {"units": "m", "long_name": "along rolling"}),
        y=("y", case["y"].values * b, {"units": "m", "long_name": "across rolling"}),
    )
    for name, (scale, unit, text) in OF_FIELDS.items():
        values = case[name].values * number(case, scale)
        scaled[name] = (case[name].dims, values, {"units": unit, "long_name": text})
    return scaled


def vtk_text(fields: xr.Dataset) -> str:
    """Return fields over y and x as a rectilinear grid of VTK, an XML file ``.vtr``.

    https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
    """
    nx, ny = fields.sizes["x"], fields.sizes["y"]
    extent = f"0 {nx - 1} 0 {ny - 1} 0 0"
    names = [str(name) for name in fields.data_vars if set(fields[name].dims) == {"x", "y"}]
    points = [
        _array(_named(name, fields), fields[name].transpose("y", "x").values) for name in names
    ]
    places = [
        _array("x", fields["x"].values),
        _array("y", fields["y"].values),
        _array("z", np.zeros(1)),
    ]
    lines = [
        '<?xml version="1.0"?>',
        '<VTKFile type="RectilinearGrid" version="1.0" byte_order="LittleEndian" '
        'header_type="UInt64">',
        f'<RectilinearGrid WholeExtent="{extent}">',
        f'<Piece Extent="{extent}">',
        "<PointData>",
        *points,
        "</PointData>",
        "<Coordinates>",
        *places,
        "</Coordinates>",
        "</Piece>",
        "</RectilinearGrid>",
        "</VTKFile>",
    ]
    return "\n".join(lines) + "\n"


def _named(name: str, fields: xr.Dataset) -> str:
    """Return the name of a field with its unit, which VTK has no other place for."""
    unit = str(fields[name].attrs.get("units", "1"))
    is_told = unit == "1" or name.endswith(f"_{unit.lower()}")
    return name if is_told else f"{name} [{unit}]"


def _array(name: str, values: np.ndarray) -> str:
    data = np.ascontiguousarray(values, dtype="<f8").tobytes()
    text = base64.b64encode(len(data).to_bytes(8, "little") + data).decode("ascii")
    return f'<DataArray type="Float64" Name={quoteattr(name)} format="binary">{text}</DataArray>'
