"""Loads of the elements of a bearing by the equilibrium of its inner ring.

ISO 16281:2008 (equations 9 to 18): balls of a ring that is displaced by (radial, axial, tilt) are
pressed by the distance of both groove centres less the distance in the unloaded bearing, and bear K
delta^(3/2); rollers bear c_L delta^(10/9). Rings keep their form, and elements do not slide. With
speeds, the outer race bears the centrifugal force of each element as well
(:mod:`ehlwave.elements.races`), which ISO 16281 leaves out.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from ehlwave.choices import chosen
from ehlwave.elements.races import Grooves, Races, ball_loads
from ehlwave.errors import SurfaceError

Floats = NDArray[np.float64]
Borne = tuple[tuple[Floats, Floats], tuple[Floats, Floats]]
"""Loads, N, and contact angles, rad, on the inner and on the outer race."""

RINGS = ("inner", "outer")
BALL_POWER, ROLLER_POWER = 3 / 2, 10 / 9
BALL_HALF_LOADED, ROLLER_HALF_LOADED = 1.2158, 1.2580
"""F_a/(F_r tan(alpha)) of a bearing half of whose elements bear load: integral of cos^n over half a
turn, n the power, over the integral of cos^(n + 1). Below 1 there is no equilibrium.
"""
EDGE = 0.95
"""Part of the half width of the load zone that tables show: at its end there is no load."""
BALANCED = 1e-9
"""Relative error of forces that a solution may leave."""
HALVINGS = 50
"""Halvings of the interval that contains the end of the load zone."""


@dataclass(frozen=True)
class LoadZone:
    """Loads around a bearing.

    Attributes
    ----------
    bear : callable
        Loads and contact angles on both races at an element's angle, rad.
    radial_m, axial_m, tilt_rad : float
        Displacement of the inner ring from where it is centred.
    """

    bear: Callable[[Floats], Borne]
    radial_m: float
    axial_m: float = 0.0
    tilt_rad: float = 0.0

    def loads_at(self, angle_deg: ArrayLike, ring: str = "inner") -> tuple[Floats, Floats]:
        """Return loads, N, and contact angles, degrees, at angles from the direction of the load.

        Parameters
        ----------
        angle_deg : array_like
            Around the bearing.
        ring : {"inner", "outer"}
            The ring; outside the load zone the outer ring bears the centrifugal force alone.
        """
        place = RINGS.index(chosen(ring, "ring", RINGS))
        loads, contact = self.bear(np.radians(np.asarray(angle_deg, dtype=np.float64)))
        return loads[place], np.degrees(contact[place])

    @property
    def half_width_deg(self) -> float:
        """Return the angle at which the load ends; 180 where all elements bear load."""
        turn = np.linspace(0, 180, 361)
        loaded = self.loads_at(turn)[0] > 0
        if loaded[-1]:
            return 180.0
        last = int(np.flatnonzero(loaded)[-1])
        low, high = turn[last], turn[last + 1]
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if self.loads_at([middle])[0][0] > 0 else (low, middle)
        return float(low)

    def angles_deg(self, points: int) -> Floats:
        """Return angles evenly spread over the load zone, with the most loaded, 0, among them.

        An odd number above 1 reaches both ends, an even number the upper end alone.

        Parameters
        ----------
        points : int
            Number of angles.
        """
        places = np.arange(points) - (points - 1) // 2
        return np.asarray(EDGE * self.half_width_deg * places / max(points // 2, 1))


def radial_zone(radial_load_n: float, elements: int, clearance_m: float, races: Races) -> LoadZone:
    """Return the zone of a radial load: the sum of Q(d cos - s/2) cos is F.

    An element lies in the direction of the load.

    Parameters
    ----------
    radial_load_n, elements, clearance_m, races
        Of the bearing; the clearance is the radial internal clearance, of a diameter.
    """
    angles = 2 * np.pi * np.arange(elements) / elements

    def inner(displacement: float, turn: Floats) -> Floats:
        return races.inner_load(displacement * np.cos(turn) - clearance_m / 2)

    def excess(displacement: float) -> float:
        return float((inner(displacement, angles) * np.cos(angles)).sum()) - radial_load_n

    alone = races.lifted_m + (radial_load_n / races.stiffness) ** (1 / races.power)
    low, high = clearance_m / 2, clearance_m / 2 + 1.01 * alone
    if clearance_m < 0:
        low = 0.0
        high = max(high, alone)
    found = float(scipy.optimize.brentq(excess, low, high, xtol=1e-22, rtol=1e-15))

    def bear(turn: Floats) -> Borne:
        load = inner(found, turn)
        flat = np.zeros_like(turn)
        return (load, load + races.centrifugal_n), (flat, flat)

    return LoadZone(bear, found)


def combined_zone(
    loads_n: tuple[float, float],
    balls: int,
    grooves: Grooves,
    races: Races,
    is_free_to_tilt: bool = False,
) -> LoadZone:
    """Return the zone of a radial and an axial load.

    Parameters
    ----------
    loads_n : pair of float
        Radial and axial load.
    balls, grooves, races
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
    scale = max(radial_n, axial_n)
    length = (scale / races.stiffness / balls) ** (1 / BALL_POWER)
    units = length * np.array([1.0, 1.0, 1 / grooves.groove_radius_m])

    def bear_of(moved: Floats) -> Callable[[Floats], Borne]:
        def bear(turn: Floats) -> Borne:
            across = a * np.cos(start_angle) + grooves.preload_m + moved[0] * np.cos(turn)
            along = a * np.sin(start_angle) + moved[1]
            along = along + grooves.groove_radius_m * np.sin(moved[2]) * np.cos(turn)
            return ball_loads(along, across, grooves, races)

        return bear

    def moved_by(given: Floats) -> Floats:
        return np.asarray(np.pad(given, (0, 3 - given.size)) * units)

    def excess(given: Floats) -> Floats:
        (load, _), (contact, _) = bear_of(moved_by(given))(angles)
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
            moved = moved_by(done.x)
            return LoadZone(bear_of(moved), *map(float, moved))
    raise _no_balance(
        loads_n, "raise the axial load, which holds an angular contact bearing together"
    )


