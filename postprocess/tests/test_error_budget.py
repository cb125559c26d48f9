"""Errors of data in film, friction and lambda ratio, against random draws of the data."""

import math
from typing import Any

import numpy as np
import pandas as pd
import pytest
from contact import SLIDING_ELLIPSE

import ehlwave
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.surface import Surface, trace_surface
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


ROLLING = {
    k: v for k, v in SLIDING_ELLIPSE.items() if k not in ("eyring_stress_pa", "slide_to_roll_ratio")
}


def waves(height_m: float, shorter_m: float = 3.1e-5) -> Surface:
    x = np.arange(0, 2e-3, 7e-7)
    height = np.cos(2 * np.pi * x / 1.03e-4) + 0.5 * np.cos(2 * np.pi * x / shorter_m)
    return trace_surface(height_m * height, step_m=7e-7, axis="x", name="w")


@pytest.mark.parametrize(
    ("keys", "surface", "options", "within"),
    [
        (ROLLING, waves(50e-9), {}, 1e-6),
        (ROLLING, waves(50e-9), {"ends": "taper", "form": "none"}, 1e-6),
        (ROLLING, waves(50e-9), {"second": waves(80e-9)}, 1e-6),
        (ROLLING, waves(300e-9, 7.1e-5), {}, 3e-3),  # averaged flow: by a table of heights
        (ROLLING, "map", {"step": 3e-6, "step_across": 4e-6}, 1e-5),
        (ROLLING | {"oil_over_flooded": 0.8}, waves(50e-9), {}, 1e-6),
        (ROLLING | {"slip_parameter": 1.2}, waves(50e-9), {}, 1e-5),
        (SLIDING_ELLIPSE, waves(50e-9), {"second": waves(30e-9)}, 1e-5),
    ],
    ids=["trace", "taper", "pair", "averaged", "map", "starved", "two-waves", "sliding"],
)
def test_lambda_ratio(
    keys: dict[str, Any],
    surface: Any,  # noqa: ANN401
    options: dict[str, Any],
    within: float,
) -> None:
    """Powers of the lambda ratio equal differences of predictions."""
    if surface == "map":
        surface = 60e-9 * np.random.default_rng(0).standard_normal((40, 30))
    errors = {"load_error": 0.1, "viscosity_error": 0.1}
    table = ehlwave.Contact(**keys, **errors).error_budget(surface, by="laws", **options)
    step = 3e-3 if within > 1e-4 else 1e-3
    for key in ("load_n", "viscosity_pa_s"):
        up, down = (
            ehlwave.Contact(**{**keys, key: keys[key] * math.exp(change)}).lambda_ratio(
                surface, by="laws", **options
            )
            for change in (step, -step)
        )
        power = math.log(up / down) / (2 * step)
        assert table.lambda_ratio[key] / 0.1 == pytest.approx(abs(power), abs=within), key


def test_lambda_ratio_is_by_the_laws() -> None:
    """Computed responses are not differentiated."""
    heavy = {**SLIDING_ELLIPSE, "load_n": 2e4, "central_film_m": 2e-7}
    slides = ehlwave.Contact(**heavy, load_error=0.1)
    with pytest.raises(RangeError, match=r"by the laws alone; leave the surface out.*The laws"):
        slides.error_budget(waves(50e-9), by="laws")
    contact = ehlwave.Contact(**ROLLING, load_error=0.1)
    with pytest.raises(RangeError, match="neither transfer nor a table"):
        contact.error_budget(waves(50e-9), by="laws", transfer=contact.transfer("paper"))


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
