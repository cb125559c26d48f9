"""Bearings: geometry, kinematics and loads by second derivations, and against published values."""

import math

import numpy as np
import pytest
from sample_bearings import tapered_bearing
from scipy.integrate import quad
from scipy.optimize import brentq

import ehlwave
from ehlwave.elements import (
    AngularContactBallBearing,
    CylindricalRollerBearing,
    DeepGrooveBallBearing,
)
from ehlwave.elements.boundary import CONFORMITY_ERROR, DIAMETER_ERROR, KNOWN, PITCH_ERROR
from ehlwave.elements.hertz import hertz_line, hertz_point, reduced_modulus
from ehlwave.elements.load_zone import (
    BALL_HALF_LOADED,
    BALL_POWER,
    ROLLER_HALF_LOADED,
    ROLLER_POWER,
)
from ehlwave.elements.practice import stribeck_load_n

EXACT = 1e-12
OIL = ehlwave.Oil.from_grade(iso_vg=68, viscosity_index=95, temperature_k=343.15)
MODULUS = 2.1e11 / 0.91


def example(clearance_m: float = 0.0) -> DeepGrooveBallBearing:
    return DeepGrooveBallBearing(
        ball_diameter_m=0.0115,
        pitch_diameter_m=0.0435,
        balls=7,
        clearance_m=clearance_m,
        elastic_modulus_pa=2.1e11,
    )


@pytest.mark.parametrize(("rx", "ry"), [(0.004, 0.15), (0.006, 0.006), (0.02, 0.005)])
def test_hertz_pressure_deforms_the_bodies_to_a_paraboloid(rx: float, ry: float) -> None:
    """Boussinesq potentials of an ellipsoidal pressure, by quadrature (Johnson, formula 3.61)."""
    found = hertz_point(500, rx, ry, MODULUS)
    a, b = found.semi_axis_x_m, found.semi_axis_y_m
    scale = found.pressure_pa * a * b * 2 / MODULUS / 2

    def integral(power_a: int, power_b: int) -> float:
        def f(t: float) -> float:  # w = b^2 tan^2(t)
            w = b**2 * math.tan(t) ** 2
            own = (
                1
                / ((a**2 + w) ** power_a * (b**2 + w) ** power_b)
                / math.sqrt((a**2 + w) * (b**2 + w))
            )
            return own * 2 * b / math.cos(t) ** 2

        return quad(f, 0, math.pi / 2, epsabs=0, epsrel=1e-13, limit=400)[0]

    assert scale * integral(0, 0) == pytest.approx(found.approach_m, rel=1e-11)
    assert scale * integral(1, 0) == pytest.approx(1 / (2 * rx), rel=1e-11)
    assert scale * integral(0, 1) == pytest.approx(1 / (2 * ry), rel=1e-11)
    load = 2 / 3 * math.pi * a * b * found.pressure_pa
    assert load == pytest.approx(500, rel=EXACT)


def test_hertz_line_bears_its_load_and_fits_its_radius() -> None:
    half, pressure = hertz_line(3e5, 6.4e-3, MODULUS)
    assert math.pi / 2 * half * pressure == pytest.approx(3e5, rel=EXACT)
    assert pressure == pytest.approx(MODULUS * half / (4 * 6.4e-3), rel=EXACT)


def test_speeds_follow_from_vectors_in_the_frame_of_the_cage() -> None:
    bearing = example()
    inner, outer = 3000 * 2 * math.pi / 60, 500 * 2 * math.pi / 60
    race_i = (bearing.pitch_diameter_m - bearing.element_diameter_m) / 2
    race_o = (bearing.pitch_diameter_m + bearing.element_diameter_m) / 2
    # Without slip the ball has the speeds of both races at its sides: its centre has their mean.
    centre = (inner * race_i + outer * race_o) / 2
    cage = centre / (bearing.pitch_diameter_m / 2)
    spin = (outer * race_o - inner * race_i) / bearing.element_diameter_m
    assert bearing.cage_speed_rpm(3000, 500) == pytest.approx(cage * 60 / 2 / math.pi, rel=EXACT)
    expected = abs((inner - cage) * race_i)
    assert bearing.surface_speed_m_per_s(3000, 500) == pytest.approx(expected, rel=EXACT)
    ball = abs((spin - cage) * bearing.element_diameter_m / 2)
    assert ball == pytest.approx(expected, rel=EXACT)
    assert abs((outer - cage) * race_o) == pytest.approx(expected, rel=EXACT)


