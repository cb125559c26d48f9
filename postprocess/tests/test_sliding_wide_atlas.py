"""The atlas of contacts that slide beyond the usual ranges."""

import re
from pathlib import Path

import numpy as np
import pytest

import ehlwave
from ehlwave.laws.atlas.atlas import load_atlas, shipped
from ehlwave.laws.atlas.kinds import SLIDING, SLIDING_WIDE
from ehlwave.laws.atlas.sliding import MODULUS_PA
from ehlwave.laws.atlas.sliding_wide import film_under_slip
from ehlwave.surface import trace_surface
from studies.atlas.anchors import WAVES, anchors, with_anchors
from studies.atlas.design import CONTACTS
from studies.atlas.sliding_wide_design import (
    AT_REST,
    EASY,
    HARD_BATCHES,
    SLOW,
    SLOW_BATCHES,
    batch_contacts,
)

ROOT = Path(__file__).resolve().parents[1]

OIL = {"reduced_modulus_pa": 226e9, "eyring_stress_pa": 5e6}
BALL = {"load_parameter_m": 5000, "lubricant_parameter_l": 8, "radius_ratio_d": 0.066}
BALL |= OIL | {"pressure_viscosity_per_pa": 2e-8, "roelands_index": 0.6}
CIRCLE = OIL | {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
THIN = {"load_parameter_m": 1000, "lubricant_parameter_l": 8, "radius_ratio_d": 0.5}
THIN |= BALL | THIN | {"eyring_stress_pa": 0.5e6}

COMPUTED = [
    (BALL, 1.1, 0.0672 + 0.2666j, 3.233, 0.0366),
    (BALL, 1.8, 0.1607 - 0.0321j, 3.231, 0.0489),
    (CIRCLE, 0.0, 0.4343 - 0.2176j, 4.114, -0.0633),
    (THIN, 1.5, 0.0083 + 0.1195j, 2.492, 0.0062),
]
"""Contact, S, film response to transverse waves of the length a, central film in the Moes scale,
friction; ehlwave-case, averaged scheme, 512 x 384 cells, flooded edges, at mesh size 0."""


@pytest.mark.parametrize(("keys", "slip", "response", "film", "friction"), COMPUTED)
def test_answers_are_those_of_the_program(
    keys: dict, slip: float, response: complex, film: float, friction: float
) -> None:
    contact = ehlwave.Contact(**keys, slip_parameter=slip)
    assert contact.atlas().kind is SLIDING_WIDE
    found = contact.response(1.0)
    assert found.source.startswith("atlas")
    assert abs(found.film - response) < found.error + 1e-3
    assert found.error < 0.3
    smooth = contact.film()
    assert smooth.central_moes == pytest.approx(film, rel=smooth.central_error + 1e-3)
    assert smooth.friction is not None
    assert abs(smooth.friction) == pytest.approx(abs(friction), rel=smooth.friction_error)


def test_both_atlases_agree_at_the_ends_of_the_usual_one() -> None:
    usual, wide = (load_atlas(shipped(kind)) for kind in (SLIDING, SLIDING_WIDE))
    random, agrees = np.random.default_rng(3), []
    for key, (low, high) in SLIDING.ranges.items():
        for end in (low, high):
            keys = {
                name: low * (high / low) ** random.uniform(0.3, 0.7)
                for name, (low, high) in SLIDING.ranges.items()
            } | {key: end}
            answers = [atlas.at(keys).responses([0.3, 1.0, 2.5], 0.0) for atlas in (usual, wide)]
            bars = answers[0].error + answers[1].error
            agrees += list(np.abs(answers[0].film - answers[1].film) < bars)
    assert np.mean(agrees) > 0.95


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        (BALL | {"load_parameter_m": 11000}, "load_parameter_m = 11000 .* 5 to 10000"),
        (BALL | {"eyring_stress_pa": 5e8}, "1.936e[+]16 to 9.68e[+]19"),
        (BALL | {"lubricant_parameter_l": 3, "radius_ratio_d": 1}, "film under slip of about 0.00"),
        (BALL | {"load_parameter_m": 300, "eyring_stress_pa": 1e5}, "inlet of .* Eyring stresses"),
    ],
)
def test_what_is_not_covered_is_refused_with_its_reason(keys: dict, said: str) -> None:
    contact = ehlwave.Contact(**keys, slip_parameter=1.8)
    with pytest.raises(ehlwave.RangeError, match=said):
        contact.film()
    with pytest.raises(ehlwave.RangeError, match=said):
        contact.response(1.0)


