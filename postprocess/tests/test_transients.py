from pathlib import Path

import numpy as np
import pytest
from synthetic import make_columns, write_results

from studies.transients import deviation, is_good, line, main, mean_deviation

SMALL = {
    "status": "converged",
    "slip_parameter": 1.5,
    "flow_law": "eyring",
    "orientation": "custom",
    "wavelength_x_over_a": 1.0,
    "amplitude_over_film": 0.01,
    "amplitude_ratio_fit": 0.5,
    "phase_fit": np.pi / 2,
    "harmonic_real": 0.0,
    "harmonic_imaginary": 0.502,
    "central_film": 0.1,
    "mean_film": 0.1,
    "mean_film_rise": 0.04,
}
LARGE = {**SMALL, "amplitude_over_film": 0.3, "mean_film": 0.1 + 0.042 * 0.03}


def test_small_waves() -> None:
    assert deviation(SMALL) == pytest.approx(0.002)
    assert is_good(SMALL)
    assert "oblique" in line(SMALL)
    assert not is_good({**SMALL, "phase_fit": 1.5})
    assert not is_good({**SMALL, "amplitude_ratio_fit": float("nan")})


def test_mean_film() -> None:
    assert mean_deviation(LARGE) == pytest.approx(1 - 0.04 / 0.042)
    assert is_good({**LARGE, "phase_fit": 1.0})
    assert not is_good({**LARGE, "mean_film_rise": 0.037})


def test_case_that_failed() -> None:
    failed = {**SMALL, "status": "stalled"}
    assert not is_good(failed)
    assert "BAD stalled" in line(failed)


def test_other_results(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(write_results(tmp_path / "r.h5", make_columns()))]) == 1
    assert "flow_law" in capsys.readouterr().err
