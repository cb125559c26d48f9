"""A small sweep of every kind of case on two ranks, interrupted once; in debug builds too, where every access is checked."""

import os
import re
import signal
import subprocess
import time
import unittest

from ehlwave_program import HANGS_S, MPI_ENVIRONMENT, FolderTest, environment, mpi_command, namelist
from store_reading import finished

TABLE = """load_parameter_m,radius_ratio_d,orientation,wavelength_over_a,response,slip_parameter,method,end_time
20,1,none,,,,,
20,1,none,,,,fas,
20,0,none,,,,,
20,0.5,transverse,1,harmonic,1.5,,
20,0,transverse,2,,,,0.5
20,1,isotropic,2,,,,0.25
20,1,longitudinal,2,,,,
"""
GROUPS = {"sweep": {"case_file": "cases.csv", "checkpoint_seconds": 0, "output": "results.h5"},
          "conditions": {"lubricant_parameter_l": 5}, "grid": {"cells_x": 32, "cells_y": 32}, "output": {"fields": True}}
CASES = len(TABLE.splitlines()) - 1
COMPLAINTS = re.compile(r"runtime error|Sanitizer|Fortran runtime|Backtrace|SIGFPE", re.IGNORECASE)


class SmallSweep(FolderTest):
    def setUp(self):
        super().setUp()
        (self.folder/"sweep.nml").write_text(namelist(GROUPS))
        (self.folder/"cases.csv").write_text(TABLE)

    def start(self, *options):
        command = [*mpi_command(2), os.environ["EHLWAVE_SWEEP"], "sweep.nml", *options]
        return subprocess.Popen(command, cwd=self.folder, env={**os.environ, **MPI_ENVIRONMENT}, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def test_it_is_stopped_and_goes_on(self):
        process = self.start()
        end = time.monotonic() + HANGS_S
        while not finished(self.folder/"results.store") and process.poll() is None and time.monotonic() < end:
            time.sleep(0.02)
        process.send_signal(signal.SIGUSR1)
        said, _ = process.communicate(timeout=HANGS_S)
        self.assertNotRegex(said, COMPLAINTS)
        held = len(finished(self.folder/"results.store"))
        self.assertGreater(held, 0, said)

        process = self.start()
        said, _ = process.communicate(timeout=HANGS_S)
        self.assertEqual(process.returncode, 0, said)
        self.assertNotRegex(said, COMPLAINTS)
        self.assertIn(f"{held} of {CASES} cases found in the store", said)
        self.assertEqual(len(finished(self.folder/"results.store")), CASES)
        for option in ("--status", "--plan"):
            outcome = subprocess.run([os.environ["EHLWAVE_SWEEP"], option, "results.h5" if option == "--status" else "sweep.nml"],
                                     cwd=self.folder, env=environment(0), capture_output=True, text=True,
                                     check=False)
            self.check_status(outcome)
            self.assertNotRegex(outcome.stdout + outcome.stderr, COMPLAINTS)


if __name__ == "__main__":
    unittest.main()
