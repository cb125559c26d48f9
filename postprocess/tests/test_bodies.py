"""Two bodies make the contact that their reduced radii and modulus make."""

import math
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy.special import ellipe, ellipk

import ehlwave
from ehlwave.contact.conditions_read import read_conditions
from ehlwave.contact.materials import MATERIALS
from ehlwave.errors import RangeError, SurfaceError
from ehlwave.inputs.slip import ratio_of, slip_of
from ehlwave.laws.table_read import table_rows

OIL = {"viscosity_pa_s": 0.05, "pressure_viscosity_per_pa": 2e-8}
STEEL = {"elastic_modulus_pa": 2.06e11, "poisson_ratio": 0.3}
GLASS = {"elastic_modulus_pa": 8.2e10, "poisson_ratio": 0.206}


def moes(contact: ehlwave.Contact) -> list[float]:
    c = contact.conditions
    return [c.m, c.l, c.d, c.slip_parameter, c.semi_axis_a_m]


@pytest.mark.parametrize("speeds", [(0.5, 0.5), (0.575, 0.425), (0.425, 0.575), (-0.575, -0.425)])
def test_an_ellipse_is_that_of_reduced_data(speeds: tuple[float, float]) -> None:
    ball = ehlwave.Body(8e-3, 12e-3, **STEEL)
    groove = ehlwave.Body(radius_y_m=-15e-3, **GLASS)
    contact = ehlwave.Contact.from_bodies(ball, groove, load_n=30, speeds_m_per_s=speeds, **OIL)
    modulus = 2 / ((1 - 0.09) / 2.06e11 + (1 - 0.206**2) / 8.2e10)
    mean = abs(sum(speeds)) / 2
    reduced = ehlwave.Contact(
        radius_x_m=8e-3,
        radius_y_m=1 / (1 / 12e-3 - 1 / 15e-3),
        reduced_modulus_pa=modulus,
        load_n=30,
        mean_speed_m_per_s=mean,
        slide_to_roll_ratio=(speeds[0] - speeds[1]) / (sum(speeds) / 2),
        **OIL,
    )
    np.testing.assert_allclose(moes(contact), moes(reduced), rtol=1e-12)
    # the definitions themselves
    speed_2u = 0.05 * 2 * mean / (modulus * 8e-3)
    m, l = 30 / (modulus * 64e-6) * speed_2u**-0.75, 2e-8 * modulus * speed_2u**0.25  # noqa: E741
    np.testing.assert_allclose(moes(contact)[:3], [m, l, 8e-3 / 60e-3], rtol=1e-12)
    assert contact.conditions.slip_parameter == pytest.approx(speeds[0] / (sum(speeds) / 2))


def test_a_line_is_that_of_a_load_per_length() -> None:
    roller, race = ehlwave.Body(5e-3, **STEEL), ehlwave.Body(-30e-3, **STEEL)
    shared = {"speeds_m_per_s": (2, 2), **OIL}
    contact = ehlwave.Contact.from_bodies(roller, race, load_n=2000, length_m=0.01, **shared)
    other = ehlwave.Contact.from_bodies(roller, race, load_n_per_m=2e5, **shared)
    modulus, radius = 2.06e11 / 0.91, 1 / (1 / 5e-3 - 1 / 30e-3)
    speed_2u = 0.05 * 4 / (modulus * radius)
    exact = [2e5 / (modulus * radius) / math.sqrt(speed_2u), 2e-8 * modulus * speed_2u**0.25, 0]
    np.testing.assert_allclose(moes(contact)[:3], exact, rtol=1e-12)
    np.testing.assert_allclose(moes(contact), moes(other), rtol=1e-15)


