"""Pictures of a case for bearing engineers, in um, GPa and us."""

from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ehlwave.results.case_file import (
    CONTACT_PRESSURE,
    central_film,
    check_field,
    number,
    positive,
    total_pressure,
)
from ehlwave.results.figures import COLOURS
from ehlwave.results.instants import at_instant
from ehlwave.results.map_panel import bar_beside, rolling_arrow
from ehlwave.results.scales_of_figures import COLUMN, aspect_note, readable_aspect
from ehlwave.results.undeformed import given_key, rigid_wave, undeformed_history

Floats = NDArray[np.float64]

REACH = 1.5
"""Largest distance from the centre that is shown, in units of a and b."""

LEVELS = np.arange(0.2, 2.01, 0.2)
"""Lines of equal film, over the smooth central film."""

FILM_SHOWN = 2.0
"""Thickest film that is shown, over the smooth central one."""

RISES = {
    "rise_mid_film_k": "half-way across",
    "rise_wall_1_k": "surface 1",
    "rise_wall_2_k": "surface 2",
}
"""Rises of the temperature along rolling, of a case with heat."""

STYLE = {"font.size": 8.5, "axes.labelsize": 9, "axes.titlesize": 9.5, "legend.fontsize": 8}


@dataclass(frozen=True)
class Units:
    """Factors and names of the units of a picture.

    In um, GPa and us where the case has dimensions; otherwise 1, in units of a, b, c, ph.
    """

    x: float
    y: float
    film: float
    pressure: float
    time: float | None
    names: tuple[str, str, str, str, str]


def units_of(case: xr.Dataset) -> Units:
    """Return the units of a case read by :func:`ehlwave.read_case`."""
    if "semi_axis_a_m" not in case:
        return Units(1, 1, 1, 1, 1, ("$x/a$", "$y/b$", "$h/c$", "$p/p_h$", "$T$"))
    a, c = (number(case, name) * 1e6 for name in ("semi_axis_a_m", "hertz_approach_c_m"))
    b = number(case, "semi_axis_b_m") * 1e6 if "semi_axis_b_m" in case else a
    speed = given_key(case, "mean_speed_m_per_s")
    time = None if speed is None else a / positive(speed, "mean_speed_m_per_s", case)
    names = (r"$x$ [$\mu$m]", r"$y$ [$\mu$m]", r"$h$ [$\mu$m]", "$p$ [GPa]", r"$t$ [$\mu$s]")
    return Units(a, b, c, number(case, "hertz_pressure_pa") * 1e-9, time, names)


def case_figure(case: xr.Dataset, time: float | None = None) -> Figure:
    """Draw film and pressure over the contact and along its midplanes, the central film in time.

    Parameters
    ----------
    case : xarray.Dataset
        From :func:`ehlwave.read_case`.
    time : float, optional
        Instant of a march with ``fields_every``, in the unit of the time axis: us, or T of a case
        without dimensions. The nearest stored instant is drawn; the last one by default.

    Returns
    -------
    matplotlib.figure.Figure
        In um, GPa and us where the case has dimensions. The history has the undeformed pattern
        besides: the film that rigid waves of the same Ai would leave. A line contact has no maps.
        With heat there are rises of the temperature besides. Where surfaces touch, pressures
        include the pressure of the solids, which midplanes show filled; the film map outlines the
        touching area.
    """
    units = units_of(case)
    if time is not None:
        case = at_instant(case, time, units.time or 1)
    is_line = case["y"].size == 1
    has_heat = next(iter(RISES)) in case
    if has_heat:
        for name in RISES:
            check_field(case, name, ("y", "x"))
    has_time = case["time"].size > 1 if "time" in case else False
    if has_time:
        check_field(case, "time", ("time",))
        check_field(case, "film_at_centre", ("time",))
    with rc_context(STYLE):
        if is_line:
            rows = 3 if has_heat else 2
            figure = Figure(figsize=(COLUMN, 2.5 * rows), layout="constrained")
            lengthwise, *more, history = figure.subplots(rows, 1)
        else:
            rows = 4 if has_heat else 3
            figure = Figure(figsize=(COLUMN, 1.85 * rows + 0.3), layout="constrained")
            (film_map, pressure_map), (lengthwise, crosswise), (spare, history), *last = (
                figure.subplots(rows, 2)
            )
            more = [last[0][1]] if has_heat else []
            if has_heat:
                draw_map(last[0][0], case["rise_mid_film_k"], units, 1, "inferno")
                last[0][0].set_title("rise half-way across the film [K]")
            most = FILM_SHOWN * central_film(case) * units.film
            draw_map(film_map, case["film"], units, units.film, most=most)
            rolling_arrow(film_map)
            film_map.set_title(f"film, {units.names[2]}")
            draw_map(pressure_map, total_pressure(case), units, units.pressure, "magma")
            if CONTACT_PRESSURE in case:
                _outline_touching(film_map, case, units)
            pressure_map.set_title(f"pressure, {units.names[3]}")
            _draw_midplane(crosswise, case, units, "y")
            _draw_contours(spare, case, units)
        _draw_midplane(lengthwise, case, units, "x")
        for axes in more:
            _draw_rises(axes, case, units)
        if has_time:
            _draw_history(history, case, units)
            key = {"loc": "outside lower right", "ncols": 2, "frameon": False}
            figure.legend(*history.get_legend_handles_labels(), **key)
        else:
            history.set_axis_off()
            history.text(0.5, 0.5, _summary(case, units), ha="center", va="center")
        figure.suptitle(conditions_text(case, units), fontsize=9)
    return figure


