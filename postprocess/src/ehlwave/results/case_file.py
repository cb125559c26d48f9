"""A contact: film and pressure from the file that ``ehlwave-case --output`` writes."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from ehlwave.errors import ResultsError
from ehlwave.hdf5 import read_dataset

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FORMAT_NAME = "ehlwave-case"
FIELDS = ("pressure", "film")
NEEDED = {"x": ("x",), "y": ("y",)} | dict.fromkeys(FIELDS, ("y", "x"))
"""Fields that pictures are drawn from, with their dimensions."""

CONTACT_PRESSURE = "contact_pressure"
"""Pressure of the solids, in files of surfaces that touch."""

FILM_SHOWN = 2.0
"""Thickest film in the figure, over the smooth contact's central film: the inlet is far above."""

REACH = 1.5
"""Largest distance from the centre that is shown, in units of a and b."""

_STYLE = {"font.size": 8.5, "axes.labelsize": 9.5, "axes.titlesize": 9.5}


def read_contact(path: str | Path) -> xr.Dataset:
    """Read the file of a case.

    Parameters
    ----------
    path : path
        HDF5 file that ``ehlwave-case --output`` wrote.

    Returns
    -------
    xarray.Dataset
        As in the file, with ``pressure`` and ``film`` over ``y`` and ``x`` (P and H of the last
        solution, dimensionless) on the whole domain.

    Raises
    ------
    ResultsError
        If it cannot be read, is not the file of a case, or has no fields.

    Examples
    --------
    The file comes from ``ehlwave-case input.nml --output contact.h5``:

    >>> import subprocess
    >>> from pathlib import Path
    >>> import ehlwave
    >>> from ehlwave.programs.programs import find_program
    >>> case = ehlwave.Case(load_parameter_m=10, lubricant_parameter_l=5, radius_ratio_d=1,
    ...     cells_x=64, cells_y=64)
    >>> _ = Path("input.nml").write_text(repr(case))
    >>> command = [find_program("ehlwave-case"), "input.nml", "--output", "contact.h5"]
    >>> done = subprocess.run(command, capture_output=True)
    >>> contact = ehlwave.read_case("contact.h5")
    >>> contact["pressure"].dims, contact.attrs["status"]
    (('y', 'x'), 'converged')
    """
    contact = read_dataset(path)
    if contact.attrs.get("format") != FORMAT_NAME:
        raise ResultsError(f"{path}: not a file of ehlwave-case --output")
    if all(name not in contact for name in FIELDS):
        raise ResultsError(f"{path}: no pressure and film (status {contact.attrs.get('status')})")
    contact.encoding["source"] = str(path)
    _check_fields(contact)
    whole = whole_domain(contact)
    whole.encoding["source"] = str(path)
    return whole


def _check_fields(contact: xr.Dataset) -> None:
    """Refuse fields that nothing can be drawn from."""
    for name, dims in NEEDED.items():
        check_field(contact, name, dims)
    if CONTACT_PRESSURE in contact:
        check_field(contact, CONTACT_PRESSURE, ("y", "x"))
    for name in ("x", "y"):
        if (np.diff(contact[name].values) <= 0).any():
            raise ResultsError(f"{_place(contact)}: dataset {name} does not increase")


def central_film(case: xr.Dataset) -> float:
    """Return H of the centre, which pictures are scaled by.

    Raises ResultsError if it is not there or not above 0, or if there is nothing that could be
    drawn.
    """
    if case["x"].size < 2:
        raise ResultsError(f"{_place(case)}: has one point along x: nothing to draw")
    for name, field in (("pressure", total_pressure(case)), ("film", case["film"])):
        if not (field.values > 0).any():
            raise ResultsError(f"{_place(case)}: {name} is nowhere above 0: nothing to draw")
    return positive(number(case, "central_film"), "central_film", case)


def total_pressure(case: xr.Dataset) -> xr.DataArray:
    """Return the pressure on a surface: of the oil, and of solids where surfaces touch."""
    if CONTACT_PRESSURE not in case:
        return case["pressure"]
    return case["pressure"] + case[CONTACT_PRESSURE]


