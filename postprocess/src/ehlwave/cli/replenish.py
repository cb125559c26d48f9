"""Actions of ``ehlwave replenish``."""

import argparse
import contextlib
import json
import sys
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_read import read_conditions
from ehlwave.errors import RangeError
from ehlwave.laws.asked import Asked
from ehlwave.laws.film_answer import with_film
from ehlwave.laws.law_list import film_for
from ehlwave.laws.replenishment import Track, replenish
from ehlwave.writing import Writer

if TYPE_CHECKING:
    from matplotlib.figure import Figure

UM = 1e6


def run_replenish(options: argparse.Namespace) -> None:
    """Print the film over time; write table and figure."""
    with warnings.catch_warnings(record=True) as notices:
        warnings.simplefilter("always")
        conditions = read_conditions(options.conditions)
    for notice in notices:
        print(f"ehlwave: note: {notice.message}", file=sys.stderr)
    Track(conditions, options.track_length)
    with contextlib.suppress(RangeError):  # the film of the formula applies, and the text notes it
        conditions = with_film(conditions, film_for(Asked(conditions), "laws"))
    table = replenish(conditions, options.track_length, options.overrollings)
    document = summary(table, conditions, options.track_length)
    print(json.dumps(document, indent=2) if options.json else text_of(table, document))
    if options.output is not None:
        written = _write(table, options.output, options.writer)
        listing = sys.stderr if options.json else sys.stdout
        print("\n".join(str(path) for path in written), file=listing)


def summary(
    table: pd.DataFrame, conditions: Conditions, track_length_m: float
) -> dict[str, object]:
    """Return inputs, derived values, and the rows."""
    track = Track(conditions, track_length_m)
    return {
        "oil_over_flooded": conditions.oil_over_flooded,
        "flooded_film_m": track.flooded_film_m,
        "film_source": conditions.film_source,
        "film_error": conditions.central_film_error,
        "track_length_m": track_length_m,
        "seconds_per_overrolling": track.period_s,
        "side_flow_per_s": track.side_flow_per_s,
        "rows": table.to_dict("records"),
    }


def text_of(table: pd.DataFrame, document: dict[str, object]) -> str:
    """Return the report: a row per decade of overrollings, and its meaning."""
    tens = np.floor(np.log10(table["overrollings"])).diff().fillna(1) > 0
    lines = [
        f"Flooded film {document['flooded_film_m'] * UM:.4g} um; film of the first overrolling: "  # type: ignore[operator]
        f"{document['film_source']}",
        "Film over the flooded film, by each loss alone and by both:",
        "overrollings      time, s   inlet  sides  both                    film, um",
    ]
    for row in table[tens | (table.index == table.index[-1])].itertuples():
        mark = "" if row.is_inside else "  (extrapolated)"
        lines.append(
            f"{row.overrollings:12d} {row.time_s:12.4g}   "
            f"{row.inlet:.3f}  {row.side_flow:.3f}  {row.film_over_flooded:.3f} "
            f"({row.film_over_flooded_low:.3f} to {row.film_over_flooded_high:.3f})  "
            f"{row.film_m * UM:.4g}{mark}"
        )
    return "\n".join(
        [
            *lines,
            "Without replenishment: no oil comes back to the track. The inlet pushes oil aside, "
            "and pressure in the contact drives it to the sides. Films thinner than the roughness "
            "mean that surfaces touch.",
        ]
    )


def replenish_figure(table: pd.DataFrame) -> "Figure":
    """Draw the film over the flooded film against overrollings, with bands."""
    from matplotlib.figure import Figure

    from ehlwave.results.scales_of_figures import COLUMN

    figure = Figure(figsize=(COLUMN, 3.2), layout="constrained")
    axes = figure.subplots()
    n = table["overrollings"]
    both = "film_over_flooded"
    low, high = table[f"{both}_low"], table[f"{both}_high"]
    axes.fill_between(n, low, high, color="C0", alpha=0.25, lw=0, label="error of both")
    # A film by one loss alone partly coincides with the film by both: it is drawn on top.
    for name, label, style in (
        (both, "by both losses", "C0-"),
        ("inlet", "by the inlet alone", "C1--"),
        ("side_flow", "by side flow alone", "k:"),
    ):
        axes.plot(n, table[name], style, label=label, lw=2.4 if name == both else 1.4)
    outside = n[~table["is_inside"]]
    if outside.size:
        axes.axvspan(outside.iloc[0], n.iloc[-1], color="0.9", lw=0, zorder=0, label="extrapolated")
    period = float(table["time_s"].iloc[-1] / (n.iloc[-1] - 1))
    axes.set(xscale="log", yscale="log", ylabel="film over flooded film")
    axes.set_xlabel(f"overrollings, one every {period:.3g} s")
    axes.legend(frameon=False)
    return figure


def _write(table: pd.DataFrame, folder: Path, writer: Writer) -> list[Path]:
    from ehlwave.results.figures import write_figure

    path = writer.table(folder / "replenish.csv", table, index=False, lineterminator="\r\n")
    return [path, *write_figure(replenish_figure(table), folder, "replenish", writer=writer)]
