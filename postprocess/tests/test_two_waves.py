"""The closed forms and the law of the two waves, against numbers of ``ehlwave-case``."""

import numpy as np
import pytest

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.contact.medium import Medium, hertz_medium
from ehlwave.contact.oils import Oil
from ehlwave.contact.rolling import rolling_transfer
from ehlwave.contact.scales import corrected_film
from ehlwave.contact.two_waves import two_waves
from ehlwave.errors import SurfaceError

KEYS = {
    "load_parameter_m": 100,
    "lubricant_parameter_l": 12.05,
    "radius_ratio_d": 1,
    "reduced_modulus_pa": 226e9,
    "semi_axis_a_m": 1e-4,
}
EYRING = {"eyring_stress_pa": 5e6}

# M = 100, L = 12.05, D = 1, flooded, 128 x 128 cells; the film response over Ai.
COMPUTED = (
    # S, eyring, lambda_x/a, lambda_y/a, response
    (1.2, True, 0.5, 1.0, 0.606137 + 0.436863j),
)


def conditions(slip: float = 1.0, *, eyring: bool = True) -> Conditions:
    return conditions_from_keys(KEYS | (EYRING if eyring else {}) | {"slip_parameter": slip})


def film(slip: float, wave_x: float, wave_y: float = 0.0, *, eyring: bool = True) -> complex:
    return complex(two_waves(conditions(slip, eyring=eyring), slip, wave_x, wave_y).at(0.0))


def test_scales_are_those_of_the_program() -> None:
    contact = conditions()
    assert contact.alphabar == pytest.approx(20.379847374576993, rel=1e-12)
    assert contact.lambdabar == pytest.approx(0.023650815000767617, rel=1e-12)
    # The program's film is off by 1.7 per cent on this grid.
    assert corrected_film(100, 12.05, 1) == pytest.approx(0.1496 / 1.017, rel=0.03)


def test_closed_forms_are_those_of_the_program() -> None:
    """The program takes the pressure of the computed centre, 1.005 ph, in place of ph."""
    contact = conditions(1.2)
    medium = hertz_medium(contact.oil, 1.0, contact.alphabar, contact.lambdabar, 0.149646, 1.2)
    kx, ky = 2 * np.pi / 0.5, 2 * np.pi
    assert abs(medium.attenuated(kx, ky, 1.2) - (0.607468 + 0.447229j)) < 0.005
    assert abs(medium.complementary_number(1.2 * kx, ky) - (13.186058 + 2.881245j)) < 0.05


def test_the_complementary_wave_is_the_one_that_is_w_without_flow() -> None:
    """Followed from psi = w in small steps while the flow grows, each by Newton's method."""
    random = np.random.default_rng(8)
    for moes in ((25, 3, 0.05), (100, 12, 1), (1500, 18, 0.3)):
        m, l, d = moes  # noqa: E741
        slip, stress = random.uniform(0.1, 1.9), 10 ** random.uniform(6, 7.5)
        keys = {"load_parameter_m": m, "lubricant_parameter_l": l, "radius_ratio_d": d}
        contact = conditions_from_keys(KEYS | keys | {"eyring_stress_pa": stress})
        medium = contact.medium(slip)
        number, angle = 2 * np.pi / np.geomspace(0.03, 8, 24), random.uniform(0, 1.57, 24)
        w, ky = slip * number * np.cos(angle), number * np.sin(angle)
        psi = w + 0j
        for share in np.linspace(0, 1, 201)[1:] ** 2:
            for _ in range(3):
                deflection = medium.rho * medium.deflection(psi, ky)
                carried = deflection + medium.drho * medium.h
                flow = share * (medium.eps_x * psi**2 + medium.eps_y * ky**2)
                slope = share * 2 * medium.eps_x * psi + 1j * carried
                slope -= 1j * (psi - w) * deflection * psi / (psi**2 + ky**2)
                psi = psi - (flow + 1j * (psi - w) * carried) / slope
        np.testing.assert_allclose(medium.complementary_number(w, ky), psi, rtol=1e-9)


def test_a_wave_number_that_is_lost_is_none() -> None:
    # No oil lets a hundred times as much through across sliding as along.
    odd = Medium(rho=1.17, drho=0.08, h=0.14, eps_x=1e-2, eps_y=1.0, k=1.8)
    found = odd.complementary_number([40.0, 40.0], [3.0, 2.0])
    assert np.isnan(found[0])
    assert np.isfinite(found[1])


@pytest.mark.parametrize("case", COMPUTED)
def test_film_response(case: tuple[float, bool, float, float, complex]) -> None:
    slip, eyring, wave_x, wave_y, computed = case
    assert abs(film(slip, wave_x, wave_y, eyring=eyring) - computed) < 0.06


def test_without_slip_the_waves_add_up_to_pure_rolling() -> None:
    waves = np.array([0.25, 0.5, 1.0, 2.0])
    rolled = rolling_transfer(100, 12.05, 1.0, waves)
    near = [film(1 + 1e-6, wave) for wave in waves]
    np.testing.assert_allclose(near, rolled, atol=1e-4)
    at_one = [film(1.0, wave) for wave in waves]
    np.testing.assert_allclose(at_one, rolled, atol=1e-12)


