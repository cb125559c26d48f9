"""Units of names, values with units of their own, values that no contact has."""

import subprocess
import sys

import numpy as np
import pytest
from contact import BALL

import ehlwave
from ehlwave.cases.keys import key_table
from ehlwave.contact.conditions_from_keys import KNOWN_KEYS
from ehlwave.errors import SurfaceError
from ehlwave.quantities import PLAUSIBLE, number, plain, unit_of

pint = pytest.importorskip("pint")
Q = pint.UnitRegistry(autoconvert_offset_to_baseunit=True).Quantity

PLAIN = BALL | {"mean_speed_m_per_s": 0.5, "pressure_viscosity_per_pa": 2.2e-8}
WITH_UNITS = {
    "radius_x_m": Q(12.7, "mm"),
    "radius_y_m": Q(0.5, "inch"),
    "reduced_modulus_pa": Q(226, "GPa"),
    "load_n": Q(0.04, "kN"),
    "mean_speed_m_per_s": Q(500, "mm/s"),
    "viscosity_pa_s": Q(50, "mPa*s"),
    "pressure_viscosity_per_pa": Q(22, "1/GPa"),
}


def test_the_program_refuses_the_same_values() -> None:
    table = key_table().set_index("name")
    for name in PLAIN.keys() - {"load_n", "mean_speed_m_per_s"}:  # open for studies by M and L
        bounds = table.loc[name, ["minimum", "maximum"]].tolist()
        assert bounds == [PLAUSIBLE[name].low, PLAUSIBLE[name].high], name
    for name in ("eyring_stress_pa", "carreau_modulus_pa"):  # the largest are Newtonian
        assert table.loc[name, "minimum"] == PLAUSIBLE[name].low, name


def test_every_unit_is_one_of_pint() -> None:
    for name in (*PLAUSIBLE, *KNOWN_KEYS):
        if unit_of(name):
            assert plain(Q(3.0, unit_of(name)), name) == pytest.approx(3.0, rel=1e-12)


def test_a_contact_in_units_is_the_one_in_si() -> None:
    one, other = ehlwave.Contact(**PLAIN).conditions, ehlwave.Contact(**WITH_UNITS).conditions
    for name in ("m", "l", "d", "semi_axis_a_m"):
        assert getattr(one, name) == pytest.approx(getattr(other, name), rel=1e-12)


def test_bodies_oils_and_surfaces_take_units() -> None:
    ball = ehlwave.Body(Q(10, "mm"), Q(1, "cm"), Q(206, "GPa"), 0.3)
    assert ball == ehlwave.Body(0.01, 0.01, 206e9, 0.3)
    oil = ehlwave.Oil.from_grade(
        iso_vg=68, temperature_k=Q(60, "degC"), density_15c_kg_per_m3=Q(0.88, "g/cm**3")
    )
    assert oil.viscosity_pa_s == pytest.approx(
        ehlwave.Oil.from_grade(
            iso_vg=68, temperature_k=333.15, density_15c_kg_per_m3=880
        ).viscosity_pa_s
    )
    shared = {"oil": oil, "load_n": Q(30, "N")}
    contact = ehlwave.Contact.from_bodies(
        ball, ball, speeds_m_per_s=(Q(50, "cm/s"), Q(0.4, "m/s")), **shared
    )
    both = ehlwave.Contact.from_bodies(ball, ball, speeds_m_per_s=Q([50, 40], "cm/s"), **shared)
    plain_speeds = ehlwave.Contact.from_bodies(ball, ball, speeds_m_per_s=(0.5, 0.4), **shared)
    assert contact.conditions.m == pytest.approx(plain_speeds.conditions.m)
    assert both.conditions.slip_parameter == pytest.approx(plain_speeds.conditions.slip_parameter)
    x = np.arange(0, 2e-3, 2e-6)
    height = 20e-9 * np.cos(2 * np.pi * x / 1e-4)
    trace = ehlwave.surface.trace_surface(Q(height * 1e9, "nm"), step_m=Q(2, "um"))
    assert trace.step_x_m == pytest.approx(2e-6)
    np.testing.assert_allclose(trace.height[:, 0], height)
    rolling = ehlwave.Contact(**PLAIN)
    with_step = ehlwave.surface.ReadOptions(step=Q(2, "um"), length_unit="mm")
    assert ehlwave.read_surface(height, with_step).step_x_m == pytest.approx(2e-6)
    cut, same = (
        rolling.deform(trace, cutoffs_m=(cutoff, None)).statistics.rq_after_m
        for cutoff in (Q(80, "um"), 80e-6)
    )
    assert cut == pytest.approx(same, rel=1e-9)
    deep, same_depth = (
        rolling.stress(trace, depths_m=depths).bodies[0].dang_van_depth_m
        for depths in (Q([20, 60], "um"), np.array([20e-6, 60e-6]))
    )
    assert deep == pytest.approx(same_depth, rel=1e-12)
    angle = rolling.response(0.5, angle_deg=Q(np.pi / 4, "rad"))
    assert angle.film == pytest.approx(rolling.response(0.5, angle_deg=45).film)