@pytest.mark.parametrize(("ring", "angle"), [("inner", 40.0), ("outer", 40.0), ("inner", 15.0)])
def test_spin_follows_from_vectors_with_no_spin_on_the_other_ring(ring: str, angle: float) -> None:
    bearing = AngularContactBallBearing(
        ball_diameter_m=0.02223, pitch_diameter_m=0.12526, balls=16, contact_angle_deg=40
    )
    alpha, ball, pitch = np.radians(angle), 0.02223 / 2, 0.12526 / 2
    # In the frame of the cage: x along the axis, y outwards. The inner race is touched at -normal.
    normal = np.array([np.sin(alpha), np.cos(alpha), 0.0])
    sides = {"inner": -normal, "outer": normal}

    def race(side: np.ndarray, turn: np.ndarray) -> np.ndarray:
        """Return the race's angular velocity by equal speeds at the contact."""
        place = np.array([0.0, pitch, 0.0]) + ball * side
        speed = np.cross(turn, ball * side)[2]
        return np.array([speed / np.cross([1.0, 0.0, 0.0], place)[2], 0.0, 0.0])

    def spin(side: np.ndarray, tilt: float) -> tuple[float, float]:
        turn = np.array([np.cos(tilt), np.sin(tilt), 0.0])
        relative = race(side, turn) - turn
        rolling = relative - (relative @ side) * side
        return float(relative @ side), float(np.linalg.norm(rolling))

    other = sides["outer" if ring == "inner" else "inner"]
    tilt = brentq(lambda one: spin(other, one)[0], -alpha - 0.4, -alpha + 0.4)
    across, along = spin(sides[ring], tilt)
    assert bearing.spin_to_roll_ratio(ring, angle) == pytest.approx(abs(across) / along, rel=1e-9)


def test_centrifugal_force_is_the_closed_form_of_handbooks() -> None:
    """Harris: 2.26e-11 D^3 n_c^2 d_m in N, mm and 1/min, for steel of 7.8 g/cm3."""
    bearing = example()
    cage = bearing.cage_speed_rpm(20000)
    expected = 2.26e-11 * 11.5**3 * cage**2 * 43.5
    assert bearing.centrifugal_load_n(20000) == pytest.approx(expected, rel=0.01)


def test_centrifugal_force_and_spin_of_the_manual() -> None:
    known = DeepGrooveBallBearing.from_boundary(bore_m=0.04, outside_m=0.08, width_m=0.018)
    largest = float(known.load_zone(radial_load_n=3000).loads_at(0.0)[0])
    shares = [known.centrifugal_load_n(speed) / largest for speed in (3000, 20000)]
    assert shares == pytest.approx([0.002, 0.10], abs=0.003)
    harris = AngularContactBallBearing(
        ball_diameter_m=0.02223, pitch_diameter_m=0.12526, balls=16, contact_angle_deg=40
    )
    found = [harris.spin_to_roll_ratio(ring, 41.48) for ring in ("inner", "outer")]
    assert found == pytest.approx([0.21, 0.27], abs=0.005)
    assert harris.spin_to_roll_ratio("inner", 0.0) == 0


def test_suggested_axial_loads_hold_bearings_together() -> None:
    tapered = tapered_bearing()
    balls = AngularContactBallBearing(
        ball_diameter_m=0.0127, pitch_diameter_m=0.07, balls=14, contact_angle_deg=40
    )
    for bearing in (tapered, balls):
        with pytest.raises(ehlwave.EhlwaveError, match="axial_load_n is missing") as raised:
            bearing.load_zone(radial_load_n=3000)
        usual = float(str(raised.value).split("such as ")[1])
        zone = bearing.load_zone(radial_load_n=3000, axial_load_n=usual)
        assert zone.half_width_deg == pytest.approx(90, abs=12)
    least = 3000 * math.tan(math.radians(15.5))
    with pytest.raises(ehlwave.EhlwaveError, match=f"above {least:.4g} N"):
        tapered.load_zone(radial_load_n=3000, axial_load_n=0.9 * least)
    assert tapered.load_zone(radial_load_n=3000, axial_load_n=1.1 * least).half_width_deg < 90


