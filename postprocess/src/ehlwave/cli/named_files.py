"""What a command reads: files that its words name, and those that its input files name.

Needs the standard library alone, until there is an input file.
"""

import argparse
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

OUTPUTS = ("output", "csv", "parquet", "netcdf", "vtk")
"""Options that name what is written; every other path is an input."""

LARGEST_INPUT_FILE = 2**20
"""Bytes; what is larger is no input file of the programs."""


def inputs(options: argparse.Namespace) -> Iterator[str | Path]:
    """Return whatever can name a file that is read: words of the command line, texts in its files.

    Outputs are none of the words. Texts are those of input files of the programs, whose keys can
    name files.
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
        if not path.is_file() or path.stat().st_size > LARGEST_INPUT_FILE:
            return
        text = path.read_text(encoding="utf-8", errors="surrogateescape")
        if "\0" in text or not re.search(r"^\s*&\w", text, re.MULTILINE):
            return
        import f90nml

        groups = f90nml.reads(text)
    except Exception:  # f90nml's parser reports bad syntax by whatever it stumbles into
        return  # whoever uses the file says what is wrong with it
    for group in groups.values():
        yield from _texts_of(group)


def _texts_of(value: object) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        yield from _texts_of(list(value.values()))
    elif isinstance(value, Iterable):
        for part in value:
            yield from _texts_of(part)
