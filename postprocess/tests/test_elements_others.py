"""Angular contact and roller bearings, cams, test rigs, rolling resistance: second derivations."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from sample_bearings import tapered_bearing
from scipy.optimize import brentq

import ehlwave
from ehlwave.elements import (
    AngularContactBallBearing,
    CamFollower,
    CylindricalRollerBearing,
    MiniTraction,
    SpurGearPair,
    TwoDisc,
    case_table,
    write_sweep,
)
from ehlwave.elements.practice import reference_viscosity_mm2_per_s, stribeck_load_n
from ehlwave.elements.rolling_resistance import error_of, rolling_force
from ehlwave.results.read import read_results
from studies.programs import run
from studies.rolling import biboulet_houpert_line, biboulet_houpert_point

EXACT = 1e-12
OIL = ehlwave.Oil.from_grade(
    iso_vg=68, viscosity_index=95, temperature_k=343.15, eyring_stress_pa=5e6
)


def test_thrust_on_an_angular_contact_bearing_by_one_equation() -> None:
    """F = Z K sin(a) [A (cos(a0)/cos(a) - 1)]^1.5; Harris has 41.6 degrees (from memory)."""
    bearing = AngularContactBallBearing(
        ball_diameter_m=0.02223,
        pitch_diameter_m=0.12526,
        balls=16,
        contact_angle_deg=40,
        conformity=0.5232,
        elastic_modulus_pa=2.1e11,
    )
    a0, distance = math.radians(40), 2 * 0.0232 * 0.02223

    def excess(angle: float) -> float:
        press = distance * (math.cos(a0) / math.cos(angle) - 1)
        return 16 * bearing.stiffness * math.sin(angle) * press**1.5 - 17800

    angle = brentq(excess, a0 * 1.001, 1.0, xtol=1e-15)
    zone = bearing.load_zone(axial_load_n=17800)
    load, found = (float(one) for one in zone.loads_at(0))
    assert math.radians(found) == pytest.approx(angle, rel=1e-10)
    assert load == pytest.approx(17800 / 16 / math.sin(angle), rel=1e-9)
    approach = distance * (math.sin(angle) * math.cos(a0) / math.cos(angle) - math.sin(a0))
    assert zone.axial_m == pytest.approx(approach, rel=1e-9)
    assert found == pytest.approx(41.6, rel=0.003)
    assert zone.axial_m * 1e3 == pytest.approx(0.0386, rel=0.077)
    place = bearing.contacts(axial_load_n=17800, inner_speed_rpm=10000, oil=OIL)[0]
    assert place.radius_x_m * 1e3 == pytest.approx(9.637247092240818, rel=1e-6)
    assert place.mean_speed_m_per_s == pytest.approx(32.21334144265318, rel=1e-6)
    assert place.hertz_pressure_pa == pytest.approx(1.5384582832533187e9, rel=1e-6)


def test_roller_bearing_of_hamrock() -> None:
    """NASA RP-1126 (from memory): 4800 N by 4 F/Z, 6.4 and 9.6 mm, 10.061 m/s."""
    bearing = CylindricalRollerBearing(
        roller_diameter_m=0.016,
        roller_length_m=0.016,
        pitch_diameter_m=0.08,
        rollers=9,
        elastic_modulus_pa=2.1e11,
    )
    speed = 524 * 60 / 2 / math.pi
    loads = {"radial_load_n": 10800.0, "inner_speed_rpm": speed, "oil": OIL}
    inner, outer = (bearing.contacts(ring=ring, **loads)[0] for ring in ("inner", "outer"))
    assert inner.radius_x_m * 1e3 == pytest.approx(6.4, rel=EXACT)
    assert outer.radius_x_m * 1e3 == pytest.approx(9.6, rel=EXACT)
    assert inner.mean_speed_m_per_s == pytest.approx(10.0608, rel=EXACT)
    assert inner.mean_speed_m_per_s == pytest.approx(10.061, rel=2e-5)
    assert stribeck_load_n(10800, 9, is_ball=False) == 4800
    assert inner.load_n == pytest.approx(4800, rel=0.03)
    # Without clearance loads do not depend on the stiffness: shares of cos^(10/9).
    turn = np.cos(2 * np.pi * np.arange(9) / 9)
    weight = np.where(turn > 0, np.abs(turn) ** (10 / 9), 0)
    assert inner.load_n == pytest.approx(10800 / (weight * turn).sum(), rel=EXACT)


def test_tapered_bearing_by_the_mean_section_and_the_frame_of_the_cage() -> None:
    bearing = tapered_bearing()
    loads = {"radial_load_n": 5000.0, "axial_load_n": 2000.0, "inner_speed_rpm": 1000.0}
    places = [bearing.contacts(ring=ring, oil=OIL, **loads) for ring in ("inner", "outer")]
    radii = [one[0].radius_x_m * 1e3 for one in places]
    assert radii == pytest.approx([4.1874355318443435, 5.8051364584851175], rel=EXACT)
    race = 0.03 - 0.005 * math.cos(math.radians(13.75))
    cage = math.pi / 30 * 1000 * race / 0.06
    expected = (math.pi / 30 * 1000 - cage) * race
    assert places[0][0].mean_speed_m_per_s == pytest.approx(expected, rel=EXACT)
    turn = np.radians([place.angle_deg for place in places[0]])
    load = np.array([place.load_n for place in places[0]])
    slope = math.radians(15.5)
    assert (load * np.cos(turn)).sum() * math.cos(slope) == pytest.approx(5000, rel=1e-9)
    assert load.sum() * math.sin(slope) == pytest.approx(2000, rel=1e-9)
    with pytest.raises(ehlwave.SurfaceError, match="axial_load_n is missing"):
        bearing.load_zone(radial_load_n=1000)


def eccentric(**others: float) -> CamFollower:
    angle = np.arange(0, 360, 0.25)
    lift = 0.004 * (1 - np.cos(np.radians(angle)))
    return CamFollower(
        angle_deg=angle, lift_m=lift, base_radius_m=0.013, width_m=0.01, preload_n=200, **others
    )


def test_eccentric_cam_on_a_flat_follower_by_the_motion_of_a_circle() -> None:
    """The circle turns about a point 4 mm from its centre: exact but for the spline."""
    cam, angles = eccentric(), np.linspace(0, 360, 25)
    assert cam.curvature_radius_m(angles) == pytest.approx(np.full(25, 0.017), rel=1e-6)
    first, second = cam.surface_speeds_m_per_s(angles, 100 * 30 / math.pi)
    centre = 100 * 0.004 * np.cos(np.radians(angles))  # centre of the circle, along the follower
    assert second == pytest.approx(centre, abs=1e-6)
    assert first == pytest.approx(np.full(25, 1.7), rel=1e-6)
    assert (first + second)[0] / 2 == pytest.approx(1.05, rel=1e-6)
    assert (first + second)[8] / 2 == pytest.approx(0.75, rel=1e-6)
    assert cam.reversals_deg() == []


def test_eccentric_cam_on_a_roller_by_the_distance_of_two_circles() -> None:
    """Pitch curve of a circle of 17 mm and a roller of 9 mm is a circle of 26 mm."""
    angle = np.arange(0, 360, 0.25)
    turn = np.radians(angle)
    reach = -0.004 * np.cos(turn) + np.sqrt(0.026**2 - (0.004 * np.sin(turn)) ** 2)
    cam = CamFollower(
        angle_deg=angle,
        lift_m=reach - 0.022,
        base_radius_m=0.013,
        width_m=0.01,
        preload_n=200,
        roller_radius_m=0.009,
    )
    assert cam.curvature_radius_m(angle[::40]) == pytest.approx(np.full(36, 0.017), rel=1e-6)
    first, second = cam.surface_speeds_m_per_s(angle[::40], 955)
    assert first.tolist() == second.tolist()


def test_reversed_entrainment_is_named_and_refused() -> None:
    angle = np.arange(0, 360, 2.0)
    near = np.abs(angle - 180) < 90
    lift = np.where(near, 0.004 * (1 + np.cos(2 * np.radians(angle - 180))), 0)
    cam = CamFollower(
        angle_deg=angle, lift_m=lift, base_radius_m=0.018, width_m=0.012, preload_n=250
    )
    first, last = cam.reversals_deg()
    # r_b + l + 2 l'' = 0: 18 + 4 + 4 c - 32 c = 0 with c = cos(2 (angle - 180)).
    expected = math.degrees(math.acos(22 / 28)) / 2
    assert (180 - first, last - 180) == pytest.approx((expected, expected), abs=0.01)
    found = cam.over_cycle(cam_speed_rpm=1000, oil=OIL, points=12, by="laws")
    assert "160.9" in found.attrs["reversals_deg"]
    nose = found.sel(angle_deg=180.0)
    assert math.isnan(float(nose["central_film_m"]))
    assert "opposite directions" in str(nose["refusal"].values)


def test_mini_traction_machine_and_two_discs() -> None:
    """75 N: 1.25 GPa in the data sheet (from memory)."""
    place = MiniTraction().contact_at(load_n=75, mean_speed_m_per_s=2, oil=OIL)
    assert place.hertz_pressure_pa * 1e-9 == pytest.approx(1.268837005121397, rel=1e-10)
    assert place.hertz_pressure_pa * 1e-9 == pytest.approx(1.25, rel=0.0151)
    rig = TwoDisc(diameters_m=(0.08, 0.04), width_m=0.005)
    mean, ratio = rig.speeds_m_per_s((1000, 1000))
    place = rig.contact_at(load_n=500, mean_speed_m_per_s=mean, slide_to_roll_ratio=ratio, oil=OIL)
    speeds = (math.pi * 0.08 * 1000 / 60, math.pi * 0.04 * 1000 / 60)
    assert place.speeds_m_per_s == pytest.approx(speeds, rel=EXACT)


def test_two_steel_balls_of_stachowiak_and_batchelor() -> None:
    """Engineering Tribology, chapter 7: Rx 6.0 mm, E' 230.8 GPa."""
    from ehlwave.elements.hertz import hertz_point, reduced_modulus

    steel = {"elastic_modulus_pa": 2.1e11, "poisson_ratio": 0.3}
    first, second = (ehlwave.Body.ball(2 * r, **steel) for r in (0.010, 0.015))
    radius = 1 / (1 / first.radius_x_m + 1 / second.radius_x_m)
    assert radius == pytest.approx(0.006, rel=EXACT)
    modulus = reduced_modulus(first, second)
    assert modulus * 1e-9 == pytest.approx(230.8, rel=1.4e-4)
    found = hertz_point(5, radius, radius, modulus)
    assert found.approach_m * 1e6 == pytest.approx(0.560452086747227, rel=EXACT)