def test_largest_loads_are_those_of_the_manual() -> None:
    text = (ROOT / "manual/howto.md").read_text(encoding="utf-8")
    rows = re.findall(
        r"^\| ([05.]+) \| ([01.]+) \| ([\d,]+) \| ([\d,]+) \| ([\d,]+) \|$", text, re.M
    )
    assert len(rows) == 4
    for stress, slip, *loads in rows:
        for load, l, d in zip(loads, (5, 12, 5), (1, 1, 0.06), strict=True):  # noqa: E741
            most = float(load.replace(",", ""))
            keys = {"lubricant_parameter_l": l, "radius_ratio_d": d, "slip_parameter": float(slip)}
            keys |= {"pressure_viscosity_per_pa": 2.2e-8, "roelands_index": 0.6}
            keys |= {"stress_modulus_pa2": 1e6 * float(stress) * MODULUS_PA}
            assert not SLIDING_WIDE.beyond(keys | {"load_parameter_m": 0.97 * most})
            assert most == 1e4 or SLIDING_WIDE.beyond(keys | {"load_parameter_m": 1.03 * most})


def test_a_rough_surface_at_rest_is_deformed() -> None:
    lengths = {"semi_axis_a_m": 0.2e-3, "radius_x_m": 15.5e-3}
    contact = ehlwave.Contact(**CIRCLE, **lengths, slip_parameter=0.0)
    x = np.arange(200) * 1e-5
    surface = trace_surface(1e-8 * np.cos(2 * np.pi * x / 0.2e-3), 1e-5, "x", "cosine")
    found = contact.deform(surface, form="none", ends="none")
    response = contact.response(1.0)
    expected = 1e-8 * np.real(response.film * np.exp(2j * np.pi * x / 0.2e-3))
    np.testing.assert_allclose(found.height[:, 0], expected, atol=1e-10)


def test_points_within_the_usual_ranges_are_those_of_the_usual_atlas() -> None:
    points = anchors(SLIDING_WIDE, 8)
    both = with_anchors(points.isel(contact=slice(2), point=slice(2 * WAVES)), SLIDING_WIDE, 8)
    assert both["is_computed"].values.tolist() == [True] * 2 + [False] * points.sizes["contact"]
    assert both.sizes["point"] == WAVES * both.sizes["contact"]
    usual, names = load_atlas(shipped(SLIDING)), SLIDING.films
    for number in range(points.sizes["contact"]):
        one = points.isel(contact=number)
        film = usual.at({key: float(one[key]) for key in SLIDING.ranges}).film()
        references, ratios = one["references"].values, [float(one[name]) for name in names]
        central = references[0] * np.exp(ratios[0])
        smallest = central * references[1] / references[0] * np.exp(ratios[1])
        assert central == pytest.approx(film.central_moes)
        assert smallest == pytest.approx(film.minimum_moes)
        assert references[2] * np.exp(ratios[2]) == pytest.approx(film.stress)


@pytest.mark.parametrize("batch", [0, HARD_BATCHES.start, SLOW_BATCHES.start])
def test_contacts_of_a_batch_lie_where_the_wide_atlas_answers(batch: int) -> None:
    chosen = batch_contacts(batch)
    assert len(chosen) == CONTACTS
    for place, contact in enumerate(chosen):
        assert SLIDING_WIDE.holds(contact)
        assert not SLIDING_WIDE.beyond(contact)
        if place not in AT_REST:
            assert not SLIDING.holds(contact)
            most = SLOW if batch in SLOW_BATCHES else SLIDING_WIDE.ranges
            assert contact["slip_parameter"] <= most["slip_parameter"][1]
        if batch == 0:
            assert film_under_slip(contact) >= EASY["film"]
