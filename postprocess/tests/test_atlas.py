import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from contact import EXPERIMENT

import ehlwave
from ehlwave.contact.conditions import MOES_KEYS
from ehlwave.contact.scales import ellipticity, moes_per_film
from ehlwave.laws.atlas.atlas import Atlas, load_atlas, shipped
from ehlwave.laws.atlas.committee import Committee
from ehlwave.laws.atlas.coordinates import hertz_film
from ehlwave.laws.atlas.kinds import KINDS, Kind
from ehlwave.laws.atlas.ranges import THICKEST_FILM, THINNEST_FILM
from ehlwave.laws.atlas.shape import Shape
from ehlwave.laws.atlas.stored import checksum, committee_of, read_packed, read_stored
from ehlwave.laws.atlas_transfer import AtlasTransfer
from ehlwave.surface import trace_surface
from studies.atlas.fit import OF_ERRORS
from studies.atlas.losses import Errors, Films, Waves, part
from studies.atlas.store import variables_of, write_atlas
from studies.atlas.train import Recipe, fitted, joined

MOES = {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1}
BALL = EXPERIMENT | {"roelands_index": 0.484}
LENGTHS = {"semi_axis_a_m": 0.2e-3, "radius_x_m": 12.5e-3}
SLIDES = {"wavelength_over_a": 0.5, "slip_parameter": 1.2}


def test_a_committee_learns_a_function_and_is_written_as_it_was_learned(tmp_path: Path) -> None:
    random = np.random.default_rng(3)
    places = random.uniform(-1, 1, (300, 2))
    truth = np.stack([np.sin(3 * places[:, 0]) * places[:, 1], places[:, 0] ** 2], axis=1)
    films = Films(places, truth)
    found = fitted(places, films.loss, films.scales, Recipe(2, 16, 400, 1e-7), [0, 1])
    assert np.quantile(np.abs(found(places) - truth), 0.95) < 0.01
    alone = [Committee(found.centre, found.scatter, [w[[k]] for w in found.layers]) for k in (0, 1)]
    np.testing.assert_allclose(
        np.mean([one(places) for one in alone], axis=0), found(places), atol=1e-6
    )
    data = xr.Dataset(variables_of("films", joined(*alone)))
    write_atlas(data, tmp_path / "some.nc")
    again = committee_of(read_stored(tmp_path / "some.nc"), "films")
    np.testing.assert_allclose(again(places), found(places), atol=1e-3)


def learned() -> dict[str, Waves | Films | Errors]:
    """Return a set of each kind of training data, of 30 points."""
    random = np.random.default_rng(4)
    shape = Shape(*(random.uniform(*limits, 30) for limits in ((30, 900), (3, 15), (0.1, 1))))
    seen = shape.seen(random.uniform(0.2, 3, 30), random.uniform(0, 90, 30))
    film, left = (random.normal(size=30) + 1j * random.normal(size=30) for _ in range(2))
    rise = np.where(random.random(30) < 0.5, np.nan, random.random(30))
    return {
        "waves": Waves(seen.coordinates, seen, film, left, rise),
        "films": Films(seen.coordinates, random.normal(size=(30, 2))),
        "errors": Errors(seen.coordinates, random.random((30, 2))),
    }


@pytest.mark.parametrize("name", ["waves", "films", "errors"])
def test_the_slopes_of_a_loss_are_its_differences(name: str) -> None:
    task = part(learned()[name], (np.arange(30) >= 5) & (np.arange(30) < 25))
    loss = task.loss
    numbers = 0.1 * np.random.default_rng(5).normal(size=(20, task.scales.size))
    slopes = loss(numbers)[1]
    for k in range(task.scales.size):
        step = np.zeros_like(numbers)
        step[3, k] = 1e-6
        change = (loss(numbers + step)[0] - loss(numbers - step)[0]) / 2e-6
        assert slopes[3, k] == pytest.approx(change, rel=1e-4, abs=1e-9)


