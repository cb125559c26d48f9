"""Mean films of rough contacts in pure rolling against marches, and their small amplitudes."""

import json
from pathlib import Path

import numpy as np
import pytest

import ehlwave
from ehlwave.surface.averaged_film import LONGITUDINAL, TRANSVERSE, averaged_film, is_covered
from ehlwave.surface.report import report_text
from studies import touching_films

RECORD = Path(__file__).parents[1] / "record" / "touching" / "films.jsonl"
MARCHES = {entry["number"]: entry for entry in map(json.loads, RECORD.read_text().splitlines())}
WAVE = np.sqrt(2) * np.cos(np.linspace(0, 2 * np.pi, 2000, endpoint=False))
ROLLER = {
    **{"radius_x_m": 0.01, "reduced_modulus_pa": 226e9, "load_n_per_m": 1e5},
    **{"mean_speed_m_per_s": 0.1, "viscosity_pa_s": 0.04},
}


@pytest.mark.parametrize("coefficient", [TRANSVERSE, 0.3, 0.0, LONGITUDINAL])
def test_small_amplitudes_rise_to_second_order(coefficient: float) -> None:
    rise = coefficient * 0.02**2
    assert averaged_film(0.02 * WAVE, rise) - 1 == pytest.approx(rise, abs=0.01 * 0.02**2)


def test_random_roughness_and_strange_rises_are_not_covered() -> None:
    random = np.random.default_rng(1).standard_normal(1000)
    assert is_covered(1.0, WAVE.max(), 1.0, TRANSVERSE)
    assert not is_covered(2.1, WAVE.max(), 1.0, TRANSVERSE)
    assert not is_covered(1.0, random.max(), 1.0, TRANSVERSE)
    assert not is_covered(1.0, WAVE.max(), 1.0, 5.0)
    assert not is_covered(1.0, 0.0, 0.0, 0.0)


def test_crests_lift_the_film_less_than_the_series_and_never_below_the_boundary() -> None:
    films = [averaged_film(rq * WAVE, TRANSVERSE * rq**2, 0.2) for rq in (0.5, 1, 2)]
    assert films[0] < 1 + TRANSVERSE * 0.5**2
    assert np.all(np.diff(films) > 0)
    assert films[2] < 1 + 0.5 * TRANSVERSE * 2**2


@pytest.mark.parametrize("number", [5, 39, 63, 89, 22, 36, 42])
def test_marches_are_within_the_error(number: int) -> None:
    found = touching_films.compare(MARCHES[number])
    assert found["by"] == "averaged flow"
    assert abs(found["off"]) <= found["error"]


@pytest.mark.parametrize(("number", "touches"), [(5, False), (63, False), (89, True), (42, True)])
def test_touching_is_that_of_the_march(number: int, touches: bool) -> None:
    found = touching_films.compare(MARCHES[number])
    assert (found["touches"], found["predicted_touches"]) == (touches, touches)


@pytest.mark.filterwarnings("ignore::ehlwave.ExtrapolationWarning")
def test_report_states_whether_surfaces_touch() -> None:
    contact, x = ehlwave.Contact(**ROLLER), np.arange(0, 4e-3, 2e-6)
    wave = 1e-7 * np.cos(2 * np.pi * x / 8e-5)
    text = report_text(contact.deform(wave, step=2e-6, boundary_film_m=2e-8))
    assert "by averaged flow" in text
    assert "does not touch (boundary film 0.02 um)" in text
    text = report_text(contact.deform(wave, step=2e-6, boundary_film_m=4e-8))
    assert "the smallest film falls to the boundary film" in text


def test_boundary_film_must_be_above_zero() -> None:
    contact = ehlwave.Contact(**ROLLER)
    with pytest.raises(ehlwave.SurfaceError, match="boundary_film_m = 0"):
        contact.deform(np.ones(2000), step=2e-6, boundary_film_m=0)
