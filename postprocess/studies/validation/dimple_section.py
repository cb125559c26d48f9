"""The rolling dimple beside the published simulation and measurement: section of the page."""

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from ehlwave.results.figures import COLOURS
from studies.section import Picture, Section, Table
from studies.validation.dimple import INSIDE, INSTANTS, OUTSIDE, Dimple, computed
from studies.validation.published import centre_line

PLATEAU_UM = 105
"""Up to where the film is nearly flat and the pressure has no spike."""


def section(folder: Path) -> Section:
    """Return the dimple's part of the page; runs in `folder` what is not there yet."""
    dimple = computed(folder)
    return Section(
        "A dimple rolling through a ball-on-disc contact",
        _text(dimple),
        [summary_table(dimple), point_table(dimple)],
        [
            Picture(
                "mourier",
                "Film and pressure along the centre line, pure rolling: this code, and the "
                "simulation and measurement of Mourier and others (2006), digitised. The measured "
                "dimple was 7 um deep, so that the measured film inside it is not to be compared",
                line_figure(dimple),
            )
        ],
    )


def point_table(dimple: Dimple) -> Table:
    """Return every digitised point of the published simulation beside this code."""
    parts = []
    for instant in INSTANTS:
        for quantity, unit in (("film", "nm"), ("pressure", "MPa")):
            x, value, fine, coarse = dimple.deviations(instant, quantity)
            line = dimple.lines[instant]
            slope = line.at(quantity, x + 0.5) - line.at(quantity, x - 0.5)
            columns = {
                "instant": instant,
                "quantity": f"{quantity}, {unit}",
                "x, um": x,
                "published": value,
                "this code": fine,
                "deviation, %": 100 * (fine - value) / value,
                "grid error, %": 100 * (fine - coarse) / 3 / value,
                "sideways, um": np.where(np.abs(slope) > 1, (fine - value) / slope, np.nan),
                "where": np.where(dimple.is_inside(instant, x), "dimple", ""),
            }
            parts.append(pd.DataFrame(columns))
    return Table(
        "mourier_points",
        "Every digitised point of the published simulation. Grid error: a third of the difference "
        "of the two grids; sideways: by how many um the curve would have to move along x to meet "
        "the point, where it rises by more than 1 nm or MPa a um",
        pd.concat(parts),
        is_long=True,
    )


def summary_table(dimple: Dimple) -> Table:
    """Return worst and rms deviations of the film by region, and whether the aims are reached."""
    rows = []
    for instant in INSTANTS:
        x, value, fine, coarse = dimple.deviations(instant, "film")
        inside = dimple.is_inside(instant, x)
        for name, chosen, aim in (("outside", ~inside, OUTSIDE), ("inside", inside, INSIDE)):
            if not chosen.any():
                continue
            off = np.abs(fine / value - 1)[chosen]
            fined = np.abs((fine + (fine - coarse) / 3) / value - 1)[chosen]
            row = {
                "instant": instant,
                "dimple": name,
                "points": chosen.sum(),
                "worst, %": 100 * off.max(),
                "rms, %": 100 * np.sqrt(np.mean(off**2)),
                "worst at mesh size 0, %": 100 * fined.max(),
                "aim, %": 100 * aim,
                "reached": "yes" if off.max() <= aim else "no",
            }
            rows.append(row)
    caption = "Film beside the published simulation, instants of pure rolling"
    return Table("mourier_film", caption, pd.DataFrame(rows))


def line_figure(dimple: Dimple) -> Figure:
    """Draw film and pressure at both instants with what was published."""
    figure = Figure(figsize=(9.0, 5.6), layout="constrained")
    panels = figure.subplots(2, len(INSTANTS), sharex=True, sharey="row")
    for column, instant in enumerate(INSTANTS):
        line = dimple.lines[instant]
        for axes, quantity in zip(panels[:, column], ("film", "pressure"), strict=True):
            axes.plot(line.x_um, getattr(line, quantity), color=COLOURS[0], label="this code")
            x, value = centre_line("simulated", instant, quantity)
            axes.plot(x, value, "o", color=COLOURS[1], markersize=3.5, label="published simulation")
        x, value = centre_line("measured", instant, "film")
        panels[0, column].plot(x, value, "+", color="0.4", markersize=5, label="measured")
        panels[0, column].set_title(f"instant {instant}", fontsize=10)
        panels[1, column].set_xlabel("x, um")
    panels[0, 0].set_xlim(-175, 175)
    panels[0, 0].set_ylim(0, 450)
    panels[0, 0].set_ylabel("film, nm")
    panels[1, 0].set_ylabel("pressure, MPa")
    panels[0, 0].legend(fontsize=8, frameon=False, loc="lower center")
    return figure


def _text(dimple: Dimple) -> list[str]:
    x, value = (np.array(one) for one in centre_line("measured", 4, "film"))
    outside = ~dimple.is_inside(4, x) & (np.abs(x) < PLATEAU_UM)
    off = 100 * (dimple.lines[4].at("film", x)[outside] / value[outside] - 1)
    x, value, fine, coarse = dimple.deviations(4, "pressure")
    under = np.abs(x) < PLATEAU_UM
    pressure = float(np.abs(fine - value)[under].max())
    x, value, fine, coarse = dimple.deviations(4, "film")
    grid = 100 * float(np.abs((fine - coarse) / 3 / fine).max())
    return [
        "Mourier, Mazuyer, Lubrecht and Donnet (2006) moved a dimple through a circular contact "
        "(M = 63.8, L = 5.79, ph = 383 MPa) and simulated it with a depth of 175 nm. The same "
        "surface, d cos(pi q/2) exp(-2 q^2), is moved through this program's contact as a "
        "measured surface, until the film has the dimple where the published film has it (middle "
        "of the two crossings of half its height; the dimple of the surface is at "
        f"{dimple.centre_um:.1f} um then). At instant 1 the dimple is outside the contact: smooth "
        "steady state. Film and pressure are compared at the digitised points, none left out and "
        "none moved.",
        f"Own errors: mesh and time step, 64 cells in a against 32, at most {grid:.1f} % of the "
        "film at these points; the domain, X from -4 to 1.5 and |Y| to 3 with P = 0 at its edges, "
        f"makes the central film {100 * dimple.domain_error:.1f} % thinner than X from -10 and |Y| "
        "to 6. The last columns of the points say by how many um a curve would have to move to "
        "meet them: on the flanks of inlet, outlet and dimple one or two um, as much as the two "
        "published instants differ from each other there, are several per cent.",
        f"Under the contact, |x| below {PLATEAU_UM} um, pressures are within {pressure:.1f} MPa at "
        "instant 4; where they fall from the spike to zero within 20 um the published curve is "
        "up to 3 um away. The film is "
        f"{off.mean():+.1f} % off the measured one outside the dimple in the mean of |x| below "
        f"{PLATEAU_UM} um, with a scatter of {off.std():.1f} %.",
    ]