def test_bars_follow_the_size_of_errors() -> None:
    random = np.random.default_rng(4)
    places = np.linspace(-1, 1, 600)[:, None]
    errors = Errors(places, np.abs(random.normal(size=(600, 1))) * np.exp(2 * places))
    found = fitted(places, errors.loss, errors.scales, OF_ERRORS, [0])(places)[:, 0]
    assert np.corrcoef(found, places[:, 0])[0, 1] > 0.95
    assert found[-60:].mean() - found[:60].mean() == pytest.approx(3.6, abs=0.7)


def test_numbers_give_the_responses_back() -> None:
    shape = Shape([50.0, 900.0], [4.0, 15.0], [1.0, 0.1])
    wave, angle = np.array([0.3, 2.0]), np.array([30.0, 90.0])
    film, pressure = np.array([0.8 + 0.3j, 0.2 + 0j]), np.array([-1 + 2j, -3 + 0j])
    seen = shape.seen(wave, angle)
    ratio, left = film / seen.law - 1, seen.pressure_left(film, pressure)
    numbers = np.stack([ratio.real, ratio.imag, left.real, left.imag], axis=1)
    np.testing.assert_allclose(seen.film(numbers), film, rtol=1e-12)
    np.testing.assert_allclose(seen.pressure(film, numbers), pressure, rtol=1e-12)


def test_a_response_is_that_of_the_program() -> None:
    # ehlwave-case, 256 x 256 cells, flooded edges, extrapolated to mesh size 0
    contact = ehlwave.Contact(**MOES)
    angle = float(np.degrees(np.arctan(0.7)))
    wave = 1 / np.hypot(1 / 0.7, 1)
    found = contact.response(wavelength_over_a=wave, angle_deg=angle)
    assert abs(found.film - (0.74223 + 0.25345j)) < 0.03
    assert abs(found.pressure - (-2.3008 + 2.3195j)) < 0.3
    assert 0 < found.error < 0.1


def test_film_of_the_paper_experiment_is_that_computed() -> None:
    film = ehlwave.Contact(**BALL).film()
    assert film.central_m == pytest.approx(0.237e-6, rel=0.01)
    assert film.minimum_m is not None
    assert film.minimum_m < film.central_m
    assert film.central_error < 0.05


