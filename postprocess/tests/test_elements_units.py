"""Elements refuse values in wrong units by the name of the argument."""

import math
from collections.abc import Callable

import numpy as np
import pytest

import ehlwave
from ehlwave.elements import (
    AngularContactBallBearing,
    BallOnDisc,
    CamFollower,
    DeepGrooveBallBearing,
    HelicalGearPair,
    MiniTraction,
    SpurGearPair,
)

OIL = ehlwave.Oil.from_grade(iso_vg=68, viscosity_index=95, temperature_k=343.15)
GEAR = {"module_m": 0.003, "teeth": (20, 40), "face_width_m": 0.03}
CAM = {"angle_deg": np.arange(0, 360, 10.0), "base_radius_m": 0.017, "width_m": 0.012}
LIFT_M = 0.004 * (1 + np.cos(np.radians(np.arange(0, 360, 10.0))))
BALLS = {"ball_diameter_m": 0.012, "pitch_diameter_m": 0.06, "balls": 9}
LOADED = {"inner_speed_rpm": 3000, "radial_load_n": 3000, "oil": OIL, "by": "laws", "points": 1}


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: MiniTraction(track_diameter_m=42), "track_diameter_m = 42: did you mean 0.042"),
        (lambda: MiniTraction(track_diameter_m=math.nan), "track_diameter_m = nan is not a finite"),
        (lambda: MiniTraction(track_diameter_m=0), "track_diameter_m = 0 must be above 0"),
        (lambda: SpurGearPair(**GEAR, centre_distance_m=90), "centre_distance_m = 90: .* 0.09"),
        (lambda: SpurGearPair(**GEAR, pressure_angle_deg=0.349), "pressure_angle_deg = 0.349 must"),
        (lambda: HelicalGearPair(**GEAR, helix_angle_deg=0.349), "give degrees, such as 20"),
        (
            lambda: AngularContactBallBearing(**BALLS, contact_angle_deg=0.7),
            "contact_angle_deg = 0.7 must be above 0.8, such as 25",
        ),
        (lambda: CamFollower(**CAM, lift_m=1e3 * LIFT_M), "lift_m = 8: did you mean 0.008"),
        (lambda: CamFollower(**CAM, lift_m=["x"] * 36), "must be lists of numbers"),
        (lambda: CamFollower(**CAM | {"base_radius_m": 17}, lift_m=LIFT_M), "base_radius_m = 17: "),
        (
            lambda: DeepGrooveBallBearing.from_boundary(bore_m=0.04, outside_m=0.08, width_m=0.18),
            "width_m = 0.18 is above outside_m - bore_m",
        ),
        (
            lambda: DeepGrooveBallBearing.from_boundary(bore_m=40, outside_m=80, width_m=18),
            "bore_m = 40: did you mean 0.04",
        ),
        (
            lambda: DeepGrooveBallBearing(ball_diameter_m=0.052, pitch_diameter_m=0.06, balls=3),
            "balls = 3 of ball_diameter_m = 0.052 do not fit",  # chords of 0.866 of the circle
        ),
        (
            lambda: DeepGrooveBallBearing(**BALLS).over_load_zone(**LOADED, rings=()),
            r"rings = \(\): give a list of",
        ),
        (
            lambda: DeepGrooveBallBearing(**BALLS).over_load_zone(**LOADED, rings="inner"),
            "rings = 'inner': give a list of",
        ),
        (
            lambda: DeepGrooveBallBearing(**BALLS).over_load_zone(
                **LOADED | {"radial_load_n": 3e9}
            ),
            "radial_load_n = 3e[+]09: did you mean",
        ),
        (
            lambda: DeepGrooveBallBearing(**BALLS).over_load_zone(**LOADED, oil_layer_m=1),
            "oil_layer_m = 1: did you mean 0.001",
        ),
        (
            lambda: SpurGearPair(**GEAR).along_path(
                pinion_torque_n_m=1.5e5, pinion_speed_rpm=1500, oil=OIL
            ),
            "Hertz pressure of .* GPa in a contact, where hard steel bears 4 GPa",
        ),
        (
            lambda: BallOnDisc(ball_diameter_m=0.019).over_speeds(
                load_n=20, mean_speeds_m_per_s=["a"], oil=OIL
            ),
            "mean_speed_m_per_s = 'a' is not a number",
        ),
    ],
)
def test_wrong_units_are_named_by_the_argument(call: Callable[[], object], said: str) -> None:
    with pytest.raises(ehlwave.SurfaceError, match=said):
        call()


def test_pressures_that_leave_dents_are_marked() -> None:
    found = DeepGrooveBallBearing(**BALLS).over_load_zone(**LOADED | {"radial_load_n": 2.5e4})
    assert float(found["hertz_pressure_pa"].max()) > 4e9
    assert "above 4 GPa hard steel keeps dents" in str(found["doubts"].values.ravel()[0])
