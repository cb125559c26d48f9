"""Input files of the programs: groups, keys and values, the values still as written.

The grammar matches the programs (``src/io/namelist_scanner.f90``): groups ``&name ... /`` of ``key
= value[, value...]``, comments from ``!`` to the end of the line, text in ``'`` or ``"`` with the
quote doubled inside, repeat counts ``3*1.0``. Stricter than a Fortran namelist: nothing but
comments outside groups, no key or group twice, no empty values, no array elements, text in quotes
stays on one line and an unquoted word is never text.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from ehlwave.errors import SurfaceError, printable
from ehlwave.inputs.namelist_tokens import END, QUOTED, WORD, Token, Tokens, shown
from ehlwave.inputs.namelist_values import Value, plain

NAME_LENGTH = 63
MOST_VALUES = 100_000
"""In one file, repeat counts included."""
MOST_BYTES = 16 * 2**20
"""A larger file is not an input file."""

_NAME = re.compile(rb"[A-Za-z][A-Za-z0-9_]*")
_Kind = TypeVar("_Kind")


@dataclass(frozen=True)
class Entry:
    """A key with its values; names are in lower case."""

    group: str
    key: str
    line: int
    values: list[Value] = field(default_factory=list)


@dataclass
class Namelist:
    """The groups and keys of an input file."""

    path: str
    groups: dict[str, int] = field(default_factory=dict)
    """Line of each."""
    entries: dict[tuple[str, str], Entry] = field(default_factory=dict)
    """By group and key."""

    def problem(self, entry: Entry, text: str, line: int | None = None) -> SurfaceError:
        """Return the error about a key or, with `line`, its value."""
        place = f"{self.path}:{line or entry.line}"
        return SurfaceError(f"{place}: key '{entry.key}' in &{entry.group}: {text}")

    def value(self, entry: Entry, reading: Callable[[Value], _Kind]) -> _Kind:
        """Return the single value of a key, read as number, logical or text."""
        first, *more = entry.values
        if more:
            several = ", ".join(shown(value.text) for value in entry.values[:2])
            raise self.problem(
                entry,
                f"{len(entry.values)} values ({several}{', ...' if len(more) > 1 else ''}) where "
                "one is needed: write one, with a point as decimal mark, and '=' after each key",
            )
        try:
            return reading(first)
        except ValueError as error:
            raise self.problem(entry, str(error), first.line) from None

    def values(
        self, reading_of: Callable[[str], Callable[[Value], Any]] = lambda key: plain
    ) -> dict[str, dict[str, Any]]:
        """Return the single values of all keys by group; without a reading by the form of each."""
        found: dict[str, dict[str, Any]] = {name: {} for name in self.groups}
        for (group, key), entry in self.entries.items():
            found[group][key] = self.value(entry, reading_of(key))
        return found


def read_namelist(path: str | Path) -> Namelist:
    """Return the groups and keys of an input file.

    Raises SurfaceError with line, key and change needed, wherever the programs refuse the file.
    """
    name = printable(str(path))
    try:
        with Path(path).open("rb") as file:
            text = file.read(MOST_BYTES + 1)
    except FileNotFoundError:
        raise SurfaceError(f"{name}: no such file: check the path") from None
    except OSError as error:
        raise SurfaceError(
            f"{name}: cannot be read ({error.strerror}): give the path of a text file"
        ) from None
    if len(text) > MOST_BYTES:
        raise SurfaceError(f"{name}: is larger than 16 MiB: give the path of an input file")
    if not text:
        raise SurfaceError(f"{name}: is empty: check the path, or write the file")
    if b"\0" in text:
        raise SurfaceError(
            f"{name}: holds zero bytes: give the path of a plain text file (ASCII or UTF-8)"
        )
    return scan_namelist(name, text)


def scan_namelist(path: str, text: bytes) -> Namelist:
    """Return the groups and keys of a text; `path` names it in messages."""
    return _Scanner(path, text).all_groups()


class _Scanner:
    """The present token, the next, and the entries found so far."""

    def __init__(self, path: str, text: bytes) -> None:
        self.tokens = Tokens(path, text)
        self.found = Namelist(path)
        self.count = 0
        self.token = self.after = self.tokens.take()
        self.shift()

    def shift(self) -> None:
        """Go to the next token."""
        self.token = self.after
        if self.token.kind != END:
            self.after = self.tokens.take()

    def all_groups(self) -> Namelist:
        while self.token.kind != END:
            self.take_group()
        if not self.found.groups:
            raise SurfaceError(
                f"{self.found.path}: holds no group: write at least one '&name ... /'"
            )
        return self.found

    def take_group(self) -> None:
        """Take a group from '&' to '/'."""
        line = self.token.line
        if self.token.kind != "&":
            raise self.tokens.fail(
                line,
                f"'{shown(self.token.text)}' stands outside a group: move it between '&name' and "
                "'/', or make it a comment with '!'",
            )
        self.shift()
        group = self.name("group")
        if group in self.found.groups:
            raise self.tokens.fail(
                line,
                f"group &{group} is given twice (first on line {self.found.groups[group]}): put "
                "all its keys into one",
            )
        self.found.groups[group] = line
        self.shift()
        while self.token.kind != "/":
            self.take_key(group, line)
        self.check_end()
        self.shift()

    def take_key(self, group: str, line: int) -> None:
        """Take a key with all its values, up to the next key or the end of the group."""
        if self.token.kind != WORD or self.after.kind != "=":
            raise self.refused_token(group, line)
        entry = Entry(group, self.name("key"), self.token.line)
        former = self.found.entries.setdefault((group, entry.key), entry)
        if former is not entry:
            raise self.tokens.fail(
                entry.line,
                f"key '{entry.key}' is given twice (first on line {former.line}): remove one",
            )
        self.shift()
        self.shift()
        needs_value = True
        while self.token.kind in (WORD, QUOTED, ",") and not self.begins_key():
            if self.token.kind != ",":
                self.take_values(entry)
            elif needs_value:
                raise self.tokens.fail(
                    self.token.line,
                    f"empty value of key '{entry.key}': give a value or remove the ','",
                )
            needs_value = self.token.kind == ","
            self.shift()
        self.check_end()
        is_next = self.begins_key() and self.after.kind == "="
        if not entry.values and (self.token.kind == "/" or is_next):
            raise self.tokens.fail(
                entry.line, f"key '{entry.key}' has no value: give one, or remove the key"
            )

    def take_values(self, entry: Entry) -> None:
        """Take a value, with or without a repeat count."""
        text, repeats = self.repeated(entry.key)
        if self.after.is_attached and self.after.kind in (WORD, QUOTED):
            raise self.tokens.fail(
                self.token.line,
                f"key '{entry.key}': '{shown(text)}' and what follows are not apart: put ',' "
                "between values and a whole text into one pair of quotes, a quote inside it "
                "doubled",
            )
        self.count += repeats
        if self.count > MOST_VALUES:
            raise self.tokens.fail(
                self.token.line,
                f"key '{entry.key}': more than {MOST_VALUES} values in the file: give fewer",
            )
        value = Value(text, self.token.kind == QUOTED, self.token.line)
        entry.values.extend([value] * repeats)

    def repeated(self, key: str) -> tuple[bytes, int]:
        """Return a value and its repeat count, of ``1.0``, ``3*1.0`` or ``3*'text'``."""
        count, star, text = self.token.text.partition(b"*")
        if self.token.kind != WORD or not star or not count.isdigit():
            return self.token.text, 1
        repeats = int(count) if len(count) <= 9 else 0
        if not 1 <= repeats <= MOST_VALUES:
            raise self.tokens.fail(
                self.token.line,
                f"repeat count in '{shown(self.token.text)}' of key '{key}' must be from 1 to "
                f"{MOST_VALUES}",
            )
        if text:
            return text, repeats
        if self.after.kind == QUOTED and self.after.is_attached:
            self.shift()
            return self.token.text, repeats
        raise self.tokens.fail(
            self.token.line,
            f"empty value of key '{key}': give a value after '{shown(self.token.text)}'",
        )

    def name(self, what: str) -> str:
        """Return the token at hand as the name of a group or key."""
        token: Token = self.token
        is_name = token.kind == WORD and len(token.text) <= NAME_LENGTH
        if not (is_name and _NAME.fullmatch(token.text)):
            raise self.tokens.fail(
                token.line,
                f"'{shown(token.text)}' is not the name of a {what}: use letters, digits and '_', "
                f"at most {NAME_LENGTH}, a letter first",
            )
        return token.text.lower().decode()

    def begins_key(self) -> bool:
        """Return whether the token at hand is a key, and not a value of the key before."""
        return self.token.kind == WORD and self.after.kind in ("=", "(")

    def refused_token(self, group: str, line: int) -> SurfaceError:
        """Return the reason why a key is missing here."""
        token = self.token
        if token.kind == END:
            return self.tokens.fail(
                line, f"group &{group} is not closed: put '/' on a line of its own at its end"
            )
        if token.kind == "&":
            message = f"group &{group} of line {line} is not closed: put '/' on a line of its own "
            message += "before this one"
        elif token.kind == "(":
            message = "'(' is not accepted: write a list as 'key = a, b, c'"
        elif token.kind in ("=", ","):
            message = f"'{token.kind}' without a key before it: write 'key = value'"
        elif self.begins_key():
            message = f"'(' after '{shown(token.text)}': array elements are not accepted: write "
            message += "the whole list as 'key = a, b, c'"
        else:
            message = f"no key before '{shown(token.text)}', or no '=' after it: write "
            message += "'key = value'"
        return self.tokens.fail(token.line, message)

    def check_end(self) -> None:
        """Refuse a '/' that belongs to something else."""
        is_apart = not self.after.is_attached or self.after.kind in ("&", END)
        if self.token.kind == "/" and not is_apart:
            raise self.tokens.fail(
                self.token.line,
                "'/' ends a group: put text that holds '/' into quotes, write fractions as decimal "
                "numbers, and begin a new line after '/'",
            )
