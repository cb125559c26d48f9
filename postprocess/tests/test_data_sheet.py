"""Oils of data sheets: examples of the standards, measured oils, effects of errors on films."""

import numpy as np
import pytest

import ehlwave
from ehlwave.contact.alpha_estimates import ESTIMATES, State, estimate_alpha
from ehlwave.contact.data_sheet import EXPANSION_PER_K
from ehlwave.contact.measured_oils import DENSITY_15C, MEASURED, TEMPERATURES_K
from ehlwave.contact.sheet_values import USUAL_INDICES
from ehlwave.contact.viscosity_grade import (
    BEND,
    COLD_K,
    GRADE_ERROR,
    HOT_K,
    INDEX_TERMS,
    ISO_GRADES,
    Walther,
    _index_limits,
    hot_viscosity,
    viscosity_index,
)
from ehlwave.errors import SurfaceError

SHEET = {"viscosity_40c_mm2_per_s": 68, "viscosity_100c_mm2_per_s": 8.6}


def test_the_examples_of_astm_d2270() -> None:
    assert round(viscosity_index(73.30, 8.86)) == 92
    assert round(viscosity_index(22.83, 5.05)) == 156
    for start, *_ in INDEX_TERMS[1:]:  # the pieces join
        below, above = _index_limits(start - 1e-9), _index_limits(start)
        np.testing.assert_allclose(above, below, rtol=2e-3)


@pytest.mark.parametrize("grade", ISO_GRADES[3:])
def test_a_viscosity_at_100_c_has_its_index(grade: float) -> None:
    for index in (0, 95, 140):
        try:
            hot = hot_viscosity(grade, index)
        except SurfaceError:
            assert grade <= 15  # thinner than 2 mm2/s at 100 C
            continue
        assert viscosity_index(grade, hot) == pytest.approx(index, abs=1e-6)


def test_a_line_of_astm_d341_meets_its_points_and_lies_between() -> None:
    line = Walther.through((313.15, 100.0), (373.15, 11.1))
    assert line.viscosity(313.15) == pytest.approx(100, rel=1e-12)
    assert line.viscosity(373.15) == pytest.approx(11.1, rel=1e-12)
    assert line.b == pytest.approx(3.57, abs=0.01)  # 3.4 to 3.7 of paraffinic oils
    thin = Walther.through((313.15, 1.2), (373.15, 0.6))  # where MacCoull's terms count
    assert thin.viscosity(373.15) == pytest.approx(0.6, rel=1e-10)
    with pytest.raises(SurfaceError, match="where ASTM D341 ends"):
        thin.viscosity(600)


@pytest.mark.parametrize("name", MEASURED)
def test_measured_viscosities_lie_on_a_line(name: str) -> None:
    """From 30 and 100 C the viscosity at 60 C follows within 12 %: the oldest are read off."""
    points = [
        (t, 1e3 * eta * (1 + EXPANSION_PER_K * (t - 288.15)) / DENSITY_15C)
        for t, eta in zip(TEMPERATURES_K, MEASURED[name].viscosity_mpa_s, strict=True)
    ]
    line = Walther.through(points[0], points[2])
    assert line.viscosity(points[1][0]) == pytest.approx(points[1][1], rel=0.12)


@pytest.mark.parametrize("name", ESTIMATES)
def test_scatters_are_those_of_the_measured_oils(name: str) -> None:
    deviations = []
    for oil in MEASURED.values():
        densities = [DENSITY_15C / (1 + EXPANSION_PER_K * (t - 288.15)) for t in TEMPERATURES_K]
        points = [
            (t, 1e3 * eta / density)
            for t, eta, density in zip(TEMPERATURES_K, oil.viscosity_mpa_s, densities, strict=True)
        ]
        line = Walther.through(points[0], points[2])
        for (_, kinematic), density, alpha in zip(
            points, densities, oil.alpha_per_gpa, strict=True
        ):
            if alpha is not None:
                found = estimate_alpha(name, State(kinematic, density, line, "mineral"))[0]
                deviations.append(1e9 * found / alpha - 1)
    largest = np.abs(deviations).max()
    assert len(deviations) == 38
    assert 0.95 * ESTIMATES[name].scatter <= largest <= ESTIMATES[name].scatter


def test_an_oil_of_a_grade_is_that_of_its_numbers() -> None:
    oil = ehlwave.Oil.from_grade(**SHEET, temperature_k=313.15, density_15c_kg_per_m3=880)
    density = 880 / (1 + EXPANSION_PER_K * 25)
    assert oil.density_kg_per_m3 == pytest.approx(density)
    assert oil.viscosity_pa_s == pytest.approx(68e-6 * density)
    assert oil.viscosity_error == 0
    warm, warmer = (
        ehlwave.Oil.from_grade(**SHEET, temperature_k=t).viscosity_pa_s for t in (332.15, 334.15)
    )
    between = ehlwave.Oil.from_grade(**SHEET, temperature_k=333.15)
    slope = np.log(warm / warmer) / 2
    assert between.viscosity_temperature_per_k == pytest.approx(slope, rel=1e-3)
    grade = ehlwave.Oil.from_grade(iso_vg=68, temperature_k=313.15)
    assert grade.viscosity_error == pytest.approx(GRADE_ERROR)
    given = ehlwave.Oil.from_grade(**SHEET, temperature_k=333.15, pressure_viscosity_per_pa=2e-8)
    assert (given.pressure_viscosity_per_pa, given.pressure_viscosity_error) == (2e-8, 0)


