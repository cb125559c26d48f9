"""Contacts whose entry points once gave different answers: one answer, the program's."""

import json
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from contact import BALL

import ehlwave
from ehlwave.app.contacts import Given
from ehlwave.app.saving import document
from ehlwave.app.task import Task, answered
from ehlwave.cli import main
from ehlwave.errors import ExtrapolationWarning, SurfaceError
from ehlwave.laws import computed_film
from ehlwave.programs import cache
from ehlwave.programs.case_input import case_keys
from ehlwave.programs.computing import run_case
from ehlwave.surface import Surface, trace_surface

HEAT: dict[str, float] = {
    "temperature_k": 333.15,
    "viscosity_temperature_per_k": 0.035,
    "oil_conductivity_w_per_m_k": 0.14,
    "oil_heat_capacity_j_per_kg_k": 2000.0,
    "oil_density_kg_per_m3": 850.0,
}
RACE: dict[str, Any] = {"load_parameter_m": 7902, "lubricant_parameter_l": 13.2}
RACE |= {"radius_ratio_d": 0.031}
"""Inner race of a 6208."""
NU_208: dict[str, Any] = {
    "radius_x_m": 0.0045,
    "reduced_modulus_pa": 2.26e11,
    "load_n_per_m": 1.2e5,
    "mean_speed_m_per_s": 8.0,
    "viscosity_pa_s": 0.02,
}
TOOTH = NU_208 | {"radius_x_m": 0.008, "load_n_per_m": 1.5e5, "mean_speed_m_per_s": 3.8}
"""A gear of module 3 where contact begins."""


@pytest.fixture(autouse=True, scope="module")
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Any:  # noqa: ANN401 - a fixture
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(cache.FOLDER, str(tmp_path_factory.mktemp("cache")))
        yield


def ridges(a_m: float) -> Surface:
    """Return ridges along rolling of wavelength a."""
    y = np.arange(1280) / 64
    return trace_surface(1e-9 * np.cos(2 * np.pi * y), a_m / 64, "y", "ridges")


def by_command(command: str, file: Path, words: list[str], capsys: Any) -> dict[str, Any]:  # noqa: ANN401
    """Return the JSON document of a command for a file of heights."""
    options = ["--length-unit", "m", "--height-unit", "m", "--form", "none", "--ends", "none"]
    assert main([command, str(file), *words, *options, "--json"]) == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


