"""Actions of ``ehlwave traction``."""

import argparse
import json
import sys

from ehlwave.errors import ArgumentError, ResultsError
from ehlwave.inputs.slip import RATIO
from ehlwave.shown import spread_of
from ehlwave.traction import CURVES, Traction, read_keys, traction, traction_figure


def run_traction(options: argparse.Namespace) -> None:
    """Compute and print friction over slip; write table and figure."""
    try:
        keys = read_keys(options.case)
        found = traction(keys, options.ratios, options.ranks, False, options.by)
    except ArgumentError as error:  # in a command, an argument is an input
        raise ResultsError(str(error)) from error
    for row in found.table.itertuples():
        if row.status not in ("converged", "law"):
            note = f"slide_to_roll_ratio = {getattr(row, RATIO):g}: {row.status}"
            print(f"ehlwave: note: {note}", file=sys.stderr)
    if options.json:
        print(json.dumps(summary(found), indent=2))
    else:
        print(text_of(found))
    if options.output is not None:
        from ehlwave.results.figures import write_figure

        path, writer = options.output / "traction.csv", options.writer
        written = [writer.table(path, found.table, index=False, lineterminator="\r\n")]
        written += write_figure(traction_figure(found), options.output, "traction", writer=writer)
        listing = sys.stderr if options.json else sys.stdout
        print("\n".join(str(path) for path in written), file=listing)


def summary(found: Traction) -> dict[str, object]:
    """Return the largest friction, warnings and rows; a number that is not known is null."""
    value, ratio, falls = found.largest
    table = found.table.astype(object)
    return {
        "largest_friction": value,
        "largest_friction_ratio": ratio,
        "friction_falls_beyond": falls,
        "shear_limit_over_pressure": found.limit,
        "warnings": found.warnings,
        "rows": table.where(table.notna(), None).to_dict("records"),
    }


def text_of(found: Traction) -> str:
    """Return the report: a row per ratio, the place of the largest friction, warnings."""
    table = found.table
    columns = [name for name in CURVES if name in table]
    heads = {"limited": "limited", "limited_thermal": "both"}
    lines = ["slide-to-roll" + "".join(f"{heads.get(name, name):>12}" for name in columns)]
    lines[0] += "   rise, K   film, um   regime" if "thermal" in table else "   film, um   regime"
    for _, row in table.iterrows():
        line = f"{row[RATIO]:13.4g}" + "".join(f"{row[name]:12.5f}" for name in columns)
        if "thermal" in table:
            line += f"{row['rise_mid_film_k']:10.1f}"
        lines.append(f"{line}{row['central_film_um']:11.4g}   {row['regime']}")
    value, ratio, falls = found.largest
    has_error = "friction_error" in table
    beyond = "it falls again beyond" if falls else "at the end of the ratios"
    limit = "" if found.limit is None else f"; stress at most {found.limit:g} of the pressure"
    error = table.loc[table[found.curve] == value, "friction_error"] if has_error else ()
    known = "".join(f" {spread_of(value, one)}" for one in error if one == one)
    lines.append(f"Largest friction {value:.4f}{known} at {ratio:g}, {beyond}{limit}.")
    return "\n".join([*lines, *(f"Warning      {text}" for text in found.warnings)])
