"""Actions of ``ehlwave stribeck``."""

import argparse
import json
import sys

from ehlwave.errors import ArgumentError, ResultsError, SurfaceError
from ehlwave.inputs.key_values import values_of
from ehlwave.inputs.namelist import read_namelist
from ehlwave.stribeck import Stribeck, stribeck, stribeck_figure


def run_stribeck(options: argparse.Namespace) -> None:
    """Compute and print the curve; write table and figure."""
    try:
        groups = values_of(read_namelist(options.case))
        keys = {key: value for group in groups.values() for key, value in group.items()}
        found = stribeck(keys, options.shares, options.factors, options.ranks, False)
    except (ArgumentError, SurfaceError) as error:  # in a command, an argument is an input
        raise ResultsError(str(error)) from error
    if options.json:
        table = found.table.astype(object)
        rows = table.where(table.notna(), None).to_dict("records")
        low, high = found.transition
        print(json.dumps({"transition_m_per_s": [low, high], "rows": rows}, indent=2))
    else:
        print(text_of(found))
    if options.output is None:
        return
    from ehlwave.results.figures import write_figure

    path, writer = options.output / "stribeck.csv", options.writer
    written = [writer.table(path, found.table, index=False, lineterminator="\r\n")]
    written += write_figure(stribeck_figure(found), options.output, "stribeck", writer=writer)
    print("\n".join(str(one) for one in written), file=sys.stderr if options.json else sys.stdout)


def text_of(found: Stribeck) -> str:
    """Return the report: a row per speed, and the speeds of the transition."""
    lines = ["speed, m/s   error   friction   of solids   share   area   mean film, nm   status"]
    for row in found.table.itertuples():
        lines.append(
            f"{row.mean_speed_m_per_s:10.4g}{100 * row.speed_error:6.1f} %"
            f"{abs(row.friction_coefficient):11.5f}{abs(row.solid_friction_coefficient):12.5f}"
            f"{row.touching_share:8.3f}{row.touching_area:7.3f}{1000 * row.mean_film_um:16.4g}"
            f"   {row.status}"
        )
    low, high = found.transition
    return "\n".join(
        [*lines, f"The shares that were asked for lie between {low:.4g} and {high:.4g} m/s."]
    )
