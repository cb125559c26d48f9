"""The server of ``ehlwave app``, started by the command as users start it, for tests."""

import contextlib
import os
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

LONGEST = 120.0
"""Seconds until it answers, on a busy machine, too."""

COMMAND = "import sys; from ehlwave.cli import main; sys.exit(main())"


@contextlib.contextmanager
def running(folder: Path, *options: str, before: str = "") -> Iterator[str]:
    """Start a server on a free port, give its address, and end it; `before` is run before it."""
    log = folder / "server.log"
    words = [sys.executable, "-c", before + COMMAND, "app", "--port", "0", *options]
    paths = os.pathsep.join(path for path in sys.path if path)
    with log.open("w") as file:
        server = subprocess.Popen(
            words,
            stdout=file,
            stderr=file,
            stdin=subprocess.DEVNULL,
            cwd=folder,
            env={**os.environ, "PYTHONPATH": paths},
        )
    try:
        end = time.monotonic() + LONGEST
        while not (found := re.search(r"http://127\.0\.0\.1:\d+", log.read_text())):
            if server.poll() is not None or time.monotonic() > end:
                raise RuntimeError(f"no server: {log.read_text()}")
            time.sleep(0.1)
        yield found[0]
    finally:
        server.terminate()
        try:
            server.wait(20)
        except subprocess.TimeoutExpired:
            server.kill()
            server.wait(20)
