"""The lambda ratio where films vanish: it falls, reports extrapolation, and is never wrong."""

import csv
import dataclasses
import json
import re
import warnings
from pathlib import Path

import numpy as np
import pytest
from contact import BALL, EXPERIMENT, experiment
from long_tests import IS_LONG

import ehlwave
from ehlwave.laws.atlas.atlas import load_atlas, shipped
from ehlwave.laws.atlas.kinds import KINDS
from ehlwave.programs.programs import find_program
from ehlwave.surface import (
    Deformed,
    Mover,
    TwoWaveTransfer,
    deform_surface,
    film_of_two,
    film_profile,
    report_json,
    report_text,
    trace_surface,
    write_results,
)
from ehlwave.surface import amplitude as amplitudes
from ehlwave.surface.amplitude import VALIDATED_ROLLING, VALIDATED_SLIDING, expected_nonlinearity
from ehlwave.surface.film_profile import second_conditions
from ehlwave.surface.surface import Surface

ROOT = Path(__file__).parents[2]


def has_programs() -> bool:
    try:
        return bool(find_program("ehlwave-case"))
    except ehlwave.ProgramError:
        return False


STEP = 0.5e-6


def noise(rng: np.random.Generator, rq_m: float = 1e-7, length_m: float = 20e-6) -> Surface:
    """Return a trace of correlated noise of this Rq, 2 mm long."""
    waves = np.fft.rfftfreq(4000, STEP)
    size = 1 / np.hypot(1, np.pi * waves * length_m)
    parts = size * (rng.standard_normal(waves.size) + 1j * rng.standard_normal(waves.size))
    parts[0] = 0
    height = np.fft.irfft(parts, 4000)
    return trace_surface(height * (rq_m / height.std()), STEP)


@pytest.mark.parametrize("ends", ["none", "mirror", "taper"])
@pytest.mark.parametrize("load", [{}, {"radius_y_m": None, "load_n": None, "load_n_per_m": 2e5}])
def test_an_offset_of_all_heights_changes_nothing(ends: str, load: dict[str, float | None]) -> None:
    keys = {key: value for key, value in (BALL | load).items() if value is not None}
    contact = ehlwave.Contact(**keys)
    height = noise(np.random.default_rng(5)).height[:, 0]
    found = [
        contact.deform(height - height.mean() + offset, step=STEP, form="none", ends=ends)
        for offset in (0, 5e-6, -3e-7)
    ]
    for one in found[1:]:
        for name in ("lambda_error", "lambda_ratio_after", "rq_after_m", "mean_film_m"):
            same = getattr(found[0].statistics, name)
            assert getattr(one.statistics, name) == pytest.approx(same, rel=1e-9)
        shares = [group.share_before for group in found[0].unjudged]
        assert [group.share_before for group in one.unjudged] == pytest.approx(shares)


def at_speed(speed: float) -> dict[str, float]:
    return BALL | {"mean_speed_m_per_s": speed}


def deformed(surface: Surface, **keys: float) -> Deformed:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ehlwave.ExtrapolationWarning)
        return ehlwave.Contact(**keys).deform(surface)


def test_it_falls_with_the_film_of_a_ball() -> None:
    surface = noise(np.random.default_rng(1))
    speeds = (4, 1, 0.5, 0.3, 0.1, 0.05, 0.03)
    found = [deformed(surface, **at_speed(u)).statistics for u in speeds]
    ratios = [one.lambda_ratio_after for one in found]
    assert ratios == sorted(ratios, reverse=True)
    assert ratios[-1] < 0.6
    errors = [one.lambda_error for one in found]
    assert errors[2:] == sorted(errors[2:])
    assert [one.extrapolated for one in found] == [False] * 4 + [True] * 3
    assert all((one.mean_rise_m is None) == one.extrapolated for one in found)


def random_contact(kind: str, rng: np.random.Generator) -> dict[str, float]:
    """Return keys of a ball or roller that rolls, of a cam, or of a sliding contact."""
    viscosity = {"viscosity_pa_s": 10 ** rng.uniform(-2, -1)}
    if kind == "line":
        line = {"radius_x_m": 10 ** rng.uniform(-2.3, -1.7), "reduced_modulus_pa": 226e9}
        return line | viscosity | {"load_n_per_m": 10 ** rng.uniform(4.5, 5.7)}
    keys = {**BALL, **viscosity, "radius_y_m": 12.7e-3 * 10 ** rng.uniform(0, 1)}
    keys["load_n"] = 10 ** rng.uniform(0.5, 2.5)
    if kind == "sliding":
        keys |= {"slip_parameter": rng.uniform(0.5, 1.5)}
        keys |= {"eyring_stress_pa": 10 ** rng.uniform(6, 7.3)}
    return keys


