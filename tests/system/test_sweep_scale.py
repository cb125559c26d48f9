"""Many cases that take no time: size of the store, all of them there once, more ranks than cores, memory and handles."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import IS_LONG, MPI_ENVIRONMENT, TestCase, mpi_command, namelist, report, run
from growth import LARGEST_GROWTH_KIB, growth, samples_of
from hdf5_reading import read

CASES = int(os.environ.get("EHLWAVE_MANY_CASES", "5000" if IS_LONG else "2000"))
LARGEST_CASE = 2048   # bytes in store and results file, without fields


class SweepScale(TestCase):
    def test_many_cases(self):
        """All are there once, in few files; memory and open files of a rank do not grow from 10 % of its cases on."""
        with tempfile.TemporaryDirectory() as folder:
            process = subprocess.Popen(self.command(CASES, 0, ranks=2), cwd=folder, env={**os.environ, **MPI_ENVIRONMENT},
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.addCleanup(process.kill)
            samples = samples_of(process, Path(folder, "results.store", "records", "000001-000001.log"))
            self.assertEqual(process.returncode, 0)
            memory, files, more_memory, more_files = growth(samples)
            report(f"{CASES} cases: {memory} KiB and {files} files open after 10 %, at most {more_memory} KiB more later")
            self.assertLess(more_memory, LARGEST_GROWTH_KIB)
            self.assertLessEqual(more_files, 0)
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
            self.check_status(outcome)
            self.assertIn(f"{CASES} finished, 0 left", outcome.stdout)

    def test_disk_of_a_case(self):
        """Numbers of the manual for real cases; costs that do not depend on their number cancel in the difference."""
        text = (Path(__file__).parents[2]/"postprocess/manual/explanation/sweeps.md").read_text()
        said = re.search(r"smooth (\S+) and (\S+) kB a case, linear responses (\S+) and (\S+) kB", text)
        patterns = {}, {"orientation": "transverse", "wavelength_over_a": 2, "response": "harmonic"}
        for number, pattern in enumerate(patterns):
            sizes = [self.disk(count, pattern) for count in (100, 200)]
            for part, name in enumerate(("store", "results file")):
                bytes_ = (sizes[1][part] - sizes[0][part])/100
                report(f"{name}: {bytes_:.0f} bytes a case")
                self.assertLess(abs(bytes_/(1000*float(said[1 + 2*number + part])) - 1), 0.1, name)

    def disk(self, count, pattern):
        """Bytes in the records of a store and in the results file of so many small cases."""
        sweep = {"load_parameter_m": [20 + 90*i/count for i in range(count)], "lubricant_parameter_l": 5, "radius_ratio_d": 1,
                 "output": "results.h5"}
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "sweep.nml").write_text(namelist({"sweep": sweep, "waviness": pattern, "grid": {"cells_x": 32, "cells_y": 32}}))
            outcome = run("sweep", "sweep.nml", folder=folder)
            self.assertIn(outcome.returncode, (0, 1), outcome.stderr)
            return [sum(path.stat().st_size for path in Path(folder, "results.store", "records").iterdir()),
                    Path(folder, "results.h5").stat().st_size]

    def test_more_ranks_than_cores(self):
        with tempfile.TemporaryDirectory() as folder:
            outcome = self.synthetic(folder, 60, 0.2, ranks=10)
            report(outcome.stdout.rstrip().split("\n")[-1])
            _, data = read(Path(folder, "results.h5"))
            self.assertEqual(set(data["status"]), {"converged"})
            self.assertEqual(set(data["rank"]), set(range(10)))   # rank 0 computes, too

    def command(self, cases, seconds, ranks):
        return [*mpi_command(ranks),
                os.environ["EHLWAVE_SYNTHETIC"], str(cases), str(seconds), "results.h5"]

    def synthetic(self, folder, cases, seconds, ranks):
        outcome = subprocess.run(self.command(cases, seconds, ranks), cwd=folder, env={**os.environ, **MPI_ENVIRONMENT},
                                 capture_output=True, text=True, check=False)
        self.check_status(outcome)
        return outcome


if __name__ == "__main__":
    unittest.main()
