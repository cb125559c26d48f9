"""scripts/run-sweep beside a launcher that misbehaves; how it starts again is in test_sweep_resume."""

import os
import resource
import subprocess
import unittest
from pathlib import Path

from ehlwave_program import HANGS_S, FolderTest, namelist

SCRIPT = Path(__file__).parents[2]/"scripts"/"run-sweep"
SWEEP = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": [1, 0.5]}
# Called as mpirun: `-n RANKS PROGRAM ...`. The first time its rank ends, and it neither takes note of that nor ends.
LOCKS_UP_ONCE = """#!/usr/bin/env python3
import os, pathlib, subprocess, sys, time
shift = sys.argv[3:]
if pathlib.Path("called").exists():
    os.execv(shift[0], shift)
pathlib.Path("called").touch()
child = subprocess.Popen(["true"])
time.sleep(7200)
"""

# The rank waits for ever in the start of MPI.
NEVER_STARTS = LOCKS_UP_ONCE.replace('["true"]', '["sleep", "7200"]').replace("sys.argv[3:]", '["false"]')


class RunSweep(FolderTest):
    def setUp(self):
        super().setUp()
        (self.folder/"sweep.nml").write_text(namelist({"sweep": SWEEP, "grid": {"cells_x": 32, "cells_y": 32}}))
        (self.folder/"launcher").write_text(LOCKS_UP_ONCE)
        (self.folder/"launcher").chmod(0o755)

    def sweep(self, *arguments, ranks=1, before=None):
        """Run the sweep by this launcher."""
        variables = {"EHLWAVE_LAUNCHER": "./launcher", "EHLWAVE_PATIENCE": "1"}
        return subprocess.run([SCRIPT, "sweep.nml", "--ranks", str(ranks), *arguments], cwd=self.folder, text=True, capture_output=True,
                              check=False, timeout=HANGS_S, env={**os.environ, **variables}, preexec_fn=before)

    def test_a_launcher_that_locks_up_is_killed(self):
        outcome = self.sweep("--output", "results.h5")
        self.check_status(outcome)
        self.assertIn("all ranks have ended", outcome.stdout)
        self.assertIn("start 1 of at most 5 again", outcome.stdout)
        self.assertTrue((self.folder/"results.h5").exists())

    def test_a_start_that_never_comes_is_ended(self):
        (self.folder/"launcher").write_text(NEVER_STARTS)
        few = 1 << 20
        outcome = self.sweep(before=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (few, few)))
        self.check_status(outcome, 3)
        self.assertIn("MPI cannot start: files may have 1024 kB only", outcome.stdout)

    def test_no_ranks_are_bad_input(self):
        for ranks in ("0", "-1", "two", ""):
            outcome = self.sweep(ranks=ranks)
            self.check_status(outcome, 2)
            self.assertRegex(outcome.stderr, r"^run-sweep: --ranks wants a whole number above 0[^\n]*\n$")


if __name__ == "__main__":
    unittest.main()
