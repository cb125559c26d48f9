"""The input that results carry: every key in use with its value, one per line."""

import re

_LINE = re.compile(r"^\s*(\w+)\s*=\s*(.*?),?\s*$", re.MULTILINE)


def keys_of_input(text: str) -> dict[str, float | str]:
    """Return the keys of an effective input with their values.

    The programs wrote it, one key per line. :mod:`ehlwave.inputs.namelist` reads the same text,
    which a test compares; this module is faster, for sweeps of thousands.
    """
    return {key: value_of(value) for key, value in _LINE.findall(text)}


def value_of(text: str) -> float | str:
    """Return a value of an input file."""
    bare = text.strip().strip("'\"")
    try:
        return float(bare)
    except ValueError:
        return bare
