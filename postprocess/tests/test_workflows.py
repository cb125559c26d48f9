"""Workflows of Snakemake and Dask: both examples run, and give the same numbers."""

import contextlib
import csv
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from test_examples import EXAMPLES, needs_programs

import ehlwave
from ehlwave.programs.programs import find_program

LONGEST_S = 500
"""Seconds of a workflow, less than the limit of a test."""


def run(folder: Path, *command: str) -> str:
    """Run a command with the programs on PATH; return its output.

    The output goes to files, and all processes of the command end with it: workers that are left
    over would hold a pipe open, and the test would wait for them.
    """
    programs = find_program("ehlwave-case").parent
    path = {
        "PATH": f"{programs}:{os.environ['PATH']}",
        "PYTHONPATH": str(Path(ehlwave.__file__).parents[1]),
        "HOME": str(folder),
    }
    said, warned = folder / "said", folder / "warned"
    with said.open("w") as out, warned.open("w") as err:
        process = subprocess.Popen(
            command,
            cwd=folder,
            env={**os.environ, **path},
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=err,
            start_new_session=True,
        )
        try:
            status = process.wait(LONGEST_S)
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
    assert status == 0, said.read_text() + warned.read_text()
    return said.read_text()


def check(rows: dict[float, tuple[float, float]]) -> None:
    """Compare Ad/Ai with the atlas, within both errors."""
    contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10, radius_ratio_d=1)
    assert list(rows) == [0.5, 1.0, 2.0]
    for wavelength, (ratio, error) in rows.items():
        atlas = contact.response(wavelength_over_a=wavelength, angle_deg=0)
        assert abs(ratio - abs(atlas.film)) < 1.5 * error * ratio + atlas.error
        assert 0 < error < 0.2


@needs_programs
def test_snakemake(tmp_path: Path) -> None:
    pytest.importorskip("snakemake")
    words = ("--snakefile", str(EXAMPLES / "Snakefile"), "--cores", "2", "--quiet", "all")
    run(tmp_path, sys.executable, "-m", "snakemake", *words)
    with (tmp_path / "ratios.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    found = [[float(row[key]) for key in ("amplitude_ratio", "error")] for row in rows]
    waves = [float(row["wavelength_over_a"]) for row in rows]
    check({wave: (ratio, error) for wave, (ratio, error) in zip(waves, found, strict=True)})


@needs_programs
def test_dask(tmp_path: Path) -> None:
    pytest.importorskip("distributed")
    said = run(tmp_path, sys.executable, str(EXAMPLES / "dask_study.py"))
    rows = [line.split() for line in said.splitlines()[1:]]
    check({float(row[0]): (float(row[1]), float(row[2].rstrip("%")) / 100) for row in rows})


def test_the_slurm_job_of_dask(tmp_path: Path) -> None:
    pytest.importorskip("dask_jobqueue")
    said = run(tmp_path, sys.executable, str(EXAMPLES / "dask_study.py"), "--job-script")
    assert "#SBATCH --cpus-per-task=1" in said
    assert "#SBATCH -t 01:00:00" in said
    assert "module load ehlwave" in said
    assert "distributed.cli.dask_worker" in said