def test_half_loaded_bearings_have_the_loads_of_a_catalogue() -> None:
    """NSK, technical report E728g, section 5: 4.37 and 4.08 F_r/Z; 1.216 and 1.260 F_r tan(a)."""
    balls = DeepGrooveBallBearing(ball_diameter_m=0.005, pitch_diameter_m=0.2, balls=100)
    rollers = CylindricalRollerBearing(
        roller_diameter_m=0.005, roller_length_m=0.005, pitch_diameter_m=0.2, rollers=100
    )
    for bearing, published in ((balls, 4.37), (rollers, 4.08)):
        largest = float(bearing.load_zone(radial_load_n=1000).loads_at(0.0)[0])
        assert 100 * largest / 1000 == pytest.approx(published, rel=0.005)
    for power, own, published in (
        (BALL_POWER, BALL_HALF_LOADED, 1.216),
        (ROLLER_POWER, ROLLER_HALF_LOADED, 1.260),
    ):
        above, below = (
            quad(lambda t, n=n: math.cos(t) ** n, 0, math.pi / 2)[0] for n in (power, power + 1)
        )
        assert own == pytest.approx(above / below, abs=5e-5)
        assert own == pytest.approx(published, rel=0.002)


def test_elements_at_the_end_of_the_zone_bear_no_load() -> None:
    bearing = DeepGrooveBallBearing(ball_diameter_m=0.0115, pitch_diameter_m=0.0435, balls=8)
    places = bearing.contacts(radial_load_n=1000, inner_speed_rpm=3000, oil=OIL)
    assert [place.angle_deg for place in places] == [0.0, 45.0, -45.0]
    assert all(place.contact.conditions.m > 0 for place in places)


def test_loads_balance_the_radial_load_and_follow_from_bisection() -> None:
    for clearance in (0.0, 1e-5, -5e-6):
        bearing = example(clearance)
        zone = bearing.load_zone(radial_load_n=1000)
        angles = np.radians(360 * np.arange(7) / 7)
        loads, _ = zone.loads_at(np.degrees(angles))
        assert (loads * np.cos(angles)).sum() == pytest.approx(1000, rel=EXACT)
        # Both approaches in series, each solved for by itself, in place of K.
        races = [bearing.bodies(ring) for ring in ("inner", "outer")]

        def press(load: float, races: list = races) -> float:
            radii = [
                [1 / (1 / getattr(a, k) + 1 / getattr(b, k)) for k in ("radius_x_m", "radius_y_m")]
                for a, b in races
            ]
            return sum(hertz_point(load, *r, reduced_modulus(*races[0])).approach_m for r in radii)

        loaded = brentq(
            lambda q, a=zone.radial_m - clearance / 2: press(q) - a, 1, 5000, xtol=1e-12
        )
        assert loads[0] == pytest.approx(loaded, rel=1e-11)


def test_combined_loads_come_to_the_radial_ones_and_balance() -> None:
    bearing = example(1e-5)
    for tilts in (False, True):
        zone = bearing.load_zone(radial_load_n=1000, axial_load_n=1000, is_free_to_tilt=tilts)
        turn = 360 * np.arange(7) / 7
        loads, angles = zone.loads_at(turn)
        across = loads * np.cos(np.radians(angles)) * np.cos(np.radians(turn))
        assert across.sum() == pytest.approx(1000, rel=1e-9)
        assert (loads * np.sin(np.radians(angles))).sum() == pytest.approx(1000, rel=1e-9)


@pytest.mark.parametrize(
    ("clearance", "loads", "published_um", "within"),
    [
        (0.0, {"radial_load_n": 1000}, 15.1101, 1e-5),
        (1e-5, {"radial_load_n": 1000}, 21.223, 1.2e-5),
        (0.0, {"axial_load_n": 1000}, 133.5381, 2e-6),
        (1e-5, {"axial_load_n": 1000}, 149.1717, 2e-6),
    ],
)
def test_displacements_of_masta_quoted_in_a_public_repository(
    clearance: float, loads: dict[str, float], published_um: float, within: float
) -> None:
    """Examples 1 to 4 of Test_BallBearing.py in minzhun/ISO16281."""
    bearing = example(clearance)
    zone = bearing.load_zone(**loads)
    moved = zone.radial_m
    if "axial_load_n" in loads:
        grooves = bearing.grooves
        moved = zone.axial_m + grooves.distance_m * math.sin(grooves.free_angle_rad)
    assert moved * 1e6 == pytest.approx(published_um, rel=within)