@pytest.mark.parametrize("kind", ["rolling", "line", "sliding"])
def test_it_falls_with_the_film_of_random_contacts(kind: str) -> None:
    rng, seen = np.random.default_rng(5), 0
    for _ in range(3):
        surface = noise(rng, 10 ** rng.uniform(-8, -6.5), 10 ** rng.uniform(-5.5, -4.3))
        keys, before = random_contact(kind, rng), np.inf
        for speed in np.geomspace(10, 0.01, 8):
            try:
                found = deformed(surface, **keys | {"mean_speed_m_per_s": speed}).statistics
            except ehlwave.RangeError:  # outside the atlas
                continue
            ratio, seen = found.lambda_ratio_after, seen + 1
            assert ratio < before, (keys, speed)
            before = ratio
    assert seen > 10


def test_where_it_is_extrapolated_python_warns_at_the_line_of_the_call() -> None:
    surface = noise(np.random.default_rng(1))
    contact = ehlwave.Contact(**at_speed(0.1))
    for call in (contact.lambda_ratio, contact.deform):
        with pytest.warns(ehlwave.ExtrapolationWarning) as told:
            call(surface)
        said = [str(one.message) for one in told]
        assert "the smooth one, without its rise" in said[0]
        assert "the surfaces touch" in said[1]
        assert {one.filename for one in told} == {__file__}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ehlwave.Contact(**BALL).lambda_ratio(surface)


def test_report_and_json_say_so_with_an_error_that_includes_it(tmp_path: Path) -> None:
    result = deformed(noise(np.random.default_rng(1)), **at_speed(0.1))
    said = report_text(result)
    assert re.search(r"error of the latter \d{3,} %: film .* \(extrapolated\)", said)
    assert "surfaces touch: no smallest film" in said
    assert "not used at this amplitude" in said
    document = json.loads(report_json(result))["statistics"]
    assert document["extrapolated"] is True
    assert document["surfaces_touch"] is True
    assert document["minimum_film_m"] is None
    assert document["lambda_error"] == pytest.approx(sum(document["lambda_errors"].values()))
    assert document["lambda_errors"]["rise"] > 0.2
    write_results(result, tmp_path)
    with (tmp_path / "deformed.csv").open(encoding="utf-8") as file:
        films = [row["film_um"] for row in csv.DictReader(file)]
    assert "" in films
    assert all(float(film) > 0 for film in films if film)


def test_transfers_without_errors_promise_none() -> None:
    surface = noise(np.random.default_rng(1))
    result = deform_surface(surface, experiment())
    assert result.statistics.lambda_error is None
    assert "not known, this transfer has none" in report_text(result)


def test_a_film_between_two_surfaces_is_never_negative() -> None:
    conditions = experiment(slip_parameter=1.3)
    high = trace_surface(2e-6 * np.cos(np.arange(400) * 0.1), 1e-6)
    film = film_of_two(
        *(
            deform_surface(high, one, TwoWaveTransfer(one))
            for one in (conditions, second_conditions(conditions))
        )
    )
    assert film.surfaces_touch
    assert film.smallest_film_m is None
    assert film.summary()["smallest_film_m"] is None
    assert "the surfaces touch" in film.text()
    assert np.nanmin(film.film_m) > 0
    mover = Mover(high, TwoWaveTransfer(conditions))
    profile = film_profile([mover], np.linspace(0, 1e-4, 50), 0.0)
    assert np.isnan(profile).any()
    assert np.nanmin(profile) > 0


MARCHES = (
    # M, L, D, lambda/a, Ai over film, S
    (100, 12.05, 1, 1.2, 0.6, 1),
    (100, 12.05, 1, 0.5, 0.9, 1),
    (200, 6, 0.5, 0.7, 0.9, 1),
    (40, 10, 1, 1.0, 0.5, 1),
    (100, 12.05, 1, 1.2, 0.1, 1.5),
    (60, 8, 1, 1.0, 0.2, 0.7),
)[:: 1 if IS_LONG else 2]


