"""Where waves touch and the solver converges, over speed, wavelength and S of a line contact."""

import argparse
import sys
import tempfile
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from ehlwave.results.figures import COLOURS
from ehlwave.writing import Writer
from studies import touching, touching_steady
from studies.judged.runs import kept

AMPLITUDE_M = 2e-7
CELLS = 128
SPEEDS = (0.003, 0.01, 0.03, 0.1, 0.3)
WAVELENGTHS = (0.5, 1.0, 2.0)
SLIPS = (0.0, 0.25, 0.5, 1.0, 1.5, 2.0)
_POINTS = list(product(WAVELENGTHS, SLIPS, SPEEDS))
_KEYS = (
    *("status", "message", "touching_share", "touching_share_error", "touching_is_artefact"),
    *("touching_area", "mean_film_um", "residual", "time_steps", "nonlinear_steps"),
    *("counted_work_units", "expected_work_units"),
)


def solve(number: int, _folder: Path) -> dict[str, Any]:
    """Compute a point of the map."""
    length, slip, speed = _POINTS[number]
    groups = touching_steady.groups_of("smooth", 0.5, CELLS)
    groups["conditions"] |= {"mean_speed_m_per_s": speed, "slip_parameter": slip}
    groups["touching"] = {"film_m": touching.BOUNDARY_M}
    wave = {"orientation": "transverse", "wavelength_over_a": length, "amplitude_m": AMPLITUDE_M}
    with tempfile.TemporaryDirectory() as name:
        found = touching.solve(groups | {"waviness": wave}, Path(name))
    point = {"wavelength_over_a": length, "slip": slip, "speed_m_per_s": speed}
    return point | {key: found.get(key) for key in _KEYS}


def outcome(row: dict[str, Any]) -> str:
    """Return the class of a point."""
    if row["touching_share"] is None:
        return NOT_CONVERGED
    if row["touching_is_artefact"]:
        return "share falls with the mesh"
    if row["status"] != "converged":
        return "mesh too coarse"
    error = row["touching_share_error"]
    if error is None or 0 < row["touching_share"] <= error:
        return "share within its error"
    return "touches" if row["touching_share"] > 0 else "does not touch"


NOT_CONVERGED = "not converged"
_MARKS = {
    "touches": ("o", 0),
    "does not touch": (".", 0),
    "share within its error": ("s", 1),
    "share falls with the mesh": ("^", 2),
    "mesh too coarse": ("D", 3),
    NOT_CONVERGED: ("x", 4),
}


def figure(rows: list[dict[str, Any]]) -> Figure:
    """Draw the outcome at all points, a panel for each wavelength, with the share beside it."""
    drawn = Figure(figsize=(7.2, 3.3), layout="constrained")
    panels = np.atleast_1d(drawn.subplots(1, len(WAVELENGTHS), sharey=True))
    for axes, length in zip(panels, WAVELENGTHS, strict=True):
        here = [row for row in rows if row["wavelength_over_a"] == length]
        for name, (mark, colour) in _MARKS.items():
            at = [(row["speed_m_per_s"], row["slip"]) for row in here if outcome(row) == name]
            x, y = zip(*at, strict=True) if at else ((), ())
            axes.plot(x, y, mark, color=COLOURS[colour], ms=5, mfc="none", label=name)
        for row in here:
            if row["touching_share"] is not None:
                text = f"{row['touching_share']:.2f}"
                where = (row["speed_m_per_s"], row["slip"])
                axes.annotate(text, where, (0, 5), textcoords="offset points", size=6, ha="center")
        axes.set(xscale="log", title=f"wavelength {length:g} b", xlabel="mean speed, m/s")
        axes.set(xlim=(SPEEDS[0] / 2, 2 * SPEEDS[-1]), ylim=(-0.2, 2.3))
    panels[0].set_ylabel("S")
    handles, labels = panels[0].get_legend_handles_labels()
    drawn.legend(handles, labels, loc="outside lower center", ncols=3, frameon=False, fontsize=8)
    return drawn


def main() -> int:
    """Compute the points that the record lacks, and draw."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--record", type=Path, required=True, help="lines of JSON; goes on")
    options = parser.parse_args()
    rows = kept(options.record, range(len(_POINTS)), solve, 1)
    table = pd.DataFrame(rows)
    table["outcome"] = [outcome(row) for row in rows]
    drawn = options.record.with_suffix(".png")
    Writer(overwrite=True).figure(drawn, figure(rows), dpi=150)
    counts = table.groupby("wavelength_over_a").outcome.value_counts().unstack(fill_value=0)
    sys.stdout.write(counts.to_string() + "\n")
    return int((table.outcome == NOT_CONVERGED).any())


if __name__ == "__main__":
    sys.exit(main())