def test_newtonian_flow_is_the_limit_of_a_large_stress() -> None:
    newtonian = conditions(1.3, eyring=False)
    large = hertz_medium(
        Oil(stress_modulus_pa2=1e40), 1.0, newtonian.alphabar, newtonian.lambdabar, 0.15, 1.3
    )
    plain = hertz_medium(Oil(), 1.0, newtonian.alphabar, newtonian.lambdabar, 0.15, 1.3)
    assert large.eps_x == pytest.approx(plain.eps_x, rel=1e-9)
    assert large.eps_y == pytest.approx(plain.eps_y, rel=1e-9)


def test_carreau_flow() -> None:
    """With n = 1/3 sigma (1 + sigma^2) = B and the factors are 1 + 3 sigma^2 and 1 + sigma^2."""
    third = Oil(stress_modulus_pa2=1.0, carreau_exponent=1 / 3)
    for stress in (1e-3, 0.3, 4.0, 1e3):
        along, across = third.tangent_factors(stress * (1 + stress**2))
        assert along == pytest.approx(1 + 3 * stress**2, rel=1e-9)
        assert across == pytest.approx(1 + stress**2, rel=1e-9)
    newton = Oil(stress_modulus_pa2=1.0, carreau_exponent=1.0)
    assert newton.tangent_factors(1e4) == pytest.approx((1.0, 1.0), rel=1e-9)
    contact = conditions_from_keys(KEYS | {"carreau_modulus_pa": 5e6, "carreau_exponent": 1.0})
    assert contact.oil.name == "Carreau"
    assert contact.medium(1.3).thinning == pytest.approx(0.0, abs=1e-9)
    assert contact.medium(1.3).eps_x == pytest.approx(conditions(eyring=False).medium(1.3).eps_x)


def test_carreau_closed_forms_are_those_of_the_program() -> None:
    """M = 103.5, S = 1.07, G = 3.2 MPa, n = 0.6, an oblique wave; a Newtonian oil has no phase."""
    moes = {
        "load_parameter_m": 103.53890556703371,
        "lubricant_parameter_l": 11.652092943398081,
        "radius_ratio_d": 0.8936040057643768,
        "pressure_viscosity_per_pa": 1.4050387317050483e-08,
    }
    oil = {"carreau_modulus_pa": 3213631.700312842, "carreau_exponent": 0.6}
    contact = conditions_from_keys(KEYS | moes | oil)
    slip, film = 1.06658914233943, 0.1410440593087922
    kx, ky = 2 * np.pi / 0.8490304683340195, 2 * np.pi / 0.3293813087011181
    medium = hertz_medium(
        contact.oil, contact.kappa, contact.alphabar, contact.lambdabar, film, slip
    )
    assert abs(medium.attenuated(kx, ky, slip) - (0.139505 + 0.133351j)) < 0.01
    psi = medium.complementary_number(slip * kx, ky)
    assert abs(psi - (7.892758 + 0.079088j)) < 0.01


@pytest.mark.parametrize(
    ("keys", "reason"),
    [
        ({"carreau_modulus_pa": 5e6}, "carreau_exponent"),
        ({"carreau_exponent": 0.5}, "carreau_modulus_pa"),
        ({"carreau_modulus_pa": 5e6, "carreau_exponent": 1.5}, "at most 1"),
        ({"carreau_modulus_pa": 5e6, "carreau_exponent": 0.5, **EYRING}, "Ree-Eyring oil, or"),
    ],
)
def test_half_an_oil_is_refused(keys: dict[str, float], reason: str) -> None:
    with pytest.raises(SurfaceError, match=reason):
        conditions_from_keys(KEYS | keys)


def test_deep_in_the_eyring_regime_one_number_decides() -> None:
    """Incompressible, transverse: a = 1/(1 - i (6/pi^2) (tau0/E') (lambda/h)^2) for S > 1."""
    contact = conditions(1.3)
    medium = contact.medium(1.3)
    rigid = type(medium)(1.0, 0.0, medium.h, medium.eps_x / medium.rho, 0.0, medium.k)
    # h = H c and c = 2 K ph a/E'.
    hertz_pa = contact.alphabar / contact.oil.pressure_viscosity_per_pa
    film_over_a = medium.h * 2 * medium.k * hertz_pa / 226e9
    for wave in (0.25, 0.5, 1.0):
        number = 5e6 / 226e9 * (wave / film_over_a) ** 2
        expected = 1 / (1 - 6j / np.pi**2 * number)
        assert abs(rigid.attenuated(2 * np.pi / wave, 0.0, 1.3) - expected) < 1e-3


def test_what_does_not_move_is_refused() -> None:
    with pytest.raises(ValueError, match="do not move"):
        film(0.0, 0.5)
    with pytest.raises(ValueError, match="do not move"):
        film(1.2, 0.0, 0.5)
