"""Figures of stresses below rough contacts: section and map, stress over depth, Dang Van's path."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ehlwave.results.figures import COLOURS
from ehlwave.results.map_panel import bar_beside, rolling_arrow
from ehlwave.results.scales_of_figures import (
    COLUMN,
    aspect_note,
    readable_aspect,
)
from ehlwave.stress.centre import contact_fields
from ehlwave.stress.criteria import von_mises
from ehlwave.stress.dang_van import PRESSURE_COEFFICIENT, Path, fatigue_shear
from ehlwave.stress.field import stress_below
from ehlwave.stress.loads import checked_poisson_ratios
from ehlwave.stress.rough import RoughStress
from ehlwave.surface.bands_figure import bars_figure

Floats = NDArray[np.float64]

UM, MPA = 1e6, 1e-6
STYLE: dict[Any, Any] = {
    "font.size": 8.5,
    "axes.labelsize": 9,
    "axes.titlesize": 9.5,
    "legend.fontsize": 8,
}
SECTION_DEPTHS = 28
GRID = (256, 64)
"""Points of the contact that is drawn, along and across."""
LINES: tuple[dict[str, Any], ...] = (
    {"color": COLOURS[0], "lw": 2.2},
    {"color": COLOURS[1], "lw": 1.2, "ls": "--"},
)
"""Styles of both bodies: the second is drawn on the first, and both are visible where they
coincide.
"""


def section_figure(
    stress: xr.Dataset, pressure_pa: xr.DataArray, unit: str = r"$\mu$m", scale: float = UM
) -> Figure:
    """Draw von Mises' stress in the plane y = 0, over a map at its depth, and the pressure.

    Parameters
    ----------
    stress : Dataset
        From :func:`ehlwave.stress.stress_below`.
    pressure_pa : DataArray
        On the surface, over x and y of the stress.
    unit, scale : str, float
        Unit of lengths, and factor on metres.
    """
    field = von_mises(stress) * MPA
    row = int(np.argmin(np.abs(stress["y"].values)))
    is_line = stress["y"].size == 1
    line = field.isel(y=row)
    deep = int(np.argmax(line.max("x").values))
    plane = field.isel(z=deep)
    most = float(max(line.max(), plane.max()))  # both maps have the colours of one bar
    with rc_context(STYLE):
        height, ratios = (4.4, (1, 1.5)) if is_line else (3.7, (1, 1))
        figure = Figure(figsize=(COLUMN, height), layout="constrained")
        axes = figure.subplots(2, 1 if is_line else 2, squeeze=False, height_ratios=ratios)
        x = stress["x"].values * scale
        top = axes[0, 0]
        top.plot(x, pressure_pa.transpose("x", "y").values[:, row] * 1e-9, color=COLOURS[0])
        top.set(ylabel="pressure [GPa]", xlim=(x[0], x[-1]), ylim=(0, None))
        top.set(xlabel=f"$x$ [{unit}]", title="pressure, $y=0$")
        z, name = stress["z"].values * scale, "von Mises [MPa]"
        _colours(axes[1, 0], x, z, line.values, name if is_line else "", most=most)
        axes[1, 0].invert_yaxis()
        axes[1, 0].set(xlabel=f"$x$ [{unit}]", ylabel=f"depth $z$ [{unit}]", aspect=1, anchor="N")
        axes[1, 0].set_title("section $y=0$")
        if not is_line:
            y = stress["y"].values * scale
            _pressure_map(axes[0, 1], x, y, pressure_pa)
            depth = float(stress["z"][deep]) * scale
            axes[1, 1].set_title(f"depth $z={depth:.3g}$ {unit}")
            _colours(axes[1, 1], x, y, plane.transpose("y", "x").values, name, most=most)
            sides = float(np.ptp(x)), float(np.ptp(y))
            rolling_arrow(axes[0, 1])
            for panel in axes[:, 1]:
                panel.set(xlabel=f"$x$ [{unit}]", ylabel=f"$y$ [{unit}]{aspect_note(*sides)}")
                panel.set_aspect(readable_aspect(*sides))
    return figure


def predicted_section(result: RoughStress) -> Figure:
    """Draw the section of the first body at an instant, the middle of the surface at the centre."""
    surface = result.surfaces[0].surface
    way = surface.height.shape[0] * surface.step_x_m / 2 / result.conditions.slip_parameter
    # The first points are at the centre at 0; later points come from behind.
    fields = contact_fields(result.surfaces, -way, GRID, reach=1.5)
    x, y = fields["x"].values, fields["y"].values
    steps = (x[1] - x[0], y[1] - y[0] if y.size > 1 else 1.0)
    reach = min(result.conditions.semi_axis_a_m, result.conditions.semi_axis_b_m)
    stress = stress_below(
        fields["pressure_pa"],
        steps,
        np.linspace(0, 1.2 * reach, SECTION_DEPTHS),
        traction_x_pa=_pull(result) * fields["pressure_pa"],
        poisson_ratio=checked_poisson_ratios(result.poisson_ratio)[0],
    )
    return section_figure(stress, fields["pressure_pa"])


def depth_figure(result: RoughStress) -> Figure:
    """Draw Dang Van's factor over depth, rough beside smooth, and the paths of the worst points."""
    with rc_context(STYLE):
        figure = Figure(figsize=(COLUMN, 6.4), layout="constrained")
        over_depth, plane = figure.subplots(2, 1)
        for body, line in zip(result.bodies, LINES, strict=False):
            depth = body.risk["z"].values * UM
            values = body.risk.values
            over_depth.plot(values.max(axis=1), depth, label=f"{body.name}, worst point", **line)
            name = "all points" if body is result.bodies[-1] else None
            ends = values.min(axis=1), values.max(axis=1)
            over_depth.fill_betweenx(depth, *ends, color="0.5", alpha=0.2, lw=0, label=name)
            plane.plot(*_in_plane(body.path), label=body.name, **line)
        smooth = np.asarray(result.bodies[0].smooth_over_depth)
        over_depth.plot(smooth, depth, color="0.2", linestyle=":", label="without roughness")
        over_depth.axvline(
            1, color="0.6", linewidth=0.8, label="limit: cracks begin within $N$ cycles"
        )
        over_depth.set(xlabel="Dang Van's factor", ylabel=r"depth $z$ [$\mu$m]", xlim=(0, None))
        over_depth.invert_yaxis()
        over_depth.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1))
        _limit_line(plane, float(fatigue_shear(result.cycles)))
        plane.set(
            xlabel=r"hydrostatic stress $\sigma_H$ [MPa]", ylabel=r"shear stress $\tau$ [MPa]"
        )
        plane.set_title(f"worst points, {cycles_text(result.cycles)}")
    return figure


