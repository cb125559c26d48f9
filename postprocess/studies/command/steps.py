"""The steps of studies: build, run a sweep, run Python. Their settings are in ``os.environ``."""

import os
import signal
import subprocess
import sys
from collections.abc import Collection
from pathlib import Path
from typing import IO

ROOT = Path(__file__).resolve().parents[3]
SCRIPTS = ROOT / "scripts"
DRIVERS = ROOT / "build" / "release" / "drivers"

CONVERGED_OR_NOT = (0, 1)
"""Exit statuses of sweeps that are at their end."""
TO_BE_CONTINUED = 85
ANY = range(256)

Stream = int | IO[str] | None
"""Where standard output of a step goes, as :mod:`subprocess` has it."""

_running: list[subprocess.Popen[str]] = []
_waiting: list[int] = []
"""Signals that came between two steps: the next one is given them."""


class StoppedError(Exception):
    """A step failed with a message; the study ends with its exit status."""

    def __init__(self, status: int) -> None:
        super().__init__(status)
        self.status = status


def refuse(message: str) -> StoppedError:
    """Print why a study cannot be run, and return the error to raise."""
    print(f"scripts/study: {message}", file=sys.stderr)
    return StoppedError(2)


def call(
    *command: object,
    accepted: Collection[int] = (0,),
    folder: Path | None = None,
    stdout: Stream = None,
) -> tuple[int, str]:
    """Run a command; return its exit status and, with ``stdout=subprocess.PIPE``, its output.

    Raises StoppedError if its exit status is not accepted.
    """
    sys.stdout.flush()
    words = list(map(str, command))
    with subprocess.Popen(words, cwd=folder, stdout=stdout, text=True) as process:
        _running.append(process)
        while _waiting:
            process.send_signal(_waiting.pop())
        said, _ = process.communicate()
        _running.clear()
    status = process.returncode if process.returncode >= 0 else 128 - process.returncode
    if status not in accepted:
        raise StoppedError(status)
    return status, said or ""


def pass_signals_on() -> None:
    """Leave signals to the running step, so that a sweep stops in good order."""

    def pass_on(number: int, _: object) -> None:
        if _running:
            _running[0].send_signal(number)
        else:
            _waiting.append(number)

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1):
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, pass_on)


def build(preset: str = "release", stdout: Stream = None) -> Path:
    """Build; return the folder of the build. Programs that the user has named are kept."""
    call(SCRIPTS / "build", preset, stdout=stdout)
    for name in ("case", "sweep"):
        os.environ.setdefault(f"EHLWAVE_{name.upper()}", str(DRIVERS / f"ehlwave-{name}"))
    return ROOT / "build" / preset


def prepare(program: Path | None = None) -> None:
    """Find Python, and build, or use an ``ehlwave-case`` or ``ehlwave-sweep`` and its neighbour."""
    if program is None:
        build()
    else:
        stem = str(program).removesuffix("-case").removesuffix("-sweep")
        if not (program.is_file() and str(program) != stem):
            raise refuse(f"--program {program}: no file whose name ends in -case or -sweep")
        os.environ |= {f"EHLWAVE_{name.upper()}": f"{stem}-{name}" for name in ("case", "sweep")}
    find_python()


def find_python(*options: str) -> None:
    """Set EHLWAVE_PYTHON and PYTHONPATH from ``scripts/python-environment``."""
    shell = 'settings=$("$@") && eval "$settings" && printf "%s\\n" "$EHLWAVE_PYTHON" "$PYTHONPATH"'
    words = ("bash", "-c", shell, "bash", SCRIPTS / "python-environment", *options)
    _, said = call(*words, stdout=subprocess.PIPE)
    os.environ["EHLWAVE_PYTHON"], os.environ["PYTHONPATH"] = said.splitlines()


def python(
    module: str, *words: object, accepted: Collection[int] = (0,), stdout: Stream = None
) -> tuple[int, str]:
    """Run a module of ``studies``, as :func:`call` does."""
    command = (os.environ["EHLWAVE_PYTHON"], "-m", f"studies.{module}", *words)
    return call(*command, accepted=accepted, stdout=stdout)


def written(module: str, *words: object) -> list[str]:
    """Run a module of ``studies``; return its printed lines: the files written."""
    return python(module, *words, stdout=subprocess.PIPE)[1].splitlines()


def report(module: str, *words: object) -> int:
    """Run the module that judges the results; return its exit status."""
    return python(module, *words, accepted=ANY)[0]


def sweep(
    file: object,
    *words: object,
    accepted: Collection[int] = CONVERGED_OR_NOT,
    folder: Path | None = None,
    stdout: Stream = None,
) -> int:
    """Run a sweep on EHLWAVE_RANKS; return 0, or 1 when some cases did not converge."""
    command = (SCRIPTS / "run-sweep", file, *words)
    return call(*command, accepted=accepted, folder=folder, stdout=stdout)[0]
