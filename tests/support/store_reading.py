"""The logs of a store, read by the rules of src/store/README.md but by other means than the program's own."""

import json
import zlib
from pathlib import Path


def records(path):
    """Good records of a log, in order; damaged lines are skipped."""
    found = []
    for line in Path(path).read_bytes().split(b"\n")[:-1]:
        parts = line.split(b" ", 2)
        if len(parts) == 3 and parts[1].isdigit() and int(parts[1]) == len(parts[2]) \
                and f"{zlib.crc32(parts[2]):08x}".encode() == parts[0]:
            found.append(parts[2].decode())
    return found


def finished(store):
    """{identity: {column: value}} of all cases done, the last run counting."""
    cases = {}
    for path in sorted(Path(store, "records").glob("*.log")):
        columns = None
        for record in records(path):
            word, _, rest = record.partition(" ")
            if word == "columns":
                columns = [name for name, _ in json.loads(rest)]
            elif word == "case" and columns:
                row = dict(zip(columns, json.JSONDecoder().raw_decode(rest)[0], strict=True))
                cases[row["case_id"]] = row
    return cases


def count_records(store, word):
    """How many records of a kind there are in all logs."""
    return sum(record.split(" ")[0] == word for path in Path(store, "records").glob("*.log") for record in records(path))
