"""Steps of ``scripts/study starvation``: laws of film and waves of contacts with too little oil."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from ehlwave.contact.formula import power_ratio, recommended_parameter, recommended_sharpness
from ehlwave.contact.formula import wave_and_direction as direction_of
from ehlwave.contact.starvation import FILM_COEFFICIENTS, WAVE_COEFFICIENTS
from ehlwave.results.figures import write_figure
from ehlwave.writing import Writer
from studies.folds import Law, fitted, held_out
from studies.sweeps import Row, read_sweep, run_command, write_rows, write_sweep

Floats = NDArray[np.float64]

OIL = (0.2, 0.35, 0.5, 0.65, 0.8, 1, 1.25, 1.6, 2.2, 3, 5)
OIL_OF_WAVES = (0.4, 0.5, 0.65, 0.8, 1, 1.6, 4)
WAVES = (
    *(("transverse", wave) for wave in (0.25, 0.5, 1.0, 2.0)),
    *((orientation, wave) for orientation in ("isotropic", "longitudinal") for wave in (0.5, 1.0)),
)
SAMPLES = 200
"""Resamples of contacts for the intervals."""


def contacts(count: int, low: Sequence[float], high: Sequence[float]) -> list[Row]:
    """Return contacts spread over M, L and D: M and D in their logarithms."""
    rng = np.random.default_rng(37)
    place = np.column_stack([(rng.permutation(count) + rng.random(count)) / count for _ in low])
    m = low[0] * (high[0] / low[0]) ** place[:, 0]
    l = low[1] + (high[1] - low[1]) * place[:, 1]
    d = low[2] * (high[2] / low[2]) ** place[:, 2]
    names = ("load_parameter_m", "lubricant_parameter_l", "radius_ratio_d")
    return [
        dict(zip(names, (float(f"{value:.4g}") for value in row), strict=True))
        for row in zip(m, l, d, strict=True)
    ]


def write_cases(folder: Path, count: int, cells: int) -> None:
    """Write both sweeps: films of `count` contacts, waves of half as many.

    Waves have `cells` along X, which resolves the meniscus (theory eq. (C8)), films two thirds of
    that. Waves of flooded contacts on the same domain are for the figure.
    """
    grid = {"cells_x": cells, "cells_y": 0, "largest_cells": cells, "x_min": -4.5}
    grid |= {"edges": "flooded"}
    films = [
        contact | {"oil_over_flooded": r}
        for contact in contacts(count, (20, 2, 0.1), (1000, 20, 1))
        for r in OIL
    ]
    waves = [
        contact | oil | {"orientation": orientation, "wavelength_over_a": wave}
        for contact in contacts(max(count // 2, 2), (50, 4, 0.1), (800, 18, 1))
        for oil in ({}, *({"oil_over_flooded": r} for r in OIL_OF_WAVES))
        for orientation, wave in WAVES
    ]
    write_sweep(folder, "films", films, {"grid": {**grid, "cells_x": 2 * cells // 3}})
    write_sweep(folder, "waves", waves, {"grid": grid, "waviness": {"response": "harmonic"}})


def usable(rows: list[Row], *, is_flooded: bool = False) -> dict[str, Floats]:
    """Return the columns of the cases that converged and whose meniscus is inside the domain.

    Or the flooded contacts: their film over the flooded film is 1.
    """

    def counts(row: Row) -> bool:
        if is_flooded:
            return not np.isfinite(row["oil_offered"])
        return bool(row["meniscus_x"] > row["domain_x_min"] + 0.3)

    good = [row for row in rows if row["status"] == "converged" and counts(row)]
    if is_flooded:
        good = [row | {"film_over_flooded": 1.0} for row in good]
    names = [name for name, value in good[0].items() if isinstance(value, (int, float))]
    return {name: np.array([row[name] for row in good], dtype=float) for name in names}


def film_law(c: dict[str, Floats]) -> Law:
    """Return R by five coefficients."""

    def law(p: Floats) -> Floats:
        m, l, d, r = (c[name] for name in _OF_FILMS)
        g = np.exp(p[0]) * (m / 100) ** p[1] * (l / 10) ** p[2] * d ** p[3] * (1 + r) ** p[4]
        return power_ratio(1 / r, g)

    return law


def constant_law(c: dict[str, Floats]) -> Law:
    """Return R with a common g."""
    return lambda p: power_ratio(1 / c["oil_over_flooded"], p[0])


def wave_law(c: dict[str, Floats]) -> Law:
    """Return Ad/Ai: the flooded formula, its parameter, sharpness and itself with powers of R."""
    x, n, along = wave_parameters(c)
    ratio = c["film_over_flooded"]

    def law(p: Floats) -> Floats:
        parameter = p[3] * x * ratio ** -(p[0] + p[1] * along)
        return power_ratio(parameter, n * ratio ** p[2]) ** (ratio ** -p[4])

    return law


def wave_parameters(c: dict[str, Floats]) -> tuple[Floats, Floats, Floats]:
    """Return x and n of the flooded formula and cos^2(theta)."""
    lengths = c["wavelength_x_over_a"], c["wavelength_y_over_a"]
    m, l = c["load_parameter_m"], c["lubricant_parameter_l"]
    x = recommended_parameter(m, l, c["gamma"], *lengths)
    return x, recommended_sharpness(l), direction_of(*lengths)[1]


_OF_FILMS = ("load_parameter_m", "lubricant_parameter_l", "radius_ratio_d", "oil_over_flooded")


def fit(name: str, law: Law, y: Floats, contact: Floats, start: Sequence[float]) -> Row:
    """Fit a law; return coefficients, intervals by drawing contacts again, and errors.

    Errors are held out: each contact is predicted by a fit to the others.
    """
    best, held = held_out(law, y, start, contact)
    rows_of = {one: np.flatnonzero(contact == one) for one in np.unique(contact)}
    rng = np.random.default_rng(1)
    drawn = [
        fitted(law, y, best, np.concatenate([rows_of[one] for one in names]))
        for names in (rng.choice(list(rows_of), len(rows_of)) for _ in range(SAMPLES))
    ]
    low, high = np.percentile(drawn, (2.5, 97.5), axis=0)
    row: Row = {"law": name, "points": len(y), "contacts": len(rows_of)}
    for k, value in enumerate(best):
        row |= {f"c{k}": float(value), f"c{k}_low": float(low[k]), f"c{k}_high": float(high[k])}
    row["rms"] = float(np.sqrt(np.mean((law(best) - y) ** 2)))
    return row | {
        "rms_held_out": float(np.sqrt(np.mean(held**2))),
        "largest_held_out": float(np.abs(held).max()),
    }


def report(folder: Path) -> None:
    """Fit the laws, write laws.csv and the figures, print a line for each law."""
    every = {name: read_sweep(folder, name) for name in ("films", "waves")}
    films, waves = (usable(rows) for rows in every.values())
    rows = []
    of_films = np.array([f"{a} {b} {c}" for a, b, c in zip(*_contact(films), strict=True)])
    of_waves = np.array([f"{a} {b} {c}" for a, b, c in zip(*_contact(waves), strict=True)])
    ratio = films["film_over_flooded"]
    rows.append(fit("R, one g", constant_law(films), ratio, of_films, (3.0,)))
    rows.append(fit("R", film_law(films), ratio, of_films, FILM_COEFFICIENTS))
    responses = waves["harmonic_extrapolated"]
    rows.append(fit("Ad/Ai", wave_law(waves), responses, of_waves, WAVE_COEFFICIENTS))
    write_rows(folder / "laws.csv", rows, digits=5)
    for row in rows:
        print(
            f"{row['law']:9} {row['points']} points of {row['contacts']} contacts: "
            f"rms {row['rms']:.4f}, held out {row['rms_held_out']:.4f}, "
            f"largest {row['largest_held_out']:.3f}; "
            + ", ".join(f"{row[f'c{k}']:.4g}" for k in range(5) if f"c{k}" in row)
        )
    _draw(folder, films, waves, usable(every["waves"], is_flooded=True), rows)


def _contact(c: dict[str, Floats]) -> list[Floats]:
    return [c[name] for name in _OF_FILMS[:3]]


def _draw(
    folder: Path,
    films: dict[str, Floats],
    waves: dict[str, Floats],
    flooded: dict[str, Floats],
    rows: list[Row],
) -> None:
    """Draw R over r and over the law, waves over x of the flooded contact and over x with R."""
    figure, panels = plt.subplots(2, 2, figsize=(10, 8.5), layout="constrained")
    _draw_films(panels[0], films, np.array([rows[1][f"c{k}"] for k in range(5)]))
    _draw_waves(panels[1], waves, flooded, np.array([rows[2][f"c{k}"] for k in range(5)]))
    write_figure(figure, folder, "starvation", writer=Writer(overwrite=True))
    plt.close(figure)


def _draw_films(panels: Sequence[Axes], films: dict[str, Floats], best: Floats) -> None:
    left, right = panels
    of_oil, ratio = films["oil_offered"], films["film_over_flooded"]
    dots = left.scatter(of_oil, ratio, c=np.log10(films["gamma"] * films["load_parameter_m"]), s=8)
    left.figure.colorbar(dots, label="log10(gamma M)")
    r = np.geomspace(0.2, 5, 100)
    for g in (2.0, 8.0):
        left.plot(r, power_ratio(1 / r, g), color="0.4", linewidth=0.8)
        left.annotate(f"g = {g:g}", (1, float(power_ratio(1.0, g))), fontsize=8)
    left.set(xscale="log", xlabel="r, oil offered over oil passed flooded", ylabel="R computed")
    ticks = (0.2, 0.5, 1.0, 2.0, 5.0)
    left.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    left.minorticks_off()
    right.plot([0, 1], [0, 1], color="0.7")
    right.scatter(film_law(films)(best), ratio, s=8)
    right.set(xlabel="R by the law", ylabel="R computed")


def _draw_waves(
    panels: Sequence[Axes], waves: dict[str, Floats], flooded: dict[str, Floats], p: Floats
) -> None:
    """Flooded and starved contacts: apart over x, on a single curve over x with the power of R."""
    for axes, power in zip(panels, (0.0, 1.0), strict=True):
        for c, marker in ((waves, "o"), (flooded, "x")):
            x, n, along = wave_parameters(c)
            ratio = c["film_over_flooded"]
            place = x * (p[3] * ratio ** -(p[0] + p[1] * along)) ** power
            response = c["harmonic_extrapolated"]
            look: dict[str, Any] = {"s": 9, "cmap": "viridis", "vmin": 0.35, "vmax": 1.0}
            look["marker"] = marker
            name = "flooded" if c is flooded else "starved"
            dots = axes.scatter(place, response, c=ratio, label=name, linewidths=0.8, **look)
        line = np.geomspace(0.02, 20, 200)
        for film, style in ((1.0, "-"), (0.6, "--"), (0.4, ":")) if power else ((1.0, "-"),):
            curve = power_ratio(line, float(np.median(n)) * film ** (p[2] * power))
            curve = curve ** (film ** -(p[4] * power))
            axes.plot(line, curve, style, color="0.3", linewidth=0.9, label=f"law, R = {film:g}")
        axes.set(xscale="log", xlim=(0.02, 20), ylabel="Ad/Ai computed")
        axes.legend(fontsize=8)
    panels[0].set(xlabel="x of the flooded contact")
    panels[1].set(xlabel="x of the starved contact, with its power of R")
    panels[1].figure.colorbar(dots, label="R")


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the sweeps or report on their results."""
    parser = argparse.ArgumentParser("a step of scripts/study starvation", description=__doc__)
    parser.add_argument("step", choices=("cases", "report"))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--contacts", type=int, default=30)
    parser.add_argument("--cells", type=int, default=384)
    return run_command(parser, _run, arguments)


def _run(options: argparse.Namespace) -> None:
    if options.step == "cases":
        write_cases(options.folder, options.contacts, options.cells)
    else:
        report(options.folder)


if __name__ == "__main__":
    sys.exit(main())
