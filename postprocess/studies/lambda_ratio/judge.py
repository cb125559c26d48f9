"""What a comparison says: errors by roughness over film and motion, and what of them remains."""

import itertools

import numpy as np
import pandas as pd

from ehlwave.results.schema import SETTLED
from ehlwave.surface.amplitude import lowest_film
from studies.lambda_ratio.simulate import HELD_OUT, SMALL
from studies.microgeometry.surfaces import Floats

OF = ["contact", "motion", "lay", "seed"]
"""Columns that name a map in a contact."""

OILS = {"rolling": "rolling", "newtonian": "sliding, Newtonian", "eyring": "sliding, Ree-Eyring"}
"""Groups of motions that errors are counted in."""


def with_errors(compared: pd.DataFrame) -> pd.DataFrame:
    """Return finished marches with their errors, predicted over marched less 1.

    ``*_error`` are those of the answer, ``*_change`` those that the roughness adds to those of the
    same map at a twentieth of the film: the grid and the atlas have no part in them.
    """
    table = compared[compared["status"].isin(SETTLED)].copy()
    table["oil"] = [OILS[name.split("-")[0]] for name in table["motion"]]
    table["amplitude"] = np.sqrt(2) * table["rq_over_film"]
    mean = table["mean_linear"] + table["rise"]
    table["mean_error"] = mean / table["mean_marched"] - 1
    table["rq_error"] = table["rq_predicted"] / table["rq_marched"] - 1
    table["lambda_error"] = (1 + table["mean_error"]) / (1 + table["rq_error"]) - 1
    small = table[table["level"] == SMALL].set_index(OF)
    for name in ("mean", "rq", "lambda"):
        base = 1 + small[f"{name}_error"].reindex(pd.MultiIndex.from_frame(table[OF])).to_numpy()
        table[f"{name}_change"] = (1 + table[f"{name}_error"]) / base - 1
    return table


def trusted_table(compared: pd.DataFrame) -> pd.DataFrame:
    """Return one row for each roughness over film and group of motions."""
    table = with_errors(compared)
    everything = compared.assign(oil=[OILS[one.split("-")[0]] for one in compared["motion"]])
    rows = []
    for (oil, level), asked in everything[everything["level"] > SMALL].groupby(["oil", "level"]):
        part = table[(table["oil"] == oil) & (table["level"] == level)]
        if part.empty:
            continue
        rows.append(
            {
                "motion": oil,
                "rq_over_film": f"{level:g}",
                "marched": len(part),
                "not_finished": len(asked) - len(part),
                "touch_somewhere": int(asked["touches"].sum()),
                "said_to_touch": int(asked["predicted_to_touch"].sum()),
                **{
                    f"{name}_error_{word}": f"{value:.3f}"
                    for name in ("lambda", "mean", "rq")
                    for word, value in _sizes(part[f"{name}_error"])
                },
                "profile_error_median": f"{part['profile_error'].median():.3f}",
                "lowest_film": f"{part['lowest_marched'].min():.3f}",
                "largest_share_below": f"{part['share_below'].max():.4f}",
            }
        )
    return pd.DataFrame(rows)


def touching(compared: pd.DataFrame) -> pd.DataFrame:
    """Return how many marches touch somewhere, by the highest deformed point over the film."""
    known = compared[compared["touches"] | compared["status"].isin(SETTLED)]
    edges = (0.0, 0.8, 1.0, 1.2, np.inf)
    rows = []
    for low, high in itertools.pairwise(edges):
        part = known[(known["highest_predicted"] >= low) & (known["highest_predicted"] < high)]
        count = {"marched": len(part), "touch_somewhere": int(part["touches"].sum())}
        at_centre = (part["share_below"] > 0).sum()
        rows.append({"highest_from": low, "to": high, **count, "near_the_centre": int(at_centre)})
    return pd.DataFrame(rows)


def factors(compared: pd.DataFrame) -> pd.DataFrame:
    """Return what errors grow with the square of the amplitude over film, by group of motions.

    95 % of the marches are within ``rq_95`` and ``mean_95``; ``lambda_95`` is of both.
    """
    table = with_errors(compared)
    table = table[table["level"] > SMALL]
    rows = []
    for oil, part in table.groupby("oil"):
        square = part["amplitude"] ** 2
        change = {
            "rq": part["rq_change"].abs() / square,
            "mean": (part["mean_marched"] - part["mean_linear"] - part["rise"]).abs() / square,
            "lambda": part["lambda_change"].abs() / square,
        }
        within = {f"{name}_95": f"{np.quantile(one, 0.95):.3f}" for name, one in change.items()}
        largest = f"{part['amplitude'].max():.2f}"
        rows.append({"motion": oil, "marched": len(part), "largest_amplitude": largest, **within})
    return pd.DataFrame(rows)


def fitted_width(compared: pd.DataFrame) -> float:
    """Return the width of ``lowest_film`` that is best for all contacts but the held-out one."""
    table = with_errors(compared)
    table = table[table["contact"] != HELD_OUT]
    widths = np.arange(0.05, 0.8, 0.01)
    linear, marched = (table[f"lowest_{one}"].to_numpy() for one in ("predicted", "marched"))
    errors = [np.mean((_corrected(linear, one) - marched) ** 2) for one in widths]
    return float(widths[int(np.argmin(errors))])


def lowest_table(compared: pd.DataFrame) -> pd.DataFrame:
    """Return the error of the lowest film, over the smooth one, linear and corrected."""
    table, width = with_errors(compared), fitted_width(compared)
    table = table[table["level"] > SMALL]
    rows = []
    for name, part in (
        ("fitted to", table[table["contact"] != HELD_OUT]),
        ("held out", table[table["contact"] == HELD_OUT]),
    ):
        linear, marched = (part[f"lowest_{one}"].to_numpy() for one in ("predicted", "marched"))
        row: dict[str, object] = {"contacts": name, "marched": len(part), "width": f"{width:.2f}"}
        for way, found in (("linear", linear), ("corrected", _corrected(linear, width))):
            row |= {f"{way}_{word}": f"{one:.3f}" for word, one in _sizes(found - marched)}
        rows.append(row)
    return pd.DataFrame(rows)


def _corrected(linear: Floats, width: float) -> Floats:
    return np.array([lowest_film(one, width) for one in linear])


def _sizes(errors: pd.Series | Floats) -> list[tuple[str, float]]:
    size = np.abs(np.asarray(errors))
    size = size[np.isfinite(size)]
    if size.size == 0:
        return [("median", np.nan), ("95", np.nan), ("largest", np.nan)]
    return [
        ("median", float(np.median(size))),
        ("95", float(np.quantile(size, 0.95))),
        ("largest", float(size.max())),
    ]


def uncovered(compared: pd.DataFrame) -> tuple[int, int]:
    """Return how many lambda ratios are further off than was stated, and how many there are.

    Films count over the smooth one of the march: the error of the smooth film has no part in it.
    """
    table = with_errors(compared)
    table = table[table["level"] > SMALL]
    bad = ~(table["lambda_error"].abs() <= table["stated_error"])
    return int(bad.sum()), len(table)
