"""Results of computed contacts, kept on disk.

Each entry is a file named after the SHA-256 digest of the input and the program. Its first line is
the digest of the rest, JSON. Entries are written under temporary names and renamed, so that several
processes can share the folder. Broken entries are computed again. A folder that cannot be written
keeps nothing.
"""

import contextlib
import hashlib
import json
import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from ehlwave.writing import keep_own_file, remove_own_file

FORMAT = "1"
FOLDER = "EHLWAVE_CACHE"
"""Environment variable with another folder."""

_NAME = re.compile(r"[0-9a-f]{64}\.json|\.ehlwave-\w+\.part")
"""Names of entries, and of entries that a stopped process left unfinished."""


def cache_folder() -> Path:
    """Return the folder of the entries.

    ``EHLWAVE_CACHE``, else ``ehlwave`` in ``XDG_CACHE_HOME`` (an absolute path) or ``~/.cache``.

    Examples
    --------
    >>> from ehlwave.programs.cache import cache_folder
    >>> cache_folder().name
    'ehlwave'
    """
    if own := os.environ.get(FOLDER):
        return Path(own)
    base = Path(os.environ.get("XDG_CACHE_HOME", ""))
    if not base.is_absolute():
        base = Path(os.path.expanduser("~"), ".cache")  # noqa: PTH111 - never raises
    return base / "ehlwave"


def digest(keys: Mapping[str, Any], program: str) -> str:
    """Return the name of an entry by its input and the program's version."""
    given = {key: value for key, value in keys.items() if value is not None}
    document = [FORMAT, program, sorted((key, repr(given[key])) for key in given)]
    return hashlib.sha256(json.dumps(document).encode()).hexdigest()


def stored(name: str) -> dict[str, Any] | None:
    """Return an entry; None if there is none, or if it is broken."""
    try:
        first, _, rest = (cache_folder() / f"{name}.json").read_bytes().partition(b"\n")
        if first.decode("ascii") != hashlib.sha256(rest).hexdigest():
            return None
        document = json.loads(rest)
        return dict(document["result"]) if document["name"] == name else None
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return None


def store(name: str, keys: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    """Keep an entry; where the folder cannot be written nothing is kept."""
    input_ = {key: value for key, value in keys.items() if value is not None}
    document = {"name": name, "input": input_, "result": dict(result)}
    rest = json.dumps(document).encode()
    data = hashlib.sha256(rest).hexdigest().encode() + b"\n" + rest
    with contextlib.suppress(OSError):
        keep_own_file(cache_folder() / f"{name}.json", data)


def entries() -> Iterator[tuple[Path, dict[str, Any] | None]]:
    """Yield the files of the folder with their inputs; None: an entry that is broken."""
    try:
        paths = sorted(cache_folder().iterdir())
    except OSError:
        return
    for path in paths:
        if _NAME.fullmatch(path.name) is None or not path.is_file():
            continue
        found = None
        if path.suffix == ".json" and stored(path.stem) is not None:
            rest = path.read_bytes().partition(b"\n")[2]
            found = dict(json.loads(rest)["input"])
        yield path, found


def clear() -> int:
    """Remove all entries, and nothing else; return how many."""
    return sum(remove_own_file(path) for path, _ in list(entries()))