def draw_map(
    axes: Axes,
    field: xr.DataArray,
    units: Units,
    scale: float,
    colours: str = "viridis",
    most: float | None = None,
    is_capped: bool | None = None,
) -> QuadMesh:
    """Draw a map; values above `most` have the last colour, which the bar shows if capped."""
    mesh = axes.pcolormesh(
        field["x"] * units.x,
        field["y"] * units.y,
        field * scale,
        cmap=colours,
        vmin=0,
        vmax=most,
        shading="gouraud",
        rasterized=True,
    )
    bar_beside(axes, mesh, capped=most is not None if is_capped is None else is_capped)
    frame_map(axes, field, units)
    return mesh


def frame_map(axes: Axes, field: xr.DataArray, units: Units) -> None:
    """Limit a map to the contact, and name its axes."""
    x, y = (
        scale * np.clip([field[name].min(), field[name].max()], -REACH, REACH)
        for name, scale in (("x", units.x), ("y", units.y))
    )
    sides = float(np.ptp(x)), float(np.ptp(y))
    axes.set(xlabel=units.names[0], ylabel=units.names[1] + aspect_note(*sides), xlim=x, ylim=y)
    axes.set_aspect(readable_aspect(*sides))


def _draw_contours(axes: Axes, case: xr.Dataset, units: Units) -> None:
    """Draw films by lines of equal thickness, as an interferogram shows them."""
    central = central_film(case)
    film = case["film"] / central
    x, y = case["x"] * units.x, case["y"] * units.y
    lines = axes.contourf(x, y, film, LEVELS, cmap="viridis", extend="both")
    axes.contour(x, y, film, LEVELS, colors="black", linewidths=0.4)
    bar_beside(axes, lines, ticks=LEVELS[1::2])
    frame_map(axes, case["film"], units)
    axes.set_title("film over smooth central film")


def _draw_midplane(axes: Axes, case: xr.Dataset, units: Units, along: str) -> None:
    """Draw film and pressure along a line through the centre, on two axes of their own colours."""
    across, scale = ("y", units.x) if along == "x" else ("x", units.y)
    line = case.sel({across: 0}, method="nearest")
    place = line[along].values * scale
    axes.plot(place, line["film"].values * units.film, color=COLOURS[0])
    axes.set(xlabel=units.names[0 if along == "x" else 1])
    axes.set_ylim(0, FILM_SHOWN * central_film(case) * units.film)
    axes.set_xlim(*(scale * np.clip([line[along].min(), line[along].max()], -REACH, REACH)))
    axes.set_ylabel(units.names[2], color=COLOURS[0])
    right = axes.twinx()
    right.plot(place, total_pressure(line).values * units.pressure, color=COLOURS[1])
    right.set_ylim(0, 1.15 * float(total_pressure(case).max()) * units.pressure)
    if CONTACT_PRESSURE in line:
        _draw_solids(right, place, line[CONTACT_PRESSURE].values * units.pressure)
    right.set_ylabel(units.names[3], color=COLOURS[1])
    axes.set_title("along rolling, $y = 0$" if along == "x" else "across, $x = 0$")


