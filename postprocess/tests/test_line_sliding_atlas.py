"""Line contacts that slide: their atlases, pairs, and refusals."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import ehlwave
from ehlwave.laws.atlas.atlas import load_atlas, shipped
from ehlwave.laws.atlas.kind import Kind
from ehlwave.laws.atlas.kinds import LINE, LINE_NEWTONIAN, LINE_SLIDING
from ehlwave.laws.atlas.sliding import MODULUS_PA
from ehlwave.surface import trace_surface
from studies.atlas.centre import centre_pressures
from studies.atlas.line_sliding_design import (
    EVENLY_SPREAD,
    SLIGHT_SLIP,
    case,
    write_batch,
    write_validation,
)

MODULUS = 2.26e11
MOES = {"load_parameter_m": 100, "lubricant_parameter_l": 11, "radius_ratio_d": 0}
EYRING = {"reduced_modulus_pa": MODULUS, "eyring_stress_pa": 5e6}
GEAR = {
    "radius_x_m": 8e-3,
    "reduced_modulus_pa": MODULUS,
    "load_n_per_m": 2e5,
    "mean_speed_m_per_s": 6,
    "viscosity_pa_s": 0.02,
    "pressure_viscosity_per_pa": 2e-8,
    "roelands_index": 0.6,
    "eyring_stress_pa": 5e6,
    "slide_to_roll_ratio": 0.5,
}


@pytest.mark.parametrize(
    ("slip", "wave", "film"),
    [
        (1.25, 0.5, -0.14349 - 0.05639j),
        (0.75, 0.5, -0.21504 - 0.32034j),
        (1.1, 2.0, 0.03991 + 0.06191j),
    ],
)
def test_a_response_is_that_of_the_program(slip: float, wave: float, film: complex) -> None:
    # ehlwave-case, 4096 cells, flooded edges, extrapolated to mesh size 0
    found = ehlwave.Contact(**MOES, **EYRING).response(wave, slip_parameter=slip)
    assert abs(found.film - film) < found.error < 0.1


@pytest.mark.parametrize(
    ("keys", "wave", "film"),
    [
        ({"load_parameter_m": 10, "slip_parameter": 1.25}, 1.0, -0.18339 + 0.74757j),
        ({"load_parameter_m": 100, "slip_parameter": 1.25}, 0.5, -0.31648 - 0.26723j),
        ({"load_parameter_m": 100, "slip_parameter": 0.75}, 0.5, -0.28276 - 0.18211j),
        ({"load_parameter_m": 30, "slip_parameter": 0.4}, 0.4, -0.52399 - 0.13673j),
    ],
)
def test_a_response_in_a_newtonian_oil_is_that_of_the_program(
    keys: dict[str, float], wave: float, film: complex
) -> None:
    # ehlwave-case, 8192 cells, flooded edges, extrapolated to mesh size 0
    found = ehlwave.Contact(**MOES | keys).response(wave)
    assert abs(found.film - film) < found.error < 0.1
    assert np.isfinite(found.pressure)


def test_a_newtonian_oil_has_the_film_of_rolling_and_deformed_shapes_under_slip() -> None:
    newtonian = {key: value for key, value in GEAR.items() if key != "eyring_stress_pa"}
    contact = ehlwave.Contact(**newtonian)
    rolls = ehlwave.Contact(**newtonian | {"slide_to_roll_ratio": 0.0})
    assert contact.film().central_m == rolls.film().central_m
    assert contact.film().minimum_m == rolls.film().minimum_m
    step = contact.conditions.semi_axis_a_m / 40
    surface = trace_surface(1e-8 * np.cos(2 * np.pi * np.arange(200) / 20), step, "x", "cosine")
    found = contact.deform(surface, form="none", ends="none")
    rolled = np.exp(2j * np.pi * np.arange(200) / 20)
    response = contact.response(0.5).film
    np.testing.assert_allclose(found.height[:, 0], 1e-8 * np.real(response * rolled), atol=2e-11)
    pair = contact.deform_pair(surface, surface, form="none", ends="none").statistics
    assert 0 < pair.lambda_error < 1
    for wave in (0.3, 1.0, 3.0):
        slow, known = contact.response(wave, slip_parameter=1.0001), rolls.response(wave)
        assert abs(slow.film - known.film) < slow.error + known.error


def test_film_and_friction_are_those_of_the_program() -> None:
    film = ehlwave.Contact(**MOES, **EYRING, slip_parameter=1.25).film()
    assert film.central_moes == pytest.approx(3.6475, rel=film.central_error)
    assert film.minimum_moes == pytest.approx(3.6475 * 0.025461 / 0.028648, rel=film.minimum_error)
    assert film.friction == pytest.approx(0.057762, rel=film.friction_error)
    assert film.central_error < 0.05


LINE_CORNER = {
    "load_parameter_m": 41.619,
    "lubricant_parameter_l": 18.202,
    "radius_ratio_d": 0.0,
    "pressure_viscosity_per_pa": 1.0331e-8,
    "roelands_index": 0.79347,
    "slip_parameter": 0.30351,
    "reduced_modulus_pa": MODULUS,
    "eyring_stress_pa": 17.208e6,
}
POINT_CORNER = {
    "load_parameter_m": 988.66,
    "lubricant_parameter_l": 18.777,
    "radius_ratio_d": 0.041174,
    "pressure_viscosity_per_pa": 1.3736e-8,
    "roelands_index": 0.79316,
    "slip_parameter": 1.2624,
    "reduced_modulus_pa": MODULUS,
    "eyring_stress_pa": 3.6286e6,
}
ROLLING_CORNER = {
    "load_parameter_m": 291.2,
    "lubricant_parameter_l": 40.601,
    "radius_ratio_d": 0.96148,
    "pressure_viscosity_per_pa": 1.0029e-8,
    "roelands_index": 0.5984,
}


@pytest.mark.parametrize(
    ("corner", "films", "own", "most"),
    [
        (LINE_CORNER, (4.6497, 3.7977), (0.0003, 0.0004), 0.04),
        (POINT_CORNER, (5.7614, 4.7609), (0.0017, 0.0055), 0.02),
        (ROLLING_CORNER, (8.1857, 4.4996), (0.0071, 0.0143), 0.04),
    ],
)
def test_errors_of_films_hold_at_ends_of_atlases(
    corner: dict[str, float],
    films: tuple[float, float],
    own: tuple[float, float],
    most: float,
) -> None:
    """The oil at ends of its ranges, and much slip; films of ehlwave-case and their errors."""
    film = ehlwave.Contact(**corner).film(by="laws")
    assert film.central_moes == pytest.approx(films[0], rel=film.central_error + own[0])
    assert film.minimum_moes == pytest.approx(films[1], rel=film.minimum_error + own[1])
    assert film.central_error < most


def test_errors_of_films_within_the_atlas_are_those_of_its_networks() -> None:
    networks = load_atlas(shipped(LINE_SLIDING))
    keys = ehlwave.Contact(**GEAR).conditions.atlas_keys()
    own = float(networks.film_errors(LINE_SLIDING.coordinates(keys))[0, 0])
    assert own == ehlwave.Contact(**GEAR).film().central_error


def test_a_gear_has_deformed_shape_and_lambda_ratio_of_one_surface_and_of_both() -> None:
    contact = ehlwave.Contact(**GEAR)
    step = contact.conditions.semi_axis_a_m / 40
    height = 1e-8 * np.cos(2 * np.pi * np.arange(200) / 20)
    surface = trace_surface(height, step, "x", "cosine")
    found = contact.deform(surface, form="none", ends="none")
    rolled = np.exp(2j * np.pi * np.arange(200) / 20)
    response = contact.response(0.5).film
    np.testing.assert_allclose(found.height[:, 0], 1e-8 * np.real(response * rolled), atol=2e-11)
    pair = contact.deform_pair(surface, surface, form="none", ends="none").statistics
    other = abs(contact.response(0.5, slip_parameter=0.75).film)
    both = np.hypot(abs(response), other) / abs(response)
    ratio = found.statistics.lambda_ratio_after / pair.lambda_ratio_after
    assert ratio == pytest.approx(both, rel=0.02)  # mean squares add, mean films nearly
    assert 0 < pair.lambda_error < 1


def test_slip_near_one_has_the_response_and_film_of_rolling() -> None:
    rolling = ehlwave.Contact(**MOES)
    slow = ehlwave.Contact(**MOES, **EYRING, slip_parameter=1.0001)
    film, expected = slow.film(), rolling.film()
    bar = film.central_error + expected.central_error
    assert film.central_moes == pytest.approx(expected.central_moes, rel=bar)
    for wave in (0.3, 1.0, 3.0):
        found, known = slow.response(wave), rolling.response(wave)
        assert abs(found.film - known.film) < found.error + known.error


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"slide_to_roll_ratio": 1.5}, "slip_parameter = 1.75 .* 0.3 to 1.7"),
        ({"eyring_stress_pa": 1e8}, "eyring_stress_pa"),
        ({"load_n_per_m": 9e7}, "of 0.4 to 2000"),
        ({"eyring_stress_pa": None, "slide_to_roll_ratio": 1.5}, "slip_parameter = 1.75"),
    ],
)
def test_outside_the_ranges_is_refused(changed: dict[str, float | None], said: str) -> None:
    keys = {key: value for key, value in (GEAR | changed).items() if value is not None}
    with pytest.raises(ehlwave.RangeError, match=said):
        ehlwave.Contact(**keys).response(1.0)


def test_the_sweep_of_a_batch_fills_the_ranges_and_resolves_the_inlet(tmp_path: Path) -> None:
    table = write_batch(tmp_path, 1).with_suffix(".csv")
    rows = np.genfromtxt(table, names=True, delimiter=",")
    for key, column in (("slip_parameter", "slip_parameter"), ("load_parameter_m",) * 2):
        low, high = LINE_SLIDING.ranges[key]
        assert np.ptp(np.log(rows[column])) > 0.8 * np.log(high / low)
    low, high = LINE_SLIDING.ranges["stress_modulus_pa2"]
    assert np.all(rows["eyring_stress_pa"] * MODULUS_PA > low * 0.999)
    assert np.all(rows["eyring_stress_pa"] * MODULUS_PA < high * 1.001)
    heavy = {key: ends[0] for key, ends in LINE_SLIDING.ranges.items()}
    heavy["load_parameter_m"] = 1500.0
    assert case(heavy, 1.0)["cells_x"] == 8192


@pytest.mark.parametrize("kind", [LINE_SLIDING, LINE_NEWTONIAN])
def test_the_ranges_of_lines_that_roll_are_kept(kind: Kind) -> None:
    assert kind.ranges.items() > LINE.ranges.items()
    assert load_atlas(shipped(kind)).kind is kind


def test_newtonian_contacts_have_sweeps_of_their_own(tmp_path: Path) -> None:
    for path in (
        write_batch(tmp_path, 0, kind=LINE_NEWTONIAN),
        write_validation(tmp_path, LINE_NEWTONIAN),
    ):
        assert "flow_law" not in path.read_text()
        rows = np.genfromtxt(path.with_suffix(".csv"), names=True, delimiter=",")
        assert "eyring_stress_pa" not in rows.dtype.names
        assert rows["slip_parameter"].min() < 0.4
        assert rows["slip_parameter"].max() > 1.6


def test_the_pressure_at_the_centre_is_found_from_the_attenuated_wave() -> None:
    row = {
        "load_parameter_m": 1.0,
        "lubricant_parameter_l": 12.0,
        "pressure_viscosity_per_pa": 2.2e-8,
        "roelands_index": 0.68,
        "slip_parameter": 1.3,
        "wavelength_x_over_a": 1.0,
        "central_film": 4.794250774,
        "attenuated_formula_real": 0.999611468,
        "attenuated_formula_imaginary": 0.012810231,
        "max_pressure": 0.7283,
    }
    # ehlwave-case, 4096 cells over X of -26 to 6: the field of the pressure at X = 0
    assert centre_pressures(pd.DataFrame([row])) == pytest.approx([0.408746], abs=1e-5)


def test_the_last_batches_lie_where_machines_are(tmp_path: Path) -> None:
    slight, light = (
        np.genfromtxt(
            write_batch(tmp_path, EVENLY_SPREAD[kind.name], kind=kind).with_suffix(".csv"),
            names=True,
            delimiter=",",
        )
        for kind in (LINE_SLIDING, LINE_NEWTONIAN)
    )
    slips = np.abs(slight["slip_parameter"] - 1)
    assert SLIGHT_SLIP[0] * 0.99 < slips.min() < slips.max() < SLIGHT_SLIP[1] * 1.01
    assert light["load_parameter_m"].max() <= 100
