"""Inputs of a command: files in its words, and files in its input files.

Needs the standard library alone.
"""

import argparse
from collections.abc import Iterator
from pathlib import Path

from ehlwave.errors import SurfaceError
from ehlwave.inputs import namelist_values
from ehlwave.inputs.namelist import read_namelist

OUTPUTS = ("output", "csv", "parquet", "netcdf", "vtk")
"""Options that name output files; every other path is an input."""


def inputs(options: argparse.Namespace) -> Iterator[str | Path]:
    """Return whatever can name a file that is read: words of the command line, texts in its files.

    Outputs are not among the words. Texts are input files of the programs, whose keys can name
    files.
    """
    for name, value in vars(options).items():
        if name in OUTPUTS:
            continue
        words = value if isinstance(value, list) else [value] if isinstance(value, Path) else []
        for word in words:
            if isinstance(word, (str, Path)):
                yield word
                yield from _texts_in(Path(word))


def _texts_in(path: Path) -> Iterator[str]:
    """Return the texts that an input file of the programs gives its keys; none of another file."""
    try:
        entries = read_namelist(path).entries.values() if path.is_file() else ()
    except (OSError, SurfaceError):
        return  # the reader of the file reports its problems
    for entry in entries:
        yield from (namelist_values.word(value) for value in entry.values if value.is_quoted)
