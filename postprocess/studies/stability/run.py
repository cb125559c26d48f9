"""Run the cases of the stability map by ``ehlwave-case``, each under a time limit."""

import json
import subprocess
import tempfile
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from studies.programs import namelist
from studies.stability.cases import Case
from studies.stability.outcome import Row, judge


def run_cases(
    program: Path,
    cases: Sequence[Case],
    limit_seconds: float,
    at_once: int = 1,
    report: Callable[[int, Row], None] = lambda number, row: None,
) -> list[Row]:
    """Run all cases, `at_once` at a time; return their rows in the order of `cases`.

    A case that takes longer than `limit_seconds` is stopped and counts as failed. `report` is
    called with the number of cases done and the row of each case as soon as it is there.
    """
    done = 0
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(at_once) as pool:
        futures = [
            pool.submit(run_case, program, case, limit_seconds, Path(folder) / f"{number}.nml")
            for number, case in enumerate(cases)
        ]
        rows = []
        for future in futures:
            rows.append(future.result())
            done += 1
            report(done, rows[-1])
    return rows


def run_case(program: Path, case: Case, limit_seconds: float, file: Path) -> Row:
    """Write the input of a case to `file`, run it and judge what comes out."""
    file.write_text(namelist(case.groups), encoding="utf-8")
    start = time.monotonic()
    try:
        ended = subprocess.run(
            [program, file, "--json", "--quiet"],
            capture_output=True,
            text=True,
            timeout=limit_seconds,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return judge(case, None, None, "", time.monotonic() - start)
    seconds = time.monotonic() - start
    message = ended.stderr.strip().replace(str(file), file.name)
    return judge(case, ended.returncode, _last_json(ended.stdout), message, seconds)


def _last_json(output: str) -> dict[str, Any] | None:
    lines = output.strip().splitlines()
    if not lines or not lines[-1].startswith("{"):
        return None
    try:
        return json.loads(lines[-1], parse_constant=_not_json)
    except ValueError:
        return None


def _not_json(word: str) -> float:
    raise ValueError(f"{word} is not JSON")