def test_the_hertz_contact_of_a_ball_bearing() -> None:
    """Its semi-axes match the elliptic integrals, both races closer than a flat."""
    d, pitch = 7.94e-3, 33.5e-3
    ball = ehlwave.Body.ball(d, material="steel")
    for race, sign in ((ehlwave.Body.inner_race, 1), (ehlwave.Body.outer_race, -1)):
        ring = race(d, pitch, osculation=0.53, material="steel")
        assert ring.radius_x_m == pytest.approx(sign * (pitch - sign * d) / 2)
        contact = ehlwave.Contact.from_bodies(
            ring, ball, load_n=15, speeds_m_per_s=(2.5, 2.5), **OIL
        )
        c = contact.conditions
        k, e = (float(f(1 - c.kappa**2)) for f in (ellipk, ellipe))
        assert c.kappa**2 * (k - e) / (e - c.kappa**2 * k) == pytest.approx(c.d, rel=1e-9)
        reduced = [1 / (2 / d + 1 / ring.radius_x_m), 1 / (2 / d + 1 / ring.radius_y_m)]
        assert c.d == pytest.approx(reduced[0] / reduced[1], rel=1e-12)
    tilted = ehlwave.Body.inner_race(d, pitch, 0.53, contact_angle_deg=25, material="steel")
    assert tilted.radius_x_m == pytest.approx((pitch / math.cos(math.radians(25)) - d) / 2)


def test_a_material_is_its_constants() -> None:
    for name, found in MATERIALS.items():
        body = ehlwave.Body(material=name.title())
        assert (body.elastic_modulus_pa, body.poisson_ratio) == found[:2]
        assert found.source


def test_what_is_outside_is_said_in_newtons_and_metres_per_second() -> None:
    ball, disc = ehlwave.Body.ball(0.02, material="steel"), ehlwave.Body(material="glass")

    def contact(load_n: float, speed: float) -> ehlwave.Contact:
        speeds = {"speeds_m_per_s": (speed, speed)}
        return ehlwave.Contact.from_bodies(ball, disc, load_n=load_n, **speeds, **OIL)

    def film(load_n: float, speed: float) -> ehlwave.Film:
        return contact(load_n, speed).film()

    with pytest.raises(RangeError) as caught:
        contact(0.2, 0.5).response(1.0, by="laws")
    said = str(caught.value)
    assert said.startswith("load_n = 0.2 gives M = ")
    assert "mean of speeds_m_per_s of" in said
    low, high = (float(word) for word in said.split("atlas holds ")[1].split(" N")[0].split(" to "))
    assert film(low, 0.5).central_m
    assert film(high, 0.5).central_m
    for load in (low * 0.98, high * 1.02):
        with pytest.raises(RangeError):
            film(load, 0.5)


def test_where_no_one_quantity_leads_inside_several_do() -> None:
    roller = ehlwave.Body(5e-3, material="steel")
    shared = {"length_m": 0.01, **OIL}

    def film(load_n: float, speed: float) -> ehlwave.Film:
        keys = {"load_n": load_n, "speeds_m_per_s": (speed, speed)} | shared
        return ehlwave.Contact.from_bodies(roller, roller, **keys).film()

    with pytest.raises(RangeError, match=r"the nearest inside the atlas has load_n = ") as caught:
        film(0.3, 100)
    words = (
        str(caught.value).split("the nearest inside the atlas has ")[1].split(". The")[0].split()
    )
    numbers = [float(words[i + 1]) for i, word in enumerate(words) if word == "="]
    assert film(*numbers).central_m


