"""Many cases that take no time: size of the store, all of them there once, more ranks than cores."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import MPI_ENVIRONMENT, mpi_command, report, run
from hdf5_reading import read

CASES = 3000
LARGEST_CASE = 2048   # bytes in store and results file, without fields


class SweepScale(unittest.TestCase):
    def test_many_cases(self):
        with tempfile.TemporaryDirectory() as folder:
            outcome = self.synthetic(folder, CASES, 0, ranks=4)
            report(outcome.stdout.rstrip().split("\n")[-1])
            paths = [path for path in Path(folder).rglob("*") if path.is_file()]
            size = sum(path.stat().st_size for path in paths)/CASES
            report(f"{size:.0f} bytes per case in {len(paths)} files")
            self.assertLess(size, LARGEST_CASE)
            self.assertLess(len(paths), 20)
            _, data = read(Path(folder, "results.h5"))
            self.assertEqual(len(set(data["case_id"])), CASES)
            self.assertEqual(set(data["status"]), {"converged"})
            self.assertTrue((data["amplitude_ratio"] >= 0).all())
            outcome = run("sweep", "--status", "results.h5", folder=folder)
            self.assertEqual(outcome.returncode, 0, outcome.stderr)
            self.assertIn(f"{CASES} finished, 0 left", outcome.stdout)

    def test_more_ranks_than_cores(self):
        with tempfile.TemporaryDirectory() as folder:
            outcome = self.synthetic(folder, 60, 0.2, ranks=10)
            report(outcome.stdout.rstrip().split("\n")[-1])
            _, data = read(Path(folder, "results.h5"))
            self.assertEqual(set(data["status"]), {"converged"})
            self.assertEqual(set(data["rank"]), set(range(10)))   # rank 0 computes, too

    def synthetic(self, folder, cases, seconds, ranks):
        command = [*mpi_command(ranks),
                   os.environ["EHLWAVE_SYNTHETIC"], str(cases), str(seconds), "results.h5"]
        outcome = subprocess.run(command, cwd=folder, env={**os.environ, **MPI_ENVIRONMENT}, capture_output=True,
                                 text=True, check=False)
        self.assertEqual(outcome.returncode, 0, outcome.stdout + outcome.stderr)
        return outcome


if __name__ == "__main__":
    unittest.main()
