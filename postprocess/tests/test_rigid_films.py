"""Rolling contacts too light to deform: films of constant viscosity, the program, neighbours."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import ehlwave
from ehlwave.contact.oils import log_viscosity
from ehlwave.laws.rigid_films import LINE, rigid_film

OIL = {"pressure_viscosity_per_pa": 2e-8, "roelands_index": 0.6}


def light(m: float, l: float) -> ehlwave.Contact:  # noqa: E741
    return ehlwave.Contact(load_parameter_m=m, lubricant_parameter_l=l, radius_ratio_d=0, **OIL)


def test_the_film_of_martin() -> None:
    film = rigid_film(light(0.01, 0.1).conditions)
    assert film.central_moes * 0.01 == pytest.approx(2.4456, rel=1e-3)


def test_reynolds_equation_solved_by_itself() -> None:
    """dp/dx of Roelands' oil from the inlet to where p and dp/dx vanish, and its load."""
    m, l, alpha = 0.2, 20.0, OIL["pressure_viscosity_per_pa"]  # noqa: E741

    def ends(film: float, outlet: float) -> tuple[float, float]:
        scale = 12 * l / (math.sqrt(2) * film**1.5)

        def slope(x: float, y: np.ndarray) -> list[float]:
            h = 1 + x**2
            eta = np.exp(log_viscosity(alpha, OIL["roelands_index"], max(y[0], 0.0) / alpha))
            return [scale * float(eta) * (x**2 - outlet**2) / h**3, y[0]]

        done = solve_ivp(slope, (-60.0, outlet), [0.0, 0.0], rtol=1e-9, atol=1e-12)
        return float(done.y[0, -1]), math.sqrt(2 * film) / l * float(done.y[1, -1])

    def load(film: float) -> float:
        outlet = brentq(lambda x: ends(film, x)[0], 0.3, 0.7, xtol=1e-8)
        return ends(film, outlet)[1]

    film = brentq(lambda h: load(h) - m, 2.5 / m, 4 / m, xtol=1e-6)
    found = rigid_film(light(m, l).conditions)
    deformed = (found.central_error - LINE.error) / LINE.error_by_growth
    assert found.central_moes / (1 + LINE.growth * deformed) == pytest.approx(film, rel=3e-3)


@pytest.mark.parametrize(
    ("m", "l", "computed"),
    [(0.1, 2, 24.6775), (0.2, 8, 13.1671), (0.3, 20, 10.8448), (0.4, 8, 7.5259)],
)
def test_films_of_the_program(m: float, l: float, computed: float) -> None:  # noqa: E741
    """ehlwave-case with accuracy = 0.005, errors of at most 0.3 %."""
    contact = light(min(m, 0.3999), l)
    film = contact.film(by="laws")
    assert "rigid" in film.source
    assert film.central_moes == pytest.approx(computed, rel=film.central_error)
    assert film.central_error < 0.05


@pytest.mark.parametrize(
    ("m", "l", "d", "computed"),
    [
        (2.125, 8, 1.0, 8.3341),
        (2.853, 17, 1.0, 5.8422),
        (5.55, 20, 0.2, 15.362),
        (15.87, 17, 0.05, 10.488),
        (22.51, 2, 0.012, 18.912),
    ],
)
def test_ellipses_of_the_program(m: float, l: float, d: float, computed: float) -> None:  # noqa: E741
    """ehlwave-case with accuracy = 0.02, errors of at most 1.3 %."""
    contact = ehlwave.Contact(load_parameter_m=m, lubricant_parameter_l=l, radius_ratio_d=d, **OIL)
    film = contact.film(by="laws")
    assert "rigid" in film.source
    assert film.central_moes == pytest.approx(computed, rel=film.central_error)
    assert film.central_error < 0.13


def test_isoviscous_film_of_brewe_hamrock_and_taylor() -> None:
    """128 alpha (phi (0.131 atan(alpha/2) + 1.683))^2 (U/W)^2, alpha = 1/D, phi = 3/(3 + 2 D)."""
    m = 0.2
    for d in (1.0, 0.2):
        contact = ehlwave.Contact(
            load_parameter_m=m, lubricant_parameter_l=0.01, radius_ratio_d=d, **OIL
        )
        formula = 32 / d * (3 / (3 + 2 * d) * (0.131 * math.atan(0.5 / d) + 1.683)) ** 2 / m**2
        assert rigid_film(contact.conditions).central_moes == pytest.approx(formula, rel=0.02)


def test_films_meet_the_atlas() -> None:
    below, above = (light(m, 8).film(by="laws") for m in (0.399, 0.401))
    assert below.central_moes == pytest.approx(above.central_moes, rel=below.central_error)
    assert "atlas" in above.source