def test_combined_displacements_of_masta() -> None:
    """Example 5: rings that tilt freely; the tilt itself differs by 1 %."""
    bearing = example(1e-5)
    zone = bearing.load_zone(radial_load_n=1000, axial_load_n=1000, is_free_to_tilt=True)
    grooves = bearing.grooves
    axial = zone.axial_m + grooves.distance_m * math.sin(grooves.free_angle_rad)
    assert zone.radial_m * 1e6 == pytest.approx(19.5923, rel=3e-5)
    assert axial * 1e6 == pytest.approx(146.4603, rel=3e-6)
    assert abs(zone.tilt_rad) * 1e3 == pytest.approx(2.6872, rel=0.012)


def test_contacts_have_angles_loads_and_contacts() -> None:
    places = example().contacts(radial_load_n=1000, inner_speed_rpm=3000, oil=OIL)
    assert [round(place.load_n, 6) for place in places] == [619.613957, 305.045922, 305.045922]
    assert [round(place.angle_deg, 2) for place in places] == [0, 51.43, -51.43]
    first = places[0]
    assert first.radius_x_m * 1e3 == pytest.approx(4.229885057471264, rel=EXACT)
    assert first.radius_y_m * 1e3 == pytest.approx(149.5, rel=EXACT)
    assert first.hertz_pressure_pa == pytest.approx(1.791039128262782e9, rel=1e-10)
    assert first.mean_speed_m_per_s == pytest.approx(3.177702913975883, rel=EXACT)
    assert first.contact.conditions.hertz_pa == pytest.approx(first.hertz_pressure_pa, rel=1e-9)
    outer = example().contacts(radial_load_n=1000, inner_speed_rpm=3000, oil=OIL, ring="outer")[0]
    assert outer.hertz_pressure_pa == pytest.approx(1.5249554177639029e9, rel=1e-10)


def test_6206_against_eng_tools() -> None:
    """Q = 5 F/Z; their ellipticity is a fit, so that pressures differ by 1 %."""
    bearing = DeepGrooveBallBearing(
        ball_diameter_m=9.525e-3,
        pitch_diameter_m=46e-3,
        balls=9,
        conformity=(4.89 / 9.525, 4.89 / 9.525),
        elastic_modulus_pa=2.1e11,
    )
    load = stribeck_load_n(1000, 9, is_ball=True)
    race, ball = bearing.bodies("inner")
    radii = [
        1 / (1 / getattr(race, k) + 1 / getattr(ball, k)) for k in ("radius_x_m", "radius_y_m")
    ]
    found = hertz_point(load, *radii, MODULUS)
    assert found.pressure_pa * 1e-6 == pytest.approx(1745.8521723734002, rel=EXACT)
    assert found.pressure_pa * 1e-6 == pytest.approx(1728, rel=0.0104)


def test_boundary_rules_hold_published_inner_dimensions() -> None:
    for name, (boundary, (ball, pitch, balls), _) in KNOWN.items():
        bore, outside, width = (1e-3 * one for one in boundary)
        found = DeepGrooveBallBearing.from_boundary(bore_m=bore, outside_m=outside, width_m=width)
        assert found.element_diameter_m == pytest.approx(1e-3 * ball, rel=DIAMETER_ERROR), name
        assert found.pitch_diameter_m == pytest.approx(1e-3 * pitch, rel=PITCH_ERROR), name
        assert abs(found.elements - balls) <= 1, name
    assert 0 < CONFORMITY_ERROR < 0.02


def test_load_zone_of_a_6208_has_both_rings_power_and_worst_places() -> None:
    bearing = DeepGrooveBallBearing.from_boundary(bore_m=0.04, outside_m=0.08, width_m=0.018)
    found = bearing.over_load_zone(radial_load_n=3000, inner_speed_rpm=3000, oil=OIL, points=5)
    assert found["central_film_m"].dims == ("ring", "angle_deg")
    assert np.isfinite(found["central_film_m"].values).all()
    assert (found["inside_error"].values > 0.01).all()
    assert (found["central_film_error"] > found["inside_error"]).all()
    own = bearing.contacts(radial_load_n=3000, inner_speed_rpm=3000, oil=OIL)[0]
    middle = found.sel(ring="inner").isel(angle_deg=2)
    assert float(middle["central_film_m"]) == own.contact.film().central_m
    assert found.attrs["kappa_iso_281"] == pytest.approx(1.87, abs=0.01)
    assert "inner ring" in found.attrs["worst"]
    assert found.attrs["rolling_power_w"] == pytest.approx(16.7, rel=0.01)