@pytest.mark.skipif(not has_programs(), reason="the programs are not built")
@pytest.mark.parametrize(("m", "l", "d", "wave", "amplitude", "slip"), MARCHES)
def test_marches_keep_to_the_error_beyond_what_was_validated_too(
    m: float,
    l: float,  # noqa: E741
    d: float,
    wave: float,
    amplitude: float,
    slip: float,
) -> None:
    keys = {"load_parameter_m": m, "lubricant_parameter_l": l, "radius_ratio_d": d}
    oil = {"slip_parameter": slip, "reduced_modulus_pa": 2.26e11, "eyring_stress_pa": 5e6}
    keys |= {} if slip == 1 else oil
    march = ehlwave.Case(
        **keys,
        **({} if slip == 1 else {"flow_law": "eyring"}),
        orientation="transverse",
        wavelength_over_a=wave,
        amplitude_over_film=amplitude,
        cells_x=96,
        cells_y=64,
    ).run()
    assert march.attrs["status"] == "converged"
    time, film = march["time"].values, march["film_at_centre"].values
    last = np.interp(np.linspace(time[-1] - wave / slip, time[-1], 400, False), time, film)
    marched = last.mean() / last.std()

    # M, L and these lengths give E' = 226 GPa where there is slip.
    lengths = {"semi_axis_a_m": 2e-4, "radius_x_m": 27.7e-3 if m == 60 else 15.5e-3}
    contact = ehlwave.Contact(**keys, **lengths)
    place = np.arange(640) * wave * 2e-4 / 64
    height = amplitude * contact.film().central_m * np.cos(2 * np.pi * place / (wave * 2e-4))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ehlwave.ExtrapolationWarning)
        found = contact.deform(trace_surface(height, place[1]), form="none", ends="none").statistics
    assert found.extrapolated == (amplitude > (VALIDATED_ROLLING if slip == 1 else 0.3))
    assert found.lambda_ratio_after == pytest.approx(marched, rel=found.lambda_error)
    assert found.lambda_error < 0.5


def test_the_factors_are_those_of_the_program() -> None:
    source = (ROOT / "src/case/linear_range.f90").read_text(encoding="utf-8")
    rolling = re.search(r":: rolling_factor = ([\d.]+)_dp", source)
    slip = re.search(r":: slip_factor\(2\) = \[([\d.]+)_dp, ([\d.]+)_dp\]", source)
    assert rolling is not None
    assert slip is not None
    assert float(rolling[1]) == amplitudes.ROLLING_FACTOR
    assert tuple(map(float, slip.groups())) == amplitudes.SLIP_FACTORS


def test_errors_of_rises_are_those_of_the_atlas() -> None:
    for kind, error in amplitudes.RISE_ERRORS.items():
        said = json.loads(load_atlas(shipped(KINDS[kind])).data.attrs["rise_cross_validated"])
        assert error == pytest.approx(said["95 %"], rel=0.04)


def test_under_slip_less_was_compared_and_more_is_expected() -> None:
    sliding = experiment(slip_parameter=1.5)
    assert amplitudes.validated_amplitude(sliding) == amplitudes.VALIDATED_FASTER
    slight = dataclasses.replace(sliding, slip_parameter=1.1)
    assert amplitudes.validated_amplitude(slight) == VALIDATED_SLIDING < VALIDATED_ROLLING
    assert expected_nonlinearity(sliding, 0.1) == pytest.approx((0.05 + 68 * 0.25) * 0.01)
    thin = dataclasses.replace(sliding, slip_parameter=0.5)
    assert expected_nonlinearity(thin, 0.1) == pytest.approx((0.05 + 18 * 0.25) * 0.01)


def test_a_rise_that_is_half_the_film_is_not_used() -> None:
    class Rising(TwoWaveTransfer):
        def rise(self, per_length_x, per_length_y):  # noqa: ANN001, ANN202
            return 40.0 + 0 * np.abs(per_length_x + per_length_y)

    contact = ehlwave.Contact(**EXPERIMENT).conditions
    surface = noise(np.random.default_rng(1), 0.1 * contact.central_film_m)
    found = deform_surface(surface, contact, Rising(contact)).statistics
    assert found.extrapolated is False
    assert found.mean_rise_m is None
    assert found.mean_film_m == contact.central_film_m