def test_the_wrong_unit_names_the_right_one() -> None:
    with pytest.raises(SurfaceError, match=r"load_n = 3 meter: give it in N, or in what converts"):
        ehlwave.Contact(**PLAIN | {"load_n": Q(3, "m")})
    with pytest.raises(SurfaceError, match="roelands_index = 3 meter: it is a number without unit"):
        ehlwave.Contact(**PLAIN | {"roelands_index": Q(3, "m")})


def test_a_value_with_a_unit_is_taken_at_its_word() -> None:
    assert number(Q(45, "Pa*s"), "viscosity_pa_s") == pytest.approx(45)
    with pytest.raises(SurfaceError, match=r"did you mean 0.045"):
        number(45, "viscosity_pa_s")


@pytest.mark.parametrize("name", [name for name in PLAUSIBLE if unit_of(name)])
def test_usual_values_pass_and_a_million_off_is_asked_about(name: str) -> None:
    low, high = PLAUSIBLE[name].usual
    for value in np.geomspace(low, high, 7):
        assert number(value, name) == value
    for value in (high * 1e9, low * 1e-9):
        if value < PLAUSIBLE[name].low or value > PLAUSIBLE[name].high:
            with pytest.raises(SurfaceError, match=f"{name} = "):
                number(value, name)


@pytest.mark.parametrize("switch", [True, np.bool_(True)])
def test_a_switch_is_no_number(switch: object) -> None:
    with pytest.raises(SurfaceError, match="oil_over_flooded = True is not a number"):
        ehlwave.Contact(**PLAIN, oil_over_flooded=switch)


def test_cases_and_studies_take_units() -> None:
    try:
        one = ehlwave.Case(**WITH_UNITS, cells_x=64, cells_y=64)
    except ehlwave.ProgramError:
        pytest.skip("the programs are not built")
    other = ehlwave.Case(**PLAIN, cells_x=64, cells_y=64)
    for key, value in other.groups["conditions"].items():
        assert one.groups["conditions"][key] == pytest.approx(value, rel=1e-12)
    lists = {"load_n": Q([0.02, 0.04], "kN"), "mean_speed_m_per_s": [Q(50, "cm/s"), Q(1, "m/s")]}
    study = ehlwave.Study(lists, **{k: v for k, v in WITH_UNITS.items() if k not in lists})
    assert study.lists["load_n"] == pytest.approx([20, 40])
    assert study.lists["mean_speed_m_per_s"] == pytest.approx([0.5, 1])
    rows = ehlwave.Study([{"load_n": Q(0.02, "kN")}, {"load_n": 40.0}], **PLAIN)
    assert rows.rows is not None
    assert rows.rows["load_n"].tolist() == pytest.approx([20, 40])


def test_nothing_of_pint_is_imported() -> None:
    code = "import ehlwave, sys; ehlwave.Contact(load_parameter_m=100, lubricant_parameter_l=10, "
    code += "radius_ratio_d=1); sys.exit('pint' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
