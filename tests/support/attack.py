"""Run a program on something odd and judge how it takes it: it may refuse, it may not crash, hang, eat the machine or babble."""

import os
import resource
import signal
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

from studies.programs import environment, program

LONGEST_S = float(os.environ.get("EHLWAVE_LONGEST", "10"))   # processor time, whatever else the machine does
LARGEST_MIB = 1024
LONGEST_LINE = 2200
REFUSED = 2


@dataclass
class Outcome:
    """How a program ended."""

    status: int
    stdout: str
    stderr: str
    seconds: float
    """Limit of processor time."""
    memory_mib: float

    def faults(self, longest_s=LONGEST_S):
        """List the faults that no input may cause; a large file may take longer."""
        found = []
        if self.status < 0 or self.status > 127:
            found.append(f"ended by signal or launcher: {self.status}")
        text = self.stdout + self.stderr
        for word in ("Backtrace", "Traceback", "backtrace", "runtime error", "Fortran runtime", "AddressSanitizer", "Error termination"):
            if word in text:
                found.append(f"says '{word}'")
        if self.seconds > longest_s:
            found.append(f"took {self.seconds:.1f} s")
        if self.memory_mib > LARGEST_MIB:
            found.append(f"took {self.memory_mib:.0f} MiB")
        for line in self.stderr.splitlines():
            if len(line) > LONGEST_LINE:
                found.append(f"a line of {len(line)} characters")
            if any(ord(letter) < 32 or ord(letter) == 127 for letter in line):
                found.append(f"a line that a terminal would obey: {line!r}")
        return found


def attack(name, *arguments, folder, stdout=None, limit_s=None):
    """Run `case` or `sweep`; a pipe where no writer ever comes must not stop it for longer than the limit."""
    command = [str(program(name)), *map(str, arguments)]
    out, err = Path(folder, "attack.out"), Path(folder, "attack.err")
    limit_s = limit_s or 60*LONGEST_S
    with (open(stdout, "wb") if stdout else out.open("wb")) as output, err.open("wb") as errors:
        process = subprocess.Popen(command, cwd=folder, env=environment(0), stdin=subprocess.DEVNULL,
                                   stdout=output, stderr=errors, preexec_fn=_small_stack)
        end = time.monotonic() + limit_s
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() > end:
                os.kill(process.pid, signal.SIGKILL)
                _, status, usage = os.wait4(process.pid, 0)
                break
            time.sleep(0.005)
        process.returncode = os.waitstatus_to_exitcode(status)
    text = out.read_text(errors="replace") if not stdout else ""
    outcome = Outcome(process.returncode, text, err.read_text(errors="replace"), usage.ru_utime + usage.ru_stime,
                      usage.ru_maxrss/1024)
    out.unlink(missing_ok=True)
    err.unlink()
    return outcome


def _small_stack():
    """Set the usual limit of systems."""
    resource.setrlimit(resource.RLIMIT_STACK, (8*2**20, resource.getrlimit(resource.RLIMIT_STACK)[1]))
    resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
