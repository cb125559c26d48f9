"""Disturb a sweep at random moments, see that nothing is lost, that the end is the same bit for bit.

    python3 torture.py [--disturbances N] [--faults N] [--bad-days N] [--ranks N] [--seed N] [--folder DIR]

Needs EHLWAVE_SWEEP (the program) and EHLWAVE_MPIEXEC; for faults EHLWAVE_FAULTS, see faults.py. A disturbance is kill -9 of a
random rank or of mpirun, SIGTERM or SIGUSR1 to one of them, or a full disk. After each, the store must be readable and hold at
least its earlier content. A finished sweep begins anew until the number of disturbances is reached. """

import argparse
import functools
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from bad_days import BadDays
from ehlwave_program import HANGS_S, MPI_ENVIRONMENT, environment, mpi_command, namelist
from faults import Faults
from hdf5_reading import read
from store_reading import finished

# where and when a case ran may differ
CIRCUMSTANCES = {"rank", "host", "started", "finished", "seconds", "work_units", "harmonic_work_units", "peak_memory_mib", "run", "job"}
FINISHED = (0, 1)
UNFINISHED = 85


def sweep_groups(cases):
    """A sweep of short cases; every eighth is a march long enough for checkpoints."""
    long_ones = max(1, cases//8)
    rows = [f"{100 + i},12.05,1,{'transverse' if i % 2 else 'isotropic'},1,32" for i in range(cases - long_ones)]
    rows += [f"{100 + i},12.05,1,transverse,0.5,64" for i in range(long_ones)]
    text = "load_parameter_m,lubricant_parameter_l,radius_ratio_d,orientation,wavelength_over_a,cells_x\n"
    groups = {"sweep": {"case_file": "cases.csv", "checkpoint_seconds": 0}, "grid": {"cells_y": 32}}
    return groups, text + "\n".join(rows) + "\n"


class Torture:
    """A sweep under attack in a folder of its own."""

    def __init__(self, folder, cases, ranks, disturbances, seed, say=print):
        self.folder, self.ranks, self.say = Path(folder), ranks, say
        self.cases = cases
        self.random = random.Random(seed)
        self.held = {}
        self.counts = {}
        groups, table = sweep_groups(cases)
        (self.folder/"sweep.nml").write_text(namelist(groups))
        (self.folder/"cases.csv").write_text(table)
        self.disk = self.folder/"disk"
        self.disk.mkdir()
        # room for the store and the results file, and for the logs of all the runs that are disturbed
        size = 8*2**20 + cases*5000 + disturbances*ranks*16000
        mount = ["mount", "-t", "tmpfs", "-o", f"size={size}", "ehlwave-torture", str(self.disk)]
        self.has_small_disk = subprocess.run(mount, capture_output=True, check=False).returncode == 0
        if not self.has_small_disk:
            say("  no small file system can be mounted here: a full disk is left out")

    def close(self):
        """Give the small disk back."""
        if self.has_small_disk:
            subprocess.run(["umount", str(self.disk)], check=False)

    def start(self, output, *options, log="run.log"):
        """Start a run in the background."""
        command = [*mpi_command(self.ranks),
                   os.environ["EHLWAVE_SWEEP"], "sweep.nml", "--output", output, *options]
        with (self.folder/log).open("a") as file:
            return subprocess.Popen(command, cwd=self.folder, env={**os.environ, **MPI_ENVIRONMENT},
                                    stdin=subprocess.DEVNULL, stdout=file, stderr=file)

    def wait(self, process):
        """Exit status of a run. An mpirun that locks up when its ranks have died is killed, as `run-sweep` does, and counted."""
        end, stuck = time.monotonic() + HANGS_S, None
        while process.poll() is None:
            now = time.monotonic()
            stuck = (stuck or now) if _has_only_dead_children(process.pid) else None
            if stuck and now > stuck + 20:
                process.kill()
                self.counts["mpirun that locked up"] = self.counts.get("mpirun that locked up", 0) + 1
                stuck = None
            if now > end:
                raise subprocess.TimeoutExpired(process.args, HANGS_S)
            time.sleep(0.02)
        return process.returncode

    def log_length(self):
        """Bytes in the log of all runs."""
        log = self.folder/"run.log"
        return log.stat().st_size if log.exists() else 0

    def wait_until_begun(self, process, before):
        """Wait for the first line of a run."""
        end = time.monotonic() + HANGS_S
        while self.log_length() <= before and process.poll() is None and time.monotonic() < end:
            time.sleep(0.02)

    def wait_for_cases(self, process, number):
        """Wait until a run has stored some more cases: on a fast machine sooner than on a busy one."""
        end = time.monotonic() + HANGS_S
        while len(finished(self.disk/"results.store")) < len(self.held) + number and process.poll() is None \
                and time.monotonic() < end:
            time.sleep(0.01)

    def disturb(self, left):
        """Start a run, disturb it once at a random moment, check the store; `left` more disturbances are to come."""
        begun = self.log_length()
        process = self.start("disk/results.h5")
        is_begun = self.random.random() < 0.85
        if is_begun:
            self.wait_until_begun(process, begun)
            self.wait_for_cases(process, self.random.randint(0, (self.cases - len(self.held))//(left + 2)))
        time.sleep(self.random.uniform(0.0, 0.1 if is_begun else 1.0))
        ranks = _descendants(process.pid)
        kinds = ["kill -9 rank"]*3 + ["kill -9 mpirun", "TERM mpirun", "TERM rank", "USR1 mpirun", "USR1 rank"]
        if self.has_small_disk:
            kinds += ["full disk"]*2
        if not is_begun:   # mpirun loses signals that it is to pass on before its ranks are there
            kinds = ["kill -9 rank", "kill -9 mpirun", "TERM mpirun"]
        kind = self.random.choice(kinds)
        if process.poll() is not None:
            kind = "none: it was over"
        elif kind == "full disk":
            filler = self.disk/"filler"
            with filler.open("wb", buffering=0) as file:
                try:
                    while file.write(b"\0"*4096):
                        pass
                except OSError:
                    pass
            time.sleep(self.random.uniform(0.2, 1.0))
            ranks = _descendants(process.pid)
        else:
            number = getattr(signal, "SIG" + ("KILL" if "-9" in kind else kind.split()[0]))
            victim = process.pid if "mpirun" in kind or not ranks else self.random.choice(ranks)
            try:
                os.kill(victim, number)
            except ProcessLookupError:
                pass
        status = self.wait(process)
        _wait_for_end(ranks)
        if kind == "full disk":
            (self.disk/"filler").unlink(missing_ok=True)
        self.counts[kind] = self.counts.get(kind, 0) + 1
        self.check_store()
        self.say(f"  {kind}: exit status {status}, {len(self.held)} of {self.cases} cases stored")
        return kind

    def check_store(self):
        """Check that stored cases are still stored, and that readable files are intact."""
        store = self.disk/"results.store"
        if not store.exists():
            return
        now = finished(store)
        for identity, row in self.held.items():
            if identity not in now:
                raise AssertionError(f"case {identity} was lost")
            if now[identity]["status"] == "crashed" and row["status"] != "crashed":
                raise AssertionError(f"case {identity} was overwritten")
        self.held = now
        outcome = subprocess.run([os.environ["EHLWAVE_SWEEP"], "--status", str(store)], capture_output=True, text=True,
                                 env=environment(0), check=False)
        if (store/"cases").exists():
            if outcome.returncode not in (*FINISHED, UNFINISHED):
                raise AssertionError(f"--status: {outcome.returncode} {outcome.stdout} {outcome.stderr}")
            if f"{self.cases}: {len(now)} finished" not in outcome.stdout:
                raise AssertionError(f"--status counts otherwise than {len(now)}:\n{outcome.stdout}")
        if (self.disk/"results.h5").exists():
            read(self.disk/"results.h5")

    def is_finished(self):
        """Whether all cases are stored."""
        return len(self.held) == self.cases

    def finish(self):
        """Run to the end and compare with a run that nobody disturbed."""
        for _ in range(5):
            # a case whose rank was killed twice, it alone, has been set aside, as it should be
            status = self.wait(self.start("disk/results.h5", "--retry", "failed"))
            if status in FINISHED:
                break
        status = self.wait(self.start("undisturbed.h5"))
        if status not in FINISHED:
            raise AssertionError(f"the undisturbed run ended with {status}")
        _, data = read(self.disk/"results.h5")
        _, expected = read(self.folder/"undisturbed.h5")
        if set(data) != set(expected):
            raise AssertionError(f"columns differ: {set(data) ^ set(expected)}")
        if len(data["case_id"]) != self.cases or len(set(data["case_id"])) != self.cases:
            raise AssertionError("not every case is there once")
        for name in set(data) - CIRCUMSTANCES:
            same = data[name] == expected[name] if isinstance(data[name], list) \
                else data[name].tobytes() == expected[name].tobytes()
            if not same:
                raise AssertionError(f"{name} differs:\n{data[name]}\n{expected[name]}")
        return len(set(data) - CIRCUMSTANCES)


def _descendants(pid):
    """Child processes, the ranks of a local mpirun."""
    found = []
    for task in Path(f"/proc/{pid}/task").glob("*/children") if Path(f"/proc/{pid}").exists() else []:
        try:
            for child in task.read_text().split():
                found += [int(child), *_descendants(int(child))]
        except OSError:
            pass
    return found


def _has_only_dead_children(pid):
    """Whether a process has children, none of which lives."""
    states = []
    for child in _descendants(pid):
        try:
            states.append(Path(f"/proc/{child}/stat").read_text().rpartition(") ")[2][0])
        except OSError:
            pass
    return bool(states) and set(states) == {"Z"}


def _wait_for_end(pids):
    """Ranks outlive a killed mpirun for a moment; those that do not notice are ended."""
    end = time.monotonic() + 20
    while any(Path(f"/proc/{pid}").exists() for pid in pids):
        if time.monotonic() > end:
            for pid in pids:
                try:
                    os.kill(pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
            end += 5
        time.sleep(0.05)


def torture(cases, disturbances, ranks, seed, folder=None, say=print):
    """Disturb a sweep so many times, finish it, compare. Returns the number of each kind of disturbance."""
    with tempfile.TemporaryDirectory(dir=folder) as place:
        run = Torture(place, cases, ranks, disturbances, seed, say)
        try:
            done = 0
            while done < disturbances and not run.is_finished():
                done += not run.disturb(disturbances - done).startswith("none")
            columns = run.finish()
        finally:
            run.close()
    say(f"  {done} disturbances ({', '.join(f'{number} {kind}' for kind, number in sorted(run.counts.items()))}); "
        f"{cases} cases, each there once, {columns} columns equal bit for bit to the undisturbed run")
    return done


def inject(faults, seed, folder=None, say=print):
    """Runs of a sweep in each of which a call of the system goes wrong. Returns the counts of `Faults`."""
    with tempfile.TemporaryDirectory(dir=folder) as place:
        run = Faults(place, seed, CIRCUMSTANCES)
        for _ in range(faults):
            fault, status = run.disturb()
            say(f"  {fault}: exit status {status}")
            for message in run.messages:
                say(f"  {message}")
            run.messages.clear()
    return run.counts


def spoil_days(days, seed, folder=None, say=print):
    """So many runs of each mode of `BadDays`. Returns its counts and the number of runs of each mode."""
    done = {}
    with tempfile.TemporaryDirectory(dir=folder) as place:
        run = BadDays(place, seed, CIRCUMSTANCES)
        for mode in [mode for mode in run.modes for _ in range(days)]:
            say(f"  {mode}: exit status {run.disturb_by(mode)}")
            done[mode] = done.get(mode, 0) + 1
            for message in run.messages:
                say(f"  {message}")
            run.messages.clear()
    return run.counts, done


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=2500)
    parser.add_argument("--disturbances", type=int, default=60)
    parser.add_argument("--faults", type=int, default=60)
    parser.add_argument("--bad-days", type=int, default=20, help="of each mode: launcher killed, locks refused, results held open")
    parser.add_argument("--ranks", type=int, default=4)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    parser.add_argument("--folder", help="where the sweep runs; default: the temporary folder of the system")
    options = parser.parse_args()
    print(f"torture: seed {options.seed}", flush=True)
    tell = functools.partial(print, flush=True)
    signals, seed = 0, options.seed
    while signals < options.disturbances:   # anything lost, doubled or different ends this with an error
        signals += torture(options.cases, options.disturbances - signals, options.ranks, seed, options.folder, tell)
        seed += 1
    counts = inject(options.faults, options.seed, options.folder, tell) if options.faults else {}
    spoilt, modes = spoil_days(options.bad_days, options.seed, options.folder, tell) if options.bad_days else ({}, {})
    bad = {name: counts.get(name, 0) + spoilt.get(name, 0) for name in ("lost", "doubled", "different", "hung", "crashed")}
    print(f"{signals} signals and full disks, {counts.get('faults', 0)} faults ({counts.get('reached', 0)} of them stopped a run), "
          + ", ".join(f"{number} {mode}" for mode, number in modes.items()) + ": "
          + ", ".join(f"{number} {name}" for name, number in bad.items()))
    sys.exit(1 if any(bad.values()) else 0)
