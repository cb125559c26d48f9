"""Mean films of rough contacts in pure rolling by marches, beside predictions.

The mean film of a march over the film of the same smooth contact on the same mesh, and the same
ratio by ``Contact.deform``. Surfaces may touch; a march whose share of the load on the solids falls
with the mesh size does not decide whether they do.
"""

import argparse
import math
import random
import sys
import tempfile
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

import ehlwave
from ehlwave.results.figures import COLOURS
from ehlwave.writing import Writer
from studies import touching
from studies.judged.runs import kept, read_rows

Groups = dict[str, dict[str, Any]]

_STEP = 0.02
"""Step of predicted heights over the half width."""
_WAVES = 40
_THINNEST = 2
"""Smooth film over the boundary film, so that smooth surfaces do not touch."""
FIRST_THIN, _THICKEST = 1001, 3
"""First number of rough contacts with thin films, most of which touch; their smooth film over the
boundary film, at most."""
_WITHIN = 0.95
"""Share of the films that must be within their error."""
_TOUCHES = 1e-4
"""Share of the load from which on a march touches."""


def draw(number: int) -> tuple[str, Groups, float]:
    """Return the kind of a rolling contact, its groups with waves, and its half width in metres."""
    chance = random.Random(1000 + number)
    is_line = number % 2 == 1
    film, thickest, least_rq = 0.0, math.inf, 0.5
    if number >= FIRST_THIN:
        thickest, least_rq = _THICKEST, 1.5
    while not _THINNEST <= film / touching.BOUNDARY_M <= thickest:
        conditions, width, film = touching.contact(chance, is_line=is_line)
    conditions["slip_parameter"] = 1
    groups = touching.smooth_case(conditions, 192 if is_line else 48, is_line=is_line)
    rq = film * math.exp(chance.uniform(math.log(least_rq), math.log(2)))
    kinds = ["transverse"] if is_line else ["transverse", "isotropic", "longitudinal"]
    orientation = chance.choice(kinds)
    is_pair = chance.random() < 0.4 and is_line
    length = round(chance.uniform(0.5 if is_line else 0.8, 1.5), 2)
    amplitude = rq * math.sqrt((4 if orientation == "isotropic" else 2) / (1 + is_pair))
    wave = {"orientation": orientation, "amplitude_m": amplitude}
    groups["waviness"] = wave | {"wavelength_over_a": length}
    if is_pair:
        groups["waviness2"] = wave | {"wavelength_over_a": length / 2}
    kind = f"{'line' if is_line else 'ball'} {'pair' if is_pair else 'wave'} {orientation}"
    return f"{kind}, Rq/film {rq / film:.2f}", groups, width


def march(number: int, _folder: Path) -> dict[str, Any]:
    """Return the mean film of a march over the smooth film, and what touches."""
    kind, groups, _ = draw(number)
    with tempfile.TemporaryDirectory() as name:
        rough = touching.solve(groups, Path(name))
    smooth = {key: keys for key, keys in groups.items() if "waviness" not in key}
    with tempfile.TemporaryDirectory() as name:
        even = touching.solve(smooth, Path(name))
    keys = ("status", "message", "touching_share", "touching_share_error", "touching_is_artefact")
    entry = {"kind": kind} | {key: rough.get(key) for key in keys}
    films = {"film_um": rough.get("mean_film_um"), "smooth_film_um": even.get("mean_film_um")}
    return entry | films | {"seconds": rough.get("seconds")}


def heights_of(groups: Groups, width: float) -> np.ndarray[Any, Any]:
    """Return heights of the waves, (along, across), m: the gap is largest where x = y = 0."""
    x = _STEP * width * np.arange(round(_WAVES / _STEP))
    is_line = "radius_y_m" not in groups["conditions"]
    y = np.zeros(1) if is_line else _STEP * 4 * width * np.arange(200)
    x = x if is_line else x[::4]
    total = np.zeros((len(x), len(y)))
    for name in {"waviness", "waviness2"} & set(groups):
        k = 2 * math.pi / (groups[name]["wavelength_over_a"] * width)
        along, across = np.cos(k * x)[:, None], np.cos(k * y)[None, :]
        turned = groups[name]["orientation"]
        shape = {"transverse": along + 0 * across, "longitudinal": across + 0 * along}
        total -= groups[name]["amplitude_m"] * shape.get(turned, along * across)
    return total


