"""Errors of film formulas over a map of M, L and D: section of the page."""

from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from ehlwave.results.figures import COLOURS
from studies.section import Picture, Section, Table
from studies.validation.film_map import LARGEST_ERROR, LOADS, LUBRICANTS, RATIOS, films
from studies.validation.formulas import CENTRAL, SMALLEST, G

_FORMULAS = {
    **{("central", name): formula for name, formula in CENTRAL.items()},
    **{("smallest", name): formula for name, formula in SMALLEST.items()},
}


def section(folder: Path) -> Section:
    """Return the part of the page about formulas; runs in `folder` what is not there yet."""
    found = films(folder)
    summary, points = summary_table(found), point_table(found)
    left_out = len(LOADS) * len(LUBRICANTS) * len(RATIOS) - len(found)
    largest = found["central_error"].max()
    text = [
        f"Steady states of smooth surfaces at {len(found)} conditions (M {LOADS[0]} to "
        f"{LOADS[-1]}, L {LUBRICANTS[0]:g} to {LUBRICANTS[-1]}, D {RATIOS[0]} to {RATIOS[-1]}; "
        f"Roelands, z = 0.68, Dowson-Higginson, alpha E' = {G:.0f}), beside the formulas in use. "
        "Films are extrapolated from 128 x 128 and 256 x 256 cells and corrected by the ratio of "
        "a domain twice as long and wide to this one on equal mesh size; the error of the central "
        f"films is at most {100 * largest:.1f} %. {left_out} of the map are left out, because the "
        "fine grid does not resolve them or their error is above "
        f"{100 * LARGEST_ERROR:.0f} %.",
        "The formulas were fitted to the solutions of their time, on far coarser grids and with "
        "other oils; Nijenbanning, Venner and Moes join asymptotes. A deviation is what a user of "
        "the formula has to expect, and says little about this program.",
    ]
    caption = "Formula over computed film, less 1, against M. Colours: L; markers: D"
    return Section(
        "Film formulas", text, [summary, points], [Picture("films", caption, figure(found))]
    )


def deviations(found: pd.DataFrame) -> pd.DataFrame:
    """Return formula over computed film, less 1, in per cent: a column for each kind and name."""
    return pd.DataFrame(
        {
            (kind, name): 100 * (np.vectorize(formula)(found.m, found.l, found.d) / found[kind] - 1)
            for (kind, name), formula in _FORMULAS.items()
        }
    )


def summary_table(found: pd.DataFrame) -> Table:
    """Return mean, rms and worst deviation of each formula for each D and over the map."""
    rows = []
    for (kind, name), deviation in deviations(found).items():
        for d in (*RATIOS, "all"):
            off = deviation if d == "all" else deviation[found.d == d]
            row = {
                "film": kind,
                "formula": name,
                "D": d,
                "conditions": off.size,
                "mean, %": off.mean(),
                "rms, %": np.sqrt(np.mean(off**2)),
                "worst, %": off[off.abs().idxmax()],
            }
            rows.append(row)
    return Table("films", "Formula over computed film, less 1", pd.DataFrame(rows))


def point_table(found: pd.DataFrame) -> Table:
    """Return every condition with its films, their errors and the deviations of all formulas."""
    data = found.assign(
        central_error=100 * found.central_error, smallest_error=100 * found.smallest_error
    )
    headings = ["M", "L", "D", "central", "error of it, %", "smallest", "error of that, %"]
    off = deviations(found)
    headings += [f"{kind}: {name}, %" for kind, name in off]
    return Table(
        "film_points",
        "Computed films, (h/Rx)(2U)^(-1/2), their errors, and formula over computed film, less 1",
        pd.concat([data, off], axis=1).set_axis(headings, axis=1),
        is_long=True,
    )


def figure(found: pd.DataFrame) -> Figure:
    """Draw the deviations of every formula against M."""
    drawn = Figure(figsize=(11.0, 3.0), layout="constrained")
    panels = drawn.subplots(1, len(_FORMULAS), sharey=True)
    for axes, ((kind, name), off) in zip(panels, deviations(found).items(), strict=True):
        for (colour, l), (marker, d) in product(
            zip(COLOURS, LUBRICANTS, strict=False), zip("os^", RATIOS, strict=True)
        ):
            some = (found.l == l) & (found.d == d)
            style = {"color": colour, "markersize": 3.5, "label": f"L = {l:g}, D = {d:g}"}
            axes.plot(found.m[some], off[some], marker, **style)
        axes.axhline(0, color="black", linewidth=0.6)
        axes.set_xscale("log")
        axes.set_xticks(LOADS, [str(m) for m in LOADS], fontsize=7)
        axes.minorticks_off()
        axes.set_xlabel("M")
        axes.set_title(f"{name}, {kind}", fontsize=7.5)
    panels[0].set_ylabel("formula less computed, %")
    handles, labels = panels[0].get_legend_handles_labels()
    drawn.legend(handles, labels, fontsize=7, frameon=False, loc="outside right center")
    return drawn
