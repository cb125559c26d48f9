"""Studies of sweeps under disturbances and of readers under mutated inputs."""

import argparse
import os
import shutil
import subprocess

from studies.command import steps
from studies.command.options import flag, given, option, study, value_of

TARGETS = ("case", "sweep", "table", "record", "surface", "trace")
TARGET = value_of("|".join(TARGETS), str, f"one of {', '.join(TARGETS)}")


@study(
    "torture",
    flag("--long", "500 disturbances and 500 faults"),
    option("--cases", "N", "of the sweep (default 2500)"),
    option("--disturbances", "COUNT", "default 60"),
    option("--faults", "COUNT", "default 60"),
    option("--bad-days", "COUNT", "of each mode (default 20)"),
    option("--ranks", "N", "default 4"),
    option("--seed", "COUNT", "of the random numbers"),
    option("--folder", "DIR", "where the sweeps run; default: the temporary folder"),
    flag(
        "--growth", "memory and open files of a rank instead, over 100,000 responses: half an hour"
    ),
    option("--responses", "N", "with --growth: linear responses (default 100000)"),
    option("--marches", "N", "with --growth: marches on small grids (default 2000)"),
)
def torture(options: argparse.Namespace) -> int:
    """Disturb sweeps, which survive everything: the long form of a test.

    Disturbs sweeps at random moments (kill -9 of ranks and of mpirun, SIGTERM, SIGUSR1, full disk);
    after each, the store must be readable and keep its content; at the end every case must be there
    once, equal bit for bit to an undisturbed run. Takes about 10 minutes on 2 cores. The small disk
    needs root. Then as many runs in each of which a system call (open, read, write, fsync, rename,
    unlink, mkdir) fails once, for a while or for ever. Then bad days of each mode: the launcher is
    killed under scripts/run-sweep, the file system refuses locks, another program holds the results
    open. The last line counts signals, faults, days, and what was lost, doubled, different, hung or
    crashed. Needs a build (scripts/build release --tests).

    Exit status: 0 passed.
    """
    if options.long:
        options.disturbances = 500 if options.disturbances is None else options.disturbances
        options.faults = 500 if options.faults is None else options.faults
    built = steps.ROOT / "build" / "release"
    os.environ.setdefault("EHLWAVE_SWEEP", str(steps.DRIVERS / "ehlwave-sweep"))
    os.environ.setdefault("EHLWAVE_MPIEXEC", "mpirun")
    os.environ.setdefault("EHLWAVE_FAULTS", str(built / "tests" / "faults.so"))
    names = ("cases", "disturbances", "faults", "bad-days", "ranks", "seed", "folder")
    words = given(options, *names, "responses", "marches")
    return _support("growth.py" if options.growth else "torture.py", *words)


@study(
    "fuzz",
    ("targets", {"nargs": "*", "type": TARGET, "metavar": "TARGET", "help": "default: all"}),
    option("--inputs", "N", "of each target (default 100000)"),
    option("--seconds", "SECONDS", "of each target, at most"),
    option("--seed", "COUNT", "of the random numbers"),
    flag("--guided", "AFL++ (Debian: afl++) looks for inputs that reach new branches"),
    option("--keep", "DIR", "with --guided: for logs and what was found (default ./guided-fuzz)"),
)
def fuzz(options: argparse.Namespace) -> int:
    """Give mutated inputs to everything that reads a file, 100,000 of each kind.

    Targets: case, sweep, table (CSV), record (log of a store), surface (HDF5), trace (ehlwave
    surface). None may end the process, hang for 10 s or take 1 GiB; such an input is kept in the
    present folder. About 5 minutes a target; with --guided 10, of all but trace. Needs a build
    (scripts/build release --tests; EHLWAVE_FUZZ_TARGET names the program of another build).

    Exit status: 0 passed.
    """
    built = steps.ROOT / "build" / ("guided" if options.guided else "release")
    if options.guided:
        if shutil.which("afl-fuzz") is None:
            raise steps.refuse("fuzz --guided needs AFL++ (Debian: apt install afl++)")
        # Its assembler marks the branches of any compiler's output.
        place = os.environ.setdefault("AFL_PATH", "/usr/lib/afl")
        os.environ["AFL_QUIET"] = "1"
        kind = ("-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_Fortran_FLAGS=-B{place}")
        steps.call("cmake", "-S", steps.ROOT, "-B", built, *kind, stdout=subprocess.DEVNULL)
        cores = ("--parallel", len(os.sched_getaffinity(0)))
        steps.call(
            "cmake", "--build", built, "--target", "fuzz_target", *cores, stdout=subprocess.DEVNULL
        )
    os.environ.setdefault("EHLWAVE_FUZZ_TARGET", str(built / "tests" / "fuzz_target"))
    words = given(options, "inputs", "seconds", "seed", "keep")
    return _support("guided_fuzz.py" if options.guided else "fuzz.py", *words, *options.targets)


def _support(program: str, *words: object) -> int:
    """Run a program of tests/support; return its exit status."""
    steps.find_python("--test")
    support = steps.ROOT / "tests" / "support"
    os.environ["PYTHONPATH"] = f"{support}:{os.environ['PYTHONPATH']}"
    command = (os.environ["EHLWAVE_PYTHON"], "-B", support / program, *words)
    return steps.call(*command, accepted=steps.ANY)[0]
