"""How oils that thin in the inlet are answered for, against films of ``ehlwave-case``."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import ehlwave
from ehlwave.contact.oils import Oil
from ehlwave.contact.thinning import MOST_LOSS, as_ree_eyring, loss_bound
from ehlwave.laws.atlas.atlas import thinned_kind
from ehlwave.laws.atlas.kinds import SLIDING

HEAVY = {"load_parameter_m": 500, "lubricant_parameter_l": 18, "radius_ratio_d": 1}
LIGHT = {"load_parameter_m": 200, "lubricant_parameter_l": 12, "radius_ratio_d": 1}
ROLLER = {"load_parameter_m": 20, "lubricant_parameter_l": 18, "radius_ratio_d": 0}
OIL = {"pressure_viscosity_per_pa": 2e-8, "roelands_index": 0.65, "reduced_modulus_pa": 2.2e11}


def eyring(stress_pa: float) -> dict[str, float]:
    return OIL | {"eyring_stress_pa": stress_pa}


def carreau(modulus_pa: float, exponent: float) -> dict[str, float]:
    return OIL | {"carreau_modulus_pa": modulus_pa, "carreau_exponent": exponent}


COMPUTED = [
    (LIGHT, eyring(5e5), 3.462),
    (HEAVY, eyring(2e6), 4.596),
    (HEAVY, eyring(3e6), 4.662),
    (HEAVY | {"load_parameter_m": 300, "lubricant_parameter_l": 15}, eyring(5e6), 4.427),
    (HEAVY, carreau(7e6, 0.35), 4.667),
    (ROLLER, eyring(2e6), 5.888),
]
"""Central films in pure rolling, Moes scale, extrapolated; within half a per cent."""


@pytest.mark.parametrize(("moes", "oil", "film"), COMPUTED)
def test_films_of_oils_that_thin_in_pure_rolling_are_within_their_errors(
    moes: dict[str, float], oil: dict[str, float], film: float
) -> None:
    found = ehlwave.Contact(**moes, **oil).film()
    assert found.central_moes == pytest.approx(film, rel=found.central_error + 0.005)
    assert found.central_error < 0.21
    assert found.friction is None


@pytest.mark.parametrize(
    ("moes", "oil"),
    [
        (LIGHT, carreau(31e3, 0.74)),
        (LIGHT | {"slip_parameter": 1.2}, carreau(31e3, 0.74)),
        (HEAVY, carreau(5e5, 0.5)),
        (HEAVY, carreau(7e6, 0.1)),
        (ROLLER, eyring(2e5)),
    ],
)
def test_oils_that_thin_too_much_are_refused_with_the_reason(
    moes: dict[str, float], oil: dict[str, float]
) -> None:
    contact = ehlwave.Contact(**moes, **oil)
    for answer in (contact.film, lambda: contact.response(0.5)):
        with pytest.raises(ehlwave.errors.RangeError, match=r"in the inlet|thins in the inlet"):
            answer()
    if contact.conditions.d:
        assert not contact.transfer("recommended").covers_all


def test_the_law_of_the_two_waves_has_no_error_where_a_carreau_oil_thins_too_much() -> None:
    light = ehlwave.Contact(**LIGHT, slip_parameter=1.2, **carreau(31e3, 0.74))
    law = light.transfer("two-waves")
    assert law.error(np.ones(1), np.ones(1)) is None
    assert "thins in the inlet" in law.outside_reason
    held = ehlwave.Contact(**LIGHT, slip_parameter=1.2, **carreau(7e6, 0.5)).transfer()
    assert held.is_covered(np.ones(1), np.ones(1)).all()


def test_a_film_does_not_jump_where_slip_begins() -> None:
    for moes, oil, _ in (*COMPUTED, (HEAVY, eyring(2e7), 0), (LIGHT, carreau(1e8, 0.5), 0)):
        if "carreau_exponent" in oil and not moes["radius_ratio_d"]:
            continue
        slips = 1, 1.0001
        rolls, slides = (ehlwave.Contact(**moes, **oil, slip_parameter=s).film() for s in slips)
        allowed = rolls.central_error + slides.central_error
        assert slides.central_moes == pytest.approx(rolls.central_moes, rel=allowed)


def test_a_carreau_oil_shears_as_its_ree_eyring_oil_at_small_stresses_and_less_at_larger() -> None:
    for exponent in (0.3, 0.5, 0.9):
        oil = Oil(stress_modulus_pa2=1e17, carreau_exponent=exponent)
        like = as_ree_eyring(oil)
        ratio = float(oil.stress_modulus_pa2) / float(like.stress_modulus_pa2)
        for stress in (1e-3, 0.3, 2.0, 8.0):  # over tau of the Ree-Eyring oil
            theirs = (1 + (stress / ratio) ** 2) ** ((1 / exponent - 1) / 2)
            own = np.sinh(stress) / stress
            assert theirs <= own * (1 + 1e-12)
            if stress < 0.1:
                assert theirs - 1 == pytest.approx(own - 1, rel=1e-5)
    newtonian = as_ree_eyring(Oil(stress_modulus_pa2=1e17, carreau_exponent=1.0))
    assert newtonian.stress_modulus_pa2 is None


def test_an_oil_that_hardly_thins_is_answered_as_a_newtonian_one() -> None:
    oil = eyring(4e7)
    plain = ehlwave.Contact(**LIGHT, **OIL)
    thick = ehlwave.Contact(**LIGHT, **oil)
    assert thinned_kind(thick.conditions) is None
    assert thinned_kind(ehlwave.Contact(**LIGHT, **eyring(3e6)).conditions) is SLIDING
    assert thick.film().central_moes == plain.film().central_moes
    more = thick.film().central_error - plain.film().central_error
    assert 0 < more == pytest.approx(thick.conditions.film_loss)
    assert more < 0.001 < MOST_LOSS
    assert thick.response(0.5).film == plain.response(0.5).film
    assert thick.response(0.5).error > plain.response(0.5).error


def test_the_bound_of_the_loss_is_one_in_the_record() -> None:
    table = pd.read_csv(Path(__file__).parents[1] / "record/thinning/thinning.csv")
    for row in table.itertuples():
        bound = loss_bound(row.lubricant_parameter_l, row.by_pressure, row.by_slip)
        assert bound == pytest.approx(row.bound, rel=2e-3)
        assert row.bound <= MOST_LOSS
    has_atlas = (table["flow_law"] == "Ree-Eyring") & (table["slip_parameter"] != 1)
    share = table["loss"] / table["bound"]
    assert share[~has_atlas].max() == pytest.approx(0.93, abs=0.005)
    assert share[has_atlas].max() == pytest.approx(1.23, abs=0.005)
    assert share.isna().sum() < 5