def test_ridges_of_a_sliding_newtonian_contact(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Stationary ridges do not feel slip: 0.6791 by the program, 0.6355 by the two waves."""
    contact = ehlwave.Contact(**BALL, slip_parameter=1.2)
    a_m = contact.conditions.semi_axis_a_m
    surface = ridges(a_m)
    np.savetxt(tmp_path / "ridges.csv", surface.height[0])
    wave = {"orientation": "custom", "wavelength_x_over_a": 0.0, "wavelength_y_over_a": 1.0}
    keys = case_keys(contact.conditions) | wave | {"response": "harmonic", "accuracy": 0.01}
    program = run_case(keys)["harmonic_extrapolated_real"]
    found = contact.response(1.0, 90)
    assert program == pytest.approx(0.679, abs=0.002)
    assert found.film.real == pytest.approx(program, abs=found.error)
    assert found.error < 0.015
    deformed = contact.deform(surface, form="none", ends="none")
    rq = deformed.statistics
    assert rq.rq_after_m / rq.rq_before_m == pytest.approx(found.film.real, rel=1e-6)
    words = ["--step", repr(a_m / 64), "--rolling-axis", "y", "--conditions"]
    words += [f"{key}={value}" for key, value in BALL.items()] + ["slip_parameter=1.2"]
    printed = by_command("lambda", tmp_path / "ridges.csv", words, capsys)
    assert printed["answer"]["lambda_ratio"] == pytest.approx(rq.lambda_ratio_after, rel=1e-6)
    assert printed["answer"]["lambda_error"] < 0.05


def test_all_doors_warn_of_a_warm_inlet_alike(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The contact of the README: heat makes its film 2.9 % thinner, 4.1 % with expansion."""
    contact = ehlwave.Contact(**BALL)
    with pytest.warns(ExtrapolationWarning, match="the inlet would warm"):
        film = contact.film()
    (text,) = film.warnings
    page = answered(Task(Given(BALL)))
    assert text in page.warnings
    assert json.loads(document(page))["film"]["central_m"] == film.central_m
    surface = ridges(contact.conditions.semi_axis_a_m)
    assert text in contact.deform(surface).warnings
    np.savetxt(tmp_path / "ridges.csv", surface.height[0])
    words = ["--step", repr(surface.step_y_m), "--rolling-axis", "y", "--conditions"]
    words += [f"{key}={value}" for key, value in BALL.items()]
    assert text in by_command("lambda", tmp_path / "ridges.csv", words, capsys)["warnings"]
    assert "inlet" in run_case(case_keys(contact.conditions) | {"accuracy": 0.05})["warning"]
    warm = ehlwave.Contact(**BALL, heat=ehlwave.Heat(**HEAT)).film()
    loss = 1 - warm.central_moes / film.central_moes
    assert 0.02 < loss < 0.05
    assert f"{100 * loss:.1f} %" in text or abs(loss - 0.041) < 0.012


def test_heavy_contacts_that_the_laws_of_starvation_and_heat_lack_are_computed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Bearings and a gear on the page: four of four were refused (M above 1000)."""
    monkeypatch.setattr(computed_film, "ACCURACY", 0.03)
    starved = answered(Task(Given(RACE | {"oil_over_flooded": 0.5}))).film
    flooded = ehlwave.Contact(**RACE).film()
    assert "computed" in starved.source
    assert 0.45 < starved.central_moes / flooded.central_moes < 0.55
    for keys in (NU_208, TOOTH, TOOTH | {"radius_x_m": 0.012}):
        given = keys | {"heat": ehlwave.Heat(**HEAT)}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            film = answered(Task(Given(given))).film
            cold = ehlwave.Contact(**keys).film()
        assert film.heated is not None
        assert film.central_m is not None
        assert cold.central_m is not None
        assert film.central_m < cold.central_m * 1.02


@pytest.mark.parametrize("name", ["body", "body2"])
def test_warm_lines_of_unlike_bodies_that_roll(name: str) -> None:
    """Rollers of 36.7 mm of glass and steel: films of law and program agree."""
    heat = ehlwave.Heat(**HEAT, **{name: ehlwave.BodyHeat(1.1, 2500.0, 800.0)})
    contact = ehlwave.Contact(
        radius_x_m=0.0367,
        reduced_modulus_pa=1.24e11,
        load_n_per_m=4.76e6,
        mean_speed_m_per_s=13.5,
        viscosity_pa_s=0.0103,
        heat=heat,
    )
    law, computed = contact.film(by="laws"), contact.film(by="computed")
    for name in ("central", "minimum"):
        own, other = (getattr(film, f"{name}_moes") for film in (law, computed))
        error = sum(getattr(film, f"{name}_error") for film in (law, computed))
        assert own == pytest.approx(other, rel=error)


def test_a_contact_does_not_change() -> None:
    contact = ehlwave.Contact(**BALL)
    with pytest.raises(AttributeError, match=r"contact\.replace\(mean_speed_m_per_s=...\)"):
        contact.mean_speed_m_per_s = 0.4  # type: ignore[attr-defined]
    slow = contact.replace(mean_speed_m_per_s=0.4)
    assert slow.film().central_m < 0.25 * contact.film().central_m


def test_a_column_of_heights_has_no_direction(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    contact = ehlwave.Contact(**BALL)
    heights = ridges(1e-4).height[0]
    for column in (heights[:, None], pd.DataFrame({"z": heights})):
        with pytest.raises(SurfaceError, match="rolling_axis="):
            contact.deform(column, step=1e-6)
    np.savetxt(tmp_path / "trace.csv", heights)
    words = ["lambda", str(tmp_path / "trace.csv"), "--length-unit", "m", "--height-unit", "m"]
    words += ["--step", "1e-6", "--conditions", *(f"{key}={value}" for key, value in BALL.items())]
    for axis, name in (("x", "along"), ("y", "across")):
        assert main([*words, "--rolling-axis", axis]) == 0
        assert name in capsys.readouterr().out


def test_one_central_film_on_one_object() -> None:
    contact = ehlwave.Contact(**NU_208)
    assert contact.film().central_m == contact.conditions.central_film_m


def test_the_program_warns_of_every_large_error() -> None:
    """A far too heavy load (M = 20,000) at a loose accuracy leaves no useful smallest film."""
    race = ehlwave.Contact(**RACE | {"load_parameter_m": 20_000})
    found = run_case(case_keys(race.conditions) | {"accuracy": 0.02})
    assert found["status"] == "converged"
    assert found["minimum_film_error"] > 0.3
    assert "smallest H" in found["warning"]
    assert found["central_film_error"] < 0.02
