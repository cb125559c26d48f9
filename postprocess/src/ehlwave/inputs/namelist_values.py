"""Values as written in an input file, turned into numbers, logicals and text.

The rules match the programs (``src/io/namelist_values.f90``). Each function raises ValueError with
the problem and the change needed.
"""

import re
from dataclasses import dataclass

from ehlwave.inputs.namelist_tokens import shown

LARGEST_WHOLE = 2**31 - 1
LARGEST_POWER = 307
"""Numbers are 0, or from 1e-307 to below 1e308 in size."""

_WHOLE = re.compile(rb"[+-]?[0-9]+")
_REAL = re.compile(rb"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)(?:[eEdD]([+-]?[0-9]+))?")
_TRUTHS = {b"true": True, b"t": True, b"false": False, b"f": False}
_TRUTHS |= {b"." + name + b".": truth for name, truth in _TRUTHS.items()}


@dataclass(frozen=True)
class Value:
    """A value, without quotes and repeat count."""

    text: bytes
    is_quoted: bool
    line: int


def real(value: Value) -> float:
    """Return a decimal number, with or without exponent (e or d)."""
    found = None if value.is_quoted else _REAL.fullmatch(value.text)
    if found is None:
        raise _misfit(value, "a number such as 1.5 or 2e-3")
    digits = found[1].replace(b".", b"")
    if not digits.strip(b"0"):
        return 0.0
    power = len(found[1].partition(b".")[0]) - 1
    power -= len(digits) - len(digits.lstrip(b"0"))
    exponent = (found[2] or b"0").lstrip(b"+-0") or b"0"
    sign = -1 if (found[2] or b"").startswith(b"-") else 1
    power += sign * (int(exponent) if len(exponent) <= 6 else 10**6)
    if power > LARGEST_POWER:
        raise ValueError(f"{shown(value.text)} is too large: write a number below 1e308")
    if power < -LARGEST_POWER:
        raise ValueError(f"{shown(value.text)} is too small: write 0 or a number from 1e-307")
    return float(value.text.lower().replace(b"d", b"e"))


def whole(value: Value) -> int:
    """Return a whole number, written without decimal point or exponent."""
    if value.is_quoted or not _WHOLE.fullmatch(value.text):
        raise _misfit(value, "a whole number such as 4, without decimal point or exponent")
    digits = value.text.lstrip(b"+-0") or b"0"
    if len(digits) > 10 or int(digits) > LARGEST_WHOLE:
        raise ValueError(
            f"{shown(value.text)} is too large for a whole number here: write one from "
            f"-{LARGEST_WHOLE} to {LARGEST_WHOLE}"
        )
    return -int(digits) if value.text.startswith(b"-") else int(digits)


def truth(value: Value) -> bool:
    """Return a logical: true, false, t or f, with or without dots around."""
    if value.is_quoted or value.text.lower() not in _TRUTHS:
        raise _misfit(value, "true or false")
    return _TRUTHS[value.text.lower()]


def word(value: Value) -> str:
    """Return a text in quotes; bytes that are not UTF-8 are kept, as in names of files."""
    if not value.is_quoted:
        raise ValueError(f"{shown(value.text)} is not in quotes: write '{shown(value.text)}'")
    return value.text.decode("utf-8", "surrogateescape")


def plain(value: Value) -> float | int | bool | str:
    """Return a value of a key whose kind is not known, by the form of the value."""
    if value.is_quoted:
        return word(value)
    if value.text.lower() in _TRUTHS:
        return truth(value)
    if _WHOLE.fullmatch(value.text):
        return whole(value)
    if _REAL.fullmatch(value.text):
        return real(value)
    raise ValueError(
        f"'{shown(value.text)}' does not fit: write a number such as 1.5 or 2e-3, true or false, "
        "or a text in quotes"
    )


def _misfit(value: Value, wanted: str) -> ValueError:
    if value.is_quoted:
        return ValueError(
            f"'{shown(value.text)}' in quotes is text: write {wanted}, without quotes"
        )
    return ValueError(f"'{shown(value.text)}' does not fit: write {wanted}")
