"""Films over time without replenishment, against closed forms and the balance of mass."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from contact import LOADED_BALL
from scipy.integrate import quad, solve_ivp
from scipy.special import iv, modstruve

import ehlwave
from ehlwave.cli import main
from ehlwave.contact.conditions import Conditions
from ehlwave.contact.formula import power_ratio
from ehlwave.contact.oils import Oil
from ehlwave.contact.starvation import FILM_BAR, film_over_flooded, film_sharpness
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.laws.replenishment import (
    SHARPNESS_ERROR,
    TIME_FACTOR,
    Track,
    after_overrollings,
    by_both_losses,
    density,
    fluidity_integral,
    overrolled,
    replenish,
    side_flow,
)


def starved(**more: float) -> Conditions:
    return ehlwave.Contact(**({**LOADED_BALL, "oil_over_flooded": 0.5} | more)).conditions


def test_closed_form_is_the_repeated_law() -> None:
    r, g = 0.8, 3.0
    for n in range(1, 50):
        r = float(power_ratio(1 / r, g))
        assert r == pytest.approx(float(after_overrollings(0.8, n, g)), rel=1e-12)


def test_overrollings_repeat_the_law_in_its_range() -> None:
    c = starved()
    n = np.arange(1, 60)
    r, expected = 0.5, []
    for _ in n:
        r = float(film_over_flooded(r, c.m, c.l, c.d))
        expected.append(r)
    assert overrolled(c, n, 1.0) == pytest.approx(np.array(expected), rel=1e-12)
    assert expected[0] == c.film_ratio


def test_overrollings_go_on_by_the_closed_form() -> None:
    c = starved()
    found = overrolled(c, np.array([10**6, 10**9]), 1.0)
    g = float(film_sharpness(0.2, c.m, c.l, c.d))
    assert np.log(1000) / np.log(found[0] / found[1]) == pytest.approx(g, rel=1e-3)


def test_error_of_g_is_that_of_the_law() -> None:
    for m, l, d in ((100, 12.05, 1), (200, 8, 0.5), (50, 10, 0.8)):  # noqa: E741
        g = float(film_sharpness(1, m, l, d))
        ends = [float(power_ratio(1.0, g * (1 + sign * SHARPNESS_ERROR))) for sign in (-1, 1)]
        assert 2 * FILM_BAR < ends[1] - ends[0] < 4 * FILM_BAR


def test_fluidity_integral_of_barus_oils(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ehlwave.laws.replenishment.DENSITY_LIMIT", 1.0)  # incompressible
    for alphabar in (0.01, 1.0, 10.0, 30.0, 300.0):
        hertz = 1e9
        # Roelands' law equals Barus' law for z = 1.
        found = fluidity_integral(Oil(alphabar / hertz, 1.0), hertz)
        if alphabar < 20:  # beyond, the difference is of large numbers
            closed = np.pi * (iv(0, alphabar) - modstruve(0, alphabar))
            assert found == pytest.approx(closed, rel=1e-6)
        else:
            assert found == pytest.approx(2 / alphabar, rel=2e-3)


def test_side_flow_is_the_balance_of_mass() -> None:
    c = starved()
    track = Track(c, 0.3)
    eta0, ph, a, b = 0.05, c.hertz_pa, c.semi_axis_a_m, c.semi_axis_b_m
    z = c.oil.roelands_index
    small = 1e-4 * b

    def eta(p: float) -> float:
        power = c.oil.pressure_viscosity_per_pa * 1.96e8 / z * ((1 + p / 1.96e8) ** z - 1)
        return float(eta0 * np.exp(power))

    def flow_over_cubed_layer(y: float) -> float:
        """Return rho h^3/(12 eta) dp/dy along x over h_l^3, by the pressure off the centreline."""
        half = np.sqrt(1 - (y / b) ** 2)

        def along(s: float) -> float:  # x = a half sin(s)
            root = half * np.cos(s)
            p = ph * root
            slope = -ph * y / b**2 / root
            return float(slope / (12 * density(p) ** 2 * eta(p)) * a * half * np.cos(s))

        return float(2 * quad(along, 0, np.pi / 2, limit=200)[0])

    rate = flow_over_cubed_layer(small) / small * 2 / track.length_m
    layer = float(density(ph)) * track.flooded_film_m * c.film_ratio
    end = 100.0
    solved = solve_ivp(lambda t, h: rate * h**3, (0, end), [layer], rtol=1e-10, atol=0)
    ratio = solved.y[0, -1] / layer * c.film_ratio
    expected = (c.film_ratio**-2 + track.side_flow_per_s * end) ** -0.5
    assert expected < 0.99 * c.film_ratio
    assert ratio == pytest.approx(expected, rel=1e-5)


def test_both_losses_one_overrolling_after_the_other() -> None:
    c, growth = starved(), 0.05
    film, expected = c.film_ratio, [c.film_ratio]
    for _ in range(50):
        behind = float(side_flow(film, growth / 2))
        g = float(film_sharpness(max(behind, 0.2), c.m, c.l, c.d))
        film = min(float(after_overrollings(behind, 1, g)), float(side_flow(behind, growth / 2)))
        expected.append(film)
    found = by_both_losses(c, np.arange(1, 52), growth)
    assert found == pytest.approx(np.array(expected), rel=1e-12)
    few = by_both_losses(c, np.array([1, 51]), growth)
    assert few[1] == pytest.approx(expected[-1], rel=1e-3)
    late = by_both_losses(c, np.array([1, 10**6]), growth)
    assert late[1] == pytest.approx((growth * 1e6) ** -0.5, rel=1e-3)


def test_table() -> None:
    c = starved()
    table = replenish(c, 0.3, 1e6)
    assert table["overrollings"].iloc[[0, -1]].tolist() == [1, 10**6]
    assert table["time_s"].iloc[-1] == pytest.approx((1e6 - 1) * 0.3 / 8)
    for name in ("inlet", "side_flow", "film_over_flooded"):
        assert (np.diff(table[name]) < 0).all()
        assert (table[f"{name}_low"] <= table[name]).all()
        assert (table[name] <= table[f"{name}_high"]).all()
        assert table[f"{name}_low"].iloc[-1] < table[f"{name}_high"].iloc[-1]
    smaller = table[["inlet", "side_flow"]].min(axis=1)
    assert table["film_over_flooded"].iloc[0] == c.film_ratio
    assert (table["film_over_flooded"].iloc[1:] < smaller.iloc[1:] * (1 + 1e-9)).all()
    flooded = c.central_film_m / c.film_ratio
    assert table["film_m"].to_numpy() == pytest.approx(table["film_over_flooded"] * flooded)
    both = "film_over_flooded"
    for sign, end in ((-1, "low"), (1, "high")):  # R has an error at the first overrolling, too
        least = table[both] * (1 + sign * c.starvation_error)
        assert (sign * (table[f"{both}_{end}"] - least) >= 0).all()
    assert (table["is_inside"] == ((table["inlet"] >= 0.2) & (table[both] >= 0.2))).all()
    assert table["is_inside"].nunique() == 2
    slow = (table["side_flow_low"] ** -2 - c.film_ratio**-2).iloc[-1]
    assert slow == pytest.approx(
        TIME_FACTOR * (table["side_flow"] ** -2 - c.film_ratio**-2).iloc[-1]
    )


@pytest.mark.parametrize(
    ("more", "given", "said"),
    [
        ({"oil_over_flooded": 8.0}, {}, "outside 0.2 to 5"),
        ({}, {"track_length_m": 1e-5}, "track length"),
        ({}, {"overrollings": 1}, "overrollings = 1"),
        ({}, {"overrollings": float("nan")}, "overrollings = nan"),
    ],
)
def test_what_is_refused(more: dict[str, float], given: dict[str, Any], said: str) -> None:
    with pytest.raises((SurfaceError, RangeError), match=said):
        replenish(starved(**more), **({"track_length_m": 0.3, "overrollings": 1e3} | given))


def test_conditions_that_are_refused() -> None:
    with pytest.raises(SurfaceError, match="oil_over_flooded is missing"):
        replenish(ehlwave.Contact(**LOADED_BALL).conditions, 0.3, 100)
    moes = {"load_parameter_m": 100, "lubricant_parameter_l": 10, "radius_ratio_d": 1}
    lengths = {"semi_axis_a_m": 1e-4, "radius_x_m": 0.01, "oil_over_flooded": 0.5}
    with pytest.raises(SurfaceError, match="dimensional"):
        replenish(ehlwave.Contact(**moes, **lengths).conditions, 0.3, 100)


def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    keys = [f"{key}={value}" for key, value in LOADED_BALL.items()]
    words = ["replenish", "--conditions", *keys, "oil_over_flooded=0.5", "--track-length", "0.3"]
    assert main([*words, "--overrollings", "1e4", "--json", "--output", str(tmp_path)]) == 0
    said = json.loads(capsys.readouterr().out)
    contact = ehlwave.Contact(**LOADED_BALL, oil_over_flooded=0.5)
    table = pd.read_csv(tmp_path / "replenish.csv")
    assert table["film_m"].iloc[0] == pytest.approx(contact.film().central_m, rel=1e-3)
    assert said["rows"][-1]["film_m"] == pytest.approx(table["film_m"].iloc[-1])
    assert {path.name for path in tmp_path.iterdir()} >= {"replenish.png", "replenish.pdf"}
    assert main(words) == 0
    text = capsys.readouterr().out
    assert "extrapolated" in text
    assert "no oil comes back to the track" in text
    assert main([*words[:-1], "1e-6"]) == 2
    assert "track length" in capsys.readouterr().err
    assert main([*words[:2], *keys, "--track-length", "0.3"]) == 2
    assert "oil_over_flooded is missing" in capsys.readouterr().err
