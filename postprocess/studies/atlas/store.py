"""The file of an atlas: units, steps of packed numbers, checksum."""

from pathlib import Path

import numpy as np
import xarray as xr

from ehlwave.atlas.kinds import KINDS
from ehlwave.atlas.stored import checksum
from ehlwave.errors import ResultsError

LONG_NAMES = {
    "responses": ("", "of each contact: those of the first come first"),
    "wavelength_over_a": ("1", "wavelength along the wave vector over the Hertz semi-axis a"),
    "angle_deg": ("degree", "angle between wave vector and rolling direction, in metres"),
    "film_real": ("1", "film response at the centre over Ai, real part"),
    "film_imaginary": (
        "1",
        "film response at the centre over Ai, imaginary part; above 0: film lags",
    ),
    "pressure_real": ("ph/c", "pressure response at the centre over Ai, real part"),
    "pressure_imaginary": ("ph/c", "pressure response at the centre over Ai, imaginary part"),
    "mean_rise": ("1", "mean film less smooth film, over the film, per (A/film)^2; one wave"),
    "error": ("1", "error of the film response, predicted from other contacts, with its own"),
    "load_parameter_m": ("1", "Moes load parameter M"),
    "lubricant_parameter_l": ("1", "Moes lubricant parameter L"),
    "radius_ratio_d": ("1", "D = Rx/Ry"),
    "pressure_viscosity_per_pa": ("1/Pa", "pressure-viscosity coefficient alpha"),
    "roelands_index": ("1", "index z of Roelands' viscosity"),
    "film_ratio": ("1", "ln of central film over Moes' formula, under slip over pure rolling"),
    "minimum_ratio": ("1", "ln of smallest over central film"),
    "slip_parameter": ("1", "S of the surface that is rough"),
    "stress_modulus_pa2": ("Pa2", "E' tau0, reduced modulus times Eyring stress"),
    "friction_ratio": ("1", "ln of mean shear stress over that at the centre without waves"),
    "central_film": ("1", "film at the centre over the Hertz approach"),
    "pressure_ratio": ("1", "ln of largest over Hertz pressure, at most that of 1.02"),
    "centre_contact": ("", "contact, from 0, of the response about which there is a kernel"),
    "rolling_real": ("1", "film response of the same wave in pure rolling, real part"),
    "rolling_imaginary": ("1", "film response of the same wave in pure rolling, imaginary part"),
    "coefficient": ("1", "of kernels: seven numbers of film, two of pressure, ln of the error"),
}
"""Units and descriptions of what the file holds."""


PACKED = {
    "wavelength_over_a": 1.5e-4,
    "angle_deg": 90 / 32767,
    "film_real": 4e-5,
    "film_imaginary": 4e-5,
    "pressure_real": 2e-3,
    "pressure_imaginary": 2e-3,
    "mean_rise": 1e-4,
    "error": 2e-5,
    "rolling_real": 4e-5,
    "rolling_imaginary": 4e-5,
    "lubricant_parameter_l": 9e-4,
    "pressure_viscosity_per_pa": 1e-12,
    "roelands_index": 2.5e-5,
    "slip_parameter": 5e-5,
    **dict.fromkeys(KINDS["sliding"].films, 0.0001),
    **{f"{name}_error": 1e-4 for name in KINDS["sliding"].films},
    "film_ratio": 4e-5,
    "minimum_ratio": 4e-5,
}
"""What is kept in two bytes, and its steps."""

MOST_STEPS = 32767

NOT_KNOWN = {"mean_rise": -32768}
"""What stands for NaN."""


def write_atlas(data: xr.Dataset, path: Path) -> None:
    """Write an atlas as classic NetCDF, a third as large as HDF5, with units and its checksum."""
    kept = {}
    for name, variable in data.variables.items():
        units, long_name = LONG_NAMES.get(str(name).removesuffix("_error"), ("1", ""))
        if str(name) not in LONG_NAMES:
            long_name = f"error of {name}: {long_name}"
        attributes = {"long_name": long_name} | ({"units": units} if units else {})
        values = variable.values
        kept[name] = (
            variable.dims,
            values.astype(np.int16 if values.dtype.kind in "ui" else np.float32),
            attributes,
        )
    written = xr.Dataset(kept, attrs=data.attrs)
    for name in PACKED.keys() & kept.keys():
        if np.nanmax(np.abs(written[name].values)) > MOST_STEPS * PACKED[name]:
            raise ResultsError(f"{path}: {name} does not fit into two bytes: change its step")
    packing = {
        name: {"dtype": "i2", "scale_factor": step, "_FillValue": NOT_KNOWN.get(name)}
        for name, step in PACKED.items()
        if name in written.variables
    }
    packing |= {name: {"_FillValue": None} for name in written.variables if name not in PACKED}
    for _ in range(2):  # the checksum is that of the values as they are read
        written.to_netcdf(path, engine="scipy", format="NETCDF3_CLASSIC", encoding=packing)
        with xr.open_dataset(path) as opened:
            written.attrs["checksum"] = checksum(opened.load())
