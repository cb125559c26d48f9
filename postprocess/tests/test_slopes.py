"""Derivatives of laws: identities that hold for any film, and places where charts meet."""

import math
from collections.abc import Callable

import pytest
from contact import SLIDING_ELLIPSE

import ehlwave
from ehlwave.errors import RangeError
from ehlwave.laws.slopes import FINE, Answer, slopes_of


@pytest.mark.parametrize("speed", [0.5, 1.5, 4.0])
@pytest.mark.parametrize("slides", [False, True])
def test_films_scale_with_the_contact(speed: float, slides: bool) -> None:
    """Lengths scaled together scale the film: their exponents add up to 1 within 1e-6."""
    rolling = ("eyring_stress_pa", "slide_to_roll_ratio")
    given = {key: value for key, value in SLIDING_ELLIPSE.items() if slides or key not in rolling}
    powers = ehlwave.Contact(**{**given, "mean_speed_m_per_s": speed}).sensitivities("laws")
    lengths = {"radius_x_m": 1, "radius_y_m": 1, "load_n": 2, "mean_speed_m_per_s": 1}
    for result, expected in (("central_film", 1.0), ("friction", 0.0)):
        if result == "friction" and not slides:
            continue
        total = sum(power * powers[result][key] for key, power in lengths.items())
        assert total == pytest.approx(expected, abs=1e-6), result


def test_speed_and_viscosity_are_one() -> None:
    """Films depend on the product of speed and viscosity alone."""
    film = ehlwave.Contact(**SLIDING_ELLIPSE).sensitivities("laws").central_film
    assert film["mean_speed_m_per_s"] == pytest.approx(film["viscosity_pa_s"], abs=1e-8)


def two_charts(edge: float, low: float, high: float) -> Callable[[float], Answer]:
    def answer(x: float) -> Answer:
        if not low <= x <= high:
            raise RangeError("outside")
        return {"y": math.exp(2 * x) + (0.1 if x > edge else 0.0)}, "ab"[x > edge]

    return answer


@pytest.mark.parametrize(
    ("edge", "low", "high"),
    [(1.0, -1.0, 1.0), (FINE / 2, -1.0, 1.0), (-FINE / 2, -1.0, 1.0), (1.0, 0.0, 1.0)],
)
def test_slopes_do_not_cross_charts(edge: float, low: float, high: float) -> None:
    """A jump of 0.1 next to the place, or an end, leaves the derivative."""
    assert slopes_of(two_charts(edge, low, high), FINE)["y"] == pytest.approx(2, abs=1e-6)


def test_a_place_without_neighbours() -> None:
    with pytest.raises(RangeError, match="either side"):
        slopes_of(two_charts(1.0, 0.0, FINE / 2), FINE)
