"""`scripts/accept` on this build, which is the gate on counts of work too; and its refusals."""

import csv
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import TestCase

SCRIPT = Path(__file__).parents[2]/"scripts"/"accept"
SHIPPED = SCRIPT.with_suffix(".csv")


def accept(*options):
    return subprocess.run([sys.executable, "-B", SCRIPT, *options], capture_output=True, text=True, check=False)


class Accept(TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.own = cls.folder/"own.csv"
        cls.outcome = accept(os.environ["EHLWAVE_CASE"])
        written = accept(os.environ["EHLWAVE_CASE"], "--write", "--values", cls.own)
        if written.returncode != 0:
            raise AssertionError(written.stdout + written.stderr)

    def test_this_build(self):
        self.check_status(self.outcome)
        self.assertIn("21 of 21 cases accepted", self.outcome.stdout)

    def test_numbers_that_are_off(self):
        """A film, an amplitude, and more work than before, each in a case of its own."""
        changes = {"smooth": ("central_film", 1 + 2e-6), "transverse": ("amplitude_ratio_fit", 1 + 2e-5),
                   "longitudinal": ("linear_steps", 0.9)}
        with self.own.open(newline="") as file:
            rows = list(csv.DictReader(file))
        for row in rows:
            if row["case"] in changes:
                column, factor = changes[row["case"]]
                row[column] = float(row[column])*factor if "steps" not in column else round(float(row[column])*factor)
        changed = self.folder/"changed.csv"
        with changed.open("w", newline="") as file:
            writer = csv.DictWriter(file, rows[0])
            writer.writeheader()
            writer.writerows(rows)
        outcome = accept(os.environ["EHLWAVE_CASE"], "--values", changed)
        self.check_status(outcome, 1)
        self.assertIn("18 of 21 cases accepted", outcome.stdout)
        failed = [line for line in outcome.stdout.split("\n") if "FAILED" in line]
        self.assertEqual(len(failed), 3)
        for line, (case, (column, _)) in zip(failed, changes.items(), strict=True):
            self.assertTrue(line.startswith(case), line)
            self.assertIn(column, line)

    def test_values_that_are_not_there(self):
        self.assertEqual(accept("--values", self.folder/"none.csv").returncode, 2)
        self.assertEqual(accept(self.folder/"no-program").returncode, 2)

    def test_shipped_values_are_of_all_cases(self):
        self.assertEqual([row.split(",")[0] for row in SHIPPED.read_text().splitlines()],
                         [row.split(",")[0] for row in self.own.read_text().splitlines()])


if __name__ == "__main__":
    unittest.main()
