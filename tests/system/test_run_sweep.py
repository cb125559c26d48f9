"""scripts/run-sweep beside a launcher that misbehaves; how it starts again is in test_sweep_resume."""

import os
import resource
import subprocess
import time
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

# The first time it is killed while its rank computes, which goes on.
IS_KILLED_ONCE = """#!/usr/bin/env python3
import os, pathlib, signal, subprocess, sys, time
shift = sys.argv[3:]
if pathlib.Path("called").exists():
    os.execv(shift[0], shift)
pathlib.Path("called").touch()
subprocess.Popen(shift, stdout=subprocess.DEVNULL, start_new_session=True)
end = time.monotonic() + 60
while "a job is at work" not in subprocess.run([shift[0], "--status", "results.h5"], capture_output=True, text=True).stdout:
    if time.monotonic() > end:
        sys.exit(9)
os.kill(os.getpid(), signal.SIGKILL)
"""
# Open MPI whose trial start is ended by the signal of a batch system.
IS_TRIED = """#!/bin/sh
if [ "$1" = --version ]; then echo 'mpirun (Open MPI) 4.1.4'; exit; fi
touch tried
sleep 1
exit 143
"""
# Open MPI that locks up in the trial start, as mpirun does where about 30 files may be open.
LOCKS_UP_WHEN_TRIED = IS_TRIED.replace("sleep 1\nexit 143", "exec sleep 600")
SHORT_S = 60   # far below the trial that locks up


class RunSweep(FolderTest):
    def setUp(self):
        super().setUp()
        (self.folder/"sweep.nml").write_text(namelist({"sweep": SWEEP, "grid": {"cells_x": 32, "cells_y": 32}}))
        (self.folder/"launcher").write_text(LOCKS_UP_ONCE)
        (self.folder/"launcher").chmod(0o755)

    def sweep(self, *arguments, ranks=1, before=None, patience=1):
        """Run the sweep by this launcher."""
        variables = {"EHLWAVE_LAUNCHER": "./launcher", "EHLWAVE_PATIENCE": str(patience)}
        return subprocess.run([SCRIPT, "sweep.nml", "--ranks", str(ranks), *arguments], cwd=self.folder, text=True, capture_output=True,
                              check=False, timeout=HANGS_S, env={**os.environ, **variables}, preexec_fn=before)

    def test_a_launcher_that_locks_up_is_killed(self):
        outcome = self.sweep("--output", "results.h5")
        self.check_status(outcome)
        self.assertIn("all ranks have ended", outcome.stdout)
        self.assertIn("restart 1 of at most 5", outcome.stdout)
        self.assertTrue((self.folder/"results.h5").exists())

    def test_a_launcher_that_is_killed_leaves_ranks_to_wait_for(self):
        (self.folder/"launcher").write_text(IS_KILLED_ONCE)
        slow = {**SWEEP, "radius_ratio_d": [1, 0.9, 0.8, 0.7, 0.6, 0.5]}
        (self.folder/"sweep.nml").write_text(namelist({"sweep": slow, "grid": {"cells_x": 384, "cells_y": 384}}))
        outcome = self.sweep("--output", "results.h5", patience=60)
        self.check_status(outcome)
        self.assertIn("restart 1 of at most 5", outcome.stdout)
        self.assertIn("6 of 6 cases found in the store", outcome.stdout)

    def start_beside(self, mpirun, patience):
        """Start the sweep by this mpirun."""
        (self.folder/"mpirun").write_text(mpirun)
        (self.folder/"mpirun").chmod(0o755)
        variables = {name: value for name, value in os.environ.items() if name != "EHLWAVE_LAUNCHER"}
        variables |= {"PATH": f"{self.folder}:{os.environ['PATH']}", "EHLWAVE_PATIENCE": str(patience)}
        return subprocess.Popen([SCRIPT, "sweep.nml", "--ranks", "1", "--output", "results.h5"], cwd=self.folder, text=True,
                                env=variables, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def said_by(self, process):
        """Output of a process up to its end, which comes soon."""
        try:
            return process.communicate(timeout=SHORT_S)[0]
        except subprocess.TimeoutExpired:
            process.kill()
            raise

    def test_a_signal_while_the_launcher_is_tried(self):
        for mpirun in (IS_TRIED, LOCKS_UP_WHEN_TRIED):
            (self.folder/"tried").unlink(missing_ok=True)
            with self.start_beside(mpirun, patience=600) as process:
                end = time.monotonic() + SHORT_S
                while not (self.folder/"tried").exists() and time.monotonic() < end:
                    time.sleep(0.01)
                process.terminate()
                said = self.said_by(process)
            self.assertEqual(process.returncode, 85, said)
            self.assertRegex(said, r"the same command goes on \(exit status 85\)\n$")

    def test_a_trial_that_locks_up_is_ended(self):
        with self.start_beside(LOCKS_UP_WHEN_TRIED, patience=1) as process:
            said = self.said_by(process)
        self.assertEqual(process.returncode, 4, said)
        self.assertIn("cannot start (number of ranks: 1)", said)

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
