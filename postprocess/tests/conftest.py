"""Shared fixtures."""

from pathlib import Path

import pytest
from synthetic import make_columns, write_results


@pytest.fixture
def results_file(tmp_path: Path) -> Path:
    """Return a file of 60 converged cases without noise, c1 = 0.2 and c2 = 0.03 on f(r) V."""
    return write_results(tmp_path / "results.h5", make_columns())


@pytest.fixture(autouse=True)
def laws_alone(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep the list of laws from computing, which takes minutes, but for tests of it."""
    if "computed" not in request.node.path.name:
        monkeypatch.setattr("ehlwave.laws.law_list.has_programs", lambda: False)
