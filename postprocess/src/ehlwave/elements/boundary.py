"""Inner dimensions of bearings by usual rules, from boundary dimensions, with their errors.

Balls: D_w = 0.3 (D - d), d_m = (d + D)/2, and as many balls as a filling angle of 186 degrees
takes: Z = 1 + 93 degrees/asin(D_w/d_m), rounded; conformities of 0.515 to 0.53 are usual
(Harris and Kotzalas, *Essential Concepts of Bearing Technology*, chapter 2, from memory). Errors
hold the published inner dimensions of :data:`KNOWN`; a test compares.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ehlwave.elements.given import above
from ehlwave.error_bars import bar
from ehlwave.errors import SurfaceError

BALL_SHARE, FILLING_DEG = 0.3, 186.0
DIAMETER_ERROR, PITCH_ERROR = bar("bearing.ball_diameter"), bar("bearing.pitch_diameter")
COUNT_ERROR, CONFORMITY_ERROR = int(bar("bearing.ball_count")), bar("bearing.conformity")
"""Errors of ball diameter and pitch diameter, relative, of the number of balls and of conformities,
absolute."""

KNOWN = {
    "6203": ((17, 40, 12), (6.746, 28.50, 8), "Case Western Reserve University, bearing data"),
    "6205": ((25, 52, 15), (7.940, 39.04, 9), "Case Western Reserve University, bearing data"),
    "6204": ((20, 47, 14), (7.92, 34.55, 8), "Xi'an Jiaotong University, XJTU-SY, LDK UER204"),
    "6305": ((25, 62, 17), (11.5, 43.5, 7), "example of ISO 16281 in minzhun/ISO16281"),
    "6206": ((30, 62, 16), (9.525, 46.0, 9), "eng-tools.dev, series a/a2"),
    "6209": ((45, 85, 19), (12.7, 65.0, 9), "Hamrock's example in HenriqueBaron/tcc-modelo"),
}
"""Boundary dimensions d, D, B in mm; ball and pitch diameter in mm, number of balls; source.
Bearings of examples are matched to designations by their dimensions."""


@dataclass(frozen=True)
class Inside:
    """Estimated inner dimensions of a ball bearing.

    Attributes
    ----------
    ball_diameter_m, pitch_diameter_m : float
        D_w and d_m.
    balls : int
        Number of balls.
    errors : mapping
        Their errors, relative; of the number absolute.
    """

    ball_diameter_m: float
    pitch_diameter_m: float
    balls: int
    errors: Mapping[str, float]

    def arguments(self) -> dict[str, Any]:
        """Return the arguments of a bearing."""
        return {
            "ball_diameter_m": self.ball_diameter_m,
            "pitch_diameter_m": self.pitch_diameter_m,
            "balls": self.balls,
        }

    def varied(self, conformity: tuple[float, float]) -> list[dict[str, Any]]:
        """Return arguments with each dimension in turn at its upper error.

        Parameters
        ----------
        conformity : pair of float
            Of both rings.
        """
        usual = self.arguments()
        larger = tuple(min(value + CONFORMITY_ERROR, 0.9) for value in conformity)
        return [
            usual
            | {
                "ball_diameter_m": self.ball_diameter_m * (1 + DIAMETER_ERROR),
                "balls": self.balls - 1,
            },
            usual | {"pitch_diameter_m": self.pitch_diameter_m * (1 + PITCH_ERROR)},
            usual | {"balls": self.balls - COUNT_ERROR},
            usual | {"conformity": larger},
        ]


def ball_inside(bore_m: float, outside_m: float, width_m: float, place: str) -> Inside:
    """Return the estimated inner dimensions of a single-row ball bearing.

    Parameters
    ----------
    bore_m, outside_m, width_m : float
        Boundary dimensions.
    place : str
        Name of the element, for messages.

    Examples
    --------
    >>> from ehlwave.elements.boundary import ball_inside
    >>> found = ball_inside(0.025, 0.052, 0.015, "DeepGrooveBallBearing")
    >>> found.balls, round(found.ball_diameter_m * 1e3, 2)
    (9, 8.1)
    """
    bore = above(bore_m, "bore_m", place, example="0.04")
    outside = above(outside_m, "outside_m", place, bore, example="0.08")
    width = above(width_m, "width_m", place, example="0.018")
    ball = BALL_SHARE * (outside - bore)
    if width > outside - bore:
        raise SurfaceError(
            f"{place}: width_m = {width:g} is above outside_m - bore_m = {outside - bore:g}, which "
            "no single-row ball bearing has: give the width of one row in m, such as "
            f"{0.45 * (outside - bore):.2g}"
        )
    if ball > width:
        raise SurfaceError(
            f"{place}: width_m = {width:g} is too small for balls of {ball:.3g} m, which "
            f"bore_m = {bore:g} and outside_m = {outside:g} leave room for: give the width of one "
            "row, or the inner dimensions"
        )
    pitch = (bore + outside) / 2
    balls = round(1 + math.radians(FILLING_DEG / 2) / math.asin(ball / pitch))
    errors = {
        "ball_diameter_m": DIAMETER_ERROR,
        "pitch_diameter_m": PITCH_ERROR,
        "balls": COUNT_ERROR,
        "conformity": CONFORMITY_ERROR,
    }
    return Inside(ball, pitch, balls, errors)