def check_field(case: xr.Dataset, name: str, dims: tuple[str, ...]) -> None:
    """Raise ResultsError unless a dataset is there and holds finite numbers over its dimensions."""
    if name not in case:
        raise ResultsError(f"{_place(case)}: dataset {name} is missing: the file is damaged")
    values = case[name]
    if values.dims != dims or values.dtype.kind not in "fiu" or values.size == 0:
        over = f"numbers over ({', '.join(dims)})" if dims else "a number"
        raise ResultsError(f"{_place(case)}: dataset {name} does not hold {over}")
    if not np.isfinite(values.values).all():
        raise ResultsError(f"{_place(case)}: dataset {name} has missing or infinite values")


def number(case: xr.Dataset, name: str) -> float:
    """Return a number of a case; ResultsError if it is not there, or not finite."""
    check_field(case, name, ())
    return float(case[name])


def positive(value: str | float, name: str, case: xr.Dataset) -> float:
    """Return a number above 0; ResultsError if it is none."""
    try:
        found = float(value)
    except ValueError:
        found = np.nan
    if not (np.isfinite(found) and found > 0):
        raise ResultsError(f"{_place(case)}: {name} = {value} must be a number above 0")
    return found


def _place(case: xr.Dataset) -> str:
    return str(case.encoding.get("source", "case"))


def whole_domain(contact: xr.Dataset) -> xr.Dataset:
    """Return fields over ``y`` on the whole domain: a half not computed is the mirror image."""
    if contact["y"].size == 1 or contact["y"].values[0] < 0:
        return contact
    other = contact.isel(y=slice(None, 0, -1))
    joined = xr.concat((other.assign_coords(y=-other["y"]), contact), "y", data_vars="minimal")
    return joined.assign_attrs(contact.attrs)


def contact_figure(contact: xr.Dataset) -> "Figure":
    """Draw pressure and film: maps over X and Y, and along the centre line.

    A line contact has the latter alone. Film is over the central film of the smooth contact. Where
    surfaces touch, the pressure includes the pressure of the solids.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    from ehlwave.results.map_panel import rolling_arrow
    from ehlwave.results.scales_of_figures import COLUMN, PAGE

    is_line = contact["y"].size == 1
    film = contact["film"] / central_film(contact)
    with rc_context(_STYLE):
        width, panels = (COLUMN, 1) if is_line else (PAGE, 3)
        figure = Figure(figsize=(width, 2.8), layout=ConstrainedLayoutEngine(w_pad=0.12))
        axes = figure.subplots(1, panels, squeeze=False)[0]
        if not is_line:
            _draw_map(axes[0], total_pressure(contact), "pressure $P$", "magma")
            _draw_map(axes[1], film, "film $H/H_c$", "viridis", FILM_SHOWN)
            rolling_arrow(axes[1])
        _draw_line(axes[-1], total_pressure(contact), film.clip(max=FILM_SHOWN))
    return figure


def _draw_map(
    axes: "Axes", field: xr.DataArray, name: str, colours: str, most: float | None = None
) -> None:
    from ehlwave.results.map_panel import bar_beside

    x, y = field["x"], field["y"]
    options: dict[str, Any] = {"cmap": colours, "vmin": 0, "vmax": most, "rasterized": True}
    mesh = axes.pcolormesh(x, y, field, shading="gouraud", **options)
    bar_beside(axes, mesh, capped=most is not None)
    axes.set(title=name, xlabel="$X$", ylabel="$Y$", aspect="equal")
    _limit(axes, "x", field["x"])
    _limit(axes, "y", field["y"])


def _draw_line(axes: "Axes", pressure: xr.DataArray, film: xr.DataArray) -> None:
    from ehlwave.results.figures import COLOURS

    axes.plot(film["x"], film.sel(y=0, method="nearest"), color=COLOURS[0])
    axes.set(title="$Y=0$", xlabel="$X$", ylim=(0, FILM_SHOWN))
    _limit(axes, "x", film["x"])
    axes.set_ylabel("$H/H_c$", color=COLOURS[0])
    right = axes.twinx()
    right.plot(pressure["x"], pressure.sel(y=0, method="nearest"), color=COLOURS[1])
    right.set_ylim(0, 1.8 * float(pressure.max()))
    right.set_ylabel("$P$", color=COLOURS[1])


def _limit(axes: "Axes", which: str, positions: xr.DataArray) -> None:
    ends = np.clip((float(positions.min()), float(positions.max())), -REACH, REACH)
    axes.set(**{f"{which}lim": ends})
