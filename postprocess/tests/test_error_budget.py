"""Errors of data in film, friction and lambda ratio, against random draws of the data."""

import math

import numpy as np
import pandas as pd
import pytest
from contact import SLIDING_ELLIPSE

import ehlwave
from ehlwave.errors import SurfaceError
from ehlwave.surface import trace_surface
from studies import budget

ERRORS = {
    "viscosity_error": 0.04,
    "pressure_viscosity_error": 0.1,
    "load_error": 0.08,
    "speed_error": 0.02,
    "eyring_stress_error": 0.1,
}
KEYS = {
    "viscosity_error": "viscosity_pa_s",
    "pressure_viscosity_error": "pressure_viscosity_per_pa",
    "load_error": "load_n",
    "speed_error": "mean_speed_m_per_s",
    "eyring_stress_error": "eyring_stress_pa",
}


def test_budget_is_the_spread_of_random_draws() -> None:
    """300 draws: their standard deviation is known within 4 %, so within 12 % of the budget."""
    rng = np.random.default_rng(7)
    table = ehlwave.Contact(**SLIDING_ELLIPSE, **ERRORS).error_budget(by="laws")
    found = []
    for _ in range(300):
        changes = {
            KEYS[name]: SLIDING_ELLIPSE[KEYS[name]] * math.exp(error * rng.standard_normal())
            for name, error in ERRORS.items()
        }
        film = ehlwave.Contact(**{**SLIDING_ELLIPSE, **changes}).film(by="laws")
        found.append((math.log(film.central_m), math.log(film.friction)))
    spread = np.std(found, axis=0)
    assert table.central_film["total"] == pytest.approx(spread[0], rel=0.12)
    assert table.friction["total"] == pytest.approx(spread[1], rel=0.12)
    assert table.central_film_share.drop("total").sum() == pytest.approx(1)
    assert table.index[0] == "pressure_viscosity_per_pa"


def test_lambda_ratio() -> None:
    """A long wave is flattened no more than a short one: lambda follows film and surface."""
    x = np.arange(0, 2e-3, 2e-6)
    trace = trace_surface(50e-9 * np.cos(2 * np.pi * x / 1e-4), step_m=2e-6, axis="x", name="w")
    rolling = {
        k: v
        for k, v in SLIDING_ELLIPSE.items()
        if k not in ("eyring_stress_pa", "slide_to_roll_ratio")
    }
    errors = {"load_error": 0.1, "viscosity_error": 0.1}
    contact = ehlwave.Contact(**rolling, **errors)
    table = contact.error_budget(trace, by="laws")
    up, down = (
        contact.replace(viscosity_pa_s=0.05 * factor).lambda_ratio(trace) for factor in (1.05, 0.95)
    )
    power = math.log(up / down) / math.log(1.05 / 0.95)
    assert table.lambda_ratio["viscosity_pa_s"] == pytest.approx(0.1 * abs(power), rel=0.02)


def test_budget_of_a_data_sheet() -> None:
    """Lambda ratio of the README's contact: the budget is the spread of 1,000 recorded draws."""
    (record,) = pd.read_csv(budget.RECORD).itertuples()
    found = budget.budget().lambda_ratio
    assert found["total"] == pytest.approx(record.budget, rel=0.01)
    assert found["total"] == pytest.approx(record.spread, rel=0.1)
    assert record.draws == budget.DRAWS
    few, beyond = budget.spread(40)  # a standard deviation of 40 draws is known within 11 %
    assert few == pytest.approx(record.spread, rel=0.3)
    assert beyond < 10


def test_film_carries_errors_of_all_data() -> None:
    sure, unsure = (
        ehlwave.Contact(**SLIDING_ELLIPSE),
        ehlwave.Contact(**SLIDING_ELLIPSE, load_error=0.2, speed_error=0.1),
    )
    more = unsure.film("laws").central_error - sure.film("laws").central_error
    powers = sure.sensitivities("laws").central_film
    expected = 0.2 * abs(powers["load_n"]) + 0.1 * powers["mean_speed_m_per_s"]
    assert more == pytest.approx(expected, rel=0.3)  # by the film formula


def test_refusals() -> None:
    with pytest.raises(SurfaceError, match="eyring_stress_error"):
        ehlwave.Contact(
            **{k: v for k, v in SLIDING_ELLIPSE.items() if k != "eyring_stress_pa"},
            eyring_stress_error=0.1,
        )
    with pytest.raises(SurfaceError, match="viscosity_error"):
        ehlwave.Contact(**SLIDING_ELLIPSE).error_budget()
