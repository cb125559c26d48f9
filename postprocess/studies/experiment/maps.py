"""Figures 5 and 7 of the paper: pressure and film over the contact, and fringes of the film."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from numpy.typing import NDArray

from studies.experiment.figures import STYLE
from studies.experiment.measure import Floats, Solved

REFRACTIVE_INDEX = 1.5
RED_UM, GREEN_UM = 0.63, 0.54
"""Wavelengths of the two filters; the paper names the colours only."""

HIGHEST_H = 0.3
"""Highest film in the surface plot, in units of c: the inlet is far above."""


def surfaces_figure(solved: Solved) -> Figure:
    """Draw P and H over X and Y as surfaces and as maps (Figure 7)."""
    film = np.minimum(solved.film, HIGHEST_H)
    with rc_context(STYLE | {"xtick.direction": "out", "ytick.direction": "out"}):
        figure = Figure(figsize=(9.0, 8.2), layout="constrained")
        shown = (("P", solved.pressure, 35), ("H", film, 55))
        grid = figure.add_gridspec(2, 2, width_ratios=(1.25, 1))
        for row, (name, values, elevation) in enumerate(shown):
            axes = figure.add_subplot(grid[row, 0], projection="3d")
            shown_x, shown_y = np.abs(solved.x + 0.1) <= 1.3, np.abs(solved.y) <= 1.3
            x_mesh, y_mesh = np.meshgrid(solved.x[shown_x], solved.y[shown_y])
            part = values[np.ix_(shown_y, shown_x)]
            axes.plot_surface(
                x_mesh,
                y_mesh,
                part,
                rcount=part.shape[0],
                ccount=part.shape[1],
                cmap="viridis",
                linewidth=0,
                antialiased=False,
                rasterized=True,
            )
            axes.view_init(elev=elevation, azim=-65)
            axes.set_box_aspect((1, 1, 0.5), zoom=0.95)
            axes.set(xlabel="X", ylabel="Y", title=name)
            axes.locator_params(nbins=5)
            axes = figure.add_subplot(grid[row, 1])
            highest = values.max() if name == "P" else 0.25
            mesh = axes.pcolormesh(
                solved.x, solved.y, values, vmin=0, vmax=highest, cmap="viridis", shading="nearest"
            )
            mesh.set_rasterized(True)
            figure.colorbar(
                mesh, ax=axes, label=name, shrink=0.8, extend="max" if name == "H" else "neither"
            )
            axes.set(xlim=(-1.6, 1.4), ylim=(-1.5, 1.5), aspect="equal", xlabel="X", ylabel="Y")
    return figure


def fringes_figure(solved: Solved) -> Figure:
    """Draw the film as duochromatic fringes, and as a map in um (beside Figure 5)."""
    film_um = solved.film * solved.c_um
    x_mm, y_mm = solved.x * solved.a_um / 1e3, solved.y * solved.a_um / 1e3
    with rc_context(STYLE | {"xtick.direction": "out", "ytick.direction": "out"}):
        figure = Figure(figsize=(8.4, 3.9), layout="constrained")
        left, right = figure.subplots(1, 2)
        mesh = left.pcolormesh(x_mm, y_mm, fringes(film_um), shading="gouraud", rasterized=True)
        left.set_title("red and green fringes of the computed film")
        mesh = right.pcolormesh(
            x_mm, y_mm, film_um, vmin=0, vmax=0.6, cmap="viridis", shading="gouraud"
        )
        mesh.set_rasterized(True)
        figure.colorbar(mesh, ax=right, label="h [um]", shrink=0.85, extend="max")
        right.set_title("computed film")
        for axes in (left, right):
            axes.set(xlim=(-0.277, 0.277), ylim=(-0.277, 0.277), aspect="equal", xlabel="x [mm]")
        left.set_ylabel("y [mm]")
    return figure


def fringes(film_um: Floats) -> NDArray[np.float64]:
    """Return colours (red, green, blue) of two-beam interference, by reflection, at each film.

    A film of zero thickness is dark: the lower of the two reflections turns the phase by pi.
    """
    colours = np.zeros((*film_um.shape, 3))
    for channel, wavelength in ((0, RED_UM), (1, GREEN_UM)):
        path = 2 * np.pi * 2 * REFRACTIVE_INDEX * film_um / wavelength
        colours[..., channel] = 0.5 - 0.5 * np.cos(path)
    return colours
