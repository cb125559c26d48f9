"""Every example runs, states an error beside its numbers, and keeps to it."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import ehlwave
from ehlwave.programs.programs import find_program

EXAMPLES = Path(__file__).parents[1] / "examples"
NUMBER = r"(-?\d+\.?\d*(?:e[-+]\d+)?)"
ENGINEER = {
    "radius_x_m": 12.52e-3,
    "radius_y_m": 12.52e-3,
    "reduced_modulus_pa": 1.17e11,
    "load_n": 39.2,
    "mean_speed_m_per_s": 0.096,
    "viscosity_pa_s": 1.22,
    "pressure_viscosity_per_pa": 2.25e-8,
    "roelands_index": 0.484,
}


def has_programs() -> bool:
    try:
        return bool(find_program("ehlwave-case")) and bool(find_program("ehlwave-sweep"))
    except ehlwave.ProgramError:
        return False


needs_programs = pytest.mark.skipif(not has_programs(), reason="the programs are not built")


def said_by(name: str, *arguments: str) -> str:
    """Return the output of an example; anything on stderr, such as a warning, fails.

    Deprecations inside other libraries are hidden, as Python hides them.
    """
    filters = ("error", "ignore::DeprecationWarning", "error::DeprecationWarning:__main__")
    options = [word for text in filters for word in ("-W", text)]
    command = [sys.executable, *options, str(EXAMPLES / name), *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def test_no_example_is_left_out() -> None:
    names = {path.name for path in EXAMPLES.glob("*.py")}
    assert names == {"academic.py", "dask_study.py", "deformed_trace.py", "engineer.py"}


@needs_programs
def test_what_the_academic_computes_agrees_with_the_atlas_within_both_errors() -> None:
    said = said_by("academic.py")
    rows = [line.split() for line in said.splitlines() if line.endswith("converged")]
    assert len(rows) == 3
    for row in rows:
        computed, own, atlas, bar, difference = complex(row[1]), *map(complex, row[2:6])
        assert abs(computed - atlas) <= own.real + bar.real
        assert difference.real == pytest.approx(abs(computed - atlas), abs=2e-4)
        assert 0 < own.real <= 0.0101 * abs(computed)  # the accuracy that was asked for


@needs_programs
def test_what_the_engineer_is_told_agrees_with_the_programs() -> None:
    said = said_by("engineer.py")
    wave = re.search(rf"waves of 0.5 a keep {NUMBER} of their height, error {NUMBER}", said)
    film = re.search(rf"central film {NUMBER} um within {NUMBER} %", said)
    ratio = re.search(rf"lambda ratio {NUMBER} within {NUMBER} %", said)
    assert wave is not None
    assert film is not None
    assert ratio is not None
    case = ehlwave.Case(
        **ENGINEER,
        orientation="transverse",
        wavelength_over_a=0.5,
        response="harmonic",
        accuracy=0.01,
    )
    found = case.run()
    kept = abs(
        complex(found["harmonic_extrapolated_real"], found["harmonic_extrapolated_imaginary"])
    )
    assert kept == pytest.approx(float(wave[1]), abs=float(wave[2]) + 0.01)
    central = float(found["central_film"] * found["hertz_approach_c_m"]) * 1e6
    error = float(film[2]) / 100 + float(found["central_film_error"])
    assert central == pytest.approx(float(film[1]), rel=error)
    assert f"{ratio[1]}" in said.split("deformed one")[0]
    assert "Reduced by   atlas" in said


def test_the_deformed_trace_has_an_error_and_files(tmp_path: Path) -> None:
    said = said_by("deformed_trace.py", str(tmp_path))
    assert re.search(rf"error of the latter {NUMBER} %: film", said)
    assert "Reduced by   atlas" in said
    assert {"deformed.csv", "deformed.png", "spectrum.pdf"} <= {f.name for f in tmp_path.iterdir()}
