"""Surfaces for the full simulation by ``ehlwave-case``."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

from ehlwave.errors import SurfaceError
from ehlwave.surface.prepare import Form, remove_form, taper
from ehlwave.surface.surface import Surface
from ehlwave.writing import Writer

FORMAT_NAME = "ehlwave-surface"


def simulation_surface(surface: Surface, form: Form = "plane", repeat: int = 1) -> Surface:
    """Return a surface that can move through a contact: form removed, ends faded to zero.

    Parameters
    ----------
    surface : Surface
        A map, or a trace along rolling.
    form : {"none", "mean", "plane", "quadratic"}
        Polynomial to remove first.
    repeat : int
        Copies along the rolling direction, for patterns of one or several whole periods.

    Raises
    ------
    SurfaceError
        If it is a trace across rolling, which is stationary in the contact, or ``repeat`` is below
        1.
    """
    if surface.is_trace and surface.trace_axis == "y":
        raise SurfaceError(
            f"{surface.name}: a trace across rolling has nothing that moves through the contact; "
            "give a map, or compute longitudinal waviness by ehlwave-case"
        )
    if not (isinstance(repeat, int | np.integer) and repeat >= 1):
        raise SurfaceError(f"repeat={repeat}: give a whole number of 1 or more")
    flat = remove_form(surface, form)
    height = np.tile(flat.height.astype(np.float64), (repeat, 1))
    height = height * np.outer(taper(height.shape[0]), taper(height.shape[1]))
    return replace(flat, height=height)


def write_simulation_surface(surface: Surface, path: Path, writer: Writer | None = None) -> None:
    """Write height over (y, x), and x and y, in metres: input of ``&surface file``.

    x counts along the motion: the last point enters the contact first. y = 0 of the contact is in
    the middle.
    """
    nx, ny = surface.height.shape
    units = {"units": "m"}
    y = (np.arange(ny) - (ny - 1) / 2) * surface.step_y_m
    dataset = xr.Dataset(
        {"height": (("y", "x"), surface.height.T, units | {"long_name": "peaks positive"})},
        coords={
            "x": ("x", np.arange(nx) * surface.step_x_m, units | {"long_name": "along rolling"}),
            "y": ("y", y, units | {"long_name": "across rolling"}),
        },
        attrs={"format": FORMAT_NAME, "title": surface.name},
    )
    (writer or Writer()).dataset(path, dataset)
