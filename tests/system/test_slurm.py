"""The batch script in a real Slurm: a job array over two nodes is stopped by its time limit, requeues, completes.

Needs slurmctld, slurmd, sbatch (Debian: slurm-wlm) and munge; scripts/install-requirements does not install them.
"""

import os
import re
import sys
import time
import unittest
from pathlib import Path

import private_slurm
from ehlwave_program import HANGS_S, MPI_ENVIRONMENT, SKIPPED, FolderTest, namelist
from hdf5_reading import read
from store_reading import count_records, finished

ROOT = Path(__file__).parents[2]
TASKS = 2
REST = 4     # seconds from the requeue of a job to its next start
CASES = 10   # so many that a task is not over before the signal comes


class Slurm(FolderTest):
    def setUp(self):
        super().setUp()
        (self.folder/"slurm").mkdir()
        self.slurm = private_slurm.PrivateSlurm(self.folder/"slurm")
        self.addCleanup(self.slurm.stop)
        loopback = {"OMPI_MCA_oob_tcp_if_include": "lo", "OMPI_MCA_btl_tcp_if_include": "lo"}
        self.slurm.environment.update(MPI_ENVIRONMENT, **loopback, EHLWAVE_SWEEP=os.environ["EHLWAVE_SWEEP"])
        if not self.slurm.start():
            self.skipTest("the private Slurm did not come up")

    def log(self, task):
        """Return the output of a task of the array so far."""
        path = self.folder/f"job-{task}.log"
        return path.read_text() if path.exists() else ""

    def is_over(self, task):
        """Return whether the job script of a task has reported its end, other than 85, to be continued."""
        said = re.search(r"task \d+: exit status (\d+): [^\n]+$", self.log(task).rstrip())
        return said is not None and said.group(1) != "85"

    def wait(self, is_done, seconds=HANGS_S):
        """Wait for the jobs; a requeued job starts again after some seconds, not after the two minutes of Slurm.

        Not at once: a start in the second of the requeue is refused, as its credential counts as revoked. An empty queue
        means nothing by itself: a job that is being requeued can be missing from it.
        """
        end = time.monotonic() + seconds
        since = {}   # when a job was first seen waiting
        while not is_done() and time.monotonic() < end:
            waiting = self.slurm.call("squeue", "-h", "-t", "PENDING", "-o", "%i").split()
            since = {job: since.get(job, time.monotonic()) for job in waiting}
            for job in waiting:
                if time.monotonic() > since[job] + REST:
                    self.slurm.call("scontrol", "update", f"jobid={job}", "StartTime=now", check=False)
            time.sleep(1)

    def test_array_requeues_until_it_is_done(self):
        sweeps = []
        for task in range(TASKS):
            rows = ["load_parameter_m,lubricant_parameter_l,radius_ratio_d,orientation,wavelength_over_a,cells_x,cells_y"]
            rows += [f"{100 + 10*n + task},12.05,1,transverse,0.5,256,128" for n in range(CASES)]
            (self.folder/f"cases_{task}.csv").write_text("\n".join(rows) + "\n")
            sweeps.append(self.folder/f"sweep_{task}.nml")
            sweeps[-1].write_text(namelist({"sweep": {"case_file": f"{self.folder}/cases_{task}.csv",
                                                      "output": f"{self.folder}/results_{task}.h5"}}))
        # Slurm sends the signal up to a minute earlier than asked for: with a limit of a minute, early in the job.
        job = self.slurm.call("sbatch", "--parsable", "--nodes=2", "--ntasks=2", "--ntasks-per-node=1",
                              "--time=1", "--signal=B:USR1@50", f"--array=0-{TASKS - 1}",
                              f"--output={self.folder}/job-%a.log", ROOT/"scripts"/"batch"/"slurm.sh", *sweeps, cwd=ROOT).strip()
        self.wait(lambda: all(self.is_over(task) for task in range(TASKS)))
        for task in range(TASKS):
            log = self.log(task)
            print(f"job {job}, task {task}:\n{log}", file=sys.stderr)
            self.assertIn("stop requested", log)
            self.assertIn("continues in another start", log)
            self.assertRegex(log, r"start \d+ on n\[1-2\], 2 ranks")
            self.assertIn("exit status 0: all cases converged", log.rstrip().split("\n")[-1])
            _, data = read(self.folder/f"results_{task}.h5")
            self.assertEqual(len(data["case_id"]), CASES)
            self.assertTrue(set(data["status"]) <= {"converged", "unresolved"}, data["status"])
            self.assertGreater(max(data["run"]), 1)
            self.assertEqual(len(finished(self.folder/f"results_{task}.store")), CASES)
            self.assertGreaterEqual(count_records(self.folder/f"results_{task}.store", "stop"), 1)


if __name__ == "__main__":
    if private_slurm.missing():
        print("SKIPPED: no Slurm here, missing " + ", ".join(private_slurm.missing()) + " (Debian: slurm-wlm munge)")
        sys.exit(SKIPPED)
    unittest.main()
