"""``ehlwave cache``: lists and clears kept results."""

import argparse
import json
from collections import Counter
from typing import Any

from ehlwave.programs.cache import cache_folder, clear, entries

OF_CASES = ("wavelength_x_over_a", "wavelength_y_over_a", "accuracy", "cells_x", "cells_y")
OF_WAVES = ("orientation", "response", "amplitude_over_film", "mean_rise", "scheme")
"""Keys in which the entries of one contact differ."""


def run_cache(options: argparse.Namespace) -> None:
    """Print the content of the cache, or clear it."""
    folder = cache_folder()
    if options.clear:
        removed = clear()
        document: dict[str, Any] = {"folder": str(folder), "removed": removed}
        text = f"{folder}: {removed} results removed"
    else:
        document = {"folder": str(folder), **contents()}
        text = _text(document)
    print(json.dumps(document, indent=2) if options.json else text)


def contents() -> dict[str, Any]:
    """Return size, contacts with their numbers of results, and the number of broken files."""
    contacts: Counter[str] = Counter()
    size, broken = 0, 0
    for path, keys in entries():
        size += path.stat().st_size
        if keys is None:
            broken += 1
            continue
        of_contact = {key: keys[key] for key in keys if key not in (*OF_CASES, *OF_WAVES)}
        contacts[", ".join(f"{key} = {value}" for key, value in of_contact.items())] += 1
    rows = [{"contact": contact, "results": count} for contact, count in contacts.items()]
    return {"bytes": size, "results": contacts.total(), "broken": broken, "contacts": rows}


def _text(document: dict[str, Any]) -> str:
    lines = [
        f"{document['folder']}: {document['results']} results of {len(document['contacts'])} "
        f"contacts, {document['bytes'] / 1024:.0f} KiB"
    ]
    if document["broken"]:
        lines.append(f"{document['broken']} broken or unfinished files; they are not used")
    lines += [f"{row['results']:5d}  {row['contact']}" for row in document["contacts"]]
    return "\n".join(lines)
