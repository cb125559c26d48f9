"""Actions of ``ehlwave identify``."""

import argparse
import json
import math
import sys

import pandas as pd

from ehlwave.errors import ArgumentError, ResultsError
from ehlwave.identify import Identified, identification_figure, identify
from ehlwave.shown import percent


def run_identify(options: argparse.Namespace) -> None:
    """Fit, print the parameters; write table and figure."""
    try:
        found = identify(options.measurements, options.case, options.fit, options.error, options.by)
    except ArgumentError as error:  # in a command, an argument is an input
        raise ResultsError(str(error)) from error
    print(json.dumps(summary(found), indent=2) if options.json else text_of(found))
    if options.output is None:
        return
    from ehlwave.results.figures import write_figure

    path, writer = options.output / "identify.csv", options.writer
    written = [writer.table(path, rows(found), index=False, lineterminator="\r\n")]
    written += write_figure(identification_figure(found), options.output, "identify", writer=writer)
    print("\n".join(str(one) for one in written), file=sys.stderr if options.json else sys.stdout)


def rows(found: Identified) -> pd.DataFrame:
    """Return measured and fitted values, a row each."""
    data = found.measurements
    table = pd.DataFrame(data.conditions)
    table["result"], table["measured"] = data.result, data.value
    table["fitted"], table["residual"] = found.fitted, found.residual
    return table


def summary(found: Identified) -> dict[str, object]:
    """Return parameters, correlation and residuals; a number that is not known is null."""
    table = rows(found).astype(object)
    return {
        "parameters": {
            one.name: {
                "value": one.value,
                "unit": one.unit,
                "relative_error": _known(one.error),
                "low": _known(one.low),
                "high": _known(one.high),
                "is_identified": one.is_identified,
            }
            for one in found.parameters
        },
        "correlation": [[_known(value) for value in row] for row in found.correlation],
        "residual_rms": found.rms,
        "noise": _known(found.noise),
        "viscosity_at_k": found.reference_k,
        "notes": found.notes,
        "sources": found.sources,
        "rows": table.where(table.notna(), None).to_dict("records"),
    }


def text_of(found: Identified) -> str:
    """Return the report."""
    lines = [f"{'parameter':32s}{'value':>12s}{'95 % interval':>26s}"]
    for one in found.parameters:
        interval = f"{one.low:.4g} to {one.high:.4g}"
        said = interval if one.is_identified else "not identified"
        unit = "" if one.unit == "1" else f" {one.unit}"
        lines.append(f"{one.name:32s}{one.value:12.4g}{said:>26s}{unit}")
    lines.append(
        f"Residuals    rms {percent(found.rms)} of {len(found.measurements)} values, by "
        + " and ".join(found.sources)
    )
    if found.reference_k is not None:
        lines.append(f"Temperature  the viscosity is that at {found.reference_k:.2f} K")
    return "\n".join([*lines, *(f"Note         {text}" for text in found.notes)])


def _known(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
