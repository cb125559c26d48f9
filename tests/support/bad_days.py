"""Bad days of a sweep: its launcher is killed, the file system refuses locks, another program holds the results open.

Each starts from a store in which half of the cases are done, and is judged as the faults of ``faults.py``; in addition the run
has to come to its end. Needs EHLWAVE_SWEEP and, for locks, EHLWAVE_FAULTS.
"""

import errno
import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import h5py
from ehlwave_program import HANGS_S, MPI_ENVIRONMENT, ONE_RANK
from faults import FINISHED, Faults

RUN_SWEEP = Path(__file__).parents[2]/"scripts"/"run-sweep"
LAUNCHER = "mpirun -q --oversubscribe"
EVERY_TIME = 1000000


class BadDays(Faults):
    """Bad days in turn in a folder."""

    modes = ("launcher killed", "locks refused", "results held open")
    variables = ONE_RANK

    def disturb_by(self, mode):
        """Run a further bad day of a mode; return the exit status of the run."""
        place, status, text = {"launcher killed": self.kill_launcher, "locks refused": self.refuse_locks,
                               "results held open": self.hold_results}[mode]()
        self.counts["faults"] += 1
        self.judge(mode, place, status, text)
        if status is not None and status not in FINISHED:
            self.fail("lost", mode, f"the run ends with {status}: {text[-400:]}")
        elif "--overwrite" in text:
            self.fail("lost", mode, f"advice to overwrite: {text[-400:]}")
        return status

    def refuse_locks(self):
        """Run where each lock on the results and in the store is refused, as network file systems do."""
        return self.attempt(f"lock 1 {self.random.choice([errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP])} {EVERY_TIME} results")

    def hold_results(self):
        """Run while another program has the results open, to read or to write."""
        place = self.folder/"attempt"
        shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(self.folder/"half", place)
        mode, version = self.random.choice(["r", "r+"]), self.random.choice(["earliest", "latest"])
        with h5py.File(place/"results.h5", mode, libver=version):
            return place, *self.run(place)

    def kill_launcher(self):
        """Run by scripts/run-sweep, whose launcher is killed at a random moment; the script has to go on by itself."""
        place = self.folder/"attempt"
        shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(self.folder/"half", place)
        variables = {**os.environ, **MPI_ENVIRONMENT, "EHLWAVE_LAUNCHER": LAUNCHER}
        log = place/"run.log"
        with log.open("w") as file:
            process = subprocess.Popen([RUN_SWEEP, "sweep.nml", "--ranks", "2"], cwd=place, env=variables, stdin=subprocess.DEVNULL,
                                       stdout=file, stderr=file, start_new_session=True)
        with process:
            launcher = _launcher_of(process)
            if self.random.random() < 0.8:
                while process.poll() is None and not log.stat().st_size:
                    time.sleep(0.005)
            time.sleep(self.random.uniform(0.0, 0.5))
            if launcher and process.poll() is None:
                _kill(launcher)
            try:
                status = process.wait(HANGS_S)
            except subprocess.TimeoutExpired:
                process.kill()
                status = None
        text = log.read_text()
        self.counts["reached"] += "restart 1 of at most" in text
        return place, status, text


def _launcher_of(process):
    """Number of the process mpirun below a script, 0 if there is none in time."""
    end = time.monotonic() + 20
    while process.poll() is None and time.monotonic() < end:
        try:
            for child in Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split():
                if Path(f"/proc/{child}/comm").read_text().strip() in ("mpirun", "orterun"):
                    return int(child)
        except OSError:
            pass
        time.sleep(0.005)
    return 0


def _kill(pid):
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
