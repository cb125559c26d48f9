"""Teeth of gears: start of the involute, undercut, backlash."""

import math

import numpy as np
import pytest

import ehlwave
from ehlwave.elements import HelicalGearPair, SpurGearPair
from ehlwave.elements.involute import InvolutePair
from ehlwave.elements.rack import involute_start_m

OIL = ehlwave.Oil.from_grade(
    iso_vg=220, viscosity_index=95, temperature_k=343.15, eyring_stress_pa=5e6
)
STEEP = 1e-9


def swept(teeth: int, shift: float, helix_deg: float) -> float:
    """Return s of the involute that the swept corner of a rack of module 1 leaves, by points.

    A tooth is a set of points of its involute; those that the rack's corner passes on their inner
    side at the same radius are cut.
    """
    beta = math.radians(helix_deg)
    alpha = math.atan(math.tan(math.radians(20)) / math.cos(beta))
    r = teeth / math.cos(beta) / 2
    base, rolled = r * math.cos(alpha), np.linspace(0, 4 * (1 - shift), 400_001)
    x = rolled - (1 - shift) * math.tan(alpha)
    y = np.full_like(x, r - 1 + shift)
    turn = rolled / r
    gear_x = x * np.cos(turn) - y * np.sin(turn)
    gear_y = x * np.sin(turn) + y * np.cos(turn)
    radius = np.hypot(gear_x, gear_y)
    out = radius > base
    pressure = np.arccos(base / radius[out])
    flank = np.tan(pressure) - pressure - (math.tan(alpha) - alpha)
    is_cut = np.arctan2(gear_x[out], gear_y[out]) > flank + STEEP
    return float(np.max(radius[out] * np.sin(pressure), where=is_cut, initial=0.0))


@pytest.mark.parametrize("helix", [0.0, 20.0])
@pytest.mark.parametrize(("teeth", "shift"), [(13, 0.0), (12, 0.0), (8, 0.3), (12, -0.3), (6, 0.0)])
def test_the_trochoid_of_the_rack_ends_the_involute(teeth: int, shift: float, helix: float) -> None:
    beta = math.radians(helix)
    alpha = math.atan(math.tan(math.radians(20)) / math.cos(beta))
    start, is_cut = involute_start_m(teeth / math.cos(beta) / 2, alpha, 1 - shift)
    expected = swept(teeth, shift, helix)
    assert is_cut == (expected > 0)
    assert start == pytest.approx(expected, abs=2e-4) or not is_cut


def test_involutes_of_more_teeth_start_where_the_corner_leaves_the_line_of_action() -> None:
    alpha = math.radians(20)
    start, is_cut = involute_start_m(10.0, alpha, 1.0)
    at = (10 - 1) ** 2 + (1 / math.tan(alpha)) ** 2  # radius of the corner on the line of action
    assert not is_cut
    assert start == pytest.approx(math.sqrt(at - (10 * math.cos(alpha)) ** 2), rel=1e-12)


def test_least_teeth_and_shifts_of_textbooks() -> None:
    """17.1 teeth without shift, and (17.1 - z)/17.1; 14.2 teeth at a helix angle of 20 degrees."""
    steep = InvolutePair(1.0, (31, 32), 14.5).least_shifts  # easyengcalc.com: 17 and 32 teeth
    assert steep[0] > 0 > steep[1]
    full = InvolutePair(1.0, (17, 18)).least_shifts
    assert full[0] > 0 > full[1]
    spur = InvolutePair(1.0, (12, 40)).least_shifts
    assert spur[0] == pytest.approx(1 - 12 / 17.097, abs=1e-4)
    helical = InvolutePair(1.0, (14, 15), helix_angle_deg=20.0)
    assert helical.least_shifts[0] > 0 > helical.least_shifts[1]
    assert [is_cut for _, is_cut in helical.starts_m] == [True, False]


def test_an_undercut_pinion_shortens_the_path() -> None:
    gears = SpurGearPair(module_m=0.003, teeth=(12, 36), face_width_m=0.03)
    shape = gears.geometry
    assert shape.path_m[0] == pytest.approx(0.003 * swept(12, 0.0, 0.0), rel=1e-3)
    assert shape.tips_m[0] < 0  # the wheel's tip passes the base tangent point
    given = {"pinion_torque_n_m": 50, "pinion_speed_rpm": 1500, "oil": OIL, "points": 3}
    with pytest.warns(ehlwave.ExtrapolationWarning, match="12 teeth, which shortens .* 0.298 or"):
        found = gears.along_path(**given)
    assert found.attrs["geometry_note"] == shape.notes
    assert float(found["distance_m"][0]) == shape.path_m[0]
    shifted = SpurGearPair(
        module_m=0.003, teeth=(12, 36), face_width_m=0.03, profile_shift=(0.3, 0.0)
    )
    assert shifted.geometry.notes == ""
    assert shifted.geometry.path_m[0] == shifted.geometry.tips_m[0] > 0


def test_tips_that_reach_the_fillet_of_the_other_gear_are_named() -> None:
    gears = HelicalGearPair(
        module_m=0.003,
        teeth=(23, 23),
        face_width_m=0.03,
        helix_angle_deg=0,
        profile_shift=(-0.42, -0.34),
    )
    shape = gears.geometry
    assert "tip of the gear with 23 teeth reaches the fillet" in shape.notes
    assert shape.path_m == shape.involutes_m


def test_published_gears_of_fzg_type_a_are_accepted() -> None:
    """Their rounded shifts would need 0.04 mm more than the 91.5 mm of the test rig."""
    given = {"module_m": 0.0045, "teeth": (16, 24), "face_width_m": 0.02}
    shape = SpurGearPair(**given, profile_shift=(0.8635, -0.5), centre_distance_m=0.0915).geometry
    assert math.degrees(shape.working_angle_rad) == pytest.approx(22.44, abs=0.01)


@pytest.mark.parametrize("distance", [None, 0.0912])
def test_backlash_is_what_the_teeth_leave_of_the_working_pitch(distance: float | None) -> None:
    shape = InvolutePair(0.003, (20, 40), centre_distance_m=distance)
    pitch_radii = [shape.working_distance_m * z / 60 for z in (20, 40)]
    left = 2 * math.pi * pitch_radii[0] / 20 - sum(shape.thicknesses_m(tuple(pitch_radii)))
    assert shape.backlash_m == pytest.approx(left, abs=1e-15)
    assert ("backlash" in shape.notes) == (distance is not None)
