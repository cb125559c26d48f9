"""scripts/study full: its sweep files, its stages, its behaviour when a stage stops."""

import csv
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import FolderTest, run

ROOT = Path(os.environ["EHLWAVE_ROOT"])
INPUTS = ROOT / "inputs" / "full"
CASES = {"paper_grid": "720 cases, 552 resolved", "resolved": "672 cases, 672 resolved",
         "dense": "1830 cases, 1830 resolved", "rheology": "102 cases, 102 resolved", "companion": "2 cases, 2 resolved"}

# Substitute for ehlwave-sweep: notes its call, ends with the status in the file `status`.
PROGRAM = """#!/bin/sh
echo "$@" >>"$CALLS"
if [ -e "$CALLS.status" ]; then exit "$(cat "$CALLS.status")"; fi
"""
LAUNCHER = """#!/bin/sh
shift 2
exec "$@"
"""


class Inputs(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("scipy"), "scipy is not installed for this Python")
    def test_sweeps_have_the_cases_they_say(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-m", "studies.paper.cases", "dense", "dense.csv"],
                           cwd=folder, check=True)
            for name, said in CASES.items():
                with self.subTest(sweep=name):
                    outcome = run("sweep", INPUTS / f"{name}.nml", "--plan", folder=folder)
                    self.assertEqual(outcome.returncode, 0, outcome.stderr)
                    counted = [line for line in outcome.stdout.split("\n") if " resolved, " in line]
                    self.assertEqual(len(counted), 1)
                    self.assertTrue(counted[0].startswith(said), counted[0])


class Stages(FolderTest):
    def setUp(self):
        super().setUp()
        self.calls = self.folder / "calls"
        for name, text in (("ehlwave-sweep", PROGRAM), ("launcher", LAUNCHER)):
            (self.folder / name).write_text(text)
            (self.folder / name).chmod(0o755)

    def study(self, *stages):
        environment = {**os.environ, "EHLWAVE_PROGRAMS": str(self.folder), "CALLS": str(self.calls),
                       "EHLWAVE_LAUNCHER": str(self.folder / "launcher")}
        words = [word for stage in stages for word in ("--stage", stage)]
        return subprocess.run([ROOT / "scripts" / "study", "full", "--output", self.folder / "out", "--ranks", "2", *words],
                              env=environment, capture_output=True, text=True, check=False)

    def stages(self):
        with (self.folder / "out" / "stages.csv").open(newline="") as file:
            return [(row["stage"], row["exit_status"]) for row in csv.DictReader(file)]

    def test_the_stages_that_are_asked_for(self):
        outcome = self.study("companion", "rheology")
        self.check_status(outcome)
        calls = [line for line in self.calls.read_text().splitlines() if "--status" not in line]
        self.assertEqual(len(calls), 6)
        self.assertIn("companion.nml --output", calls[0])
        self.assertEqual([name for name, _ in self.stages()][:3], ["companion", "rheology-default", "rheology-barus"])
        self.assertTrue((self.folder / "out" / "rheology-barus.nml").read_text().endswith("&lubricant viscosity_law = 'barus' /\n"))

    def test_a_stage_that_is_stopped_stops_the_study(self):
        Path(f"{self.calls}.status").write_text("85")
        outcome = self.study("companion", "paper_grid")
        self.assertEqual(outcome.returncode, 85)
        self.assertIn("the same command goes on", outcome.stderr)
        self.assertEqual(self.stages(), [("companion", "85")])

    def test_cases_that_did_not_converge_do_not_stop_it(self):
        Path(f"{self.calls}.status").write_text("1")
        outcome = self.study("companion", "paper_grid")
        self.assertEqual(outcome.returncode, 1)
        self.assertEqual(self.stages(), [("companion", "1"), ("paper_grid", "1")])

    def test_an_unknown_stage_is_refused(self):
        outcome = self.study("figures")
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("--stage: invalid choice: 'figures'", outcome.stderr)


if __name__ == "__main__":
    unittest.main()
