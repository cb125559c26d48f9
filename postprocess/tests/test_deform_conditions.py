import math
from pathlib import Path

import numpy as np
import pytest
from contact import EXPERIMENT, experiment

from ehlwave.contact.conditions import FIT_ERROR
from ehlwave.contact.scales import ellipticity, moes_film
from ehlwave.errors import SurfaceError
from ehlwave.surface import conditions_from_keys, read_conditions

MOES = {"load_parameter_m": 100, "lubricant_parameter_l": 10, "radius_ratio_d": 1}


def test_experiment_agrees_with_the_paper() -> None:
    # Tables 1 and 2 of the paper; its M is 2.7 % off its own formula.
    c = experiment()
    assert pytest.approx(0.185e-3, rel=5e-3) == c.semi_axis_a_m
    assert c.m == pytest.approx(130.77, rel=0.03)
    assert c.l == pytest.approx(6.61, rel=2e-3)
    assert 60e-6 * c.v_per_wavelength == pytest.approx(1.42, rel=0.04)
    assert pytest.approx(0.24e-6, rel=0.05) == c.central_film_m


def test_a_line_contact_has_no_ellipticity() -> None:
    with pytest.raises(SurfaceError, match="line contact"):
        ellipticity(0.0)
    with pytest.raises(SurfaceError, match="line contact"):
        conditions_at(0.004)


def test_ellipticity_is_continuous_and_has_the_line_contact_limit() -> None:
    assert ellipticity(1.0) == 1
    assert ellipticity(1 - 1e-9) == pytest.approx(1, abs=1e-9)
    # kappa ~ D^(2/3) is Hamrock and Brewe's fit 1.0339 (Ry/Rx)^0.636, good to 3 %.
    for d in (0.9, 0.35, 0.12, 0.04):
        assert 1 / ellipticity(d) == pytest.approx(1.0339 * d**-0.636, rel=0.035)


def test_two_sides_of_the_series_near_the_circle_agree() -> None:
    low, high = (conditions_at(d) for d in (0.99992, 0.99994))
    assert abs(low - 1) / 8e-5 == pytest.approx(abs(high - 1) / 6e-5, rel=1e-3)


def conditions_at(d: float) -> float:
    """Return kappa*gamma: through all elliptic integrals."""
    keys = {"load_parameter_m": 100, "lubricant_parameter_l": 10, "radius_ratio_d": d}
    c = conditions_from_keys(keys | {"semi_axis_a_m": 1e-4})
    return c.kappa * c.gamma


def test_moes_parameters_and_radius_give_what_the_dimensional_data_give() -> None:
    full = experiment(radius_y_m=0.1)
    keys = {
        "load_parameter_m": full.m,
        "lubricant_parameter_l": full.l,
        "radius_ratio_d": full.d,
        "semi_axis_a_m": full.semi_axis_a_m,
        "radius_x_m": EXPERIMENT["radius_x_m"],
    }
    again = conditions_from_keys(keys)
    assert again.hertz_approach_c_m == pytest.approx(full.hertz_approach_c_m, rel=1e-13)
    assert again.central_film_m == pytest.approx(full.central_film_m, rel=1e-13)
    assert again.v_per_wavelength == pytest.approx(full.v_per_wavelength, rel=1e-13)
    del keys["radius_x_m"]
    assert conditions_from_keys(keys).central_film_m is None
    given = conditions_from_keys(keys | {"central_film_m": 3e-7})
    assert given.central_film_m == 3e-7


def test_speed_and_load_move_moes_parameters_as_their_powers() -> None:
    base, faster = experiment(), experiment(mean_speed_m_per_s=0.048)
    assert faster.m / base.m == pytest.approx(2**-0.75, rel=1e-12)
    assert faster.l / base.l == pytest.approx(2**0.25, rel=1e-12)
    assert experiment(load_n=78.4).semi_axis_a_m / base.semi_axis_a_m == pytest.approx(
        2 ** (1 / 3), rel=1e-12
    )
    # V follows alphabar^(3/2) L^-2, second form of eq. (17).
    alphabar = base.l / math.pi * (1.5 * base.m * base.gamma) ** (1 / 3)
    v = math.sqrt(2 * math.pi**3 / 3) * alphabar**1.5 / base.l**2
    assert base.v_per_wavelength * base.semi_axis_a_m == pytest.approx(v, rel=1e-12)


