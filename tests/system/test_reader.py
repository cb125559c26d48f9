"""Both readers of input files, in Fortran and in Python, give the same verdict, message and values."""

import os
import re
import struct
import subprocess
import unittest
from pathlib import Path

from ehlwave.errors import SurfaceError
from ehlwave.inputs.key_table import KEYS
from ehlwave.inputs.key_values import values_of
from ehlwave.inputs.namelist import read_namelist
from ehlwave.inputs.namelist_values import real, truth, whole
from ehlwave_program import HANGS_S, IS_LONG, FolderTest, report
from fuzz import SWEEP, TABLE_SWEEP, Mutator
from reader_files import OF_KEYS, WRITTEN, Drawing, KeyDrawing

KEY_LISTING = os.environ.get("EHLWAVE_KEY_LISTING")
LISTING = os.environ.get("EHLWAVE_NAMELIST_LISTING")
ROOT = Path(__file__).resolve().parents[2]
DRAWN, MUTATED, BOUNDED = (5000, 5000, 20000) if IS_LONG else (60, 60, 500)
ADVICE = re.compile(r"(unknown (group|key)|&\w+ is no group|; did you mean).*")
"""End of a message; each reader has its own."""


def listing(path):
    """Return the output of namelist_listing.f90 for the Python reader."""
    try:
        found = read_namelist(path)
    except SurfaceError as error:
        return f"refused {error}"
    words = ["read"]
    for group, line in found.groups.items():
        words += ["&", group, str(line)]
        for entry in found.entries.values():
            if entry.group == group:
                words += ["=", entry.key, str(entry.line)]
                words += [word for value in entry.values for word in listed(value)]
    return " ".join(words)


def key_listing(path):
    """Return the output of key_listing.f90 for the Python reader."""
    try:
        groups = values_of(read_namelist(path))
    except SurfaceError as error:
        return f"refused {error}"
    words = ["read"]
    for name, key in KEYS.items():
        found = groups.get(key.group, {})
        for one in (name, key.short):
            if one in found:
                words += [name, bits(found[one])]
    return " ".join(words)


def bits(value):
    """Return a value as the listing of keys has it."""
    if isinstance(value, str):
        return "x" + value.encode("utf-8", "surrogateescape").hex().upper()
    return struct.pack(">d", float(value)).hex().upper()


def listed(value):
    """A value of each kind."""
    return ["q" if value.is_quoted else "w", str(value.line), "x" + value.text.hex().upper(),
            reading(real, value, lambda number: struct.pack(">d", number).hex().upper()), reading(whole, value, str),
            reading(truth, value, lambda is_true: "t" if is_true else "f")]


def reading(read, value, written):
    """A value of a kind as text, '-' where it has another."""
    try:
        return written(read(value))
    except ValueError:
        return "-"


@unittest.skipUnless(LISTING, "no namelist_listing")
class Reader(FolderTest):
    def compare(self, what, texts, program=LISTING, own=listing):
        """The lines of both readers, file by file."""
        paths = []
        for number, text in enumerate(texts):
            paths.append(self.folder/f"{number}.nml")
            paths[-1].write_bytes(text)
        done = subprocess.run([program], input="".join(f"{path}\n" for path in paths), capture_output=True, text=True,
                              errors="surrogateescape", timeout=HANGS_S, check=True)
        lines = done.stdout.split("\n")[:-1]
        self.assertEqual(len(lines), len(paths))
        refused = 0
        for path, line in zip(paths, lines):
            refused += line.startswith("refused")
            line, found = (ADVICE.sub("", one) for one in (line, own(path)))
            if line != found:
                self.assertEqual(line[:2000], found[:2000], path.read_bytes()[:2000])
        report(f"{what}: {len(paths)} of {len(paths)} files the same, {refused} refused")
        return refused

    def test_written(self):
        self.assertEqual(self.compare("accepted", [text for text, is_read in WRITTEN if is_read]), 0)
        refused = [text for text, is_read in WRITTEN if not is_read]
        self.assertEqual(self.compare("refused", refused), len(refused))

    def test_inputs_of_the_repository(self):
        texts = [path.read_bytes() for path in sorted((ROOT/"inputs").rglob("*.nml"))]
        self.assertGreater(len(texts), 10)
        self.assertEqual(self.compare("inputs", texts), 0)

    def test_drawn(self):
        drawing = Drawing(seed=5)
        refused = self.compare("drawn", [drawing.next() for _ in range(DRAWN)])
        self.assertTrue(DRAWN/10 < refused < DRAWN*9/10)

    def test_mutated(self):
        corpus = [path.read_bytes() for path in sorted((ROOT/"inputs").glob("*.nml"))]
        corpus += [SWEEP, TABLE_SWEEP.encode()] + [text for text, is_read in WRITTEN if is_read and len(text) < 10**5]
        mutator = Mutator(corpus, seed=6)
        refused = self.compare("mutated", [mutator.next() for _ in range(MUTATED)])
        self.assertTrue(0 < refused < MUTATED)

    def test_bounds_of_keys(self):
        corpus = [path.read_bytes() for path in sorted((ROOT/"inputs").glob("*.nml"))]
        drawing, mutator = KeyDrawing(KEYS, seed=7), Mutator(corpus, seed=8)
        texts = OF_KEYS + corpus + [text for text, _ in WRITTEN if len(text) < 10**5]
        count = BOUNDED - len(texts)
        texts += [drawing.next() if number % 4 else mutator.next() for number in range(count)]
        refused = self.compare("keys", texts, KEY_LISTING, key_listing)
        self.assertTrue(BOUNDED/10 < refused < BOUNDED*9/10)


if __name__ == "__main__":
    unittest.main()
