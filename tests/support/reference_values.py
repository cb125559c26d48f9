"""Rows of the reference files as dictionaries of numbers."""

import csv
from pathlib import Path

FOLDER = Path(__file__).parent.parent / "verification" / "reference"


def rows(name):
    """All rows of a file; text stays text."""
    with (FOLDER / name).open(newline="") as file:
        return [{key: _number(value) for key, value in row.items()} for row in csv.DictReader(file)]


def case_groups(row):
    """Input groups of the contact of a row; its grid has a cell less than points."""
    cells = int(row["points"]) - 1
    return {"m": row["load_parameter_m"], "l": row["lubricant_parameter_l"], "d": row["radius_ratio_d"],
            "grid": {"cells_x": cells, "cells_y": cells}}


def case_name(row):
    """Short name for messages."""
    name = f"M={row['load_parameter_m']:g} D={row['radius_ratio_d']:g} {row['points']:g} points"
    if "orientation" in row:
        name += f" {row['orientation']} {row['wavelength_over_a']:g}"
    return name


def _number(text):
    try:
        return float(text)
    except ValueError:
        return text