def test_rolling_resistance_has_the_limits_of_the_papers() -> None:
    """Formulas 41 and 40 of part 1, 1.47 U^(3/4) and 1.42 (U W)^(1/2); formula 31 of part 2."""
    modulus, radius = 2.26e11, 0.01
    heavy = rolling_force(5e4, radius, math.inf, modulus, 0.01, 1.0, 0.01) / 0.01
    speed = 2 * 0.01 * 1.0 / (modulus * radius)
    assert heavy == pytest.approx(1.47 * speed**0.75 * modulus * radius, rel=0.01)
    light = rolling_force(0.02, radius, math.inf, modulus, 0.1, 10.0, 0.01) / 0.01
    speed = 2 * 0.1 * 10 / (modulus * radius)
    load = 2.0 / (modulus * radius)
    assert light == pytest.approx(1.42 * math.sqrt(speed * load) * modulus * radius, rel=0.02)
    point = rolling_force(1e5, radius, radius, modulus, 0.001, 0.1)
    speed = 2 * 0.001 * 0.1 / (modulus * radius)
    half = (1.5 * 1e5 * radius / modulus) ** (1 / 3)
    assert point == pytest.approx(
        1.8 * 2 * half / radius * speed**0.75 * modulus * radius**2, rel=0.02
    )


