"""Shared fixtures."""

from pathlib import Path

import pytest
from synthetic import make_columns, write_results


@pytest.fixture
def results_file(tmp_path: Path) -> Path:
    """Return a file of 60 converged cases without noise, c1 = 0.2 and c2 = 0.03 on f(r) V."""
    return write_results(tmp_path / "results.h5", make_columns())
