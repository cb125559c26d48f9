"""Runs of the programs for computed answers: results by name, from the cache where they are."""

import json
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ehlwave.errors import ProgramError
from ehlwave.programs.cache import digest, store, stored
from ehlwave.programs.case_input import case_groups, case_text
from ehlwave.programs.programs import find_program, namelist
from ehlwave.programs.progress import Following, following, run_following
from ehlwave.writing import write_new_text

Keys = Mapping[str, Any]
Result = dict[str, Any]

USABLE = ("converged", "inaccurate")
"""Statuses whose numbers have error estimates that hold."""

UNFINISHED = ("pending", "over_budget", "crashed", "interrupted")
"""Statuses that another run may change: such rows are not kept."""

WAVE_COLUMNS = (
    *("status", "message", "is_resolved", "harmonic_real", "harmonic_imaginary", "harmonic_error"),
    *("harmonic_extrapolated_real", "harmonic_extrapolated_imaginary"),
    *("harmonic_pressure_extrapolated_real", "harmonic_pressure_extrapolated_imaginary"),
    *("harmonic_pressure_real", "harmonic_pressure_imaginary", "error_estimate", "seconds"),
    *(
        "amplitude_ratio_fit",
        "phase_fit",
        "mean_film_rise",
        "frozen_heat_error",
        "central_film_moes",
        "central_film_error",
    ),
)
"""Columns of a sweep that are kept of each wave."""


def run_case(keys: Keys, progress: Following = None) -> Result:
    """Return the result of a smooth or wavy contact, as of ``ehlwave-case --json``.

    Parameters
    ----------
    keys : mapping
        Keys of the input file; None: left out.
    progress : callable or False, optional
        As of :meth:`ehlwave.Case.run`.

    Raises
    ------
    ProgramError
        If there is no program, or if it does not solve the case; the message has the reason.
    """
    text = case_text(keys)
    program = _program("ehlwave-case", text, "contact.nml")
    name = digest(keys, _version(program))
    if (found := stored(name)) is None:
        with tempfile.TemporaryDirectory() as folder, following(progress) as callback:
            path = Path(folder, "contact.nml")
            write_new_text(path, text)
            quiet = [] if callback else ["--quiet"]
            done = run_following([str(program), str(path), "--json", *quiet], callback, "stderr")
        if done.returncode not in (0, 1):
            raise ProgramError(_said(done, path))
        found = dict(json.loads(done.stdout.rstrip().splitlines()[-1]))
        check(found)
        store(name, keys, found)
    return found


def check(found: Result) -> None:
    """Raise ProgramError unless the numbers of a result can be used."""
    if found.get("status") not in USABLE or found.get("is_resolved") is False:
        status = found.get("status")
        reason = found.get("message") or "the grid does not resolve it"
        raise ProgramError(f"ehlwave-case: the contact is {status}: {reason}")


def run_waves(keys: Keys, waves: Sequence[Keys], progress: Following = None) -> list[Result]:
    """Return the results of a contact with different waves, by a single sweep.

    Waves that were not solved are returned with their status and message.

    Parameters
    ----------
    keys : mapping
        Keys of all cases.
    waves : sequence of mappings
        Further keys of each case; all have the same keys.
    progress : callable or False, optional
        As of :meth:`ehlwave.Study.run`.

    Raises
    ------
    ProgramError
        If there is no program, or if it refuses the input.
    """
    columns = {key: [one[key] for one in waves] for key in waves[0]} if waves else {}
    groups = case_groups(keys)
    sweep = {key: values[0] for key, values in columns.items()}
    case = case_text({**keys, **sweep})
    program = _program("ehlwave-sweep", case, "wave.nml")
    version = _version(program)
    names = [digest({**keys, **wave}, version) for wave in waves]
    found = {name: stored(name) for name in names}
    missing = [(name, wave) for name, wave in zip(names, waves, strict=True) if not found[name]]
    if missing:
        rows = _sweep(program, groups, [wave for _, wave in missing], progress)
        for (name, wave), row in zip(missing, rows, strict=True):
            found[name] = row
            if row["status"] not in UNFINISHED:
                store(name, {**keys, **wave}, row)
    return [dict(found[name] or {}) for name in names]


def is_usable(row: Result) -> bool:
    """Return whether the response of a wave can be used."""
    return row["status"] in USABLE and bool(row["is_resolved"])


def _sweep(
    program: Path, groups: Mapping[str, Keys], waves: Sequence[Keys], progress: Following
) -> list[Result]:
    """Return the columns of each wave, in the order of the waves."""
    with tempfile.TemporaryDirectory() as name, following(progress) as callback:
        folder = Path(name)
        lines = [",".join(waves[0]), *(",".join(map(str, wave.values())) for wave in waves)]
        write_new_text(folder / "waves.csv", "\n".join(lines) + "\n")
        sweep = {"case_file": str(folder / "waves.csv"), "output": str(folder / "waves.h5")}
        path = folder / "waves.nml"
        write_new_text(path, namelist({**groups, "sweep": sweep}))
        done = run_following([str(program), str(path)], callback, "stdout")
        if done.returncode not in (0, 1):
            raise ProgramError(_said(done, path))
        from ehlwave.results.read import read_results

        results = read_results(folder / "waves.h5")
        x, y = results["wavelength_x_over_a"].values, results["wavelength_y_over_a"].values
        rows = []
        for wave in waves:
            asked = np.array([wave["wavelength_x_over_a"], wave["wavelength_y_over_a"]], float)
            k = int(np.argmin(np.hypot(x - asked[0], y - asked[1])))
            if not np.allclose([x[k], y[k]], asked, rtol=1e-6):
                raise ProgramError(f"{program.name}: no result for waves of {asked} a")
            kept = [column for column in WAVE_COLUMNS if column in results]
            rows.append({column: _plain(results[column].values[k]) for column in kept})
    return rows


def _plain(value: Any) -> Any:  # noqa: ANN401 - number, text or truth
    return value.item() if hasattr(value, "item") else value


def _said(done: "subprocess.CompletedProcess[str]", path: Path) -> str:
    """Return the last lines of a program, without the name of an input file that is gone."""
    lines = (done.stderr or done.stdout).strip().splitlines()[-5:]
    return "; ".join(line.replace(f"{path}: ", "") for line in lines)


def _program(name: str, text: str, path: str) -> Path:
    """Return the program; ProgramError with the input file and the command if there is none."""
    try:
        return find_program(name)
    except ProgramError as error:
        raise ProgramError(
            f"{error}. To compute the contact elsewhere, save the lines below as {path} and run "
            f"ehlwave-case {path} --json\n{text}"
        ) from None


def _version(program: Path) -> str:
    """Return version and build of a program."""
    found = program.stat()
    return _version_of(program, found.st_mtime_ns, found.st_size)


@lru_cache(maxsize=8)
def _version_of(program: Path, _changed: int, _size: int) -> str:
    done = subprocess.run(
        [str(program), "--version", "--verbose"], capture_output=True, text=True, check=False
    )
    lines = [line for line in done.stdout.splitlines() if not line.startswith("processor:")]
    return " ".join(lines)
