"""Laws of ridges under slip, of waves in warm contacts, of smallest films of heavy contacts."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest

import ehlwave
from ehlwave.errors import RangeError
from ehlwave.laws.two_wave_transfer import TwoWaveTransfer
from ehlwave.laws.warm_waves import warmth_of

RECORD = Path(__file__).resolve().parents[1] / "record/judged"
CARREAU = {
    "radius_x_m": 0.0125,
    "radius_y_m": 0.0125,
    "reduced_modulus_pa": 2.26e11,
    "load_n": 30,
    "mean_speed_m_per_s": 1,
    "viscosity_pa_s": 0.04,
    "pressure_viscosity_per_pa": 2e-8,
    "roelands_index": 0.6,
    "slip_parameter": 1.5,
}
THINS = {"carreau_modulus_pa": 7e6, "carreau_exponent": 0.35}


def test_ridges_in_a_carreau_oil_feel_slip() -> None:
    """Computed and extrapolated: 0.8663; in pure rolling 0.73."""
    contact = ehlwave.Contact(**CARREAU, **THINS)
    found = contact.response(0.5, 90)
    assert abs(found.film) == pytest.approx(0.8663, abs=found.error)
    assert found.error < 0.06
    rolling = ehlwave.Contact(**CARREAU | {"slip_parameter": 1}, **THINS).response(0.5, 90)
    assert abs(rolling.film) < 0.75


def test_ridges_in_a_newtonian_oil_do_not_feel_slip() -> None:
    found = ehlwave.Contact(**CARREAU).response(0.5, 90)
    rolling = ehlwave.Contact(**CARREAU | {"slip_parameter": 1}).response(0.5, 90)
    assert found.film == rolling.film
    assert found.error == rolling.error


def test_ridges_beyond_the_oils_of_the_law_are_refused() -> None:
    thin = {"carreau_modulus_pa": 2e4, "carreau_exponent": 0.35}
    reasons = TwoWaveTransfer(ehlwave.Contact(**CARREAU, **thin).conditions).reasons()
    assert any("thins in the inlet" in reason for reason in reasons)


@pytest.mark.parametrize(
    ("m", "l", "d", "right"),
    [
        (7902, 13.2, 0.031, 3.954),
        (3000, 10, 0.9, 0.884),
        (6000, 10, 0.5, 1.172),
        (2942, 8.25, 0.25, 1.997),
    ],
)
def test_the_smallest_film_of_a_heavy_contact(m: float, l: float, d: float, right: float) -> None:  # noqa: E741
    """Computed on 1024 x 1024 cells of the fitted scheme, Moes scale, within 1 %."""
    keys = {"load_parameter_m": m, "lubricant_parameter_l": l, "radius_ratio_d": d}
    oil = {"pressure_viscosity_per_pa": 2e-8, "roelands_index": 0.68}
    film = ehlwave.Contact(**keys, **oil).film()
    assert film.minimum_moes == pytest.approx(right, rel=film.minimum_error + 0.01)
    assert film.minimum_error < 0.05


def test_a_smallest_film_beyond_the_computed_loads_is_unknown() -> None:
    keys = {"load_parameter_m": 20000, "lubricant_parameter_l": 10, "radius_ratio_d": 0.05}
    film = ehlwave.Contact(**keys).film()
    assert math.isnan(film.minimum_moes)
    assert math.isfinite(film.central_moes)


def test_waves_of_a_warm_contact() -> None:
    """A wave that a warm inlet flattens, against a march with carried temperatures."""
    with (RECORD / "warm_waves.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if row["carried_real"]]
    row = next(r for r in rows if r["number"] == "14")
    heat = ehlwave.Heat(
        float(row["temperature_k"]),
        float(row["viscosity_temperature_per_k"]),
        float(row["oil_conductivity_w_per_m_k"]),
        float(row["oil_heat_capacity_j_per_kg_k"]),
        870,
        body=ehlwave.BodyHeat(float(row["body_conductivity_w_per_m_k"])),
        body2=ehlwave.BodyHeat(float(row["body2_conductivity_w_per_m_k"])),
    )
    names = ("radius_x_m", "radius_y_m", "reduced_modulus_pa", "load_n", "mean_speed_m_per_s")
    names += ("viscosity_pa_s", "eyring_stress_pa", "pressure_viscosity_per_pa", "roelands_index")
    keys = {name: float(row[name]) for name in names} | {"slip_parameter": 1.0}
    wave = float(row["wavelength_over_a"]), float(row["angle_deg"])
    contact = ehlwave.Contact(**keys, heat=heat)
    computed = complex(float(row["carried_real"]), float(row["carried_imaginary"]))
    found, cold = contact.response(*wave), ehlwave.Contact(**keys).response(*wave)
    assert abs(found.film - computed) < 0.5 * abs(cold.film - computed)
    assert abs(found.film - computed) < found.error
    # The transfer of surfaces is the same law.
    theta, q = np.radians(wave[1]), 1 / (wave[0] * contact.conditions.semi_axis_a_m)
    along, across = np.array([q * np.cos(theta)]), np.array([q * np.sin(theta)])
    assert contact.transfer().ratio(along, across)[0] == pytest.approx(found.film, abs=2e-3)


def test_waves_under_slip_with_heat_need_an_eyring_oil() -> None:
    heat = ehlwave.Heat(313.15, 0.042, 0.14, 2000, 870)
    film = ehlwave.Contact(**CARREAU, heat=heat).film()
    assert warmth_of(film, heat, 1.0) == 0
    with pytest.raises(RangeError, match="eyring_stress_pa"):
        warmth_of(film, heat, 1.5)


def test_waves_of_a_hot_sliding_ball() -> None:
    """Isothermal 0.86 + 0.32i; by marches on 96 and 128 cells 0.64 + 0.39i."""
    heat = ehlwave.Heat(313.15, 0.04, 0.14, 2000, 870)
    keys = {**CARREAU, "load_n": 60, "mean_speed_m_per_s": 4, "viscosity_pa_s": 0.05}
    found = ehlwave.Contact(**keys, eyring_stress_pa=5e6, heat=heat).response(0.7)
    assert abs(found.film - (0.641 + 0.384j)) < found.error < 0.25


def test_errors_hold_for_the_contacts_of_the_record() -> None:
    replaced = {"before", "ridges, rolling", "isothermal"}
    with (RECORD / "coverage.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if row["law"] not in replaced]
    assert len(rows) == 9
    for row in rows:
        assert float(row["within"]) >= 0.95, row["law"]
        assert float(row["beyond_1.5"]) <= 0.01, row["law"]
