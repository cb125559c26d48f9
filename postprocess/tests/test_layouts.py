"""Two hundred layouts of text files: read right, or asked; never wrong."""

import os
from pathlib import Path

import numpy as np
import pytest
from drawn_layouts import Layout, drawn

from ehlwave.errors import SurfaceError
from ehlwave.surface import ReadOptions, Surface, read_surface

COUNT = 20_000 if os.environ.get("EHLWAVE_LONG_TESTS") else 200


def is_right(surface: Surface, layout: Layout) -> bool:
    truth = layout.height_m[:, None] if layout.height_m.ndim == 1 else layout.height_m.T
    steps = [layout.step_m, 0.0 if layout.step_across_m is None else layout.step_across_m]
    return (
        surface.height.shape == truth.shape
        and np.allclose(surface.height, truth, rtol=1e-9, atol=1e-18)
        and np.allclose([surface.step_x_m, surface.step_y_m], steps, rtol=1e-4)
    )


def read(layout: Layout, said: dict[str, object]) -> str:
    """Return "right" or the question; fail if the surface differs."""
    try:
        surface = read_surface(layout.path, ReadOptions(**said))  # type: ignore[arg-type]
    except SurfaceError as error:
        return str(error)
    assert is_right(surface, layout), (layout.path, said, surface.notes, surface.height.shape)
    return "right"


def test_layouts_are_read_right_or_asked(tmp_path: Path) -> None:
    asked = []
    for seed in range(COUNT):
        layout = drawn(tmp_path, seed)
        first = read(layout, {})
        assert first == "right" or not layout.is_complete, (layout.path, first)
        # The answers to questions are true.
        if first != "right":
            without = {key: value for key, value in layout.said.items() if key != "decimal"}
            steps = {"step": 1e6 * layout.step_m, "length_unit": "um"}
            everything = {"height_unit": layout.height_unit, **steps, **layout.said}
            answers = [read(layout, said) for said in (without, layout.said, everything)]
            if "right" not in answers:
                asked.append((layout.path.name, answers))
        layout.path.unlink()
    assert len(asked) < 0.2 * COUNT, asked


def test_a_wrong_surface_would_be_seen(tmp_path: Path) -> None:
    layout = drawn(tmp_path, 0)
    assert "right" in (read(layout, {}), read(layout, layout.said))
    layout.height_m = layout.height_m * 1.001
    with pytest.raises(AssertionError):
        _ = read(layout, {}), read(layout, layout.said)


def test_blanks_inside_a_heading_make_no_columns(tmp_path: Path) -> None:
    """The name of a quantity is no unit: `Hauteur, nm` above numbers is one heading, not two."""
    layout = drawn(tmp_path, 1014604)
    assert "# Hauteur, nm Distance/um" in layout.path.read_text(encoding="utf-16")
    answers = {"height_unit": layout.height_unit, "step": 1e6 * layout.step_m, "length_unit": "um"}
    assert read(layout, answers) != ""  # right or asked; `read` fails where it is wrong
