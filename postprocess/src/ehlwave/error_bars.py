"""Errors of laws and models: the table ``error_bars.csv``, where no module has a number of its own.

A row has a value, the number of contacts or waves behind it, its basis and its study. The basis is
``record`` where ``python -m studies.error_bars`` computes the value from records of studies,
``kept`` where a study takes hours or was made once, ``standard`` where a publication states it.
Factors of the program's errors are in ``src/case/error_factors.f90``.
"""

import csv
from collections.abc import Mapping
from functools import cache
from importlib.resources import files

TABLE = "error_bars.csv"


@cache
def bars() -> Mapping[str, Mapping[str, str]]:
    """Return the rows of the table, by name."""
    text = (files("ehlwave") / TABLE).read_text(encoding="utf-8")
    return {row["name"]: row for row in csv.DictReader(text.splitlines())}


def bar(name: str) -> float:
    """Return the value of a row.

    Parameters
    ----------
    name : str
        Name of the row, as ``"heat.friction"``.

    Examples
    --------
    >>> from ehlwave.error_bars import bar
    >>> bar("oil.grade")
    0.1
    """
    return float(bars()[name]["value"])
