"""Computed answers: films, responses, input files, and the cache."""

import json
import math
import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from long_tests import IS_LONG

import ehlwave
from ehlwave.cases.keys import key_groups
from ehlwave.cli import main
from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_read import read_given
from ehlwave.errors import ProgramError, RangeError
from ehlwave.laws import computed_rows, computed_transfer
from ehlwave.laws.computed_film import computed_film
from ehlwave.laws.computed_rows import ComputedRows
from ehlwave.laws.computed_transfer import ComputedTransfer
from ehlwave.laws.computed_waves import Responses, changed, film_of, no_base, refined
from ehlwave.laws.law_list import LIST, WARM
from ehlwave.programs import cache
from ehlwave.programs.case_input import GROUPS, case_keys, case_text
from ehlwave.programs.computing import is_usable, run_case, run_waves
from ehlwave.programs.progress import watching

STEEL: dict[str, Any] = {
    "radius_x_m": 0.0125,
    "reduced_modulus_pa": 2.26e11,
    "viscosity_pa_s": 0.05,
}
BALL: dict[str, Any] = STEEL | {"radius_y_m": 0.0125, "load_n": 60, "mean_speed_m_per_s": 4}
ROLLERS: dict[str, Any] = {
    "radius_x_m": 0.01,
    "reduced_modulus_pa": 2.26e11,
    "load_n_per_m": 2.8e5,
    "mean_speed_m_per_s": 8,
    "viscosity_pa_s": 0.016,
    "pressure_viscosity_per_pa": 1.6e-8,
    "roelands_index": 0.6,
    "eyring_stress_pa": 5e6,
    "slide_to_roll_ratio": 0.3,
}
HEAT = ehlwave.Heat(
    temperature_k=353.15,
    viscosity_temperature_per_k=0.034,
    oil_conductivity_w_per_m_k=0.127,
    oil_heat_capacity_j_per_kg_k=2080,
    oil_density_kg_per_m3=840,
    body=ehlwave.BodyHeat(21),
)