def predict(number: int) -> dict[str, Any]:
    """Return the ratio of the films, its error, and whether the surfaces touch, without a march."""
    _, groups, width = draw(number)
    contact = ehlwave.Contact(**groups["conditions"], **groups["lubricant"])
    heights = heights_of(groups, width)
    is_line = heights.shape[1] == 1
    step = _STEP * width * (1 if is_line else 4)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ehlwave.ExtrapolationWarning)
        found = contact.deform(
            heights[:, 0] if is_line else heights.T,
            step=step,
            form="mean",
            boundary_film_m=touching.BOUNDARY_M,
        ).statistics
    smooth_m = found.mean_film_m - (found.mean_rise_m or 0.0)
    return {
        "predicted": found.mean_film_m / smooth_m,
        "error": found.lambda_errors["rise"],
        "by": found.mean_rise_by,
        "deformed_over_film": found.rq_after_m / smooth_m,
        "predicted_touches": found.surfaces_touch,
    }


def compare(entry: dict[str, Any]) -> dict[str, Any]:
    """Return a march beside its prediction; of a march that did not end only the march.

    It does not decide whether surfaces touch where the share is an artefact or below its error.
    """
    if entry["film_um"] is None or entry["smooth_film_um"] is None:
        return entry
    predicted = predict(entry["number"])
    off = predicted["predicted"] * entry["smooth_film_um"] / entry["film_um"] - 1
    share, error = entry["touching_share"], entry["touching_share_error"]
    touches = None if _TOUCHES < share <= error else share > _TOUCHES
    if entry["touching_is_artefact"]:
        touches = None
    return entry | predicted | {"off": off, "touches": touches}


def summary(entries: list[dict[str, Any]]) -> str:
    """Return how many films are within their error, and how often touching is right.

    Contacts rougher than the range of predictions do not count.
    """
    lines = []
    for name in ("line", "ball"):
        ended = [one for one in entries if one.get("by") and one["kind"].startswith(name)]
        within = sum(abs(one["off"]) <= one["error"] for one in ended)
        decided = [one for one in ended if one["touches"] is not None]
        right = sum(one["touches"] == one["predicted_touches"] for one in decided)
        largest = max((abs(one["off"]) for one in ended), default=math.nan)
        lines.append(
            f"{name}: {within} of {len(ended)} films within their error, at most "
            f"{100 * largest:.0f} % off; touching right in {right} of {len(decided)}"
        )
    return "\n".join(lines) + "\n"


def figure(compared: list[dict[str, Any]]) -> Figure:
    """Draw predicted over marched mean films, both over the smooth film, with declared errors."""
    drawn = Figure(figsize=(5.2, 4.2), layout="constrained")
    axes = drawn.subplots()
    kinds = {
        "lines, transverse": ("line", ".", 0),
        "points, transverse": ("ball wave transverse", "s", 1),
        "points, isotropic": ("ball wave isotropic", "o", 2),
        "points, longitudinal": ("ball wave longitudinal", "^", 3),
    }
    for label, (kind, mark, colour) in kinds.items():
        ended = [one for one in compared if one.get("by") and one["kind"].startswith(kind)]
        marched = [one["film_um"] / one["smooth_film_um"] for one in ended]
        found = [one["predicted"] for one in ended]
        error = [one["error"] * one["predicted"] for one in ended]
        axes.errorbar(
            marched,
            found,
            error,
            fmt=mark,
            label=label,
            color=COLOURS[colour],
            ms=4,
            mfc="none",
            lw=0.7,
        )
    axes.plot((1, 2.5), (1, 2.5), "-", color="0.6", lw=0.7, zorder=0)
    axes.set(xlabel="mean film over smooth film, marched", ylabel="predicted")
    axes.legend(frameon=False, fontsize=8)
    return drawn


def main() -> int:
    """Run the marches that the record lacks, compare and draw."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=40, help="contacts (default 40)")
    parser.add_argument("--thin", type=int, default=20, help="more of thin films (default 20)")
    parser.add_argument("--record", type=Path, required=True, help="lines of JSON; goes on")
    options = parser.parse_args()
    recorded = (row["number"] for row in read_rows(options.record))
    drawn = range(1, options.count + 1)
    thin = range(FIRST_THIN, FIRST_THIN + options.thin)
    entries = kept(options.record, sorted({*drawn, *thin, *recorded}), march, 1)
    compared = [compare(entry) for entry in entries]
    table = pd.DataFrame(compared)
    Writer(overwrite=True).text(options.record.with_suffix(".csv"), table.to_csv(index=False))
    picture = options.record.with_suffix(".png")
    Writer(overwrite=True).figure(picture, figure(compared), dpi=150)
    sys.stdout.write(summary(compared))
    ended = [one for one in compared if one.get("by")]
    return int(sum(abs(one["off"]) <= one["error"] for one in ended) < _WITHIN * len(ended))


if __name__ == "__main__":
    sys.exit(main())
