"""Loads of the elements of a bearing by the equilibrium of its inner ring.

ISO 16281:2008 (equations 9 to 18): balls of a ring that is displaced by (radial, axial, tilt) are
pressed by the distance of both groove centres less the distance in the unloaded bearing, and bear K
delta^(3/2); rollers bear c_L delta^(10/9). Rings keep their form, elements do not slide, and there
are no centrifugal loads.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from ehlwave.errors import SurfaceError

Floats = NDArray[np.float64]

BALL_POWER, ROLLER_POWER = 3 / 2, 10 / 9
BALL_HALF_LOADED, ROLLER_HALF_LOADED = 1.2158, 1.2580
"""F_a/(F_r tan(alpha)) of a bearing half of whose elements bear load: integral of cos^n over half a
turn, n the power, over the integral of cos^(n + 1). Below 1 there is no equilibrium.
"""
BALANCED = 1e-9
"""Relative error of forces that a solution may leave."""


@dataclass(frozen=True)
class LoadZone:
    """Loads around a bearing.

    Attributes
    ----------
    press : callable
        Approach of both rings at an element, m, and contact angle, rad, of its angle in rad.
    stiffness : float
        Load per approach to the power, N/m^power.
    power : float
        Of the approach.
    radial_m, axial_m, tilt_rad : float
        Displacement of the inner ring from where it is centred.
    """

    press: Callable[[Floats], tuple[Floats, Floats]]
    stiffness: float
    power: float
    radial_m: float
    axial_m: float = 0.0
    tilt_rad: float = 0.0

    def loads_at(self, angle_deg: ArrayLike) -> tuple[Floats, Floats]:
        """Return loads, N, and contact angles, degrees, at angles from the direction of the load.

        Parameters
        ----------
        angle_deg : array_like
            Around the bearing.
        """
        press, contact = self.press(np.radians(np.asarray(angle_deg, dtype=np.float64)))
        loads = self.stiffness * np.maximum(press, 0) ** self.power
        return loads, np.degrees(contact)

    @property
    def half_width_deg(self) -> float:
        """Return the angle at which the load ends; 180 where all elements bear load."""
        turn = np.linspace(0, np.pi, 361)
        press = self.press(turn)[0]
        if press[-1] > 0:
            return 180.0
        last = int(np.flatnonzero(press > 0)[-1])
        end = scipy.optimize.brentq(
            lambda x: float(self.press(np.array([x]))[0][0]), turn[last], turn[last + 1]
        )
        return float(np.degrees(end))


def radial_zone(
    radial_load_n: float, elements: int, clearance_m: float, stiffness: float, power: float
) -> LoadZone:
    """Return the zone of a radial load: sum of K (d cos - s/2)^n cos = F.

    An element lies in the direction of the load.

    Parameters
    ----------
    radial_load_n, elements, clearance_m, stiffness, power
        Of the bearing; the clearance is the radial internal clearance, of a diameter.
    """
    angles = 2 * np.pi * np.arange(elements) / elements

    def force(displacement: float) -> float:
        press = np.maximum(displacement * np.cos(angles) - clearance_m / 2, 0)
        return float((stiffness * press**power * np.cos(angles)).sum())

    alone = (radial_load_n / stiffness) ** (1 / power)
    low, high = clearance_m / 2, clearance_m / 2 + 1.01 * alone
    if clearance_m < 0:
        low = 0.0
        high = max(high, alone)
    found = float(
        scipy.optimize.brentq(lambda x: force(x) - radial_load_n, low, high, xtol=1e-22, rtol=1e-15)
    )

    def press(turn: Floats) -> tuple[Floats, Floats]:
        return found * np.cos(turn) - clearance_m / 2, np.zeros_like(turn)

    return LoadZone(press, stiffness, power, found)


@dataclass(frozen=True)
class Grooves:
    """Parameters of the approach of two grooved rings.

    Attributes
    ----------
    distance_m : float
        Of both groove centres, (f_i + f_o - 1) D_w.
    free_angle_rad : float
        Contact angle without load.
    groove_radius_m : float
        Of the circle of the inner groove centres.
    pitch_radius_m : float
        Of the ball centres.
    """

    distance_m: float
    free_angle_rad: float
    groove_radius_m: float
    pitch_radius_m: float


def combined_zone(
    loads_n: tuple[float, float],
    balls: int,
    grooves: Grooves,
    stiffness: float,
    is_free_to_tilt: bool = False,
) -> LoadZone:
    """Return the zone of a radial and an axial load.

    Parameters
    ----------
    loads_n : pair of float
        Radial and axial load.
    balls, grooves, stiffness
        Of the bearing.
    is_free_to_tilt : bool
        Whether the rings tilt until no moment is left; otherwise they stay parallel.

    Raises
    ------
    SurfaceError
        If no equilibrium is found.
    """
    radial_n, axial_n = loads_n
    angles = 2 * np.pi * np.arange(balls) / balls
    a, start_angle = grooves.distance_m, grooves.free_angle_rad

    def press_of(moved: Floats) -> Callable[[Floats], tuple[Floats, Floats]]:
        def press(turn: Floats) -> tuple[Floats, Floats]:
            across = a * np.cos(start_angle) + moved[0] * np.cos(turn)
            along = a * np.sin(start_angle) + moved[1]
            along = along + grooves.groove_radius_m * np.sin(moved[2]) * np.cos(turn)
            return np.hypot(across, along) - a, np.arctan2(along, across)

        return press

    scale = max(radial_n, axial_n)
    length = (scale / stiffness / balls) ** (1 / BALL_POWER)

    def excess(given: Floats) -> Floats:
        moved = np.zeros(3)
        moved[: given.size] = given * length
        moved[2] /= grooves.groove_radius_m
        press, contact = press_of(moved)(angles)
        load = stiffness * np.maximum(press, 0) ** BALL_POWER
        sums = [
            (load * np.cos(contact) * np.cos(angles)).sum() - radial_n,
            (load * np.sin(contact)).sum() - axial_n,
            (load * np.sin(contact) * np.cos(angles)).sum(),
        ]
        return np.array(sums[: given.size]) / scale

    unknown = 3 if is_free_to_tilt else 2
    for share in (1.0, 3.0, 0.3, 10.0, 30.0):
        first = np.array([share * radial_n / scale, 3 * share * axial_n / scale, 0.0])[:unknown]
        done = scipy.optimize.root(excess, first, method="hybr", tol=1e-14)
        if np.abs(excess(done.x)).max() < BALANCED:
            moved = np.zeros(3)
            moved[:unknown] = done.x * length
            moved[2] /= grooves.groove_radius_m
            return LoadZone(press_of(moved), stiffness, BALL_POWER, *map(float, moved))
    raise SurfaceError(
        f"no equilibrium of radial_load_n = {radial_n:g} and axial_load_n = {axial_n:g}: raise the "
        "axial load, which holds an angular contact bearing together"
    )


def tapered_zone(
    loads_n: tuple[float, float],
    rollers: int,
    angle_rad: float,
    stiffness: float,
    axis_angle_deg: float,
) -> LoadZone:
    """Return the zone of rollers on cones: c_L (d_r cos(phi) cos(a) + d_a sin(a))^(10/9).

    Parameters
    ----------
    loads_n : pair of float
        Radial and axial load.
    rollers : int
        Number of rollers.
    angle_rad : float
        Contact angle a of the outer race.
    stiffness : float
        c_L.
    axis_angle_deg : float
        Angle of the roller's axis, which speeds take as contact angle.

    Raises
    ------
    SurfaceError
        If no equilibrium is found.
    """
    radial_n, axial_n = loads_n
    turn = 2 * np.pi * np.arange(rollers) / rollers
    cosine, sine = np.cos(angle_rad), np.sin(angle_rad)
    alone = axial_n / rollers / sine
    length = (max(alone, radial_n / rollers) / stiffness) ** (1 / ROLLER_POWER)

    def press_at(moved: Floats, angles: Floats) -> Floats:
        return np.asarray(moved[0] * np.cos(angles) * cosine + moved[1] * sine)

    def excess(given: Floats) -> Floats:
        load = stiffness * np.maximum(press_at(given * length, turn), 0) ** ROLLER_POWER
        forces = (load * cosine * np.cos(turn)).sum() - radial_n, (load * sine).sum() - axial_n
        return np.array(forces) / max(loads_n)

    for share in (1.0, 0.3, 3.0, 10.0):
        start = np.array([share * 3 * radial_n / max(loads_n), share / sine])
        done = scipy.optimize.root(excess, start, method="hybr", tol=1e-14)
        if np.abs(excess(done.x)).max() < BALANCED:
            moved = done.x * length
            tilted = np.radians(axis_angle_deg)
            return LoadZone(
                _rigid(press_at, moved, tilted),
                stiffness,
                ROLLER_POWER,
                *map(float, moved),
            )
    raise SurfaceError(
        f"no equilibrium of radial_load_n = {radial_n:g} and axial_load_n = {axial_n:g}: raise the "
        "axial load, which holds a tapered bearing together, above "
        f"{radial_n * np.tan(angle_rad):.4g} N"
    )


def _rigid(
    press_at: Callable[[Floats, Floats], Floats], moved: Floats, contact_rad: float
) -> Callable[[Floats], tuple[Floats, Floats]]:
    """Return approaches of displaced cones, with the same contact angle everywhere."""
    return lambda turn: (press_at(moved, turn), np.full_like(turn, contact_rad))
