"""A rank dies at the start of a sweep, in its middle, at its end, within and between the calls of MPI: nothing is lost."""

import os
import subprocess
import unittest

from ehlwave_program import EIGHT_CASES, HANGS_S, IS_LONG, MPI_ENVIRONMENT, SKIPPED, FolderTest, is_open_mpi, mpi_command, namelist
from hdf5_reading import read
from store_reading import finished
from torture import CIRCUMSTANCES

RANKS = 3
# call of MPI, the how manieth, rank that dies in it: begin, settings for all, cases and outcomes, all agree, end
DEATHS = ["mpi_init 1 1", "mpi_bcast 1 0", "mpi_recv 1 1", "mpi_send 3 1", "mpi_isend 4 0", "mpi_allreduce 1 1",
          "mpi_finalize 1 0"]
MORE = ["mpi_init 1 0", "mpi_bcast 2 2", "mpi_isend 1 1", "mpi_bcast 1 1", "mpi_bcast 3 0", "mpi_bcast 4 1",
        "mpi_recv 3 2", "mpi_recv 2 0", "mpi_recv 5 0", "mpi_send 1 2", "mpi_isend 2 2", "mpi_isend 2 0", "mpi_isend 8 0", "mpi_allreduce 1 0", "mpi_finalize 1 2"]


class DeadRanks(FolderTest):
    def setUp(self):
        super().setUp()
        self.expected = self.finish("undisturbed")

    def run_in(self, name, *command, **variables):
        """Run a sweep in a folder of its own; the folder and how it ended."""
        folder = self.folder/name
        folder.mkdir(exist_ok=True)
        (folder/"sweep.nml").write_text(namelist(EIGHT_CASES))
        return folder, subprocess.run([*command, os.environ["EHLWAVE_SWEEP"], "sweep.nml"], cwd=folder, capture_output=True,
                                      env={**os.environ, **MPI_ENVIRONMENT, **variables}, text=True, timeout=HANGS_S, check=False)

    def finish(self, name):
        """Columns of the results of a run that nothing disturbs, but for where and when."""
        folder, outcome = self.run_in(name)
        self.check_status(outcome)
        return {name: repr(list(values)) for name, values in read(folder/"results.h5")[1].items() if name not in CIRCUMSTANCES}

    def test_nothing_is_lost(self):
        for number, death in enumerate(DEATHS + MORE*IS_LONG):
            with self.subTest(death=death):
                folder, outcome = self.run_in(str(number), *mpi_command(RANKS), LD_PRELOAD=os.environ["EHLWAVE_FAULTS"],
                                              EHLWAVE_DEATH=death)
                self.assertNotEqual(outcome.returncode, 0, "nobody died")
                held = finished(folder/"results.store")
                self.assertEqual(self.finish(str(number)), self.expected)
                for identity, row in finished(folder/"results.store").items():
                    if identity in held:
                        self.assertEqual(row, held[identity])


if __name__ == "__main__":
    if not os.environ.get("EHLWAVE_FAULTS") or not is_open_mpi():
        print("SKIPPED: no library to preload, or another MPI than Open MPI, whose calls have other names")
        raise SystemExit(SKIPPED)
    unittest.main()