def test_reference_viscosity_of_a_published_example() -> None:
    """The Tribology Handbook, A20.6, after SKF: 13.2 mm2/s at 500 rpm, bore 340, outside 420 mm."""
    assert reference_viscosity_mm2_per_s(500, 0.38) == pytest.approx(13.2, rel=0.01)


def test_reference_viscosity_meets_at_a_thousand_turns() -> None:
    low, high = (reference_viscosity_mm2_per_s(n, 0.06) for n in (999.9999, 1000.0))
    assert low == pytest.approx(high, rel=0.03)


def test_cases_have_the_moes_parameters_of_the_contacts() -> None:
    place = MiniTraction().contact_at(load_n=75, mean_speed_m_per_s=2, oil=OIL)
    row = case_table([place]).iloc[0].to_dict()
    again = ehlwave.Contact(**row).conditions
    own = place.contact.conditions
    assert (again.m, again.l, again.d) == pytest.approx((own.m, own.l, own.d), rel=1e-10)


def test_a_sweep_solves_the_path_of_a_gear_with_both_ends(tmp_path: Path) -> None:
    """The example of the manual: the default grid leaves two of nine places unresolved."""
    pair = SpurGearPair(module_m=0.003, teeth=(20, 40), face_width_m=0.03)
    oil = ehlwave.Oil.from_grade(
        iso_vg=220, viscosity_index=95, temperature_k=343.15, eyring_stress_pa=5e6
    )
    oil = replace(oil, viscosity_error=0, pressure_viscosity_error=0, conductivity_error=0)
    load = {"pinion_torque_n_m": 150, "pinion_speed_rpm": 1500}
    places = pair.places(**load, oil=oil, options={"heat": True})
    write_sweep(places, tmp_path, heat=True)
    outcome = run("sweep", "sweep.nml", folder=tmp_path)
    assert outcome.returncode == 0, outcome.stdout
    found = read_results(tmp_path / "results.h5")
    assert set(found["status"].values) == {"converged"}
    assert found["is_resolved"].values.all()
    films = zip(places, found["central_film_um"].values, strict=True)
    for place, film_um in films:
        law = place.contact.film()
        assert law.central_error < 0.2
        assert film_um == pytest.approx(law.central_m * 1e6, rel=law.central_error + 0.01)