def test_input_files_of_ehlwave_case_are_read_and_overridden(tmp_path: Path) -> None:
    file = tmp_path / "contact.nml"
    lines = "\n".join(f" {key} = {value}" for key, value in EXPERIMENT.items() if "visc" not in key)
    file.write_text(
        f"&conditions\n{lines}\n viscosity_pa_s = 1.22\n/\n"
        "&lubricant pressure_viscosity_per_pa = 2.25e-8 /\n&grid cells_x = 64 /\n"
    )
    assert read_conditions([str(file)]) == experiment()
    changed = read_conditions([str(file), "load_n=20", "slip_parameter=1.2"])
    assert changed == experiment(load_n=20, slip_parameter=1.2)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"load_n": 1}, "radius_x_m is missing"),
        ({**EXPERIMENT, "load_parameter_m": 100}, "gives both"),
        ({**EXPERIMENT, "load": 1}, "unknown key load"),
        ({**EXPERIMENT, "load_n": -1}, "load_n = -1 must be above 0"),
        ({**EXPERIMENT, "load_n": float("nan")}, "not a finite number"),
        ({**EXPERIMENT, "load_n": "ten"}, "not a number"),
        ({**EXPERIMENT, "radius_y_m": 1e-3}, "D = Rx/Ry"),
        ({**EXPERIMENT, "slip_parameter": 3}, "0 to 2"),
        ({"load_parameter_m": 1, "lubricant_parameter_l": 1, "radius_ratio_d": 1}, "semi_axis_a_m"),
        ({**MOES, "semi_axis_a_m": 0.2, "radius_x_m": 0.01}, "did you mean 0.0002"),
        ({**MOES, "semi_axis_a_m": 0.02, "radius_x_m": 0.01}, "must be below radius_x_m"),
        ({**MOES, "semi_axis_a_m": 2e-7, "radius_x_m": 0.01}, "not what contacts have"),
        (
            {**MOES, "semi_axis_a_m": 2e-5, "radius_x_m": 0.01, "reduced_modulus_pa": 2.2e11},
            "needs a reduced modulus of 1.21e[+]03 GPa",
        ),
    ],
)
def test_bad_conditions_are_refused(keys: dict[str, float], message: str) -> None:
    with pytest.raises(SurfaceError, match=message):
        conditions_from_keys(keys)


def test_rounded_lengths_do_not_contradict_and_equal_radii_are_a_circle() -> None:
    rng = np.random.default_rng(7)
    for _ in range(100):
        one, two = rng.uniform(1e-3, 0.1, 2)
        rx, ry = 1 / (1 / one + 1 / two), one * two / (one + two)
        circle = conditions_from_keys(EXPERIMENT | {"radius_x_m": rx, "radius_y_m": ry})
        assert circle.d == pytest.approx(1, rel=1e-12)
        assert circle.d <= 1
        full = conditions_from_keys(EXPERIMENT | {"radius_x_m": one, "radius_y_m": 5 * one})
        assert full.modulus_pa == pytest.approx(EXPERIMENT["reduced_modulus_pa"])
        moes = dict(zip(MOES, (full.m, full.l, full.d), strict=True))
        keys = moes | {"semi_axis_a_m": full.semi_axis_a_m, "radius_x_m": one}
        for key in ("reduced_modulus_pa", "pressure_viscosity_per_pa"):
            keys[key] = EXPERIMENT[key]
        conditions_from_keys({key: float(f"{value:.2g}") for key, value in keys.items()})


def test_files_that_are_no_conditions_are_refused(tmp_path: Path) -> None:
    with pytest.raises(SurfaceError, match="no such file"):
        read_conditions([str(tmp_path / "absent.nml")])
    other = tmp_path / "other.nml"
    other.write_text("&grid cells_x = 64 /\n")
    with pytest.raises(SurfaceError, match="no group &conditions"):
        read_conditions([str(other)])


def test_film_formula_has_the_right_asymptotes() -> None:
    shape = 1 + 0.63
    elastic = 3.18 * shape ** (-14 / 25) * 1e6 ** (-2 / 15)
    assert moes_film(1e6, 0.0, 1.0) == pytest.approx(elastic, rel=1e-3)
    rigid = 145 * 1.796 ** (-15 / 7) / 0.01**2
    assert moes_film(0.01, 0.0, 1.0) == pytest.approx(rigid, rel=1e-2)
    piezoviscous = 1.48 * shape ** (-7 / 20) * 1e5 ** (-1 / 12) * 30**0.75
    assert moes_film(1e5, 30.0, 1.0) == pytest.approx(piezoviscous, rel=0.03)
    line = 1.311 * 1e5 ** (-1 / 8) * 30**0.75
    assert moes_film(1e5, 30.0, 0.0) == pytest.approx(line, rel=0.03)
    assert moes_film(1e5, 0.0, 0.0) == pytest.approx(2.621 * 1e5 ** (-1 / 5), rel=1e-3)


def test_films_by_formulas_have_their_errors() -> None:
    ball = conditions_from_keys(EXPERIMENT)
    assert ball.central_film_error == FIT_ERROR
    assert conditions_from_keys(EXPERIMENT | {"central_film_m": 1e-7}).central_film_error == 0
    sliding = EXPERIMENT | {"slip_parameter": 1.2, "eyring_stress_pa": 5e6}
    thinned = conditions_from_keys(sliding)
    assert thinned.central_film_error == pytest.approx(FIT_ERROR + thinned.film_loss)
    unknown = conditions_from_keys(sliding | {"eyring_stress_pa": 2e5})
    assert unknown.central_film_error is None
    assert "how much the oil thins" in unknown.film_source
