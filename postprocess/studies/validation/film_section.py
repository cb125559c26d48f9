"""What film formulas miss by over a map of M, L and D: section of the page."""

from itertools import product
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from ehlwave_post.figures import COLOURS
from studies.section import Cell, Picture, Section, Table
from studies.validation.film_map import LARGEST_ERROR, LOADS, LUBRICANTS, RATIOS, Film, films
from studies.validation.formulas import CENTRAL, SMALLEST, G

_KINDS = {"central": CENTRAL, "smallest": SMALLEST}


def section(folder: Path) -> Section:
    """Return the part of the page about formulas; runs in `folder` what is not there yet."""
    found = films(folder)
    summary, points = summary_table(found), point_table(found)
    left_out = len(LOADS) * len(LUBRICANTS) * len(RATIOS) - len(found)
    largest = max(one.central_error for one in found)
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


def summary_table(found: list[Film]) -> Table:
    """Return mean, rms and worst deviation of each formula for each D and over the map."""
    rows: list[tuple[Cell, ...]] = []
    for kind, formulas in _KINDS.items():
        for name in formulas:
            for d in (*RATIOS, None):
                off = np.array([_deviation(kind, name, one) for one in found if d in (None, one.d)])
                rows.append(
                    (
                        *(kind, name, "all" if d is None else d, off.size, 100 * float(off.mean())),
                        100 * float(np.sqrt(np.mean(off**2))),
                        100 * float(off[np.abs(off).argmax()]),
                    )
                )
    return Table(
        "films",
        "Formula over computed film, less 1",
        ("film", "formula", "D", "conditions", "mean, %", "rms, %", "worst, %"),
        rows,
    )


def point_table(found: list[Film]) -> Table:
    """Return every condition with its films, their errors and the deviations of all formulas."""
    names = [(kind, name) for kind, some in _KINDS.items() for name in some]
    rows = [
        (
            *(one.m, one.l, one.d, one.central, 100 * one.central_error),
            *(one.smallest, 100 * one.smallest_error),
            *(100 * _deviation(kind, name, one) for kind, name in names),
        )
        for one in found
    ]
    return Table(
        "film_points",
        "Computed films, (h/Rx)(2U)^(-1/2), their errors, and formula over computed film, less 1",
        (
            *("M", "L", "D", "central", "error, %", "smallest", "error, %"),
            *(f"{kind}: {name}, %" for kind, name in names),
        ),
        rows,
        is_long=True,
    )


def figure(found: list[Film]) -> Figure:
    """Draw the deviations of every formula against M."""
    names = [(kind, name) for kind, some in _KINDS.items() for name in some]
    drawn = Figure(figsize=(11.0, 3.0), layout="constrained")
    panels = drawn.subplots(1, len(names), sharey=True)
    for axes, (kind, name) in zip(panels, names, strict=True):
        for (colour, l), (marker, d) in product(
            zip(COLOURS, LUBRICANTS, strict=False), zip("os^", RATIOS, strict=True)
        ):
            some = [one for one in found if (one.l, one.d) == (l, d)]
            off = [100 * _deviation(kind, name, one) for one in some]
            label = f"L = {l:g}, D = {d:g}"
            axes.plot(
                [one.m for one in some], off, marker, color=colour, markersize=3.5, label=label
            )
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


def _deviation(kind: str, name: str, film: Film) -> float:
    return _KINDS[kind][name](film.m, film.l, film.d) / getattr(film, kind) - 1