def test_refused_heat_leaves_the_reason_and_the_film_without() -> None:
    bearing = DeepGrooveBallBearing.from_boundary(bore_m=0.04, outside_m=0.08, width_m=0.018)
    found = bearing.over_load_zone(
        radial_load_n=30000, inner_speed_rpm=3000, oil=OIL, points=1, heat=True, by="laws"
    )
    for ring in ("inner", "outer"):
        one = found.sel(ring=ring)
        answered = "central_film_m" in one and np.isfinite(one["central_film_m"].values).all()
        assert answered or str(one["refusal"].values[0])
        assert np.isfinite(one["isothermal_central_film_m"].values).all()


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"balls": 0}, "balls = 0 must be a whole number of at least 3"),
        ({"balls": 30}, "do not fit"),
        ({"conformity": 0.4}, "above 0.5"),
        ({"ball_diameter_m": -1}, "ball_diameter_m = -1"),
        ({"pitch_diameter_m": 0.01}, "pitch_diameter_m = 0.01 must be above 0.0115"),
        ({"clearance_m": 0.01}, "above a tenth of the diameter of an element"),
    ],
)
def test_wrong_bearings_are_refused_by_name(changed: dict[str, object], said: str) -> None:
    given = {"ball_diameter_m": 0.0115, "pitch_diameter_m": 0.0435, "balls": 7} | changed
    with pytest.raises(ehlwave.SurfaceError, match=said):
        DeepGrooveBallBearing(**given)  # type: ignore[arg-type]


@pytest.mark.parametrize("speed", [math.nan, math.inf, "fast"])
def test_speeds_that_are_no_numbers_are_refused(speed: float) -> None:
    with pytest.raises(ehlwave.SurfaceError, match=r"inner_speed_rpm = .* is not a"):
        example().contacts(radial_load_n=1000, inner_speed_rpm=speed, oil=OIL)


def test_an_oil_layer_below_zero_is_refused() -> None:
    load = {"radial_load_n": 1000, "inner_speed_rpm": 3000}
    with pytest.raises(ehlwave.SurfaceError, match="oil_layer_m = -1e-06 must be above 0"):
        example().over_load_zone(**load, oil=OIL, oil_layer_m=-1e-6)


def test_tables_without_answers_have_films() -> None:
    load = {"radial_load_n": 1000, "inner_speed_rpm": 3000}
    found = example().over_load_zone(**load, oil=OIL, by="laws", oil_over_flooded=1e-3)
    assert np.isnan(found["central_film_m"].values).all()
    assert all(found["refusal"].values.ravel())


def test_no_load_is_refused() -> None:
    with pytest.raises(ehlwave.SurfaceError, match=r"radial_load_n = 0\.0 must be above 0"):
        example().contacts(inner_speed_rpm=3000, oil=OIL)


FAST = 15000.0
HARRIS = AngularContactBallBearing(
    ball_diameter_m=0.02223,
    pitch_diameter_m=0.12526,
    balls=16,
    contact_angle_deg=40,
    conformity=0.5232,
)
TURN = 360 * np.arange(16) / 16


@pytest.mark.parametrize("radial", [0.0, 10000.0])
def test_balls_balance_contact_forces_and_centrifugal_force(radial: float) -> None:
    zone = HARRIS.load_zone(axial_load_n=17800, radial_load_n=radial, inner_speed_rpm=FAST)
    force = HARRIS.centrifugal_load_n(FAST, 0.0, 40.0)
    (inner, inside), (outer, outside) = (zone.loads_at(TURN, ring) for ring in ("inner", "outer"))
    sines, cosines = ([f(np.radians(a)) for a in (inside, outside)] for f in (np.sin, np.cos))
    assert outer * cosines[1] == pytest.approx(inner * cosines[0] + force, rel=1e-9)
    assert outer * sines[1] == pytest.approx(inner * sines[0], abs=1e-9 * force)
    assert (inner * sines[0]).sum() == pytest.approx(17800, rel=1e-8)
    around = inner * cosines[0] * np.cos(np.radians(TURN))
    assert around.sum() == pytest.approx(radial, abs=1e-4)
    assert (inside > outside).all()


