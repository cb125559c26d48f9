"""The atlas of contacts that slide in a Ree-Eyring oil."""

import numpy as np
import pytest

import ehlwave
from ehlwave.laws.atlas.kinds import SLIDING
from ehlwave.laws.atlas.sliding_shape import SlidingShape
from ehlwave.laws.atlas_transfer import AtlasTransfer
from ehlwave.surface import TwoWaveTransfer, trace_surface

MOES = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
OIL = {"reduced_modulus_pa": 226e9, "eyring_stress_pa": 5e6}
LENGTHS = {"semi_axis_a_m": 0.2e-3, "radius_x_m": 15.5e-3}

COMPUTED = [
    (1.1, 0.5, 0.6050 + 0.4647j, -3.880 + 4.652j),
    (1.1, 1.0, 0.3319 + 0.5308j, -3.265 + 2.816j),
    (1.3, 0.5, 0.5559 + 0.4456j, -4.357 + 4.393j),
    (1.3, 1.0, 0.0554 + 0.3696j, -4.846 + 1.915j),
]
"""S, lambda/a, film and pressure; ehlwave-case, 256 x 256 cells, flooded, at mesh size 0."""

FILM, FRICTION = 4.285, 0.05400
"""At S = 1.3; the film in the Moes scale."""


@pytest.mark.parametrize(("slip", "wave", "film", "pressure"), COMPUTED)
def test_a_response_is_that_of_the_program(
    slip: float, wave: float, film: complex, pressure: complex
) -> None:
    found = ehlwave.Contact(**MOES, **OIL).response(wave, slip_parameter=slip)
    assert "atlas" in found.source
    assert abs(found.film - film) < found.error
    assert found.error < 0.08
    assert abs(found.pressure - pressure) < 0.1 * abs(pressure)


def test_film_and_friction_are_those_of_the_program() -> None:
    film = ehlwave.Contact(**MOES, **OIL, slip_parameter=1.3).film()
    assert film.friction is not None
    assert film.friction_error is not None
    assert film.central_moes == pytest.approx(FILM, rel=film.central_error)
    assert film.friction == pytest.approx(FRICTION, rel=film.friction_error)
    assert film.central_error < 0.03
    assert film.friction_error < 0.08
    assert ehlwave.Contact(**MOES, **OIL).film().friction is None
    assert ehlwave.Contact(**MOES, slip_parameter=1.3).film().friction is None  # Newtonian


@pytest.mark.parametrize(
    ("moes", "eyring_stress_pa", "slip", "friction"),
    [
        ((38, 11.8, 1), 21.5e6, 1.001, 0.009258),
        ((25, 8.8, 0.04), 1.2e6, 0.998, 1.069e-5),
        ((60, 9, 0), 8e6, 1.0002, 0.033868),
    ],
)
def test_friction_is_less_well_known_at_slight_slip_and_of_light_contacts(
    moes: tuple[float, float, float], eyring_stress_pa: float, slip: float, friction: float
) -> None:
    """Friction of the program on twice the length and width; viscosity counts at slight slip."""
    oil = {"reduced_modulus_pa": 2.2e11, "eyring_stress_pa": eyring_stress_pa}
    keys = dict(zip(MOES, moes, strict=True)) | oil
    found = ehlwave.Contact(**keys, slip_parameter=slip).film()
    assert found.friction == pytest.approx(friction, rel=found.friction_error)


def test_bars_are_as_wide_as_the_condition_asks() -> None:
    thin = ehlwave.Contact(**MOES | {"load_parameter_m": 1000}, **OIL)
    thick = ehlwave.Contact(**MOES | {"load_parameter_m": 25, "radius_ratio_d": 0.1}, **OIL)
    bars = [
        [contact.response(wave, slip_parameter=0.6).error for wave in (0.3, 1, 3)]
        for contact in (thin, thick)
    ]
    assert np.mean(bars[1]) > 1.5 * np.mean(bars[0])


def test_of_stress_and_modulus_the_product_counts() -> None:
    one = ehlwave.Contact(**MOES, reduced_modulus_pa=1e11, eyring_stress_pa=11.3e6)
    other = ehlwave.Contact(**MOES, **OIL)
    for slip in (0.7, 1.2):
        films = [contact.response(0.7, slip_parameter=slip).film for contact in (one, other)]
        assert films[0] == pytest.approx(films[1], rel=1e-9)


def test_slip_that_vanishes_is_rolling() -> None:
    contact = ehlwave.Contact(**MOES, **OIL)
    rolling = contact.response(0.7)
    for slip in (0.999, 1.001):
        found = contact.response(0.7, slip_parameter=slip)
        assert abs(found.film - rolling.film) < found.error + rolling.error


