"""Contacts one behind another on one track, to which no oil comes back: theory (C5) and (C6).

Each contact is offered what the one before left behind, all across. The films are compared with
those that know the middle of the track only.
"""

import tempfile
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from ehlwave.contact.formula import power_ratio
from ehlwave.contact.oils import Oil
from ehlwave.contact.starvation import FILM_RANGES, film_sharpness
from ehlwave.errors import ResultsError
from ehlwave.hdf5 import opened
from ehlwave.laws.replenishment import after_overrollings, fluidity_integral
from ehlwave.programs.programs import namelist
from ehlwave.results.figures import write_figure
from ehlwave.writing import Writer
from studies.programs import last_line, run
from studies.sweeps import Row, write_rows

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class TrackOfContacts:
    """M, L and D, what the first contact is offered over what it passes flooded, and how many."""

    m: float
    l: float
    d: float
    start: float
    count: int

    @property
    def name(self) -> str:
        """For tables and figures."""
        return f"M {self.m:g}, L {self.l:g}, D {self.d:g}, r {self.start:g}"


ROWS = (
    TrackOfContacts(100, 12.05, 1, 2, 15),
    TrackOfContacts(100, 12.05, 1, 0.6, 15),
    TrackOfContacts(300, 8, 0.3, 1, 15),
    TrackOfContacts(100, 12.05, 1, 0.25, 60),
)
"""The last one is thin enough for the flow to the sides inside the contact to rule."""


def contact_behind(track: TrackOfContacts, profile: Path | None, cells: int, folder: Path) -> Row:
    """Compute one contact; return its results, Y, and the layers before and behind it."""
    inlet: Row = {"oil_over_flooded": track.start}
    if profile is not None:
        inlet["oil_profile"] = str(profile)
    grid = {"x_min": -4.5, "x_max": 1.5, "y_max": 2, "cells_x": 6 * cells, "cells_y": 4 * cells}
    groups: dict[str, Row] = {
        "conditions": {
            "load_parameter_m": track.m,
            "lubricant_parameter_l": track.l,
            "radius_ratio_d": track.d,
        },
        "grid": {**grid, "edges": "flooded"},
        "inlet": inlet,
    }
    case, output = folder / "case.nml", folder / "case.h5"
    Writer(overwrite=True).text(case, namelist(groups))
    done = run("case", case, "--json", "--quiet", "--overwrite", "--output", output)
    if done.returncode != 0:
        raise ResultsError(f"{track.name}: {(done.stdout + done.stderr).strip()}")
    result: Row = last_line(done)
    with opened(output) as file:
        for name in ("y", "layer_offered", "layer_behind"):
            result[name] = file[name][()]
    return result


def follow(track: TrackOfContacts, cells: int) -> list[Row]:
    """Return film and layers of the contacts of a track, the first one first."""
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as folder:
        profile, whole = None, 0.0
        for n in range(1, track.count + 1):
            found = contact_behind(track, profile, cells, Path(folder))
            middle = int(np.argmin(np.abs(found["y"])))
            offered, behind = found["layer_offered"], found["layer_behind"]
            whole = whole or float(offered[middle])
            rows.append(
                {
                    "track": track.name,
                    "overrolling": n,
                    "r": float(offered[middle]) / whole * track.start,
                    "R": found["film_over_flooded"],
                    "r_behind": float(behind[middle]) / whole * track.start,
                    "side_flow": found["side_flow"],
                    "mass_balance_error": found["mass_balance_error"],
                    "alphabar": found["alphabar"],
                    "lambdabar": found["lambdabar"],
                    "kappa": found["kappa"],
                    "layer": whole / track.start,
                }
            )
            profile = Path(folder, f"layer_{n}.csv")
            half = slice(middle, -1)  # the last row is the edge, where nothing is balanced
            lines = zip(found["y"][half], behind[half] / whole, strict=True)
            text = "\n".join(f"{y:.12g},{share:.12g}" for y, share in lines)
            Writer().text(profile, f"y_over_b,layer_over_given\n{text}\n")
    return rows