def _outline_touching(axes: Axes, case: xr.Dataset, units: Units) -> None:
    """Outline the areas where solids touch."""
    touches = (case[CONTACT_PRESSURE] > 0).astype(float)
    if touches.any() and not touches.all():
        places = touches["x"] * units.x, touches["y"] * units.y
        axes.contour(*places, touches, [0.5], colors="white", linewidths=0.8)


def _draw_solids(axes: Axes, place: Floats, pressure: Floats) -> None:
    """Fill the pressure of the solids, below the pressure of oil and solids together."""
    axes.fill_between(place, pressure, color=COLOURS[1], alpha=0.3, linewidth=0, label="solids")
    axes.legend(loc="upper right", frameon=False)


def _draw_rises(axes: Axes, case: xr.Dataset, units: Units) -> None:
    """Draw rises of the temperature along the line through the centre."""
    line = case.sel({"y": 0}, method="nearest")
    for name, label in RISES.items():
        axes.plot(line["x"].values * units.x, line[name].values, label=label)
    axes.set_xlim(*(units.x * np.clip([line["x"].min(), line["x"].max()], -REACH, REACH)))
    axes.set(xlabel=units.names[0], ylabel="rise [K]", title="temperature, $y = 0$")
    axes.legend(frameon=False)


def _draw_history(axes: Axes, case: xr.Dataset, units: Units) -> None:
    film = case["film_at_centre"].values * units.film
    scale = 1 if units.time is None else units.time
    axes.plot(case["time"].values * scale, film, color=COLOURS[0], label="in the contact")
    central = central_film(case) * units.film
    undeformed = undeformed_history(case)
    low, high = film.min(), film.max()
    if undeformed is not None:
        rigid = undeformed * units.film
        both = rigid_wave(case, "_2", 1.0) is not None
        name = "undeformed, both surfaces" if both else "undeformed"
        axes.plot(case["time"].values * scale, rigid, color="0.6", linewidth=0.9, label=name)
        low, high = min(low, rigid.min()), max(high, rigid.max())
    axes.axhline(central, color="black", linewidth=0.6, linestyle=":", label="smooth")
    if "instant" in case:
        instant = float(case["instant"]) * scale
        axes.axvline(instant, color=COLOURS[1], linewidth=0.9, label="instant of the maps")
    axes.set_ylim(low - 0.08 * (high - low), high + 0.08 * (high - low))
    axes.set(xlabel=units.names[4], ylabel=units.names[2], title="film at the centre in time")
    axes.margins(x=0)


def conditions_text(case: xr.Dataset, units: Units) -> str:
    """Return M, L, D and S, and the instant of a march, for the head of the picture."""
    letters = {"M": "load_parameter_m", "L": "lubricant_parameter_l"}
    letters |= {"D": "radius_ratio_d", "S": "slip_parameter"}
    parts = [f"${k}$ = {number(case, key):.5g}" for k, key in letters.items() if key in case]
    last = case["time"].values[-1:] if "time" in case and case["time"].size > 1 else []
    for instant in [float(case["instant"])] if "instant" in case else last:
        name = units.names[4].split(" [")[0]
        unit = "" if name == "$T$" else r" $\mu$s"
        parts.append(f"{name} = {instant * (units.time or 1):.4g}{unit}")
    return ", ".join(parts)


def _summary(case: xr.Dataset, units: Units) -> str:
    lines = [str(case.attrs.get("status", ""))]
    if (oil := given_key(case, "oil_over_flooded")) is not None:
        lines.append(f"$r$ = {positive(oil, 'oil_over_flooded', case):g}")
    symbol, _, unit = units.names[2].partition(" ")
    for name, text in (("central_film", "central film"), ("minimum_film", "smallest film")):
        film = f"{number(case, name) * units.film:.4g} {unit.strip('[]')}".rstrip()
        lines.append(f"{text}: {symbol} = {film}")
    if "harmonic_ratio" in case and np.isfinite(case["harmonic_ratio"]):
        lines.append(f"$A_d/A_i$ of small waves: {number(case, 'harmonic_ratio'):.3f}")
    return "\n".join(lines)