def test_centres_of_balls_close_between_the_groove_centres() -> None:
    """Both vectors from the ball's centre end at the groove centres of the displaced ring."""
    zone = HARRIS.load_zone(axial_load_n=17800, radial_load_n=10000, inner_speed_rpm=FAST)
    grooves, (power, both) = HARRIS.grooves, (HARRIS.power, HARRIS.stiffnesses)
    sums = np.zeros((2, TURN.size))
    for ring, radius, stiffness in zip(("inner", "outer"), grooves.radii_m, both, strict=True):
        load, angle = zone.loads_at(TURN, ring)
        length = radius + (load / stiffness) ** (1 / power)
        sums += length * np.array([np.sin(np.radians(angle)), np.cos(np.radians(angle))])
    free = grooves.free_angle_rad
    along = grooves.distance_m * math.sin(free) + zone.axial_m
    across = grooves.distance_m * math.cos(free) + zone.radial_m * np.cos(np.radians(TURN))
    assert sums[0] == pytest.approx(along, rel=1e-10)
    assert sums[1] == pytest.approx(across, rel=1e-10)


def test_outer_ring_bears_the_centrifugal_force_beside_the_load() -> None:
    """The larger approach of the outer race is that of its load, solved for by itself."""
    bearing, speed = example(), 20000.0
    force = bearing.centrifugal_load_n(speed)
    given = {"radial_load_n": 1000, "inner_speed_rpm": speed, "oil": OIL}
    full = {**given, "has_centrifugal_load": True}
    inner, outer = (bearing.contacts(ring=ring, **full) for ring in ("inner", "outer"))
    assert [b.load_n - a.load_n for a, b in zip(inner, outer, strict=True)] == pytest.approx(
        [force] * 3
    )
    radial = sum(one.load_n * math.cos(math.radians(one.angle_deg)) for one in inner)
    assert radial == pytest.approx(1000, rel=EXACT)
    approach = sum(
        (place.load_n / k) ** (1 / BALL_POWER)
        for place, k in zip((inner[0], outer[0]), bearing.stiffnesses, strict=True)
    )
    zone = bearing.load_zone(radial_load_n=1000, inner_speed_rpm=speed)
    assert zone.radial_m == pytest.approx(approach, rel=EXACT)
    assert 80 < zone.half_width_deg < 90
    table = bearing.over_load_zone(**full, points=3).isel(angle_deg=1)
    assert table["load_n"].values == pytest.approx([inner[0].load_n, outer[0].load_n])
    assert bearing.contacts(ring="outer", **given)[0].load_n == pytest.approx(619.613957, rel=1e-8)
    with pytest.warns(ehlwave.errors.ExtrapolationWarning, match="centrifugal force"):
        bearing.over_load_zone(**given, points=1)


def test_rib_of_tapered_rollers_bears_centrifugal_force_along_their_axis() -> None:
    bearing = tapered_bearing()
    given = {"radial_load_n": 1000, "axial_load_n": 1500}
    zone = bearing.load_zone(inner_speed_rpm=FAST, **given)
    turn = 360 * np.arange(16) / 16
    (inner, _), (outer, _) = (zone.loads_at(turn, ring) for ring in ("inner", "outer"))
    force = bearing.centrifugal_load_n(FAST, 0.0, bearing.axis_angle_deg)
    inside, outside, axis = (math.radians(a) for a in (12, 15.5, 13.75))
    rib = (outer * math.sin(outside) - inner * math.sin(inside)) / math.cos(axis)
    across = outer * math.cos(outside) - inner * math.cos(inside) + rib * math.sin(axis)
    assert across == pytest.approx(force, rel=1e-9)
    ring = inner * math.sin(inside) + rib * math.cos(axis)
    assert ring.sum() == pytest.approx(1500, rel=1e-8)
    with pytest.raises(ehlwave.EhlwaveError, match="no equilibrium"):
        bearing.load_zone(inner_speed_rpm=60000, **given)