def tapered_zone(
    loads_n: tuple[float, float],
    rollers: int,
    angle_rad: float,
    races: Races,
    axis_angle_deg: float,
) -> LoadZone:
    """Return the zone of rollers on cones: c_L (d_r cos(phi) cos(a) + d_a sin(a))^(10/9).

    The rib of the inner ring holds each roller along its axis. Both give the inner ring the load of
    the outer race less the centrifugal force.

    Parameters
    ----------
    loads_n : pair of float
        Radial and axial load.
    rollers : int
        Number of rollers.
    angle_rad : float
        Contact angle a of the outer race.
    races : Races
        Of the bearing, with the centrifugal force normal to the outer race.
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
    # Pressed outward, the rollers bear a part of the axial load through their rib.
    left_n = axial_n - rollers * races.centrifugal_n * sine
    advice = (
        "raise the axial load, which holds a tapered bearing together, above "
        f"{radial_n * np.tan(angle_rad) + axial_n - left_n:.4g} N"
    )
    if left_n <= 0:
        raise _no_balance(loads_n, advice)
    alone = left_n / rollers / sine
    length = (max(alone, radial_n / rollers) / races.stiffness) ** (1 / ROLLER_POWER)

    def inner(moved: Floats, angles: Floats) -> Floats:
        press = moved[0] * np.cos(angles) * cosine + moved[1] * sine
        return races.inner_load(press + races.lifted_m)

    def excess(given: Floats) -> Floats:
        load = inner(given * length, turn)
        forces = (load * cosine * np.cos(turn)).sum() - radial_n, (load * sine).sum() - left_n
        return np.array(forces) / max(loads_n)

    for share in (1.0, 0.3, 3.0, 10.0):
        start = np.array([share * 3 * radial_n / max(loads_n), share / sine])
        done = scipy.optimize.root(excess, start, method="hybr", tol=1e-14)
        if np.abs(excess(done.x)).max() < BALANCED:
            moved = done.x * length
            break
    else:
        raise _no_balance(loads_n, advice)

    def bear(angles: Floats) -> Borne:
        load, axis = inner(moved, angles), np.full_like(angles, np.radians(axis_angle_deg))
        return (load, load + races.centrifugal_n), (axis, axis)

    return LoadZone(bear, *map(float, moved))


def _no_balance(loads_n: tuple[float, float], advice: str) -> SurfaceError:
    radial_n, axial_n = loads_n
    return SurfaceError(
        f"no equilibrium of radial_load_n = {radial_n:g} and axial_load_n = {axial_n:g}: {advice}"
    )
