"""Progress of the programs: callbacks, and a bar in notebooks."""

import re
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from importlib import import_module
from threading import Timer
from typing import Literal

Progress = Callable[[int, int, str], object]
"""Called with the number done, the total, and the unit: ``(32, 88, "time step")``."""

Following = Progress | Literal[False] | None
"""None: a bar in a notebook that has tqdm and ipywidgets, nothing elsewhere; False: nothing."""

_WATCHER: ContextVar[Progress | None] = ContextVar("watcher", default=None)

_COUNT = re.compile(r"^\S+ (?:(?P<before>\D+) )?(?P<done>\d+)/(?P<whole>\d+)(?: (?P<after>\w+))?")
"""After the time of the day: ``time step 3/88`` of a case, ``3/9 cases, ...`` of a sweep."""


def counted(line: str) -> tuple[int, int, str] | None:
    """Return the numbers of a progress line: done, whole, and unit; None: another line."""
    found = _COUNT.match(line)
    if found is None:
        return None
    return int(found["done"]), int(found["whole"]), found["before"] or found["after"] or ""


def run_following(
    command: Sequence[str],
    callback: Progress | None,
    stream: Literal["stdout", "stderr"],
    seconds: float | None = None,
    environment: Mapping[str, str] | None = None,
) -> "subprocess.CompletedProcess[str]":
    """Run a program and call back for each line of progress in a stream.

    An error of the callback, Ctrl-C among them, ends the program in good order before it is raised.

    Raises subprocess.TimeoutExpired if it takes longer than `seconds`.
    """
    if callback is None:
        return subprocess.run(
            command, capture_output=True, text=True, check=False, timeout=seconds, env=environment
        )
    other = "stderr" if stream == "stdout" else "stdout"
    with tempfile.TemporaryFile("w+") as quiet:
        streams = {stream: subprocess.PIPE, other: quiet}
        with subprocess.Popen(command, text=True, env=environment, **streams) as process:  # type: ignore[call-overload]
            late: list[bool] = []
            timer = Timer(seconds or 0, lambda: (late.append(True), process.kill()))
            if seconds is not None:
                timer.start()
            lines = []
            try:
                for line in getattr(process, stream):
                    lines.append(line)
                    if (found := counted(line)) is not None:
                        callback(*found)
            except BaseException:
                process.terminate()
                raise
            finally:
                timer.cancel()
                process.wait()
        if late and seconds is not None:
            raise subprocess.TimeoutExpired(list(command), seconds)
        quiet.seek(0)
        texts = {stream: "".join(lines), other: quiet.read()}
    return subprocess.CompletedProcess(list(command), process.returncode, **texts)


@contextmanager
def watching(progress: Progress) -> Iterator[None]:
    """Follow all programs that run within a `with` block, unless they have a callback of their own.

    Parameters
    ----------
    progress : callable
        As of :meth:`ehlwave.Case.run`; may raise, which ends the program and the block.
    """
    token = _WATCHER.set(progress)
    try:
        yield
    finally:
        _WATCHER.reset(token)


@contextmanager
def following(progress: Following) -> Iterator[Progress | None]:
    """Return the requested callback: the given one, a bar in a notebook, or None."""
    if progress is None:
        progress = _WATCHER.get()
    if progress is not None:
        yield progress or None
        return
    if not _is_notebook():
        yield None
        return
    try:
        import_module("ipywidgets")  # without it a bar is text on standard error
        make = import_module("tqdm.auto").tqdm
    except ImportError:
        yield None
        return
    with make() as bar:

        def show(done: int, whole: int, text: str) -> None:
            bar.total, bar.n = whole, done
            bar.set_description(text)  # draws

        yield show


def _is_notebook() -> bool:
    """Return whether this is a kernel of Jupyter: a terminal of IPython is another class."""
    if "IPython" not in sys.modules:
        return False
    shell = sys.modules["IPython"].get_ipython()
    return type(shell).__name__ == "ZMQInteractiveShell"
