"""The draw of contacts with heat, and the summary of what became of them."""

import math

import pytest

from studies import heat_map
from studies.heat_map import KINDS, SPEED, Row, draw, grid, load, summary


def test_draw() -> None:
    """Contacts stay within the conditions that are promised; a number is one contact for ever."""
    for number in range(40):
        groups = draw(number)
        assert groups == draw(number)
        conditions = groups["conditions"]
        assert SPEED[0] <= conditions["mean_speed_m_per_s"] <= SPEED[1]
        assert 0 <= conditions["slide_to_roll_ratio"] <= 2
        assert ("load_n_per_m" in conditions) == (KINDS[number % len(KINDS)] == "line")
        assert "cells_y" not in grid(groups, 64)["grid"] or "load_n" in conditions


def test_load() -> None:
    """Hertz: a circle of 10 mm under 1 GPa, and the limit of a slender ellipse is no line."""
    radius, modulus, pressure = 0.01, 2.26e11, 1e9
    a = math.pi * radius * pressure / modulus
    circle = load("circle", 1.0, pressure, radius, modulus)
    assert circle["radius_y_m"] == pytest.approx(radius)
    assert circle["load_n"] == pytest.approx(a**3 * modulus / (1.5 * radius))
    nearly = load("ellipse", 0.999, pressure, radius, modulus)
    assert nearly["load_n"] == pytest.approx(circle["load_n"], rel=1e-2)
    line = load("line", 0.0, pressure, radius, modulus)["load_n_per_m"]
    assert math.sqrt(line * modulus / (2 * math.pi * radius)) == pytest.approx(pressure)


def row(number: int, status: str, message: str = "", **more: float) -> Row:
    """Return a contact of which only the outcome counts."""
    return Row(number, "circle", "eyring", 1.0, 0.5, status, message, **more)


def test_summary() -> None:
    """Contacts that fail without a reason are named; ratios and errors are counted."""
    rows = [
        row(0, "converged", ratio=2.0, heat_balance_error=1e-4, worst_share_of_error=0.5),
        row(1, "unresolved", "too coarse", ratio=5.0, heat_balance_error=2e-3),
        row(2, "stalled", "why"),
        row(3, "stalled"),
    ]
    said = summary(rows)
    assert "2 of 4 contacts settled; without a reason: [3]" in said
    assert "median 3.50, largest 5.00, above 4: 1" in said
    assert "largest error 2.0e-03, above 1e-3: 1" in said
    assert "in 1 of 1, largest share 0.50" in said


def test_share_of_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """More levels and a finer mesh are compared with the stated errors."""
    values = {12: 1.0, 24: 1.002}

    def timed(groups: heat_map.Groups, repeats: int) -> tuple[dict[str, float], float]:
        assert repeats == 1
        mesh = 1.03 if groups["grid"]["cells_x"] == 128 else 1
        film = values[groups["heat"].get("levels", 12)] * mesh
        return {"central_film": film, "friction_coefficient": 0.05}, 0.0

    monkeypatch.setattr(heat_map, "timed", timed)
    result = {"cells_x": 64, "cells_y": 64, "central_film": 1.0, "friction_coefficient": 0.05}
    errors = {"central_film_error": 0.02, "friction_error": 0.01}
    groups = grid(draw(1), 64)
    assert heat_map.finer(groups, result | errors) == pytest.approx(1.5)


def test_freezing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Marches whose temperatures follow are compared with responses, as complex numbers."""
    seen: list[heat_map.Groups] = []

    def timed(groups: heat_map.Groups, repeats: int) -> tuple[dict[str, float | None], float]:
        seen.append(groups)
        march = {"amplitude_ratio_fit": 0.5, "phase_fit": math.pi / 2}
        response = {"harmonic_ratio": 0.5, "harmonic_phase": math.pi}
        return {**march, **response, "frozen_heat_error": 1.0}, repeats

    monkeypatch.setattr(heat_map, "timed", timed)
    groups = grid(draw(1), 64)
    assert heat_map.freezing(groups, 1) == pytest.approx((math.sqrt(0.5), math.sqrt(0.5)))
    heat_map.freezing(groups, 2)
    slips = [case["conditions"]["slide_to_roll_ratio"] for case in seen]
    assert slips[0] == -slips[1] < 0
    assert "wave_temperatures" not in groups["heat"]