def cycles_text(cycles: float) -> str:
    """Return a number of cycles as figures show it, such as N = 10^8."""
    factor, power = f"{cycles:.3g}".partition("e")[::2] if cycles >= 1e5 else (f"{cycles:.3g}", "")
    if not power:
        return f"$N={factor}$"
    front = "" if float(factor) == 1 else rf"{factor}\cdot"
    return f"$N={front}10^{{{int(power)}}}$"


def ripple_figure(result: RoughStress) -> Figure:
    """Draw the largest shear of the ripple alone over depth, and the ripple of the pressure."""
    with rc_context(STYLE):
        figure = Figure(figsize=(COLUMN, 5.2), layout="constrained")
        profile, over_depth = figure.subplots(2, 1)
        for surface, ripple, colour in zip(result.surfaces, result.ripples, COLOURS, strict=False):
            pressure = ripple.pressure()[: ripple.measured]
            along = ripple.moves
            step = surface.surface.step_x_m if along else surface.surface.step_y_m
            values = pressure[:, pressure.shape[1] // 2] if along else pressure[0]
            profile.plot(np.arange(values.size) * step * UM, values * MPA, color=colour, lw=0.9)
        letter = "x" if result.ripples[0].moves else "y"
        profile.set(xlabel=rf"${letter}$ on the surface [$\mu$m]", ylabel="pressure ripple [MPa]")
        profile.margins(x=0)
        for body, line in zip(result.bodies, LINES, strict=False):
            depth = body.risk["z"].values * UM
            over_depth.plot(body.ripple_over_depth_pa * MPA, depth, label=body.name, **line)
        over_depth.set(xlabel="largest shear of the ripple [MPa]", ylabel=r"depth $z$ [$\mu$m]")
        over_depth.set_xlim(0, None)
        over_depth.invert_yaxis()
        over_depth.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1), ncols=2)
    return figure


def risk_figure(result: RoughStress) -> Figure:
    """Draw the exponents of Dang Van's factor near the surface in the amplitude of the waves.

    A bar for each octave of the wavelength, by direction; a panel for each body that has waves.
    Bars above 0: less of these waves lowers the factor.

    Parameters
    ----------
    result : RoughStress
        Of rough surfaces.

    Returns
    -------
    matplotlib.figure.Figure
        Wavelengths in um.
    """
    panels = {body.name: [(band, band.gradient) for band in body.bands] for body in result.bodies}
    return bars_figure({f"Dang Van's factor,\n{name}": bars for name, bars in panels.items()})


def _pull(result: RoughStress) -> float:
    return -result.friction * float(np.sign(result.bodies[0].slip - 1))


def _in_plane(path: Path) -> tuple[Floats, Floats]:
    return path.hydrostatic * MPA, path.shear * MPA


def _limit_line(axes: Axes, fatigue_pa: float) -> None:
    """Draw where the factor is 1."""
    low = axes.get_xlim()[0]
    pressure = np.array([low, 0.0])
    limit = fatigue_pa * MPA - PRESSURE_COEFFICIENT * pressure
    axes.plot(pressure, limit, color="0.4", linewidth=1, linestyle="--", label="factor 1")
    axes.set(xlim=(low, 0), ylim=(0, None))
    axes.legend(frameon=False, loc="lower left")


def _pressure_map(axes: Axes, x: Floats, y: Floats, pressure_pa: xr.DataArray) -> None:
    values = pressure_pa.transpose("y", "x").values * 1e-9
    _colours(axes, x, y, values, "pressure [GPa]", "magma")
    axes.set_title("pressure")


def _colours(
    axes: Axes,
    x: Floats,
    y: Floats,
    values: Floats,
    name: str,
    colours: str = "viridis",
    most: float | None = None,
) -> None:
    """Draw a map, with a colour bar where the quantity is named."""
    style = {"cmap": colours, "vmin": 0, "vmax": most, "shading": "gouraud", "rasterized": True}
    mesh = axes.pcolormesh(x, y, values, **style)
    if name:
        bar_beside(axes, mesh, name)
