"""Limits of machine elements: preload, large clearances, sharp cams, rings and discs at rest."""

import math

import numpy as np
import pytest
from scipy.optimize import fsolve

import ehlwave
from ehlwave.elements import (
    CamFollower,
    CylindricalRollerBearing,
    DeepGrooveBallBearing,
    SpurGearPair,
    TwoDisc,
    case_table,
)
from ehlwave.elements.load_zone import EDGE
from ehlwave.elements.place import ElementContact
from ehlwave.errors import SurfaceError

OIL = ehlwave.Oil.from_grade(iso_vg=68, viscosity_index=95, temperature_k=343.15)


def bearing(clearance_m: float = 0.0, **others: tuple[float, float]) -> DeepGrooveBallBearing:
    return DeepGrooveBallBearing(
        ball_diameter_m=0.012, pitch_diameter_m=0.06, balls=9, clearance_m=clearance_m, **others
    )


@pytest.mark.parametrize("clearance", [-2e-5, -1e-9, 0.0, 1e-9, 2e-5])
def test_small_axial_loads_leave_the_radial_zone(clearance: float) -> None:
    alone = bearing(clearance).load_zone(radial_load_n=3000)
    both = bearing(clearance).load_zone(radial_load_n=3000, axial_load_n=1e-6)
    assert both.radial_m == pytest.approx(alone.radial_m, rel=1e-9)
    turn = 40.0 * np.arange(9)
    assert both.loads_at(turn)[0] == pytest.approx(alone.loads_at(turn)[0], abs=1e-3)


def test_preloaded_balls_under_both_loads_by_the_distance_of_the_groove_centres() -> None:
    own, clearance, turn = bearing(-2e-5), -2e-5, 2 * np.pi * np.arange(9) / 9
    distance = (0.52 + 0.53 - 1) * 0.012

    def left(moved: np.ndarray) -> list[float]:
        radial = distance - clearance / 2 + moved[0] * np.cos(turn)
        reach = np.hypot(radial, moved[1])
        load = own.stiffness * np.maximum(reach - distance, 0) ** 1.5
        across, along = load * radial / reach * np.cos(turn), load * moved[1] / reach
        return [across.sum() / 2000 - 1, along.sum() / 1000 - 1]

    moved = fsolve(left, [1e-5, 5e-5], xtol=1e-13)
    zone = own.load_zone(radial_load_n=2000, axial_load_n=1000)
    assert (zone.radial_m, zone.axial_m) == pytest.approx(tuple(moved), rel=1e-9)
    # Preload alone, without any axial load: each ball bears K (s/2)^1.5.
    light = own.load_zone(radial_load_n=1e-3).loads_at(turn)[0]
    assert light == pytest.approx(own.stiffness * 1e-5**1.5, rel=1e-4)


def test_grooves_that_let_the_balls_past_are_refused_with_an_axial_load() -> None:
    own = bearing(0.001, conformity=(0.51, 0.52))
    zone = own.load_zone(radial_load_n=3000)
    assert float(zone.loads_at(0)[0]) == pytest.approx(3000, rel=1e-12)  # a single ball
    with pytest.raises(ehlwave.SurfaceError, match=r"no hold along the axis: .* below 0\.00072"):
        own.load_zone(radial_load_n=3000, axial_load_n=10)


@pytest.mark.parametrize("points", [1, 2, 3, 4, 9])
def test_the_most_loaded_place_is_among_the_angles(points: int) -> None:
    zone = bearing(2e-5).load_zone(radial_load_n=3000)
    angles = zone.angles_deg(points)
    assert len(angles) == points
    assert 0.0 in angles
    assert np.ptp(np.diff(angles, append=2 * angles[-1] - angles[-2 % points])) < 1e-9
    assert abs(angles).max() <= EDGE * zone.half_width_deg * (1 + 1e-12)
    given = {"radial_load_n": 3000, "inner_speed_rpm": 3000, "oil": OIL}
    found = bearing(2e-5).over_load_zone(points=points, rings=("inner",), by="laws", **given)
    most = max(place.load_n for place in bearing(2e-5).places(rings=("inner",), **given))
    assert float(found["load_n"].max()) == pytest.approx(most, rel=1e-12)