def test_starved_band_and_a_layer_of_oil() -> None:
    """Much oil gives the flooded film, little oil the layer under pressure."""
    bearing = CylindricalRollerBearing(
        roller_diameter_m=0.016, roller_length_m=0.016, pitch_diameter_m=0.08, rollers=9
    )
    given = {"radial_load_n": 10800.0, "inner_speed_rpm": 3000.0, "oil": OIL, "points": 1}
    films = []
    for layer in (1e-7, 1e-4):
        found = bearing.over_load_zone(**given, oil_layer_m=layer).isel(angle_deg=0)
        films.append(found["film_starved_m"].values)
        flooded = found["central_film_m"].values
        assert found["film_starved_low_m"].values == pytest.approx(0.3 * flooded, rel=0.02)
    assert films[1] == pytest.approx(flooded, rel=0.01)
    assert (films[0] < 1e-7).all()
    assert (films[0] > 0.7e-7).all()  # oil under pressure is denser
    passes = bearing.overrolling_time_s(3000)
    cage = 3000 * (1 - 0.016 / 0.08) / 2
    assert passes == pytest.approx(60 / (9 * (3000 - cage)), rel=EXACT)


PROGRAM = (
    (3e4, None, 0.01, 2.0, 0.03, 65.31),
    (1e5, None, 0.01, 2.0, 0.03, 71.10),
    (3e5, None, 0.01, 5.0, 0.03, 139.68),
    (3e5, None, 0.01, 1.0, 0.03, 42.746),
    (1e6, None, 0.01, 10.0, 0.03, 232.79),
    (20, 0.01, 0.01, 1.0, 0.02, 0.011209),
    (100, 0.01, 0.01, 3.0, 0.02, 0.036423),
    (30, 0.03, 0.01, 2.0, 0.02, 0.045876),
    (100, 0.05, 0.01, 2.0, 0.02, 0.074202),
    (300, 0.1, 0.005, 4.0, 0.02, 0.18514),
    (1000, 0.1, 0.005, 4.0, 0.02, 0.24662),
    (600, 0.15, 0.005, 3.0, 0.02, 0.20693),
)
"""Load (lines: per length), Ry, Rx, speed, viscosity, and rolling resistance of ehlwave-case at
E' = 226 GPa, alpha = 18 1/GPa."""


@pytest.mark.parametrize("given", PROGRAM)
def test_rolling_resistance_of_the_program_is_within_the_error(given: tuple[float, ...]) -> None:
    load, across, along, speed, viscosity, computed = given
    length = 1.0 if across is None else None
    ry = math.inf if across is None else across
    found = rolling_force(load, along, ry, 2.26e11, viscosity, speed, length)
    assert computed == pytest.approx(found, rel=error_of(length))


def test_rolling_resistance_is_that_of_the_study() -> None:
    """Written independently, as the shift of the centre of pressure."""
    modulus, radius, load, u, eta = 2.26e11, 0.01, 20.0, 1.0, 0.02
    speed = 2 * eta * u / (modulus * radius)
    m = load / (modulus * radius**2) / speed**0.75
    half = (1.5 * load * radius / modulus) ** (1 / 3)
    shift = biboulet_houpert_point(m, 1, speed) * half
    force = load * shift / (2 * radius)
    assert rolling_force(load, radius, radius, modulus, eta, u) == pytest.approx(force, rel=1e-9)
    m = 3e5 / (modulus * radius) / math.sqrt(speed)
    half = math.sqrt(8 * 3e5 * radius / (math.pi * modulus))
    force = 3e5 * biboulet_houpert_line(m) * half / (2 * radius)
    line = rolling_force(3e5, radius, math.inf, modulus, eta, u, 1.0)
    assert line == pytest.approx(force, rel=1e-9)