def side_loss(row: Row, r: Floats | float, share: float = 1.0) -> Floats:
    """Return the share of the layer that one overrolling drives to the sides, (C6).

    Or what a `share` of an overrolling does: half of it is upstream of the centre. With an
    overrolling's time l_t/(2 mean speed) in (C6), h_l^-2 grows by 2 kappa^2 I/lambdabar in
    units of the deformation, h_l = r times the layer that the flooded contact passes.
    """
    oil = Oil()
    fluidity = fluidity_integral(oil, row["alphabar"] / oil.pressure_viscosity_per_pa)
    growth = share * 2 * row["kappa"] ** 2 * fluidity / row["lambdabar"]
    return np.asarray(1 - (1 + growth * (np.asarray(r) * row["layer"]) ** 2) ** -0.5)


def inlet_loss(track: TrackOfContacts, r: Floats | float) -> Floats:
    """Return the share that the inlet pushes aside, 1 - (1 + r^g)^(-1/g), by the law for g."""
    known = np.maximum(r, FILM_RANGES["r"][0])
    g = film_sharpness(known, track.m, track.l, track.d)
    return np.asarray(1 - power_ratio(1 / np.asarray(r), g) / np.asarray(r))


def predicted(track: TrackOfContacts, row: Row, count: int) -> tuple[Floats, Floats]:
    """Return r behind each contact by the inlet alone, and by inlet and side flow.

    The law for R has all that is lost upstream of the centre. That is at least half of the side
    flow; the other half follows.
    """
    alone, both, behind = track.start, track.start, []
    for _ in range(count):
        alone *= 1 - float(inlet_loss(track, alone))
        both *= 1 - max(float(inlet_loss(track, both)), float(side_loss(row, both, 0.5)))
        both *= 1 - float(side_loss(row, both, 0.5))
        behind.append((alone, both))
    columns = np.array(behind)
    return columns[:, 0], columns[:, 1]


def compare(track: TrackOfContacts, rows: list[Row]) -> Row:
    """Return how far films and layers of a track are from (C5), (C6) and both together."""
    n = np.array([row["overrolling"] for row in rows], dtype=float)
    film = np.array([row["R"] for row in rows])
    behind = np.array([row["r_behind"] for row in rows])

    def misfit(g: Floats) -> Floats:
        return np.asarray(after_overrollings(track.start, n, float(g[0])) / film - 1)

    g = float(least_squares(misfit, (3.0,)).x[0])
    alone, both = predicted(track, rows[0], len(rows))
    first = 1 - behind[0] / track.start
    return {
        "track": track.name,
        "overrollings": len(rows),
        "R_first": film[0],
        "R_last": film[-1],
        "g_fitted": g,
        "closed_form_largest": float(np.abs(misfit(np.array([g]))).max()),
        "g_law": float(film_sharpness(track.start, track.m, track.l, track.d)),
        "inlet_largest": float(np.abs(alone / behind - 1).max()),
        "inlet_and_sides_largest": float(np.abs(both / behind - 1).max()),
        "loss_first": first,
        "loss_first_inlet": float(inlet_loss(track, track.start)),
        "loss_first_sides": float(side_loss(rows[0], track.start)),
        "mass_balance_largest": max(row["mass_balance_error"] for row in rows),
    }


def report_overrollings(folder: Path, cells: int) -> list[Row]:
    """Compute the tracks; write overrollings.csv, tracks.csv and the figure."""
    every, compared = [], []
    for track in ROWS:
        rows = follow(track, cells)
        every += rows
        compared.append(compare(track, rows))
    write_rows(folder / "overrollings.csv", every, digits=5)
    write_rows(folder / "tracks.csv", compared, digits=4)
    draw(folder, every)
    return compared


def draw(folder: Path, rows: list[Row]) -> None:
    """Draw the layer behind each contact over the overrollings, computed and by both losses."""
    figure, panels = plt.subplots(2, 2, figsize=(9, 6.5), layout="constrained")
    for axes, track in zip(panels.flat, ROWS, strict=True):
        own = [row for row in rows if row["track"] == track.name]
        n = np.array([row["overrolling"] for row in own])
        alone, both = predicted(track, own[0], len(own))
        axes.plot(n, [row["r_behind"] for row in own], "o", ms=3, label="computed")
        axes.plot(n, alone, "--", label="inlet, (C5)")
        axes.plot(n, both, "-", label="inlet and sides, (C5) and (C6)")
        axes.set(title=track.name, xlabel="overrollings", ylabel="r behind the contact, Y = 0")
    panels.flat[0].legend()
    write_figure(figure, folder, "overrollings", writer=Writer(overwrite=True))
    plt.close(figure)
