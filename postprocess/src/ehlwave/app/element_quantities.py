"""The numbers that the page asks for of machine elements."""

from typing import NamedTuple

from ehlwave.app.quantities import LENGTHS, Quantity

FORCES = {"N": 0, "kN": 3}
TURNS = {"rpm": 0}
DEGREES = {"degrees": 0}


class Asked(NamedTuple):
    """Fields of an element."""

    dimensions: tuple[Quantity, ...]
    conditions: tuple[Quantity, ...]


def _length(key: str, label: str, example: str, text: str = "") -> Quantity:
    return Quantity(key, label, example, LENGTHS, text)


_SPEEDS = (
    Quantity("inner_speed_rpm", "Speed of the inner ring", "3000", TURNS),
    Quantity("outer_speed_rpm", "Speed of the outer ring", "0", TURNS),
)
_RADIAL = Quantity("radial_load_n", "Radial load", "3", {"kN": 3, "N": 0})
_AXIAL = Quantity("axial_load_n", "Axial load", "2", {"kN": 3, "N": 0})
_ROLLER = (
    _length("roller_diameter_m", "Roller diameter", "11"),
    _length("roller_length_m", "Roller length", "12"),
    _length("pitch_diameter_m", "Pitch diameter", "60"),
    Quantity("rollers", "Rollers", "13"),
)
_GEAR = (
    _length("module_m", "Normal module", "3"),
    Quantity("teeth_1", "Teeth of the pinion", "20"),
    Quantity("teeth_2", "Teeth of the wheel", "40"),
    _length("face_width_m", "Face width", "30"),
    Quantity("pressure_angle_deg", "Pressure angle", "20", DEGREES),
    Quantity("profile_shift_1", "Profile shift, pinion", "0"),
    Quantity("profile_shift_2", "Profile shift, wheel", "0"),
    _length("centre_distance_m", "Centre distance", "", "Blank: without backlash."),
)
_DRIVEN = (
    Quantity("pinion_torque_n_m", "Torque of the pinion", "150", {"N m": 0}),
    Quantity("pinion_speed_rpm", "Speed of the pinion", "1500", TURNS),
)

TABS: dict[str, dict[str, Asked]] = {
    "Bearing": {
        "DeepGrooveBallBearing": Asked(
            (
                _length("bore_m", "Bore d", "40"),
                _length("outside_m", "Outside diameter D", "80"),
                _length("width_m", "Width B", "18"),
                _length("clearance_m", "Radial clearance", "0"),
            ),
            (_RADIAL, *_SPEEDS),
        ),
        "AngularContactBallBearing": Asked(
            (
                _length("ball_diameter_m", "Ball diameter", "11"),
                _length("pitch_diameter_m", "Pitch diameter", "60"),
                Quantity("balls", "Balls", "14"),
                Quantity("contact_angle_deg", "Contact angle", "40", DEGREES),
            ),
            (_AXIAL, Quantity("radial_load_n", "Radial load", "0", {"kN": 3, "N": 0}), *_SPEEDS),
        ),
        "CylindricalRollerBearing": Asked(_ROLLER, (_RADIAL, *_SPEEDS)),
        "TaperedRollerBearing": Asked(
            (
                *_ROLLER,
                Quantity("inner_angle_deg", "Angle of the inner race", "12", DEGREES),
                Quantity("outer_angle_deg", "Angle of the outer race", "15.5", DEGREES),
            ),
            (_RADIAL, _AXIAL, *_SPEEDS),
        ),
    },
    "Gear": {
        "SpurGearPair": Asked(_GEAR, _DRIVEN),
        "HelicalGearPair": Asked(
            (*_GEAR, Quantity("helix_angle_deg", "Helix angle", "20", DEGREES)), _DRIVEN
        ),
    },
    "Cam": {
        "CamFollower": Asked(
            (
                _length("base_radius_m", "Radius of the base circle", "18"),
                _length("width_m", "Width", "12"),
                _length("roller_radius_m", "Radius of the roller", "9", "Blank: flat follower."),
                _length("lift_height_m", "Lift", "8", "As (1 + cos)/2 over the opening."),
                Quantity("opening_deg", "Opening", "140", DEGREES),
                Quantity("preload_n", "Spring preload", "250", FORCES),
                Quantity("spring_rate_n_per_m", "Spring rate", "40", {"N/mm": 3, "N/m": 0}),
                Quantity("mass_kg", "Moved mass", "0.12", {"kg": 0}),
            ),
            (Quantity("cam_speed_rpm", "Speed of the cam", "1000", TURNS),),
        )
    },
}
"""Elements of each tab."""