def test_all_that_messages_call_inside_is() -> None:
    rng = np.random.default_rng(7)

    def drawn(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    kinds: list[str] = []
    for _ in range(30):
        radius = drawn(1e-4, 1)
        keys = {
            "radius_x_m": radius,
            "radius_y_m": radius * drawn(1, 90),
            "load_n": drawn(1e-4, 1e7),
        }
        keys |= {"mean_speed_m_per_s": drawn(1e-6, 250), "viscosity_pa_s": drawn(1e-4, 10)}
        keys |= {"reduced_modulus_pa": drawn(1e9, 6e11)}
        keys |= {"pressure_viscosity_per_pa": drawn(5e-9, 4e-8)}
        try:
            ehlwave.Contact(**keys).film()
            continue
        except RangeError as error:
            said = str(error)
        one = re.findall(
            r"(?:^|, or )(\w+) (?:= \S+ gives .* atlas holds|of) (\S+) to (\S+) ", said
        )
        words = said.partition("the nearest inside the atlas has ")[2].split("; or compute")[0]
        several = {key: float(end) for key, end in re.findall(r"(\w+) = (\S+)", words)}
        changes = [{key: float(end)} for key, *ends in one for end in ends]
        changes += [several] if several else []
        kinds += ["several" if several else "one"] * bool(changes)
        for change in changes:
            assert ehlwave.Contact(**keys | change).film().central_m, (said, change)
    assert {"one", "several"} == set(kinds)


def test_reduced_radii_are_called_so() -> None:
    groove = ehlwave.Body.inner_race(7.94e-3, 33.5e-3, osculation=0.505, material="steel")
    ball = ehlwave.Body.ball(7.94e-3, material="steel")
    with pytest.raises(RangeError, match=r"reduced radius_x_m = .* gives D = "):
        ehlwave.Contact.from_bodies(groove, ball, load_n=30, speeds_m_per_s=(2, 2), **OIL).film()


@pytest.mark.parametrize("ratio", np.linspace(-2, 2, 401))
def test_slip_and_ratio_are_one(ratio: float) -> None:
    ratio = round(float(ratio), 2)
    assert slip_of(ratio) == float(f"{1 + ratio / 2:.4f}")  # the decimal that people would type
    assert ratio_of(slip_of(ratio)) == ratio


def test_a_harmonic_table_may_have_ratios() -> None:
    raw = pd.DataFrame({"M": [100.0] * 2, "L": 10.0, "D": 1.0, "r": 0.0, "amplitude_ratio": 0.5})
    raw["lambda_over_a"] = [0.5, 1.0]
    one = table_rows(raw.assign(slide_to_roll_ratio=0.3), "table")
    other = table_rows(raw.assign(slip_parameter=1.15), "table")
    pd.testing.assert_frame_equal(one, other)
    with pytest.raises(SurfaceError, match=r"table: slip_parameter = .* and slide_to_roll_ratio"):
        table_rows(raw.assign(slip_parameter=1.15, slide_to_roll_ratio=0.3), "table")


def test_a_later_word_on_the_command_line_counts(tmp_path: Path) -> None:
    file = tmp_path / "contact.nml"
    moes = "load_parameter_m = 100, lubricant_parameter_l = 10, radius_ratio_d = 1"
    file.write_text(f"&conditions {moes}, slip_parameter = 1.4 /")
    words = [str(file), "semi_axis_a_m=1e-4", "slide_to_roll_ratio=0.3"]
    assert read_conditions(words).slip_parameter == 1.15
    assert read_conditions([*words[2:0:-1], words[0]]).slip_parameter == 1.4
    file.write_text(f"&conditions {moes}, slide_to_roll_ratio = 0.3 /")
    assert read_conditions(words[:2]).slip_parameter == 1.15
    with pytest.raises(SurfaceError, match=r"slip_parameter = 1.1 and slide_to_roll_ratio = 0.3"):
        read_conditions([*words, "slip_parameter=1.1"])


def test_a_ratio_stands_wherever_a_slip_parameter_does() -> None:
    data = {"load_parameter_m": 100, "lubricant_parameter_l": 10, "radius_ratio_d": 1}
    data |= {"reduced_modulus_pa": 2.26e11, "eyring_stress_pa": 5e6}
    one = ehlwave.Contact(**data, slide_to_roll_ratio=0.3)
    other = ehlwave.Contact(**data, slip_parameter=1.15)
    assert one.conditions == other.conditions
    rolling = ehlwave.Contact(**data)
    assert rolling.response(0.5, slide_to_roll_ratio=0.3) == one.response(0.5)
    for both in ({"slip_parameter": 1.15, "slide_to_roll_ratio": 0.3},):
        with pytest.raises(SurfaceError, match=r"slip_parameter = 1.15 and slide_to_roll_ratio"):
            ehlwave.Contact(**data, **both)
        with pytest.raises(SurfaceError, match=r"slip_parameter = 1.15 and slide_to_roll_ratio"):
            rolling.response(0.5, **both)
