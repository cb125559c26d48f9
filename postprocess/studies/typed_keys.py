"""Write the keys of the program as types, for editors and type checkers, and as pages.

python -m studies.typed_keys   writes src/ehlwave/inputs/keys.py and key_table.py from
                               ehlwave-case --keys --json, and the pages of inputs/keys from
                               ehlwave-sweep --keys --markdown
"""

import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ehlwave.cases.keys import key_table
from ehlwave.contact.conditions_from_keys import KNOWN_KEYS
from ehlwave.programs.programs import find_program
from ehlwave.writing import Writer

PLACE = Path(__file__).parents[1] / "src" / "ehlwave" / "inputs" / "keys.py"
TABLE_PLACE = PLACE.with_name("key_table.py")
PAGES = Path(__file__).parents[2] / "inputs" / "keys"
TYPES = {"number": "SupportsFloat", "whole": "SupportsIndex", "truth": "bool", "word": "str"}
WIDTH = 100

OBJECTS = dict.fromkeys(("file", "file_2"), "Text | SurfaceLike | TopographyLike")
"""Keys that take more than the name of a file."""

HEADER = '''\
"""The keys of input files as types. Written by ``python -m studies.typed_keys``: do not edit."""

from __future__ import annotations

from os import PathLike
from typing import TYPE_CHECKING, Literal, SupportsFloat, SupportsIndex, TypedDict

if TYPE_CHECKING:
    from ehlwave.inputs.surfaces import SurfaceLike, TopographyLike

Text = str | PathLike[str]
'''

TABLE = '''\
"""Key table of the programs. Written by ``python -m studies.typed_keys``: do not edit."""

from ehlwave.inputs.key import Key

KEYS: dict[str, Key] = {{
{rows}}}
"""Keys in the order of the table."""

GROUP_OF = {{name: key.group for name, key in KEYS.items()}}
"""Group of each key in a file."""
'''

CLASS = '''

class {name}({base}, total=False):
    """{text}"""

'''

OF_SWEEPS = {
    "unresolved": 'Literal["run", "skip"]',
    "largest_case_seconds": "SupportsFloat",
    "checkpoint_seconds": "SupportsFloat",
    "case_file": "Text",
    "output": "Text",
}
"""Keys of ``&sweep`` other than lists, which the program leaves out of JSON."""


def module(keys: Sequence[dict[str, Any]]) -> str:
    """Return the text of the module, from the rows of :func:`ehlwave.cases.keys.key_table`."""
    known = {key["name"]: key for key in keys}
    contact = {name: known.get(name, {"kind": "number"}) for name in KNOWN_KEYS}
    parts = [HEADER, CLASS.format(name="CaseKeys", base="TypedDict", text="Keys of a case.")]
    parts += [_member(name, key) for name, key in known.items()]
    parts.append(CLASS.format(name="StudyKeys", base="CaseKeys", text="Shared by all of a study."))
    parts += [f"    {name}: {kind}\n" for name, kind in OF_SWEEPS.items()]
    text = "Keys of :class:`ehlwave.Contact`."
    parts.append(CLASS.format(name="ContactKeys", base="TypedDict", text=text))
    parts += [_member(name, key) for name, key in contact.items()]
    return "".join(parts)


def table(keys: Sequence[dict[str, Any]]) -> str:
    """Return the text of the module with the key table, from the same rows."""
    rows = "".join(_row(str(key["name"]), key) for key in keys)
    return TABLE.format(rows=rows)


def _row(name: str, key: dict[str, Any]) -> str:
    """Return a row of the key table."""
    words = [repr(key["group"]), repr(key["kind"])]
    short = name.removesuffix("_2") if key["group"].endswith("2") else ""
    more = {"unit": "" if key["unit"] == "1" else key["unit"]}
    more |= {bound: key[bound] for bound in ("above", "minimum", "maximum")}
    more |= {"choices": tuple(key["choices"]), "short": short}
    given = {name: value for name, value in more.items() if not _is_nothing(value)}
    words += [f"{name}={_number(value)}" for name, value in given.items()]
    words = [word.replace("'", '"') for word in words]
    if len(line := f'    "{name}": Key({", ".join(words)}),\n') <= WIDTH:
        return line
    lines = "".join(f"        {word},\n" for word in words)
    return f'    "{name}": Key(\n{lines}    ),\n'


def _is_nothing(value: Any) -> bool:  # noqa: ANN401 - of a table
    return value is None or value in ("", ()) or value != value


def _number(value: Any) -> str:  # noqa: ANN401 - of a table
    return f"{value:.15g}" if isinstance(value, (int, float)) else repr(value)


def _member(name: str, key: dict[str, Any]) -> str:
    kind = TYPES[key["kind"]]
    if kind == "str":
        words = [f'"{word}"' for word in key["choices"]]
        kind = f"Literal[{', '.join(words)}]" if words else OBJECTS.get(name, "Text")
        if len(line := f"    {name}: {kind}\n") > WIDTH:
            kind = "Literal[\n" + "".join(f"        {word},\n" for word in words) + "    ]"
    line = f"    {name}: {kind}\n"
    if not key.get("help"):
        return line
    unit = "" if key["unit"] == "1" else f", {key['unit']}"
    said = f"{key['help']}{unit}".replace('"', "'")
    return line + f'    """{_cut(said)}"""\n'


def _cut(text: str) -> str:
    """Return a text that fits into a line, cut at a semicolon or comma where it is longer."""
    room = WIDTH - 10
    for mark in ("; ", ", ", " "):
        while len(text) > room and mark in text:
            text = text.rpartition(mark)[0]
    return text.rstrip(":;,")


def pages(reference: str) -> dict[Path, str]:
    """Return a page for each group of the reference that the program prints."""
    groups = re.split(r"^#(?=# `&(\w+)`$)", reference, flags=re.MULTILINE)[1:]
    return {
        PAGES / f"{name}.md": text.rstrip("\n") + "\n"
        for name, text in zip(groups[::2], groups[1::2], strict=True)
    }


def main(arguments: Sequence[str] = ()) -> int:
    """Write modules and pages."""
    if arguments:
        print(__doc__)
        return 2
    rows: Any = key_table().to_dict("records")
    words = [str(find_program("ehlwave-sweep")), "--keys", "--markdown"]
    reference = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    texts = {PLACE: module(rows), TABLE_PLACE: table(rows), **pages(reference)}
    for place, text in texts.items():
        Writer(overwrite=True).text(place, text)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
