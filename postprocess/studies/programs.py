"""Run the programs of the build, for studies and tests; the standard library is all it needs.

``EHLWAVE_CASE``, ``EHLWAVE_SWEEP`` and ``EHLWAVE_MPIEXEC`` override the programs of the release
build and ``mpiexec``.
"""

import functools
import json
import math
import os
import resource
import subprocess
import tempfile
from pathlib import Path
from typing import Any

from ehlwave.programs.programs import Groups, namelist
from ehlwave.writing import write_new_text

ROOT = Path(__file__).resolve().parents[2]

# Open MPI as root in a container: no vader copies, loopback only. Other MPIs do not look at them.
MPI_ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
}
# Open MPI starts a program without a launcher in half the time: no daemon, no network.
ONE_RANK = {
    "OMPI_MCA_ess_singleton_isolated": "1",
    "OMPI_MCA_pml": "ob1",
    "OMPI_MCA_btl": "self",
}
_OPEN_MPI_ARGUMENTS = (
    *("--oversubscribe", "--mca", "oob_tcp_if_include", "lo"),
    *("--mca", "btl_tcp_if_include", "lo"),
)

Outcome = subprocess.CompletedProcess[str]


def program(name: str) -> Path:
    """Return where ``case`` or ``sweep`` is."""
    built = ROOT / "build" / "release" / "drivers" / f"ehlwave-{name}"
    return Path(os.environ.get(f"EHLWAVE_{name.upper()}") or built)


def mpi_command(ranks: int) -> list[str]:
    """Return the command that starts so many ranks, more than the machine has cores if need be."""
    return [_mpiexec(), "-n", str(ranks), *(_OPEN_MPI_ARGUMENTS if is_open_mpi() else ())]


def environment(ranks: int) -> dict[str, str]:
    """Return the environment of a program on so many ranks; 0: without a launcher."""
    return {**os.environ, **MPI_ENVIRONMENT, **({} if ranks else ONE_RANK)}


def _mpiexec() -> str:
    return os.environ.get("EHLWAVE_MPIEXEC") or "mpiexec"


@functools.cache
def is_open_mpi() -> bool:
    """Return whether ``mpiexec`` is Open MPI's."""
    said = subprocess.run([_mpiexec(), "--version"], capture_output=True, text=True, check=False)
    return "Open MPI" in said.stdout or "OpenRTE" in said.stdout


def paper_edges(groups: Groups) -> Groups:
    """Return the groups with P = 0 at the edges of the domain unless they set the edges.

    The paper, the reference values of the tests and the records of the studies have it so.
    """
    return {**groups, "grid": {"edges": "truncated", **groups.get("grid", {})}}


def run(
    name: str,
    *arguments: object,
    ranks: int = 0,
    folder: str | Path | None = None,
    seconds: float | None = None,
    processor_s: int | None = None,
) -> Outcome:
    """Run ``case`` or ``sweep`` in `folder`; with `ranks` under mpiexec.

    After so many seconds of the processor it is stopped, with a negative status.

    Raises subprocess.TimeoutExpired if it takes longer than `seconds`; it has been stopped then;
    OSError if there is no such program.
    """
    command = [str(program(name)), *map(str, arguments)]
    if ranks:
        command = [*mpi_command(ranks), *command]
    return subprocess.run(
        command,
        cwd=folder,
        env=environment(ranks),
        capture_output=True,
        text=True,
        check=False,
        timeout=seconds,
        preexec_fn=None if processor_s is None else lambda: _limit_processor(processor_s),
    )


def _limit_processor(seconds: int) -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))


def run_case(groups: Groups, *options: str) -> Outcome:
    """Run ``case`` with an input file of these groups, see `paper_edges`."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "case.nml")
        write_new_text(path, namelist(paper_edges(groups)))
        return run("case", path, *options)


def processor_seconds(groups: Groups, repeats: int, *options: str) -> tuple[Outcome, float]:
    """Run a case some times; return the last outcome and the least processor time."""
    least = math.inf
    for _ in range(repeats):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        outcome = run_case(groups, *options)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        least = min(least, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return outcome, least


def last_line(outcome: Outcome) -> Any:  # noqa: ANN401 - an object as JSON has it
    """Return the JSON object on the last line of the output."""
    return json.loads(outcome.stdout.rstrip("\n").split("\n")[-1], parse_constant=_not_json)


def solve(**groups: Any) -> dict[str, Any]:  # noqa: ANN401 - groups, or m, l, d
    """Return the result of a case that has to converge, see `paper_edges`.

    ``m``, ``l`` (12.05 if absent) and ``d`` may replace the keys of ``conditions``.

    Raises AssertionError if it does not; the message has the input and the program's message.
    """
    if "m" in groups:
        moes = {
            "load_parameter_m": groups.pop("m"),
            "lubricant_parameter_l": groups.pop("l", 12.05),
            "radius_ratio_d": groups.pop("d"),
        }
        groups["conditions"] = {**moes, **groups.get("conditions", {})}
    outcome = run_case(groups, "--json", "--quiet")
    if outcome.returncode != 0:
        said = outcome.stdout + outcome.stderr
        raise AssertionError(f"exit status {outcome.returncode} for\n{namelist(groups)}\n{said}")
    result: dict[str, Any] = last_line(outcome)
    return result


def _not_json(word: str) -> float:
    raise ValueError(f"{word} is not JSON")