@pytest.mark.parametrize("speeds", [(0.0, 0.0), (1000.0, 1000.0)])
def test_rings_that_turn_together_are_refused(speeds: tuple[float, float]) -> None:
    inner, outer = speeds
    given = {"radial_load_n": 3000, "inner_speed_rpm": inner, "outer_speed_rpm": outer, "oil": OIL}
    with pytest.raises(ehlwave.SurfaceError, match="no contact rolls"):
        bearing().over_load_zone(**given)
    with pytest.raises(ehlwave.RangeError, match="both surfaces stand still"):
        _ = bearing().contacts(**given)[0].contact


def test_a_turning_outer_ring_is_a_turning_inner_ring_for_the_contacts() -> None:
    given = {"radial_load_n": 3000, "oil": OIL, "points": 1, "by": "laws"}
    inner = bearing().over_load_zone(inner_speed_rpm=3000, **given)
    outer = bearing().over_load_zone(inner_speed_rpm=0, outer_speed_rpm=3000, **given)
    for name in ("mean_speed_m_per_s", "central_film_m", "load_n"):
        assert outer[name].values.tolist() == inner[name].values.tolist()
    assert outer.attrs["kappa_iso_281"] == inner.attrs["kappa_iso_281"]
    # A place of the inner ring meets 9 balls a turn of the cage past it.
    gamma = 0.2
    for found, cage in ((inner, (1 - gamma) / 2), (outer, (1 + gamma) / 2)):
        past = abs((1 if found is inner else 0) - cage) * 3000 / 60 * 9
        assert found.attrs["time_between_overrollings_s"] == pytest.approx(1 / past, rel=1e-12)


@pytest.mark.parametrize("speeds", [(0, 0), (100, -100)])
def test_discs_that_draw_no_oil_in_are_refused(speeds: tuple[float, float]) -> None:
    with pytest.raises(ehlwave.SurfaceError, match="draw no oil in"):
        TwoDisc(diameters_m=(0.08, 0.08), width_m=0.01).speeds_m_per_s(speeds)


@pytest.mark.parametrize(
    ("angle_deg", "said"),
    [
        (np.linspace(0, 6.2, 90), "leaves 353.8 degrees without a lift"),
        (np.r_[0:89.0, math.nan], "finite numbers"),
    ],
)
def test_wrong_angles_of_cams_are_refused(angle_deg: np.ndarray, said: str) -> None:
    lift = np.linspace(0, 1e-3, 90)
    with pytest.raises(ehlwave.SurfaceError, match=said):
        CamFollower(angle_deg=angle_deg, lift_m=lift, base_radius_m=0.015, width_m=0.01)


def test_a_roller_too_large_for_the_nose_of_the_cam_is_refused() -> None:
    """The path of its centre has a radius below its own: the cam would be cut off."""
    angle = np.arange(0, 360, 1.0)
    x = np.clip(1 - abs(angle - 180) / 25, 0, 1)
    cam = CamFollower(
        angle_deg=angle,
        lift_m=0.012 * x**3 * (10 - 15 * x + 6 * x**2),
        base_radius_m=0.006,
        width_m=0.01,
        roller_radius_m=0.02,
        preload_n=3000,
    )
    turn, given = math.radians(1.0), {"cam_speed_rpm": 500, "oil": OIL}
    reach = 0.026 + cam._lift(np.radians(angle))
    x, y = reach * np.cos(np.radians(angle)), reach * np.sin(np.radians(angle))
    # Three neighbours on the path of the centre lie on a circle.
    bent = [np.gradient(one, turn) for one in (x, y)]
    twice = [np.gradient(one, turn) for one in bent]
    radius = np.hypot(*bent) ** 3 / (bent[0] * twice[1] - bent[1] * twice[0])
    assert 0 < radius[170] < 0.02
    with pytest.raises(ehlwave.SurfaceError, match="cuts the cam's flank off at 170 degrees"):
        cam.contact_at(170.0, **given)
    assert radius[158] < 0  # hollow: the flank touches the roller
    assert cam.contact_at(158.0, **given).radius_x_m > 0