@pytest.mark.parametrize(
    ("keys", "asked", "said"),
    [
        (MOES, {"wavelength_over_a": 5}, "0.1 to 4"),
        (MOES, {"wavelength_over_a": 0.05}, "0.1 to 4"),
        (MOES, {"wavelength_over_a": 1, "angle_deg": 100}, "0 to 90"),
        (MOES, {"wavelength_over_a": 1, "slip_parameter": 1.9}, "slip_parameter = 1.9"),
        ({**MOES, "lubricant_parameter_l": 40}, SLIDES, "L = 40: the law was fitted to 2.5 to 20"),
        ({**MOES, "load_parameter_m": 20000}, SLIDES, "M = 2e[+]04: the law was fitted to 20"),
        ({**MOES, "radius_ratio_d": 0.05}, SLIDES, "D = 0.05: the law was fitted to 0.1 to 1"),
        ({**MOES, "load_parameter_m": 4}, {"wavelength_over_a": 1}, "load_parameter_m = 4"),
        ({**MOES, "roelands_index": 0.1}, {"wavelength_over_a": 1}, "roelands_index = 0.1"),
    ],
)
def test_nothing_is_extrapolated(keys: dict, asked: dict, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        ehlwave.Contact(**keys).response(**asked)


def test_nearly_rigid_contacts_and_impossible_pressures_are_refused() -> None:
    slender = {"load_parameter_m": 15, "lubricant_parameter_l": 5, "radius_ratio_d": 0.02}
    with pytest.raises(ehlwave.RangeError, match="times the Hertz approach"):
        ehlwave.Contact(**slender).response(1.0, by="laws")
    assert "rigid" in ehlwave.Contact(**slender).film().source
    assert ehlwave.Contact(**slender | {"load_parameter_m": 60}).film().central_error > 0
    heavy = {"load_parameter_m": 9000, "lubricant_parameter_l": 20, "radius_ratio_d": 1}
    with pytest.raises(ehlwave.RangeError, match=r"a Hertz pressure of 1[0-9.]+ GPa"):
        ehlwave.Contact(**heavy, pressure_viscosity_per_pa=1e-8).film()
    ehlwave.Contact(**heavy, pressure_viscosity_per_pa=2e-8).film()
    with pytest.raises(ehlwave.RangeError, match=r"alpha ph of 17[0-9.]+ \(of at most 160\)"):
        ehlwave.Contact(**heavy | {"load_parameter_m": 13000}).film()
    thin = {"load_parameter_m": 90000, "lubricant_parameter_l": 4, "radius_ratio_d": 0.04}
    with pytest.raises(ehlwave.RangeError, match=r"approach \(of at least 0.0015"):
        ehlwave.Contact(**thin).film()
    assert ehlwave.Contact(**thin | {"lubricant_parameter_l": 12}).film().central_error > 0


def test_smallest_loads_by_slenderness_are_those_of_the_manual() -> None:
    slender = 0.6, 0.1, 0.04, 0.01
    for l, loads in ((20, (5, 13, 20, 38)), (42, (9, 20, 28, 49))):  # noqa: E741
        for m, d in zip(loads, slender, strict=True):
            films = [hertz_film(0.98 * m, l, d), hertz_film(m, 2, d), hertz_film(m, l, d)]
            assert max(films[1:]) < THICKEST_FILM
            assert m == 5 or films[0] > 0.95 * THICKEST_FILM
    for l, d in ((5, 0.04), (19, 1)):  # noqa: E741
        assert 0.95 * hertz_film(1e5, l, d) < THINNEST_FILM < hertz_film(1e5, l, d) * 1.02


def test_advice_keeps_to_films_that_the_atlas_holds() -> None:
    ball = BALL | {"radius_y_m": 12.52e-3 / 0.02, "mean_speed_m_per_s": 8e-3}
    for load, said in ((20000.0, "gives M = 1.56e"), (1.0, "gives a film of 50.8 times")):
        with pytest.raises(ehlwave.RangeError, match=said) as raised:
            ehlwave.Contact(**ball | {"load_n": load}).response(1.0, by="laws")
        found = re.search(r"holds ([0-9.e+]+) to ([0-9.e+]+) N", str(raised.value))
        assert found is not None
        for inside in map(float, found.groups()):
            assert ehlwave.Contact(**ball | {"load_n": inside}).film().central_m


def test_advice_leaves_out_quantities_that_move_no_coordinate() -> None:
    """The Eyring stress moves none in pure rolling; this ball bearing bears hardly any load."""
    keys = {
        "load_n": 10.85,
        "viscosity_pa_s": 0.08222,
        "pressure_viscosity_per_pa": 2.111e-8,
        "roelands_index": 0.68,
        "eyring_stress_pa": 2.333e6,
        "reduced_modulus_pa": 2.264e11,
        "radius_x_m": 2.185e-3,
        "radius_y_m": 0.06967,
        "mean_speed_m_per_s": 11.04,
    }
    with pytest.raises(ehlwave.RangeError, match=r"gives a film of .* atlas holds 14\.3 to"):
        ehlwave.Contact(**keys).film(by="laws")


def test_a_ball_bearing_is_answered() -> None:
    keys = {"load_parameter_m": 3645, "lubricant_parameter_l": 8, "radius_ratio_d": 0.066}
    contact = ehlwave.Contact(**keys, pressure_viscosity_per_pa=2e-8, roelands_index=0.6)
    # ehlwave-case, fitted scheme, 256 x 384 cells, flooded edges, extrapolated to mesh size 0
    found = contact.response(wavelength_over_a=1.0)
    assert abs(found.film - (0.2503 + 0.2069j)) < found.error + 1e-3
    film = contact.atlas().at(contact.conditions.atlas_keys()).film()
    computed = 0.018610 * moes_per_film(3645, ellipticity(0.066))
    assert film.central_moes == pytest.approx(computed, rel=film.central_error + 1e-3)


def test_waves_raise_the_mean_film_as_computed() -> None:
    # ehlwave-case, 128 x 128 cells: M = 134.4, L = 6.62, alpha = 2.25e-8, z = 0.484
    contact = ehlwave.Contact(**BALL)
    chart = contact.atlas().at(contact.conditions.atlas_keys())
    for wave, angle, computed in (
        (0.35, 0, 0.263),
        (0.7, 0, 0.169),
        (1.5, 0, 0.053),
        (0.7, 90, 0.081),
    ):
        rise = chart.responses(wave, angle).rise
        assert rise == pytest.approx(computed, abs=0.03)  # 95 % of rises are within 0.07
    a = contact.conditions.semi_axis_a_m
    x = np.arange(400) * a / 40
    amplitude = 30e-9
    surface = trace_surface(amplitude * np.cos(2 * np.pi * 2 * x / a), a / 40)
    found = contact.deform(surface, form="none", ends="none").statistics
    film = found.mean_film_m - found.mean_rise_m
    assert found.mean_rise_m == pytest.approx(
        chart.responses(0.5, 0).rise * amplitude**2 / film, rel=0.02
    )


def test_under_slip_the_law_of_the_two_waves_answers() -> None:
    # 512 x 384 cells, extrapolated; the stress lies above the range of the atlas
    contact = ehlwave.Contact(**MOES, reduced_modulus_pa=226e9, eyring_stress_pa=500e6)
    for wave, computed in ((0.5, 0.855), (1.0, 0.685)):
        found = contact.response(wavelength_over_a=wave, slip_parameter=1.1)
        assert abs(abs(found.film) - computed) < found.error
        assert "two waves" in found.source
    newtonian = ehlwave.Contact(**MOES)
    standing = newtonian.response(wavelength_over_a=1.0, angle_deg=90, slip_parameter=1.1)
    rolling = newtonian.response(wavelength_over_a=1.0, angle_deg=90)
    assert (standing.film, standing.error) == (rolling.film, rolling.error)


def test_a_surface_is_deformed_by_its_responses() -> None:
    contact = ehlwave.Contact(**MOES, **LENGTHS)
    wave = 0.5 * LENGTHS["semi_axis_a_m"]
    x = np.arange(200) * wave / 20
    surface = trace_surface(1e-8 * np.cos(2 * np.pi * x / wave), wave / 20, "x", "cosine")
    found = contact.deform(surface, form="none", ends="none")
    response = contact.response(0.5)
    expected = 1e-8 * np.real(response.film * np.exp(2j * np.pi * x / wave))
    np.testing.assert_allclose(found.height[:, 0], expected, atol=2e-11)
    assert found.error_m == pytest.approx(response.error * 1e-8 / 2**0.5, rel=0.05)
    film = contact.film().central_m
    assert film is not None
    ratio = contact.lambda_ratio(surface, form="none", ends="none")
    assert ratio == pytest.approx(film / (abs(response.film) * 1e-8 / 2**0.5), rel=2e-3)
    by_formula = contact.lambda_ratio(surface, by="paper")
    assert by_formula != pytest.approx(ratio, rel=0.01)


def test_waves_outside_are_continued_and_counted_in_the_error() -> None:
    conditions = ehlwave.Contact(**MOES, **LENGTHS).conditions
    transfer = AtlasTransfer(conditions)
    a = conditions.semi_axis_a_m
    waves = 1 / (a * np.array([0.01, 0.0999, 0.1001, 3.999, 4.001, 40.0]))
    zero = np.zeros(1)
    ratio, error = transfer.ratio(waves, zero), transfer.error(waves, zero)
    assert abs(ratio[0] - 1) < 0.05 * abs(ratio[2] - 1)
    assert abs(ratio[1] - ratio[2]) < 1e-3
    assert abs(ratio[3] - ratio[4]) < 1e-3
    assert abs(ratio[5]) < 0.15 * abs(ratio[4])
    assert np.all(error[[0, 5]] >= np.array([abs(1 - ratio[0]), abs(ratio[5])]))
    np.testing.assert_array_equal(transfer.is_covered(waves, zero), [0, 0, 1, 1, 0, 0])
    assert transfer.ratio(zero, zero)[0] == 0
    # conjugate against the motion, even across
    one = transfer.ratio(waves[2:3], waves[2:3])
    assert transfer.ratio(-waves[2:3], waves[2:3])[0] == pytest.approx(np.conj(one[0]))


def test_the_film_of_the_atlas_takes_the_place_of_the_formula_but_not_of_a_given_one() -> None:
    conditions = ehlwave.Contact(**MOES, **LENGTHS).conditions
    assert conditions.film_source.startswith("atlas")
    contact = ehlwave.Contact(**MOES, **LENGTHS, central_film_m=1e-7)
    given, film = contact.conditions, contact.film()
    assert given.central_film_m == film.central_m == 1e-7
    assert film.central_moes == pytest.approx(1e-7 / given.metres_per_moes)
    assert film.central_error == given.central_film_error == 0
    assert film.minimum_m is None
    assert film.source == given.film_source
    assert "0.1 um" in contact._repr_html_()
    assert "Hc, Moes" in film._repr_html_()


def test_the_smallest_film_is_below_the_central_one_or_not_known() -> None:
    heavy = ehlwave.Contact(
        load_parameter_m=39258, lubricant_parameter_l=10.977, radius_ratio_d=0.0889
    )
    assert math.isnan(heavy.film().minimum_moes)
    assert math.isnan(heavy.film().minimum_error)
    rng, unknown = np.random.default_rng(5), 0
    for _ in range(150):
        moes = (np.exp(rng.uniform(*np.log(ends))) for ends in ((5, 1e5), (2, 42), (0.01, 1)))
        try:
            film = ehlwave.Contact(**dict(zip(MOES_KEYS, moes, strict=True))).film()
        except ehlwave.errors.RangeError:
            continue
        unknown += math.isnan(film.minimum_moes)
        assert math.isnan(film.minimum_moes) or film.minimum_moes <= film.central_moes
        assert math.isnan(film.minimum_moes) or film.minimum_error < 1
    assert unknown < 40


@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
def test_the_file_has_units_provenance_and_a_checksum(tmp_path: Path, kind: Kind) -> None:
    assert shipped(kind).stat().st_size < 200_000
    packed, attrs = read_packed(shipped(kind).read_bytes())
    assert attrs["checksum"] == checksum(packed, attrs)
    assert "revision" in attrs["program"]
    with xr.open_dataset(shipped(kind), mask_and_scale=False) as opened:
        data = opened.load()
    assert all("long_name" in data[name].attrs for name in data.variables)
    assert data["waves_w1"].attrs["units"] == "1"
    weights = packed["waves_w1"]
    for dtype, is_same in (("<i2", True), (">i2", True), ("i8", False)):
        other = packed | {"waves_w1": replace(weights, values=weights.values.astype(dtype))}
        assert (checksum(other, attrs) == attrs["checksum"]) is is_same  # the order of bytes alone
    for variable in data.variables.values():
        variable.encoding = {}
    data["waves_b3"][0] += 1
    data.to_netcdf(tmp_path / "damaged.nc", engine="scipy")
    with pytest.raises(ehlwave.ResultsError, match="damaged"):
        load_atlas(tmp_path / "damaged.nc")
    stored = read_stored(shipped(kind))
    with pytest.raises(ehlwave.ResultsError, match="not an atlas"):
        Atlas(replace(stored, attrs={**stored.attrs, "format": "else"}))
    with pytest.raises(ehlwave.ResultsError, match="a former atlas"):
        Atlas(replace(stored, attrs={**stored.attrs, "format": "ehlwave-atlas 2"}))
    with pytest.raises(ehlwave.ResultsError, match="an atlas with the ranges"):
        Atlas(replace(stored, attrs={**stored.attrs, "ranges": "{}"}))