@pytest.mark.parametrize("kind", USUAL_INDICES)
def test_oils_of_a_grade_lie_within_the_error_of_the_usual_index(kind: str) -> None:
    """Any oil of a kind, grade and usual index; with the index given, any oil of the grade."""
    rng = np.random.default_rng(14)
    low, usual, high = USUAL_INDICES[kind]
    for _ in range(12):
        grade, at_k = rng.choice([32, 68, 150, 220, 460]), rng.uniform(313.15, 373.15)
        oils = {
            True: ehlwave.Oil.from_grade(iso_vg=grade, kind=kind, temperature_k=at_k),
            False: ehlwave.Oil.from_grade(
                iso_vg=grade, viscosity_index=usual, kind=kind, temperature_k=at_k
            ),
        }
        for varies, oil in oils.items():
            cold, index = grade * rng.uniform(0.9, 1.1), rng.uniform(low, high) if varies else usual
            line = Walther.through((COLD_K, cold), (HOT_K, hot_viscosity(cold, index)))
            other = 1e-6 * line.viscosity(at_k) * oil.density_kg_per_m3
            assert abs(other / oil.viscosity_pa_s - 1) <= oil.viscosity_error * (1 + 1e-9)


def test_extrapolated_viscosities_carry_the_bend_of_measured_oils() -> None:
    """From 60 and 100 C, the viscosity at 30 C; the light machine oil is off by far more."""
    outside = []
    for name, oil in MEASURED.items():
        points = [
            (t, 1e3 * eta * (1 + EXPANSION_PER_K * (t - 288.15)) / DENSITY_15C)
            for t, eta in zip(TEMPERATURES_K, oil.viscosity_mpa_s, strict=True)
        ]
        (t, measured), *known = points
        u = np.log([t / COLD_K, *(at / COLD_K for at, _ in known)]) / np.log(HOT_K / COLD_K)
        bend = BEND * (u[0] - u[1]) * (u[0] - u[2])
        line = Walther.through(*known)
        ordinate = line.a - line.b * np.log10(t)
        exact = np.log10(np.log10(measured + 0.7))
        outside += [name] if abs(exact - ordinate) > bend * 1.01 else []
    assert outside == ["light machine oil 38"]
    line = Walther.through((COLD_K, 68.0), (HOT_K, 8.6))
    errors = [line.extrapolation_error(t) for t in (250, 290, 313.15, 340, 373.15, 420)]
    assert errors[2:5] == [0, 0, 0]
    assert errors[0] > errors[1] > 0.05
    assert errors[5] > 0.05


def test_a_measured_oil_is_as_measured() -> None:
    for name, measured in MEASURED.items():
        for t, eta, alpha in zip(TEMPERATURES_K, *measured, strict=True):
            if alpha is not None:
                oil = ehlwave.Oil.named(name, temperature_k=t)
                assert oil.viscosity_pa_s == pytest.approx(1e-3 * eta, rel=1e-9)
                assert oil.pressure_viscosity_per_pa == pytest.approx(1e-9 * alpha)
    with pytest.raises(SurfaceError, match=r"was measured from 333.15 to 373.15 K"):
        ehlwave.Oil.named("light machine oil 38", temperature_k=310)


@pytest.mark.parametrize("key", ["viscosity", "pressure_viscosity"])
@pytest.mark.parametrize("is_line", [False, True])
def test_films_carry_what_the_oil_is_not_known_by(key: str, is_line: bool) -> None:
    """The error is how much the film of the atlas changes with the oil, within a fifth."""
    data = {"radius_x_m": 0.01, "reduced_modulus_pa": 2.26e11, "mean_speed_m_per_s": 0.5}
    data |= {"load_n_per_m": 1e5} if is_line else {"radius_y_m": 0.01, "load_n": 30}
    oil = {"viscosity_pa_s": 0.05, "pressure_viscosity_per_pa": 1.8e-8}
    full = {"viscosity": "viscosity_pa_s", "pressure_viscosity": "pressure_viscosity_per_pa"}[key]

    def film(factor: float, **errors: float) -> ehlwave.Film:
        return ehlwave.Contact(**data, **oil | {full: oil[full] * factor}, **errors).film()

    known, unsure = film(1), film(1, **{f"{key}_error": 0.2})
    carried = unsure.central_error - known.central_error
    change = max(abs(film(f).central_m / known.central_m - 1) for f in (0.8, 1.2))
    assert carried == pytest.approx(change, rel=0.2)
    assert unsure.minimum_error - known.minimum_error == pytest.approx(carried)


def test_the_lambda_ratio_carries_it() -> None:
    data = {"radius_x_m": 0.01, "radius_y_m": 0.01, "reduced_modulus_pa": 2.26e11, "load_n": 30}
    data |= {"mean_speed_m_per_s": 0.5, "viscosity_pa_s": 0.05}
    x = np.arange(0, 2e-3, 2e-6)
    trace = ehlwave.surface.trace_surface(20e-9 * np.cos(2 * np.pi * x / 1e-4), step_m=2e-6)
    known, unsure = (
        ehlwave.Contact(**data, viscosity_error=e).deform(trace).statistics for e in (0, 0.1)
    )
    assert unsure.lambda_error - known.lambda_error == pytest.approx(0.07, abs=0.015)
