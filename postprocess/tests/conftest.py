"""Shared fixtures."""

from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from synthetic import make_columns, write_results

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@pytest.fixture
def results_file(tmp_path: Path) -> Path:
    """Return a file of 60 converged cases without noise, c1 = 0.2 and c2 = 0.03 on f(r) V."""
    return write_results(tmp_path / "results.h5", make_columns())


@pytest.fixture(autouse=True)
def laws_alone(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep the list of laws from computing, which takes minutes, but for tests of it."""
    if "computed" not in request.node.path.name:
        monkeypatch.setattr("ehlwave.laws.law_list.has_programs", lambda: False)


@pytest.fixture
def legible_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Refuse figures whose smallest text is below 6 pt in print: a column of 84 mm, else a page."""
    from ehlwave.writing import Writer

    write = Writer.figure

    def checked(self: Writer, path: str | Path, figure: "Figure", **options: object) -> Path:
        from matplotlib.text import Text

        from ehlwave.results.scales_of_figures import COLUMN

        width = figure.get_figwidth()
        texts = [one for one in figure.findobj(Text) if one.get_text().strip()]
        smallest = min((one.get_fontsize() for one in texts if one.get_visible()), default=99.0)
        printed = smallest * (84 if width <= COLUMN else 174) / 25.4 / width
        assert printed > 6 - 0.02, f"{path}: {printed:.2g} pt in print"
        return write(self, path, figure, **options)

    monkeypatch.setattr(Writer, "figure", checked)
