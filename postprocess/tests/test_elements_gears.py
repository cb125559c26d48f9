"""Gears: geometry, kinematics and loads by second derivations, and against published values."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import trapezoid

import ehlwave
from ehlwave.elements import HelicalGearPair, SpurGearPair, write_sweep
from ehlwave.elements.place import ASSUMED_EYRING_ERROR, ASSUMED_EYRING_PA
from ehlwave.elements.report import report_text

EXACT = 1e-12
OIL = ehlwave.Oil.from_grade(
    iso_vg=220, viscosity_index=95, temperature_k=343.15, eyring_stress_pa=5e6
)
FZG = {
    "module_m": 0.0045,
    "teeth": (16, 24),
    "face_width_m": 0.014,
    "profile_shift": (0.1817, 0.1715),
    "centre_distance_m": 0.0915,
}


def test_flank_speeds_follow_from_rigid_rotation_in_the_plane() -> None:
    """Velocities of both flanks at a point of the line of action, by vectors."""
    gears = SpurGearPair(**FZG)
    shape = gears.geometry
    alpha, a = shape.working_angle_rad, shape.working_distance_m
    along = np.array([math.sin(alpha), math.cos(alpha)])  # direction of the line of action
    across = np.array([-along[1], along[0]])
    foot = shape.base_radii_m[0] * np.array([math.cos(alpha), -math.sin(alpha)])
    turn = 2250 * 2 * math.pi / 60
    for s in np.linspace(*shape.path_m, 7):
        point = foot + s * along
        place = gears.contact_at(float(s), pinion_torque_n_m=70, pinion_speed_rpm=2250, oil=OIL)
        speeds = []
        for centre, omega in ((np.zeros(2), turn), (np.array([a, 0.0]), -turn * 16 / 24)):
            arm = point - centre
            speeds.append(omega * np.array([-arm[1], arm[0]]))
        # Both flanks move alike along the line of action, and slide across it.
        assert speeds[0] @ along == pytest.approx(speeds[1] @ along, rel=1e-11)
        for found, expected in zip(place.speeds_m_per_s, speeds, strict=True):
            assert found == pytest.approx(abs(float(expected @ across)), rel=1e-11)


def test_radii_at_the_pitch_point_by_the_formula_of_euler_and_savary() -> None:
    shape = SpurGearPair(**FZG).geometry
    first, second = (float(one) for one in shape.radii_m(shape.pitch_point_m))
    rolling = [shape.working_distance_m * z / 40 for z in (16, 24)]
    assert first == pytest.approx(rolling[0] * math.sin(shape.working_angle_rad), rel=EXACT)
    assert second == pytest.approx(rolling[1] * math.sin(shape.working_angle_rad), rel=EXACT)
    curvature = (1 / rolling[0] + 1 / rolling[1]) / math.sin(shape.working_angle_rad)
    assert 1 / first + 1 / second == pytest.approx(curvature, rel=EXACT)


def test_the_load_carries_the_torque_at_any_place() -> None:
    """Flanks in contact share the normal force: at s and a base pitch on."""
    gears = SpurGearPair(**FZG)
    shape = gears.geometry
    first, last = shape.path_m
    for s in np.linspace(first, first + shape.base_pitch_m, 52)[1:-1]:
        both = [s + k * shape.base_pitch_m for k in (0, 1)]
        share = sum(float(shape.share(one)) for one in both if one <= last)
        assert share == pytest.approx(1, rel=1e-9)
    place = gears.contact_at(
        shape.pitch_point_m, pinion_torque_n_m=70, pinion_speed_rpm=2250, oil=OIL
    )
    assert place.load_n * shape.base_radii_m[0] == pytest.approx(70, rel=EXACT)


@pytest.mark.parametrize(("torque", "published_mpa"), [(265.1, 1547.3), (70, 795.1)])
def test_fzg_type_c_pressure_at_the_pitch_point(torque: float, published_mpa: float) -> None:
    """FVA 54/7 load stages 10 and 5 (from memory), E = 206 GPa."""
    gears = SpurGearPair(**FZG)
    shape = gears.geometry
    place = gears.contact_at(
        shape.pitch_point_m, pinion_torque_n_m=torque, pinion_speed_rpm=2250, oil=OIL
    )
    assert place.hertz_pressure_pa * 1e-6 == pytest.approx(published_mpa, rel=0.0025)
    assert math.degrees(shape.working_angle_rad) == pytest.approx(22.44, abs=0.005)
    assert shape.contact_ratio == pytest.approx(1.4376502545596352, rel=EXACT)


def test_ratio_one_has_its_pitch_radius() -> None:
    gears = SpurGearPair(
        module_m=0.01093,
        teeth=(18, 18),
        face_width_m=0.021,
        profile_shift=(0.158, 0.158),
        centre_distance_m=0.2,
    )
    shape = gears.geometry
    place = gears.contact_at(
        shape.pitch_point_m, pinion_torque_n_m=1878, pinion_speed_rpm=3000, oil=OIL
    )
    expected = 0.2 * math.sin(shape.working_angle_rad) / 4
    assert place.radius_x_m == pytest.approx(expected, rel=EXACT)
    assert place.slide_to_roll_ratio == pytest.approx(0, abs=1e-12)
    found = gears.along_path(
        pinion_torque_n_m=1878, pinion_speed_rpm=3000, oil=OIL, points=9, stress=False
    )
    assert float(found["slide_to_roll_ratio"][0]) == pytest.approx(-1.2058799873616015, rel=1e-9)
    assert found["load_n_per_m"].values[4] * 1e-3 == pytest.approx(967.4483881118242, rel=EXACT)


def test_path_of_a_gear_of_module_three_with_both_ends() -> None:
    gears = SpurGearPair(module_m=0.003, teeth=(20, 40), face_width_m=0.03)
    found = gears.along_path(pinion_torque_n_m=150, pinion_speed_rpm=1500, oil=OIL)
    ends = found["distance_m"].values[[0, -1]]
    assert tuple(ends) == gears.geometry.path_m
    assert np.isfinite(found["central_film_m"].values).all()
    assert found.attrs["sliding_power_w"] > found.attrs["rolling_power_w"] > 0
    assert 0.97 < found.attrs["efficiency"] < 1
    for name in ("radius_m", "speed_1_m_per_s", "speed_2_m_per_s", "load_n_per_m", "friction"):
        assert name in found


def test_the_largest_pressure_at_the_inner_point_of_single_contact_is_named() -> None:
    """ISO 6336-2: B of the pinion, where the whole load begins; nine even places miss it."""
    gears = SpurGearPair(module_m=0.003, teeth=(20, 40), face_width_m=0.03)
    asked = {"pinion_torque_n_m": 150, "pinion_speed_rpm": 1500, "oil": OIL, "by": "laws"}
    found = gears.along_path(**asked)
    shape = gears.geometry
    b = shape.path_m[1] - shape.base_pitch_m
    force = 150 / shape.base_radii_m[0] / 0.03
    modulus = 2.26373626373e11  # E', steel
    radius = b * (shape.action_m - b) / shape.action_m
    expected = math.sqrt(force * modulus / (2 * math.pi * radius))
    assert found.attrs["peak_hertz_pressure_pa"] == pytest.approx(expected, rel=1e-9)
    assert found.attrs["peak_hertz_distance_m"] == pytest.approx(b, rel=EXACT)
    assert float(found["hertz_pressure_pa"].max()) < 0.98 * expected


def test_an_oil_without_flow_law_takes_an_assumed_eyring_stress(tmp_path: Path) -> None:
    """Friction equals that of an oil with this stress, and its error covers other stresses."""
    gears = SpurGearPair(module_m=0.003, teeth=(20, 40), face_width_m=0.03)
    exact = dict.fromkeys(("viscosity_error", "pressure_viscosity_error", "conductivity_error"), 0)
    own = replace(OIL, **exact)
    plain = replace(own, eyring_stress_pa=None)
    asked = {"pinion_torque_n_m": 150, "pinion_speed_rpm": 1500, "heat": True, "by": "laws"}
    found, known = (gears.along_path(oil=oil, points=5, **asked) for oil in (plain, own))
    assert np.isfinite(found["minimum_film_m"].values).all()
    assert found["friction"].values == pytest.approx(known["friction"].values, rel=1e-12)
    assert found.attrs["assumed_eyring_stress_pa"] == ASSUMED_EYRING_PA == OIL.eyring_stress_pa
    assert all("assumed Eyring stress of 5 MPa within 40 %" in one for one in found.doubts.values)
    assert "assumed_eyring_stress_pa" not in known.attrs
    assert "Eyring stress, assumed: 5 MPa within 40 %" in report_text(found)
    more = (found["friction_error"] - known["friction_error"]).values
    for factor in (1 - ASSUMED_EYRING_ERROR, 1 + ASSUMED_EYRING_ERROR):
        other = replace(own, eyring_stress_pa=factor * ASSUMED_EYRING_PA)
        changed = gears.along_path(oil=other, points=5, **asked)
        difference = np.abs(changed["friction"] / found["friction"] - 1).values
        assert (difference > 0.1).all()
        assert (difference < more).all()
    cold = gears.along_path(oil=plain, points=5, **asked | {"heat": None})
    assert "friction: not known without heat" in str(cold["refusal"].values[0])
    weights = found["sliding_power_w"].values
    error = float(weights @ found["friction_error"].values / weights.sum())
    assert found.attrs["sliding_power_error"] == pytest.approx(error, rel=1e-12)
    places = gears.places(points=3, oil=plain, pinion_torque_n_m=150, pinion_speed_rpm=1500)
    text = write_sweep(places, tmp_path, heat=True)[1].read_text()
    assert "flow_law = 'eyring'" in text
    assert "eyring_stress_pa = 5000000.0" in text


def test_power_is_the_integral_of_the_moment_over_a_mesh() -> None:
    gears = SpurGearPair(module_m=0.003, teeth=(20, 40), face_width_m=0.03)
    found = gears.along_path(pinion_torque_n_m=150, pinion_speed_rpm=1500, oil=OIL, points=41)
    turn = 1500 * 2 * math.pi / 60
    angle = np.radians(found["pinion_angle_deg"].values)
    power = found["sliding_power_w"].values
    # A mesh lasts 2 pi/z of the pinion.
    mean = trapezoid(power, angle) / (2 * math.pi / 20)
    assert found.attrs["sliding_power_w"] == pytest.approx(mean, rel=0.05)
    assert turn * 150 * (1 - found.attrs["efficiency"]) == pytest.approx(
        found.attrs["sliding_power_w"] + found.attrs["rolling_power_w"], rel=1e-9
    )


def test_profile_shifted_spur_gears_of_a_published_table() -> None:
    """Bolsover, "Profile Shifted External Spur Gears", by the centre distance."""
    shape = SpurGearPair(
        module_m=0.003,
        teeth=(12, 24),
        face_width_m=0.03,
        profile_shift=(0.6, 0.36),
        centre_distance_m=0.0565,
    ).geometry
    assert math.degrees(shape.working_angle_rad) == pytest.approx(26.0888, abs=6e-5)
    bases = [2e3 * radius for radius in shape.base_radii_m]
    assert bases == pytest.approx([33.8289, 67.6579], abs=6e-5)
    tips = [2e3 * radius for radius in shape.tip_radii_m]
    assert tips == pytest.approx([44.840, 79.400], abs=6e-4)
    assert shape.contact_ratio == pytest.approx(1.202, abs=6e-4)


def test_profile_shifted_helical_gears_of_a_published_table() -> None:
    """A worksheet of ISO 21771 on scribd.com, document 376176518: both ways to the distance."""
    own = {"module_m": 0.0035, "teeth": (31, 30), "face_width_m": 0.03, "helix_angle_deg": 21.0}
    shifts = (0.291, 0.651877131252 - 0.291)
    shape = HelicalGearPair(**own, profile_shift=shifts).geometry  # type: ignore[arg-type]
    assert 1e3 * shape.working_distance_m == pytest.approx(116.5, abs=1e-6)
    by_distance = HelicalGearPair(**own, profile_shift=shifts, centre_distance_m=0.1165)  # type: ignore[arg-type]
    for one in (shape, by_distance.geometry):
        assert math.degrees(one.transverse_angle_rad) == pytest.approx(21.2990642859, abs=1e-9)
        assert math.degrees(one.working_angle_rad) == pytest.approx(23.8707609654, abs=1e-6)


def test_helical_radii_by_the_section_normal_to_the_flank() -> None:
    """The normal curvature of an involute helicoid is 1/s times cos^2 of the angle to the base."""
    gears = HelicalGearPair(module_m=0.003, teeth=(20, 40), face_width_m=0.03, helix_angle_deg=20)
    shape = gears.geometry
    beta_b = math.asin(math.sin(math.radians(20)) * math.cos(math.radians(20)))
    assert shape.base_helix_rad == pytest.approx(beta_b, rel=EXACT)
    s = shape.pitch_point_m
    # Euler: the transverse section cuts at beta_b from the normal section, Meusnier: 1/cos(beta_b).
    transverse = 1 / s
    normal = transverse * math.cos(beta_b) ** 2 / math.cos(beta_b)
    assert float(shape.radii_m(s)[0]) == pytest.approx(1 / normal, rel=EXACT)
    assert gears.overlap_ratio == pytest.approx(
        0.03 * math.sin(math.radians(20)) / (math.pi * 0.003), rel=EXACT
    )
    straight = HelicalGearPair(
        module_m=0.003, teeth=(20, 40), face_width_m=0.03, helix_angle_deg=0
    ).geometry
    spur = SpurGearPair(module_m=0.003, teeth=(20, 40), face_width_m=0.03).geometry
    assert straight.path_m == pytest.approx(spur.path_m, rel=EXACT)


def test_helical_contact_lines_bear_the_normal_force() -> None:
    gears = HelicalGearPair(module_m=0.003, teeth=(20, 40), face_width_m=0.06, helix_angle_deg=20)
    shape = gears.geometry
    place = gears.contact_at(
        shape.pitch_point_m, pinion_torque_n_m=150, pinion_speed_rpm=1500, oil=OIL
    )
    lines = shape.contact_ratio * 0.06 / math.cos(shape.base_helix_rad)
    assert place.load_n_per_m * lines == pytest.approx(gears.normal_load_n(150), rel=EXACT)
    assert place.load_n * shape.contact_ratio == pytest.approx(gears.normal_load_n(150), rel=EXACT)


def test_helical_power_is_the_sum_over_all_contact_lines() -> None:
    """Friction 1: force times sliding speed over slices of the face, whose mesh is staggered."""
    gears = HelicalGearPair(module_m=0.003, teeth=(20, 40), face_width_m=0.06, helix_angle_deg=25)
    assert gears.overlap_ratio > 1
    shape, turn = gears.geometry, 1500 * 2 * math.pi / 60
    first, last = shape.path_m
    lines = shape.contact_ratio * 0.06 / math.cos(shape.base_helix_rad)
    z = 0.06 * (np.arange(400) + 0.5) / 400
    powers = []
    for phase in (np.arange(50) + 0.5) / 50:
        at = phase * shape.base_pitch_m + z * math.tan(shape.base_helix_rad)
        s = (at[:, None] + shape.base_pitch_m * np.arange(-20, 20)).ravel()
        s = s[(s > first) & (s < last)]
        slide = np.abs(turn * s - turn / 2 * (shape.action_m - s))
        slice_m = 0.06 / 400 / math.cos(shape.base_helix_rad)
        powers.append(float((gears.normal_load_n(150) / lines * slice_m * slide).sum()))
    s = np.linspace(first, last, 9)
    found = xr.Dataset(
        {name: ("distance_m", np.ones(9)) for name in ("friction", "rolling_resistance_n")},
        {"distance_m": s},
    )
    sliding, _ = gears._powers_w(found, 150, 1500, 1.0)
    assert sliding == pytest.approx(np.mean(powers), rel=1e-3)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"teeth": (6, 40)}, "contact ratio 0.74 .* undercuts the gear with 6 teeth, .* 0.649 or"),
        ({"centre_distance_m": 0.08}, "centre_distance_m = 0.08 must be at least 0.09,"),
        ({"centre_distance_m": 0.0899}, "centre_distance_m = 0.0899 must be at least 0.09,"),
        ({"centre_distance_m": 0.0965}, "contact ratio"),
        ({"module_m": 0}, "module_m = 0 must be above 0"),
        ({"teeth": 20.5}, "whole number"),
        ({"teeth": (20, -60)}, "internal gears are not covered"),
        ({"teeth": (9, 60), "profile_shift": (0.9, 0)}, "teeth of the gear with 9 are pointed"),
        ({"module_m": 3}, "did you mean 0.003"),
        ({"material": ("steel", "steel", "steel")}, "give one name, or two"),
    ],
)
def test_wrong_gears_are_refused_by_name(changed: dict[str, object], said: str) -> None:
    given = {"module_m": 0.003, "teeth": (20, 40), "face_width_m": 0.03} | changed
    with pytest.raises(ehlwave.SurfaceError, match=said):
        SpurGearPair(**given)  # type: ignore[arg-type]


def test_load_factors_below_zero_are_refused() -> None:
    gears = SpurGearPair(module_m=0.003, teeth=(20, 40), face_width_m=0.03)
    given = {"pinion_torque_n_m": 150, "pinion_speed_rpm": 1500, "load_factor": -1}
    with pytest.raises(ehlwave.SurfaceError, match="load_factor = -1 must be above 0"):
        gears.places(**given, oil=OIL)


@pytest.mark.parametrize("helix", [0.0, 20.0])
def test_teeth_without_backlash_fill_the_working_pitch(helix: float) -> None:
    gears = HelicalGearPair(
        module_m=0.003,
        teeth=(17, 43),
        face_width_m=0.03,
        helix_angle_deg=helix,
        profile_shift=(0.4, 0.1),
    )
    shape = gears.geometry
    cosine = math.cos(shape.working_angle_rad)
    radii = tuple(base / cosine for base in shape.base_radii_m)
    pitch = 2 * math.pi * radii[0] / 17
    assert sum(shape.thicknesses_m((radii[0], radii[1]))) == pytest.approx(pitch, rel=1e-12)
