"""Derivatives of laws: identities that hold for any film, and places where charts meet."""

import contextlib
import math
import random
from typing import Any

import numpy as np
import pint
import pytest
from contact import SLIDING_ELLIPSE
from long_tests import IS_LONG

import ehlwave
from ehlwave.duals import seeded, valued
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.laws.atlas.ranges import CONTACT_RANGES


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


def test_units() -> None:
    """Values with units have the derivatives of their numbers in SI."""
    unit = pint.UnitRegistry()
    given = {**SLIDING_ELLIPSE, "load_n": SLIDING_ELLIPSE["load_n"] / 1e3 * unit.kilonewton}
    plain = ehlwave.Contact(**SLIDING_ELLIPSE).sensitivities("laws")
    assert np.allclose(ehlwave.Contact(**given).sensitivities("laws"), plain, rtol=1e-9)


def test_every_key_has_a_row() -> None:
    """Lengths beside M, L and D scale the film; a Carreau oil has its own keys."""
    moes = {"load_parameter_m": 100, "lubricant_parameter_l": 10, "radius_ratio_d": 0.5}
    lengths = {"semi_axis_a_m": 1e-4, "radius_x_m": 0.01}
    film = ehlwave.Contact(**moes, **lengths).sensitivities("laws").central_film
    assert film[["semi_axis_a_m", "radius_x_m"]].to_list() == pytest.approx([2, -1], abs=1e-8)
    rolling = ("eyring_stress_pa", "slide_to_roll_ratio")
    given = {key: value for key, value in SLIDING_ELLIPSE.items() if key not in rolling}
    carreau = {"carreau_modulus_pa": 5e6, "carreau_exponent": 0.6}
    powers = ehlwave.Contact(**given, **carreau).sensitivities("laws")
    assert set(powers.index) == given.keys() | carreau.keys() | {"roelands_index"}
    with pytest.raises(SurfaceError, match="by"):
        ehlwave.Contact(**moes).sensitivities("atlas")


def random_contact(rng: random.Random) -> dict[str, Any]:
    """Draw a line or an ellipse that rolls or slides, warm or starved, whose film a law has."""
    while True:
        radius, hertz = 10 ** rng.uniform(-2.3, -1.6), rng.uniform(0.4e9, 1.8e9)
        keys: dict[str, Any] = {
            "radius_x_m": radius,
            "reduced_modulus_pa": 2.26e11,
            "mean_speed_m_per_s": 10 ** rng.uniform(-1, 0.8),
            "viscosity_pa_s": 10 ** rng.uniform(-2, -0.6),
            "pressure_viscosity_per_pa": rng.uniform(1.2e-8, 2.6e-8),
            "roelands_index": rng.uniform(0.5, 0.7),
        }
        if rng.random() < 0.3:
            keys["load_n_per_m"] = 2 * math.pi * radius * hertz**2 / 2.26e11
        else:
            ratio = rng.choice((1.0, rng.uniform(0.1, 0.95)))
            load = 2 / 3 * math.pi**3 * hertz**3 * (radius / (1 + ratio)) ** 2 / 2.26e11**2
            keys |= {"radius_y_m": radius / ratio, "load_n": load}
        if rng.random() < 0.5:
            slip = {"slip_parameter": rng.uniform(0.5, 1.5)}
            keys |= slip | {"eyring_stress_pa": rng.uniform(2e6, 1e7)}
        elif rng.random() < 0.3:
            keys["oil_over_flooded"] = rng.uniform(0.3, 2)
        if rng.random() < 0.3:
            keys["heat"] = ehlwave.Heat(333.0, 0.04, 0.14, 2000, 870)
        with contextlib.suppress(RangeError):
            ehlwave.Contact(**keys).film("laws")
            return keys


def chart_of(source: str) -> str:
    """Return a source without numbers of the contact."""
    return source.split(",")[0]


def results(keys: dict[str, Any], wave: float) -> tuple[dict[str, Any], str]:
    """Return films, friction and response with their source; raises RangeError outside the laws."""
    contact = ehlwave.Contact(**keys)
    film, source = contact.film("laws"), ""
    found = {"central": film.central_m, "minimum": film.minimum_m, "friction": film.friction}
    with contextlib.suppress(RangeError):
        response = contact.response(wave, by="laws")
        found["response"], source = abs(response.film), chart_of(response.source)
    return {k: v for k, v in found.items() if v}, chart_of(film.source) + source


LIGHT = [
    {"load_parameter_m": m, "lubricant_parameter_l": 8.0, "radius_ratio_d": d}
    for m, d in ((2.125, 1.0), (0.1, 0.0))
]
"""A ball and a line that hardly deform."""


def test_slopes_of_random_contacts() -> None:
    """Derivatives by every key equal differences of fourth order within a chart."""
    step, count = 2e-4, 0
    for number in range(-len(LIGHT), 300 if IS_LONG else 10):
        rng = random.Random(number)
        keys = LIGHT[number] if number < 0 else random_contact(rng)
        wave = rng.uniform(0.25, 1.0)

        def at(
            x: float, key: str, keys: dict[str, Any] = keys, wave: float = wave
        ) -> tuple[dict[str, Any], str]:
            return results({**keys, key: keys[key] * math.exp(x)}, wave)

        names = [key for key, value in keys.items() if isinstance(value, float) and value]
        plain, own = results(keys, wave)
        found, source = results({**keys, **seeded({key: keys[key] for key in names})}, wave)
        assert source == own
        assert {name: abs(valued(one)) for name, one in found.items()} == pytest.approx(
            {name: abs(one) for name, one in plain.items()}, rel=1e-12
        )
        for place, key in enumerate(names):
            try:
                around = [at(place * step, key) for place in (-2, -1, 1, 2)]
            except (RangeError, SurfaceError):
                continue
            if any(source != own for _, source in around):
                continue  # another chart
            for name, one in found.items():
                a, b, c, d = (math.log(abs(numbers[name])) for numbers, _ in around)
                expected = (8 * (c - b) - (d - a)) / (12 * step)
                slope, scale = one.slopes[place] / one.value, max(1, abs(expected))
                assert slope == pytest.approx(expected, abs=1e-6 * scale), (number, key, name)
                count += 1
    assert count > (4000 if IS_LONG else 150)


@pytest.mark.parametrize("key", CONTACT_RANGES)
def test_slopes_at_the_ends_of_a_chart(key: str) -> None:
    """At the ends of the ranges derivatives are as 1 % inside, within the scatter of the law."""
    middle = {name: math.sqrt(low * high) for name, (low, high) in CONTACT_RANGES.items()}
    for end, inside in zip(CONTACT_RANGES[key], (1.01, 0.99), strict=True):
        there, near = (
            ehlwave.Contact(**{**middle, key: end * factor}).sensitivities("laws")
            for factor in (1.0, inside)
        )
        for name in ("central_film", "minimum_film"):
            for by in CONTACT_RANGES:
                assert there[name][by] == pytest.approx(near[name][by], abs=0.02), (end, by, name)