@pytest.fixture(autouse=True)
def shared(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    """Give all tests, of all workers, one cache, as they ask for the same contacts."""
    own = tmp_path_factory.getbasetemp()
    session = own.parent if "PYTEST_XDIST_WORKER" in os.environ else own
    monkeypatch.setenv(cache.FOLDER, str(session / "computed"))


@pytest.fixture
def folder(shared: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Give a test a cache of its own."""
    monkeypatch.setenv(cache.FOLDER, str(tmp_path / "cache"))
    return tmp_path / "cache"


def inner_race() -> Conditions:
    """Return the inner race of a 6208."""
    keys: dict[str, Any] = {
        "load_parameter_m": 7902,
        "lubricant_parameter_l": 13.2,
        "radius_ratio_d": 0.031,
    }
    return ehlwave.Contact(**keys, semi_axis_a_m=1e-4, radius_x_m=4.5e-3).conditions


def test_groups_are_those_of_the_program() -> None:
    known = key_groups()
    for group, keys in GROUPS.items():
        for key in keys.split():
            assert known[key] == group


@pytest.mark.parametrize(
    ("keys", "heat"),
    [
        (BALL, None),
        (BALL | {"oil_over_flooded": 0.5}, None),
        (BALL | {"slip_parameter": 1.3, "carreau_modulus_pa": 7e6, "carreau_exponent": 0.35}, None),
        (ROLLERS, HEAT),
    ],
)
def test_a_contact_is_written_as_an_input_file(
    tmp_path: Path, keys: dict[str, Any], heat: ehlwave.Heat | None
) -> None:
    contact = ehlwave.Contact(**keys, heat=heat)
    path = tmp_path / "contact.nml"
    path.write_text(case_text(case_keys(contact.conditions, heat)))
    found = read_given([str(path)])
    assert found.conditions == contact._given  # a file has the film of a formula
    assert found.heat == heat
    plan = ehlwave.Case(**case_keys(contact.conditions, heat)).plan()
    assert plan["load_parameter_m"] == pytest.approx(contact.conditions.m, rel=1e-12)


def test_other_laws_of_the_oil_are_written(tmp_path: Path) -> None:
    path = tmp_path / "barus.nml"
    path.write_text(
        "&conditions load_parameter_m = 50, lubricant_parameter_l = 5, radius_ratio_d = 1, "
        "semi_axis_a_m = 1e-4 /\n&lubricant viscosity_law = 'barus' /\n"
    )
    path.write_text(path.read_text().replace(", semi_axis_a_m = 1e-4", ""))
    found = read_given([str(path), "semi_axis_a_m=1e-4"]).conditions
    film = computed_film(found)
    direct = ehlwave.Case(
        load_parameter_m=50,
        lubricant_parameter_l=5,
        radius_ratio_d=1,
        viscosity_law="barus",
        cells_x=384,
        cells_y=384,
    ).run()
    assert film.central_moes == pytest.approx(float(direct["central_film_moes"]), rel=0.005)


def test_a_film_is_that_of_a_finer_grid() -> None:
    film = computed_film(inner_race())
    keys = case_keys(inner_race()) | {"scheme": "fitted", "cells_x": 384, "cells_y": 384}
    fine = run_case(keys)
    assert film.central_moes == pytest.approx(fine["central_film_moes"], rel=film.central_error)
    smallest = fine["minimum_film"] * fine["central_film_moes"] / fine["central_film"]
    assert film.minimum_moes == pytest.approx(smallest, rel=film.minimum_error)
    assert film.minimum_error < 0.05


def test_films_agree_with_the_atlas() -> None:
    random = np.random.default_rng(1)
    for _ in range(6 if IS_LONG else 3):
        m, l, d = 10 ** random.uniform(1.5, 2.8), random.uniform(4, 16), random.uniform(0.2, 1)  # noqa: E741
        contact = ehlwave.Contact(load_parameter_m=m, lubricant_parameter_l=l, radius_ratio_d=d)
        atlas, film = contact.film(), computed_film(contact.conditions)
        error = atlas.central_error + film.central_error
        assert film.central_moes == pytest.approx(atlas.central_moes, rel=error)


def test_responses_along_the_motion_agree_with_the_atlas(monkeypatch: pytest.MonkeyPatch) -> None:
    """The next test compares waves across the motion with finer grids."""
    waves = (0.15, 0.5, 1.3, 3.0)
    if not IS_LONG:  # an octave
        waves = (0.55, 0.9)
        monkeypatch.setattr(computed_transfer, "WAVE_RANGE", (0.5, 1.0))
        monkeypatch.setattr(computed_transfer, "FIRST", 3)
    contact = ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10, radius_ratio_d=1)
    found = ComputedTransfer(contact.conditions)
    for wave in waves:
        atlas, computed = contact.response(wave, 90.0), found.response(wave, 90.0)
        assert abs(atlas.film - computed.film) < atlas.error + computed.error


def test_interpolated_waves_are_those_of_finer_grids(monkeypatch: pytest.MonkeyPatch) -> None:
    c = inner_race()
    waves = np.array([0.37, 0.9, 2.1])
    if not IS_LONG:  # an octave
        waves = np.array([0.6, 0.9])
        monkeypatch.setattr(computed_transfer, "WAVE_RANGE", (0.5, 1.0))
        monkeypatch.setattr(computed_transfer, "FIRST", 3)
    transfer = ComputedTransfer(c)
    keys = case_keys(c) | {
        "orientation": "custom",
        "response": "harmonic",
        "cells_x": 384,
        "cells_y": 192,
        "scheme": "fitted",
    }
    columns = [{"wavelength_x_over_a": float(w), "wavelength_y_over_a": 0.0} for w in waves]
    qx = 1 / (waves * c.semi_axis_a_m)
    found, error = transfer.ratio(qx, 0 * qx), transfer.error(qx, 0 * qx)
    for k, row in enumerate(run_waves(keys, columns)):
        exact = row["harmonic_extrapolated_real"] + 1j * row["harmonic_extrapolated_imaginary"]
        assert abs(found[k] - exact) < error[k]
    assert np.all(error < 0.03)
    np.testing.assert_allclose(transfer.ratio(-qx, 0 * qx), found.conj())


def test_rolling_contacts_whose_inlet_stays_cold_are_computed_without_heat() -> None:
    given = {
        "radius_x_m": 0.01,
        "reduced_modulus_pa": 2.26e11,
        "load_n_per_m": 5e4,
        "mean_speed_m_per_s": 0.05,
        "viscosity_pa_s": 0.02,
        "pressure_viscosity_per_pa": 2e-8,
    }
    heat = ehlwave.Heat(313.15, 0.04, 0.14, 2000, 870)
    warm = ehlwave.Contact(**given, heat=heat).film(by="computed")
    cold = ehlwave.Contact(**given).film(by="computed")
    assert warm.heated is not None
    assert warm.heated.film_factor == 1
    assert warm.central_m == cold.central_m
    assert 0 < warm.central_error - cold.central_error < 0.002
    fast = ehlwave.Contact(**given | {"mean_speed_m_per_s": 10}, heat=heat).film(by="computed")
    assert fast.heated is not None
    assert fast.heated.film_factor < 0.98


def test_starved_contacts_are_computed() -> None:
    ball = ehlwave.Contact(load_parameter_m=60, lubricant_parameter_l=8, radius_ratio_d=0.5)
    c = replace(ball.conditions, oil_over_flooded=0.7)
    film, flooded = computed_film(c), computed_film(ball.conditions)
    assert 0.6 < film.central_moes / flooded.central_moes < 0.75
    with pytest.raises(RangeError, match="pure rolling"):
        ComputedTransfer(replace(c, slip_parameter=1.2))


def test_short_waves_of_starved_contacts_are_computed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Waves below 0.2 a have a grid that is fine along the wave; they were continued."""
    contact = ehlwave.Contact(load_parameter_m=60, lubricant_parameter_l=8, radius_ratio_d=0.5)
    c = replace(contact.conditions, oil_over_flooded=0.6)
    if not IS_LONG:  # an octave
        monkeypatch.setattr(computed_transfer, "WAVE_RANGE", (0.1, 0.2))
        monkeypatch.setattr(computed_transfer, "FIRST_STARVED", 3)
    found = ComputedTransfer(c).response(0.12, 0.0)
    wave = {"orientation": "custom", "wavelength_x_over_a": 0.12, "wavelength_y_over_a": 0.0}
    fine = {"response": "harmonic", "cells_x": 640, "cells_y": 64, "mean_rise": False}
    row = run_case(case_keys(c) | wave | fine)
    true = complex(row["harmonic_extrapolated_real"], row["harmonic_extrapolated_imaginary"])
    assert abs(found.film - true) < found.error < 0.06


def test_changes_of_marches_are_added_and_continued() -> None:
    log = np.log(np.geomspace(0.1, 4, 9))
    still = np.zeros(log.size)
    nothing = complex(math.nan, math.nan)
    found = Responses(
        log=log,
        film=np.exp(-np.exp(log)) + 0j,
        pressure=np.full(log.size, nothing),
        error=still + 0.01,
        between=still[1:],
        rise=still,
        base=no_base,
    )
    inside = np.log(np.geomspace(0.5, 3, 5))
    change = replace(
        found,
        log=inside,
        film=np.full(5, 0.2j),
        pressure=np.full(5, nothing),
        error=np.full(5, 0.02),
        between=np.zeros(4),
        rise=np.zeros(5),
    )
    both = changed(found, change)
    film, _, error, _ = both.at(inside)
    np.testing.assert_allclose(film, found.at(inside)[0] + 0.2j, atol=1e-12)
    np.testing.assert_allclose(error, 0.03, atol=1e-12)
    film, _, error, _ = both.at(both.log[:1])
    assert film[0].imag == pytest.approx(0.2 * (0.1 / 0.5) ** 1.5)
    assert error[0] == pytest.approx(0.01 + film[0].imag)


def test_warm_contacts_have_marches_that_carry_temperatures(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Few waves about the response, and coarse marches; linear responses alone are wrong."""
    contact = ehlwave.Contact(**ROLLERS, heat=HEAT)
    film, law = computed_film(contact.conditions, HEAT), contact.film()
    assert film.central_m is not None
    assert law.central_m is not None
    assert film.central_m == pytest.approx(law.central_m, rel=law.central_error)
    assert film.friction == pytest.approx(law.friction, rel=law.friction_error)
    for name in ("WAVE_RANGE", "CHANGED_LINE"):
        monkeypatch.setattr(computed_transfer, name, (0.5, 1.0))
    for name in ("FIRST", "FIRST_CHANGES"):
        monkeypatch.setattr(computed_transfer, name, 3)
    for name in ("MOST", "MOST_CHANGES"):
        monkeypatch.setattr(computed_transfer, name, 5)
    monkeypatch.setattr(computed_rows, "LINE_CELLS", {"cells_x": 96})
    found = ComputedTransfer(contact.conditions, HEAT).response(0.7, 0.0)
    keys = {key: v for key, v in case_keys(contact.conditions, HEAT).items() if v is not None}
    march = ehlwave.Case(
        **keys,
        orientation="transverse",
        wavelength_over_a=0.7,
        amplitude_over_film=0.02,
        wave_temperatures="carried",
        cells_x=256,
    ).run()
    size, phase = float(march["amplitude_ratio_fit"]), float(march["phase_fit"])
    true = size * np.exp(1j * phase)
    assert abs(found.film - true) < found.error < 0.06
    rows = ComputedRows(contact.conditions, HEAT, None).linear(np.array([0.7]), 0.0)
    assert abs(film_of(rows[0]) - true) > 2 * found.error


def test_the_law_of_warm_waves_is_for_newtonian_oils_that_warm_little() -> None:
    """Rollers under slip: a light load, and 1.4 GPa, whose viscosity falls by 6,000 times."""
    rollers = STEEL | {"radius_x_m": 0.01, "mean_speed_m_per_s": 3}
    light = ehlwave.Contact(**rollers, load_n_per_m=1e5, slide_to_roll_ratio=0.02, heat=HEAT)
    found = light.response(0.7)
    assert "law of warm waves" in found.source
    assert 0.01 < found.error < 0.1
    hot = ehlwave.Contact(**rollers, load_n_per_m=5.5e5, slide_to_roll_ratio=1.0, heat=HEAT)
    error = hot.film(by="computed").friction_error
    assert error is not None
    assert 0.005 < error < 0.1  # on 256 cells the friction differs by 0.3 %
    with pytest.raises(RangeError, match="viscosity falls"):
        next(law for law in LIST if law.name == WARM).transfer(hot._asked())


def test_kept_results_are_not_computed_again(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    keys: dict[str, Any] = {"load_parameter_m": 10, "lubricant_parameter_l": 5, "radius_ratio_d": 1}
    first = run_case(keys | {"accuracy": 0.05})
    runs: list[object] = []
    monkeypatch.setattr("ehlwave.programs.computing.run_following", lambda *a, **_: runs.append(a))
    assert run_case({"accuracy": 0.05} | keys) == first
    assert not runs
    assert main(["cache", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["results"] == 1
    (entry,) = folder.iterdir()
    data = entry.read_bytes()
    for broken in (b"", data[:-1], data.replace(b"converged", b"diverged."), b"\xff" * 9):
        entry.write_bytes(broken)
        with pytest.raises(AttributeError):  # computed again
            run_case(keys | {"accuracy": 0.05})
    (folder / "notes.txt").write_text("mine")
    assert main(["cache", "--clear"]) == 0
    assert [path.name for path in folder.iterdir()] == ["notes.txt"]


@pytest.mark.parametrize("variable", [cache.FOLDER, "XDG_CACHE_HOME", "HOME"])
def test_the_folder_follows_the_environment(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, variable: str
) -> None:
    monkeypatch.delenv(cache.FOLDER)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setenv(variable, str(tmp_path))
    parts = {cache.FOLDER: (), "XDG_CACHE_HOME": ("ehlwave",), "HOME": (".cache", "ehlwave")}
    assert cache.cache_folder() == tmp_path.joinpath(*parts[variable])


def test_folders_that_cannot_be_written_keep_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv(cache.FOLDER, str(tmp_path / "file" / "cache"))
    keys: dict[str, Any] = {"load_parameter_m": 10, "lubricant_parameter_l": 5, "radius_ratio_d": 1}
    assert run_case(keys | {"accuracy": 0.05})["status"] == "converged"


def test_without_programs_the_message_has_file_and_command(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert not folder.exists()
    monkeypatch.setenv("EHLWAVE_PROGRAMS", str(tmp_path))
    with pytest.raises(ProgramError) as error:
        computed_film(inner_race())
    text = str(error.value)
    assert "ehlwave-case contact.nml --json" in text
    assert "load_parameter_m = 7902" in text


def test_contacts_that_are_not_solved_are_refused() -> None:
    keys = case_keys(inner_race()) | {"cells_x": 16, "cells_y": 16}
    with pytest.raises(ProgramError, match=r"unresolved|not converged|stalled|diverged"):
        run_case(keys)


def test_progress_is_called_and_may_stop(folder: Path) -> None:
    c = ehlwave.Contact(load_parameter_m=20, lubricant_parameter_l=5, radius_ratio_d=1).conditions
    seen: list[str] = []
    with watching(lambda done, whole, text: seen.append(f"{done}/{whole} {text}")):
        assert math.isfinite(computed_film(c).central_moes)
    assert seen

    def stop(*_: object) -> None:
        raise KeyboardInterrupt

    before = len(list(folder.iterdir()))
    with watching(stop), pytest.raises(KeyboardInterrupt):
        ComputedTransfer(c).response(1.0, 0.0)
    assert len(list(folder.iterdir())) == before


def test_waves_that_are_not_solved_are_kept_and_said(monkeypatch: pytest.MonkeyPatch) -> None:
    keys = case_keys(inner_race()) | {
        "orientation": "custom",
        "response": "harmonic",
        "cells_x": 64,
        "cells_y": 64,
    }
    wave = {"wavelength_x_over_a": 0.1, "wavelength_y_over_a": 0.0}
    (row,) = run_waves(keys, [wave])
    assert not is_usable(row)
    monkeypatch.setattr("ehlwave.programs.computing.run_following", None)
    assert run_waves(keys, [wave])[0]["status"] == row["status"]
    with pytest.raises(ProgramError, match="of 7 waves were not solved"):
        refined(lambda waves: [row] * len(waves), (0.1, 4.0), 0.01, most=7)
