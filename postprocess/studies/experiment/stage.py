"""Run the cases of the experiment by ``ehlwave-case``, each once."""

import hashlib
import json
import subprocess
import threading
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from ehlwave_post.deform import cut_period, read_surface, simulation_surface
from ehlwave_post.deform.prepare import remove_form
from ehlwave_post.deform.simulation import write_simulation_surface
from ehlwave_post.errors import ResultsError
from studies.experiment.cases import (
    COSINE,
    SMOOTH,
    TRACE,
    Groups,
    Run,
    groups_of,
)
from studies.experiment.trace import WAVELENGTH_UM
from studies.programs import namelist

REPEATS = 16
"""Waves one behind the other: with the fronts faded they cover the contact from T = 4.0 on."""

SURFACE_FILE = "sputtered_wave.h5"


class Stage:
    """The runs in one folder.

    A run is done when its record, ``<name>.json``, is there and was made of the same input; the
    record is written last and at once, so a run that was killed is run again.
    """

    def __init__(self, program: Path, folder: Path, base: Groups) -> None:
        """Set the program, the folder of all files, and the groups of the study's input."""
        self.program, self.folder, self.base = program, folder, base
        self._children: set[subprocess.Popen[str]] = set()
        self._lock = threading.Lock()
        self._start = time.monotonic()
        self._left = 0
        self._is_stopped = False

    def prepare_surface(self, trace: Path) -> None:
        """Write the file of one wave of the trace, from its middle, repeated."""
        wave = cut_period(remove_form(read_surface(trace), "plane"), WAVELENGTH_UM * 1e-6)
        target = self.folder / SURFACE_FILE
        part = target.with_suffix(".part.h5")
        write_simulation_surface(simulation_surface(wave, "none", REPEATS), part)
        part.replace(target)

    def run_all(self, runs: Sequence[Run], jobs: int) -> None:
        """Run what is not done, ``jobs`` at a time, the smooth contacts first.

        Raises
        ------
        ResultsError
            If a run did not converge; the others are run all the same.
        """
        failures: list[str] = []
        self._left = len(runs)
        pool = ThreadPoolExecutor(jobs)
        try:
            for group in ([r for r in runs if r.surface == SMOOTH], runs):
                chosen = [r for r in group if group is not runs or r.surface != SMOOTH]
                failures += [text for text in pool.map(self._run_reported, chosen) if text]
        finally:
            self._stop_children()
            pool.shutdown(cancel_futures=True)
        if failures:
            raise ResultsError("\n".join(failures))

    def record(self, run: Run) -> dict[str, Any] | None:
        """Return the record of a run, None if there is none that can be read."""
        return read_record(self.folder, run)

    def is_done(self, run: Run, key: str) -> bool:
        """Whether there is a result of the same input."""
        found = self.record(run)
        return (
            found is not None
            and found["input"] == key
            and (self.folder / f"{run.name}.h5").is_file()
        )

    def _run_reported(self, run: Run) -> str:
        begin = time.monotonic()
        failure = self._run(run)
        with self._lock:
            self._left -= 1
            elapsed = time.monotonic() - self._start
            seconds = time.monotonic() - begin
            outcome = "failed" if failure else f"{seconds:.1f} s" if seconds > 0.1 else "there"
            print(
                f"experiment: {run.name:28s} {outcome:>8s}, {elapsed:.0f} s in all, "
                f"{self._left} to go",
                flush=True,
            )
        return failure

    def _run(self, run: Run) -> str:
        """Run one case unless it is done; return what went wrong, or nothing."""
        film = None
        if run.surface == COSINE:
            smooth = self.record(run.smooth)
            if smooth is None:
                return f"{run.name}: no result of {run.smooth.name}, which it needs"
            film = smooth["result"]["central_film_um"] * 1e-6
        text = namelist(groups_of(run, self.base, film, SURFACE_FILE))
        key = self._key(run, text)
        if self.is_done(run, key):
            return ""
        record = self.folder / f"{run.name}.json"
        record.unlink(missing_ok=True)
        (self.folder / f"{run.name}.nml").write_text(text, encoding="utf-8")
        code, output, errors = self._call(run)
        if code != 0:
            return f"{run.name}: exit status {code}: {errors.strip() or output.strip()[-300:]}"
        result = json.loads(output.splitlines()[-1])
        part = record.with_suffix(".json.part")
        part.write_text(json.dumps({"input": key, "result": result}, indent=1), encoding="utf-8")
        part.replace(record)
        return ""

    def _key(self, run: Run, text: str) -> str:
        """Return what a result depends on: the input, and the heights of the surface."""
        digest = hashlib.sha256(text.encode())
        if run.surface == TRACE:
            heights = read_surface(self.folder / SURFACE_FILE)
            digest.update(heights.height.tobytes())
            digest.update(str(heights.step_x_m).encode())
        return digest.hexdigest()

    def _call(self, run: Run) -> tuple[int, str, str]:
        command = [self.program, f"{run.name}.nml", "--json", "--quiet"]
        command += ["--output", f"{run.name}.h5"]
        with self._lock:
            if self._is_stopped:
                return -1, "", "stopped"
            child = subprocess.Popen(
                command,
                cwd=self.folder,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
            )
            self._children.add(child)
        out, errors = child.communicate()
        with self._lock:
            self._children.discard(child)
        return child.returncode, out, errors

    def _stop_children(self) -> None:
        with self._lock:
            self._is_stopped = True
            for child in self._children:
                child.terminate()


def read_record(folder: Path, run: Run) -> dict[str, Any] | None:
    """Return the record of a run in a folder, None if there is none that can be read."""
    try:
        found = json.loads((folder / f"{run.name}.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return found if isinstance(found, dict) and {"input", "result"} <= found.keys() else None