def test_outside_its_stresses_the_law_of_the_two_waves_answers() -> None:
    contact = ehlwave.Contact(**MOES, reduced_modulus_pa=226e9, eyring_stress_pa=500e6)
    found = contact.response(0.7, slip_parameter=1.2)
    assert found.source.startswith("law of the two waves")
    with pytest.raises(ehlwave.RangeError, match="eyring_stress_pa reduced_modulus_pa"):
        ehlwave.Contact(
            **MOES, reduced_modulus_pa=226e9, eyring_stress_pa=500e6, slip_parameter=1.2
        ).film()


def shape_of_ends() -> SlidingShape:
    """Return the two contacts at the ends of all ranges."""
    keys = {name: np.array([low, high]) for name, (low, high) in SLIDING.ranges.items()}
    state = {"central_film": np.array([0.9, 0.02]), "pressure_ratio": np.array([-0.8, 0.0])}
    return SlidingShape.of_keys(keys | state).with_rolling(np.array([0.5 + 0.1j, 0.9 + 0j]))


def test_numbers_give_the_responses_back() -> None:
    shape = shape_of_ends()
    wave, angle = np.array([0.3, 2.0]), np.array([30.0, 0.0])
    film, pressure = np.array([0.8 + 0.3j, 0.2 + 0j]), np.array([-1 + 2j, -3 + 0j])
    seen = shape.seen(wave, angle)
    assert seen.coordinates.shape == (2, 15)
    left, pressed = film - seen.law, seen.pressure_left(film, pressure)
    none = np.zeros(2)
    numbers = np.stack([none, none, left.real, left.imag, pressed.real, pressed.imag], axis=1)
    np.testing.assert_allclose(seen.film(numbers), film, rtol=1e-12)
    np.testing.assert_allclose(seen.pressure(film, numbers), pressure, rtol=1e-12)
    np.testing.assert_allclose(seen.slopes[:, 1], 1j * seen.slopes[:, 0])


def test_without_slip_the_pressure_is_that_of_plane_waves() -> None:
    """The film of long waves that roll: 1 + W P with the wave number of the oil's wave."""
    keys = {name: np.array([(low * high) ** 0.5]) for name, (low, high) in SLIDING.ranges.items()}
    keys |= {"slip_parameter": np.ones(1), "central_film": np.full(1, 0.1)}
    shape = SlidingShape.of_keys(keys | {"pressure_ratio": np.zeros(1)})
    seen = shape.with_rolling(np.array([0.6 + 0.2j])).seen([0.5], [20.0])
    film = seen.film(np.zeros((1, 6)))
    assert film == pytest.approx(0.6 + 0.2j)
    pressure = seen.pressure(film, np.zeros((1, 6)))
    np.testing.assert_allclose(pressure * seen.compliance, (film - 1) * seen.gain, rtol=1e-12)


def test_a_surface_under_slip_is_deformed_by_its_responses() -> None:
    contact = ehlwave.Contact(**MOES, **OIL, **LENGTHS, slip_parameter=1.2)
    assert isinstance(contact.transfer(), AtlasTransfer)
    assert isinstance(contact.transfer("two-waves"), TwoWaveTransfer)
    wave = 0.5 * LENGTHS["semi_axis_a_m"]
    x = np.arange(200) * wave / 20
    surface = trace_surface(1e-8 * np.cos(2 * np.pi * x / wave), wave / 20, "x", "cosine")
    found = contact.deform(surface, form="none", ends="none")
    response = contact.response(0.5, slip_parameter=1.2)
    expected = 1e-8 * np.real(response.film * np.exp(2j * np.pi * x / wave))
    np.testing.assert_allclose(found.height[:, 0], expected, atol=1e-10)


def test_slip_that_thins_films_widens_their_errors() -> None:
    moes = {"load_parameter_m": 100, "lubricant_parameter_l": 10, "radius_ratio_d": 1}
    carreau = {"carreau_modulus_pa": 5e6, "carreau_exponent": 0.5, "reduced_modulus_pa": 2.2e11}
    rolling, sliding = (ehlwave.Contact(**moes, **carreau, slip_parameter=s) for s in (1, 1.3))
    more = sliding.conditions.film_loss - rolling.conditions.film_loss
    assert more > 0.01
    assert sliding.film().central_error == pytest.approx(rolling.film().central_error + more)
    newtonian = ehlwave.Contact(**moes, slip_parameter=1.3)
    own = rolling.film().central_error - rolling.conditions.film_loss
    assert newtonian.film().central_error == pytest.approx(own)


def test_inlets_that_thin_beyond_the_contacts_of_the_atlas_are_refused() -> None:
    """148 Eyring stresses in the inlet: by the networks 1.90, computed 0.94."""
    keys = {"load_parameter_m": 286.72, "lubricant_parameter_l": 19.899, "radius_ratio_d": 0.336}
    oil = {"pressure_viscosity_per_pa": 1.0243e-8, "roelands_index": 0.58349}
    stress = {"reduced_modulus_pa": 2.26e11, "eyring_stress_pa": 9.0616e5}
    contact = ehlwave.Contact(**keys, **oil, **stress, slip_parameter=0.50108)
    with pytest.raises(ehlwave.RangeError, match="Eyring stresses"):
        contact.film(by="laws")
