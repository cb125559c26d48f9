"""Readable tables, CSV and JSON."""

import json
import math
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from ehlwave.contact.formula import PAPER_C1, PAPER_C2
from ehlwave.results.fit import Interval
from ehlwave.results.points import count_by_status, of_orientation
from ehlwave.results.refit import RefitRow, RefitSettings
from ehlwave.results.schema import (
    CONVERGED,
    DIMENSION,
    ORIENTATIONS,
    PENDING,
    PROVENANCE_ATTRIBUTES,
    UNRESOLVED,
)
from ehlwave.writing import Writer

VARIABLE_NAMES = {"f_v": "f V", "f_v2": "f V2"}

_CASE_HEADINGS = {
    "case": "case",
    "case_id": "id",
    "status": "status",
    "orientation": "orientation",
    "load_parameter_m": "M",
    "lubricant_parameter_l": "L",
    "radius_ratio_d": "D",
    "wavelength_over_a": "lambda/a",
    "source_file": "file",
}


def summary_text(results: xr.Dataset) -> str:
    """Return counts of cases by status and orientation, and the list of failed cases."""
    groups = {"all": results}
    names = sorted(set(results["orientation"].values.tolist()), key=_orientation_order)
    groups |= {name: of_orientation(results, name) for name in names}
    statuses = list(count_by_status(results))
    lines = [["orientation", "cases", *statuses, "converged and resolved"]]
    for name, members in groups.items():
        counts = count_by_status(members)
        resolved = (members["status"] == CONVERGED) & (members["is_resolved"] != 0)
        cells = [members.sizes[DIMENSION], *(counts.get(status, 0) for status in statuses)]
        lines.append([name, *(str(cell) for cell in (*cells, int(resolved.sum())))])
    has_failed = ~results["status"].isin((CONVERGED, UNRESOLVED, PENDING))
    failed = results.isel({DIMENSION: np.flatnonzero(has_failed)})
    text = _aligned(lines)
    if not failed.sizes[DIMENSION]:
        return f"{text}\n\nNo case failed."
    columns = [[_short(value) for value in failed[name].values] for name in _CASE_HEADINGS]
    listing = [list(_CASE_HEADINGS.values()), *(list(row) for row in zip(*columns, strict=True))]
    return f"{text}\n\nFailed cases:\n{_aligned(listing)}"


def refit_text(rows: Sequence[RefitRow], settings: RefitSettings) -> str:
    """Return the refitted coefficients beside the paper's, and how well the points follow them."""
    quality = [["points", "x", "n", "conditions", "rms before", "rms after", "rms V2/V", ""]]
    fitted = [["points", "x", "c1", "bootstrap", "lmfit", "c2", "bootstrap", "lmfit"]]
    fitted.append(["paper", "f V", f"{PAPER_C1}", "", "", f"{PAPER_C2}"])
    for row in rows:
        name = [row.group, VARIABLE_NAMES[row.variable]]
        errors = [_number(value) for value in (row.rms_paper, row.rms_refit, row.tightness)]
        quality.append([*name, str(row.points), str(row.conditions), *errors, row.note])
        fit1 = [_number(row.c1), _interval(row.c1_bootstrap), _interval(row.c1_profile)]
        fit2 = [_number(row.c2), _interval(row.c2_bootstrap), _interval(row.c2_profile)]
        fitted.append([*name, *fit1, *fit2])
    return (
        "Ad/Ai = 1 / (1 + c1 x + c2 x^2) at converged and resolved points\n\n"
        f"{_aligned(fitted)}\n\n"
        f"{100 * settings.confidence:g} % intervals. bootstrap: {settings.replicates} samples of "
        f"operating conditions (M, L, D), seed {settings.seed};\n"
        "lmfit: profile of the sum of squares, errors of points taken as independent.\n\n"
        f"{_aligned(quality)}\n\n"
        "rms of the residual before (paper's coefficients) and after the refit; V2/V: after."
    )


def refit_record(row: RefitRow) -> dict[str, Any]:
    """Return a row as flat names and values, intervals as ``..._low`` and ``..._high``."""
    record: dict[str, Any] = {}
    for name, value in asdict(row).items():
        if isinstance(value, tuple):
            record[f"{name}_low"], record[f"{name}_high"] = value
        else:
            record[name] = value
    return record


def refit_json(
    rows: Sequence[RefitRow], settings: RefitSettings, points: xr.Dataset, ratio: str
) -> str:
    """Return rows, settings and origin of the points as a JSON document; NaN becomes null."""
    origins = points[["source_file", *PROVENANCE_ATTRIBUTES]].to_dataframe()
    origins = origins[["source_file", *PROVENANCE_ATTRIBUTES]].drop_duplicates()
    document = {
        "formula": "1 / (1 + c1 x + c2 x^2)",
        "paper": {"c1": PAPER_C1, "c2": PAPER_C2},
        "ratio": ratio,
        "settings": asdict(settings),
        "sources": origins.sort_values(list(origins)).to_dict("records"),
        "rows": [
            {name: _finite_or_none(value) for name, value in refit_record(row).items()}
            for row in rows
        ],
    }
    return json.dumps(document, indent=2, allow_nan=False)


def write_dataset_csv(
    path: Path, data: xr.Dataset, columns: Sequence[str] = (), writer: Writer | None = None
) -> None:
    """Write columns of a per-case dataset, all by default, numbers with all their digits."""
    _write_csv(path, dataset_table(data, columns), writer)


def dataset_table(data: xr.Dataset, columns: Sequence[str] = ()) -> pd.DataFrame:
    """Return columns of a per-case dataset, all by default, as a table."""
    return data.to_dataframe().reset_index()[list(columns or [*data, *data.coords])]


def write_refit_csv(path: Path, rows: Sequence[RefitRow], writer: Writer | None = None) -> None:
    """Write a line per group and variable."""
    _write_csv(path, pd.DataFrame([refit_record(row) for row in rows]), writer)


def _write_csv(path: Path, table: pd.DataFrame, writer: Writer | None) -> None:
    (writer or Writer()).table(path, table, na_rep="nan", lineterminator="\r\n")


def _aligned(lines: Sequence[Sequence[str]]) -> str:
    """Return lines of cells as text columns; short lines are filled up."""
    width = max(len(line) for line in lines)
    full = [[*line, *[""] * (width - len(line))] for line in lines]
    widths = [max(len(cell) for cell in column) for column in zip(*full, strict=True)]
    return "\n".join(
        "  ".join(cell.ljust(size) for cell, size in zip(line, widths, strict=True)).rstrip()
        for line in full
    )


def _orientation_order(name: str) -> tuple[int, str]:
    known = name in ORIENTATIONS
    return (ORIENTATIONS.index(name) if known else len(ORIENTATIONS), name)


def _short(value: Any) -> str:  # noqa: ANN401 - any numpy scalar
    return f"{value:g}" if isinstance(value, np.floating) else str(value)


def _number(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.4g}"


def _interval(interval: Interval) -> str:
    low, high = interval
    return "-" if math.isnan(low) else f"[{low:.4g}, {high:.4g}]"


def _finite_or_none(value: Any) -> Any:  # noqa: ANN401 - any JSON value
    return None if isinstance(value, float) and not math.isfinite(value) else value
