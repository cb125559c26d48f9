"""Nothing that a terminal would obey comes from names, inputs, results or stores to it."""

import shutil
import subprocess
import unittest
import zlib
from pathlib import Path

from ehlwave_program import VERSION, FolderTest, namelist, run

SWEEP = {"sweep": {"load_parameter_m": [20, 25], "lubricant_parameter_l": 5, "radius_ratio_d": 1}, "grid": {"cells_x": 16, "cells_y": 16}}
ROOT = Path(__file__).parents[2]
HARM = "\x1b]0;owned\x07\x1b[2J\x9b31m"
UNPRINTABLE = {*range(32), 127, *range(128, 160)} - {10}


class Terminal(FolderTest):
    def setUp(self):
        super().setUp()
        (self.folder/"sweep.nml").write_text(namelist(SWEEP))

    def check(self, name, *arguments, status):
        """Check that a run prints no control character except ends of lines; return its output."""
        return self.check_outcome(run(name, *arguments, folder=self.folder), status)

    def check_outcome(self, outcome, status):
        text = outcome.stdout + outcome.stderr
        self.assertEqual(outcome.returncode, status, text)
        self.assertEqual([line for line in text.split("\n") if UNPRINTABLE & set(map(ord, line))], [])
        return text

    def test_names(self):
        """Names of inputs, of results, of stores."""
        for text in [HARM, "a\nNOTICE: all is well", "\x9b31m", "\udc9b31m"]:
            with self.subTest(text=text):
                shutil.copy(self.folder/"sweep.nml", self.folder/f"{text}.nml")
                self.check("sweep", f"{text}.nml", "--output", f"{text}.h5", status=0)
                self.check("sweep", f"{text}.nml", "--output", f"{text}.h5", "--retry", "version", status=0)
                self.check("sweep", "--status", f"{text}.h5", status=0)
                self.check("sweep", f"{text}.nml", "--plan", "--output", f"{text}.h5", status=0)
                self.check("sweep", "--status", f"no{text}.h5", status=2)
                self.check("case", f"{text}.nml", "--output", f"{text}.h5", status=2)
                self.check("case", f"no{text}.nml", status=2)

    def test_options_of_scripts(self):
        said = subprocess.run([ROOT/"scripts"/"build", HARM], capture_output=True, text=True, check=False)
        self.assertIn("unknown preset", self.check_outcome(said, 2))

    def test_crafted_store(self):
        """Every text of the records of a store is replaced by a harmful text; checksums are right."""
        self.check("sweep", "sweep.nml", status=0)
        log = next((self.folder/"results.store"/"records").iterdir())
        lines = []
        for line in log.read_bytes().split(b"\n")[:-1]:
            record = line.split(b" ", 2)[2]
            escaped = b"\\u001b]0;x\\u0007\\u001b[2J"
            if record.startswith(b"case "):
                for word in (b'"converged"', b'"unresolved"'):
                    record = record.replace(word, b'"stalled"')
                record = record.replace(b'"none"', b'"' + escaped + b'"').replace(b'""', b'"' + escaped + b'"')
            elif record.startswith(b"run "):
                record = record.replace(f'"{VERSION}"'.encode(), b'"' + escaped + b'"')
            lines.append(b"%08x %d %s\n" % (zlib.crc32(record), len(record), record))
        log.write_bytes(b"".join(lines))
        text = self.check("sweep", "--status", "results.h5", status=1)
        self.assertIn("stalled", text)
        self.assertIn("?]0;x?", text)
        text = self.check("sweep", "sweep.nml", status=1)
        self.assertIn("ehlwave ?]0;x??[2J", text)
        store = self.folder/"results.store"/"store"
        store.write_text(HARM)
        self.check("sweep", "sweep.nml", status=2)


if __name__ == "__main__":
    unittest.main()
