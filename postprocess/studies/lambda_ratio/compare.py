"""A rough map inside the contact: marched, and predicted as `Contact.deform` does.

Both are films over the smooth one where the map passes the contact centre, in a narrow strip.
"""

import functools
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from scipy.interpolate import RectBivariateSpline

from ehlwave.results.case_file import read_contact
from ehlwave.results.schema import SETTLED
from ehlwave.surface import Surface
from ehlwave.surface.prepare import TAPERED_SHARE
from studies import sweeps
from studies.lambda_ratio.simulate import SMALL, Levels, March, marches
from studies.microgeometry.surfaces import Floats

STRIP = 0.3
"""Half the width of the strip at the contact centre, in units of b."""

REACH = 0.5
"""Half the sides of the part of the contact, in units of a and b, where thin films are counted."""

TOUCHING = 0.03
"""Of the smooth film: below that real surfaces would touch."""

TOUCHES = "the waves touch"
"""In the message of a march whose film falls below that somewhere."""


def compare(folder: Path, contact: str, levels: Levels | None = None) -> pd.DataFrame:
    """Return one row for each march of a contact that has been done.

    Ratios are predicted over marched; ``mean_linear`` is of the smooth film, ``mean`` of the film
    and its rise of second order.
    """
    rows = sweeps.read_sweep(folder, contact)
    done = {Path(row["file"]).stem + _motion(row): row for row in rows}
    found = []
    for march in marches(contact, levels):
        wanted = march.row(folder)
        row = done.get(Path(wanted["file"]).stem + _motion(wanted))
        if row is not None and row["status"] != "pending":
            found.append(_compare(march, row, folder))
    return pd.DataFrame(found)


def _motion(row: sweeps.Row) -> str:
    return f"{row['slip_parameter']:g}{row['flow_law']}"


def _compare(march: March, row: sweeps.Row, folder: Path) -> dict[str, object]:
    predicted = march.predicted()
    conditions, statistics = predicted.conditions, predicted.statistics
    film_m = row["central_film"] * conditions.hertz_approach_c_m
    errors = statistics.lambda_errors or {}
    found: dict[str, object] = {
        "contact": march.contact,
        "motion": march.motion,
        "lay": march.surface.name,
        "seed": march.seed,
        "level": march.level,
        "rq_over_film": float(march.surface.height[_inner(march.surface)].std()) / film_m,
        "status": row["status"],
        "touches": TOUCHES in str(row.get("message")),
        "predicted_to_touch": statistics.surfaces_touch,
        "stated_error": sum(errors.values()) - errors.get("film", 0.0),
        "amplitude_over_film": statistics.amplitude_over_film,
        "highest_predicted": float(predicted.height.max()) / film_m,
        "seconds": row["seconds"],
    }
    if row["status"] not in SETTLED:
        return found
    simulated = read_contact(sweeps.fields_file(folder, march.contact, row))
    marched, below, passing = _marched(simulated, march)
    heights = _heights(predicted.height, march, passing, simulated) / film_m
    before = _heights(predicted.surface.height, march, passing, simulated) / film_m
    of_formula = float(march.bodies.conditions.central_film_m or np.nan)
    rise = _rise(march) * (march.level * of_formula / film_m) ** 2
    linear = 1 - heights
    return found | {
        "rq_before": float(before.std()),
        "rq_marched": float(marched.std()),
        "rq_predicted": float(linear.std()),
        "mean_marched": float(marched.mean()),
        "mean_linear": float(linear.mean()),
        "rise": rise,
        "profile_error": float(np.std(linear - marched) / before.std()),
        "lowest_marched": float(marched.min()),
        "lowest_predicted": float(linear.min() + rise),
        "share_below": below,
    }


def _inner(surface: Surface) -> slice:
    """Return the part of a map that is not faded."""
    count = surface.height.shape[0]
    return slice(round(TAPERED_SHARE * count), round((1 - TAPERED_SHARE) * count))


def _marched(simulated: xr.Dataset, march: March) -> tuple[Floats, float, Floats]:
    """Return films over the smooth one in the strip, the share of thin ones, and positions, m."""
    film = simulated["film_over_time"].values
    time = simulated["field_time"].values
    position = np.interp(time, simulated["time"].values, simulated["surface_position_m"].values)
    x, y = (simulated[name].values for name in ("x", "y"))
    over = film / film[0]
    length = march.surface.height.shape[0] * march.surface.step_x_m
    chosen = np.abs(position / length - 0.5) <= 0.5 - TAPERED_SHARE
    middle = int(np.abs(x).argmin())
    strip = (film - film[0])[np.ix_(chosen, np.abs(y) <= STRIP, [middle])][:, :, 0]
    strip = 1 + strip / film[0, int(np.abs(y).argmin()), middle]
    part = over[np.ix_(chosen, np.abs(y) <= REACH, np.abs(x) <= REACH)]
    return strip, float(np.mean(part < TOUCHING)), position[chosen]


def _heights(heights: Floats, march: March, position: Floats, simulated: xr.Dataset) -> Floats:
    """Return heights at positions along the map and in the strip, m."""
    surface = march.surface
    nx, ny = heights.shape
    x = np.arange(nx) * surface.step_x_m
    y = (np.arange(ny) - 0.5 * (ny - 1)) * surface.step_y_m
    across = simulated["y"].values
    across = across[np.abs(across) <= STRIP] * march.bodies.conditions.semi_axis_b_m
    order = np.argsort(position)
    found = np.empty((position.size, across.size))
    found[order] = RectBivariateSpline(x, y, heights)(position[order], across)
    return found


@functools.cache
def _rise_of(contact: str, motion: str, lay: str, seed: int) -> float:
    for one in marches(contact, (SMALL,)):
        if (one.motion, one.surface.name, one.seed) == (motion, lay, seed):
            predicted = one.predicted()
            s = predicted.statistics
            film_m = float(predicted.conditions.central_film_m or np.nan)
            return (s.mean_rise_m or 0.0) * film_m / s.rq_before_m**2
    return float("nan")


def _rise(march: March) -> float:
    """Return what the mean film rises in second order, over the film and (Rq/film)^2."""
    return _rise_of(march.contact, march.motion, march.surface.name, march.seed)