def test_round_off_of_a_lift_table_does_not_turn_a_surface_round() -> None:
    bodies = (ehlwave.Body(0.02, material="steel"), ehlwave.Body(material="steel"))
    rest, noise, back = (
        ElementContact(bodies, OIL, (1.9, second), 250.0, length_m=0.012)
        for second in (0.0, -3e-5, -3e-3)
    )
    assert noise.contact.film(by="laws").central_m == pytest.approx(
        rest.contact.film(by="laws").central_m, rel=1e-4
    )
    assert case_table([noise])["slip_parameter"].tolist() == [2.0]
    assert (noise.is_opposite, back.is_opposite) == (False, True)
    with pytest.raises(ehlwave.RangeError, match="opposite directions"):
        _ = back.contact
    assert case_table([back]).empty


ROLLERS = {"roller_diameter_m": 0.016, "roller_length_m": 0.016, "pitch_diameter_m": 0.08}


@pytest.mark.parametrize(
    ("element", "call", "given", "said"),
    [
        (
            bearing(),
            "over_load_zone",
            {"inner_speed_rpm": 3000, "radial_load": 3000},
            r"DeepGrooveBallBearing: unknown radial_load \(did you mean radial_load_n\?\)",
        ),
        (
            bearing(),
            "contacts",
            {"inner_speed_rpm": 3000, "load": 3000},
            "unknown load: give one of radial_load_n, axial_load_n, is_free_to_tilt",
        ),
        (
            CylindricalRollerBearing(**ROLLERS, rollers=9),
            "contacts",
            {"inner_speed_rpm": 3000, "radial_load_n": 9e3, "axial_load_n": 1e3},
            "CylindricalRollerBearing: unknown axial_load_n",
        ),
        (
            SpurGearPair(module_m=0.003, teeth=(20, 40), face_width_m=0.03),
            "along_path",
            {"pinion_torque_n_m": 150, "pinion_speed_rpm": 1500, "heats": True},
            r"SpurGearPair: unknown heats \(did you mean heat\?\)",
        ),
        (
            bearing(),
            "over_load_zone",
            {"inner_speed_rpm": 3000, "radial_load_n": 0},
            "radial_load_n = 0.* must be above 0",
        ),
    ],
)
def test_arguments_that_a_call_does_not_take_are_named(
    element: object, call: str, given: dict[str, float], said: str
) -> None:
    with pytest.raises(SurfaceError, match=said):
        getattr(element, call)(**given, oil=OIL)


def test_a_missing_oil_is_named() -> None:
    place = bearing().contacts(radial_load_n=3000, inner_speed_rpm=3000, oil=None)[0]
    with pytest.raises(SurfaceError, match=r"oil = None is no ehlwave\.Oil"):
        _ = place.contact


def test_flanks_roll_at_the_pitch_point() -> None:
    """Round-off of both speeds is no sliding, for which friction would be unknown."""
    slides = []
    for pinion in range(17, 41):
        pair = SpurGearPair(module_m=0.003, teeth=(pinion, 2 * pinion + 1), face_width_m=0.03)
        place = pair.contact_at(
            pair.geometry.named_points_m["C"],
            pinion_torque_n_m=150,
            pinion_speed_rpm=1500,
            oil=OIL,
        )
        assert place.slide_to_roll_ratio == 0.0
        assert place.contact.conditions.rolls
        slides.append(place.speeds_m_per_s[0] != place.speeds_m_per_s[1])
    assert any(slides)
