"""Random heavy loads with an accuracy: the draw, its finer selves, and the summary."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from studies import heavy_draw, heavy_refinement, heavy_schemes
from studies.heavy_draw import BEARING, LOADS, LUBRICANTS, NARROWEST, check, draw, summary
from studies.programs import Groups
from studies.work_unit import convolutions


def test_draw() -> None:
    """Contacts stay within the conditions that are promised; a number is one contact for ever."""
    for number in range(40):
        groups = draw(number)
        assert groups == draw(number)
        conditions = groups["conditions"]
        assert LOADS[0] <= conditions["load_parameter_m"] <= LOADS[1]
        assert LUBRICANTS[0] <= conditions["lubricant_parameter_l"] <= LUBRICANTS[1]
        assert NARROWEST <= conditions["radius_ratio_d"] <= 1
        assert (conditions["radius_ratio_d"] == BEARING) == (number % 4 == 3)
        assert ("waviness" in groups) == (number % 3 == 2)


def _run(groups: Groups) -> tuple[Mapping[str, Any], float]:
    """Return a contact whose film is 2 % off on 64 cells, with an error that falls with h^2."""
    asked = "accuracy" in groups["solver"]
    cells = 64 if asked else groups["grid"]["cells_x"]
    scheme = "fitted" if asked else groups["solver"]["scheme"]
    off = 0.02 * (64 / cells) ** 2
    result = {"central_film": 1 + off, "harmonic_ratio": None, "status": "converged"}
    if "waviness" in groups:
        result["harmonic_ratio"] = 0.5 * (1 + off / 10)
    result |= {"scheme": scheme, "cells_x": cells, "cells_y": cells // 2, "refinements": 0}
    result |= {"error_estimate": off, "total_work_units": 1.0, "expected_work_units": 1.0}
    return {**result, "message": ""}, 2.5


def test_check() -> None:
    """Smooth contacts are judged by their film, others by Ad/Ai."""
    smooth, _, wavy = check(range(3), _run)
    assert smooth.film_error == pytest.approx(1.02 / 1.005 - 1)
    assert math.isnan(smooth.ratio_error)
    assert not smooth.is_within
    assert wavy.ratio_error == pytest.approx(1.002 / 1.0005 - 1)
    assert wavy.is_within
    told = replace(wavy, number=7, status="inaccurate")
    said = summary([smooth, wavy, told])
    assert "1 of 3 contacts within 1%" in said
    assert "off without a word: [0]; other status: 7 inaccurate; longest run 2.5 s" in said


def test_finer() -> None:
    """The finer self has twice the cells, the same scheme and no accuracy."""
    groups = draw(2)
    fine = heavy_draw.finer(groups, {"cells_x": 128, "cells_y": 96, "scheme": "fitted"})
    assert fine["grid"] == {"edges": "flooded", "cells_x": 256, "cells_y": 192}
    assert fine["solver"]["scheme"] == "fitted"
    assert "accuracy" not in fine["solver"]
    assert fine["waviness"] == groups["waviness"]


def _scheme_run(**groups: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return a film off by 100/n^2 averaged, 5/n^2 fitted, which fails below 96 cells."""
    scheme, cells = groups["solver"]["scheme"], groups["grid"]["cells_x"]
    if cells < 96 and scheme == "averaged":
        raise AssertionError
    off = {"averaged": 100, "fitted": 50}[scheme] / cells**2
    return {
        **{"central_film": 1 + off, "harmonic_ratio": 0.5 * (1 + off), "status": "converged"},
        **{"cells_x": cells, "cells_y": cells // 2, "total_work_units": 10.0},
    }


def test_least_work() -> None:
    """The coarsest grid within 1 % counts, and nothing above a grid that is not."""
    points = list(heavy_schemes.measure(_scheme_run, [(100, 1)], 256))
    smooth = heavy_schemes.table(points)[0]
    work = {n: 10 * float(convolutions(n / math.sqrt(2))) for n in (96, 128)}
    assert smooth["averaged"] == pytest.approx(work[128])
    assert smooth["fitted"] == pytest.approx(work[96])
    by_chance = [replace(point, error=0.001 if point.cells_x == 96 else 0.02) for point in points]
    assert math.isnan(heavy_schemes.least_work(by_chance))


def test_waves_have_points() -> None:
    """No grid has fewer than 8 points on a wave."""
    points = heavy_schemes.measure(_scheme_run, [(100, 1)], 256)
    assert all(p.cells_x * p.wavelength_over_a / 4 >= 8 for p in points if p.wavelength_over_a > 0)


def test_refinement_of_one_cell_block() -> None:
    """An error within a hundredth of the nodes: a patch there, and what two halvings save."""
    shares = np.zeros((100, 100))
    shares[:10, 40:50] = -1
    found = heavy_refinement.bound_of(shares, np.linspace(0, 1, 100), 0.05)
    strip_share, strip, share, rectangles, _, any_shape, any_size = found
    assert strip_share == pytest.approx(0.005)
    assert strip == pytest.approx(16 / (1 + 20 * 0.005))
    assert share == pytest.approx(0.01)
    assert rectangles == pytest.approx(16 / (1 + 20 * 0.01))
    assert any_shape <= rectangles
    assert any_size == pytest.approx(100)
    even = heavy_refinement.bound_of(np.ones((40, 40)), np.linspace(0, 1, 40), 2)
    assert even[1] == even[3] == even[5] == even[6] == 1


def test_refinement_predicts_the_error() -> None:
    """The truncation error, weighted, is the error of the film."""
    (found,) = heavy_refinement.measure([(1000, 0.07)])
    assert found.predicted_error == pytest.approx(found.film_error, rel=0.1)
    assert 1 < found.rectangles < found.any_shape < found.centre < 16
