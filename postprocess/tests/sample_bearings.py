"""Bearings that several tests take."""

from ehlwave.elements import TaperedRollerBearing


def tapered_bearing() -> TaperedRollerBearing:
    """Return a tapered roller bearing whose races have angles of 12 and 15.5 degrees."""
    return TaperedRollerBearing(
        roller_diameter_m=0.01,
        roller_length_m=0.015,
        pitch_diameter_m=0.06,
        rollers=16,
        inner_angle_deg=12,
        outer_angle_deg=15.5,
    )
