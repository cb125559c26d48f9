"""Contacts of a ball or roller with both races, under its centrifugal force."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

STEPS = 60
"""Newton steps at most; a few are usual."""
BALANCED = 1e-12
"""Force that may be left on a ball, over its largest load."""


@dataclass(frozen=True)
class Races:
    """Both contacts of an element, which bear K delta^n each.

    Attributes
    ----------
    stiffnesses : pair of float
        K on the inner and on the outer race, N/m^n.
    power : float
        n.
    centrifugal_n : float
        Centrifugal force that presses the element on the outer race, N.
    """

    stiffnesses: tuple[float, float]
    power: float
    centrifugal_n: float = 0.0

    @property
    def softness(self) -> Floats:
        """Return K^(-1/n) of both races."""
        return np.asarray(self.stiffnesses) ** (-1 / self.power)

    @property
    def stiffness(self) -> float:
        """Return K of both contacts in series."""
        return float(self.softness.sum() ** -self.power)

    @property
    def lifted_m(self) -> float:
        """Return the approach of both races below which the inner race bears no load."""
        return float((self.centrifugal_n / self.stiffnesses[1]) ** (1 / self.power))

    def inner_load(self, approach_m: ArrayLike) -> Floats:
        """Return the load of the inner race; the outer race bears the centrifugal force as well.

        Solves (Q/K_i)^(1/n) + ((Q + F)/K_o)^(1/n) = delta. The left side is concave in Q, and the
        start is below its root, so that Newton's steps rise to the root.

        Parameters
        ----------
        approach_m : array_like
            Approach of both races, delta, m.
        """
        inner, outer = self.softness
        root = np.maximum(np.asarray(approach_m) - self.lifted_m, 0) / (inner + outer)
        load = np.asarray(root**self.power, dtype=np.float64)
        if self.centrifugal_n == 0:
            return load
        here = load > 0
        found, delta, share = load[here], np.asarray(approach_m)[here], 1 / self.power
        for _ in range(STEPS):
            borne = found + self.centrifugal_n
            off = inner * found**share + outer * borne**share - delta
            step = off / (share * (inner * found ** (share - 1) + outer * borne ** (share - 1)))
            found = found - step
            if np.all(np.abs(step) <= BALANCED * found):
                break
        load[here] = found
        return load


@dataclass(frozen=True)
class Grooves:
    """Parameters of the approach of two grooved rings.

    Attributes
    ----------
    radii_m : pair of float
        Distance of a ball's centre from the groove centres without load, (f - 1/2) D_w, inner and
        outer ring.
    free_angle_rad : float
        Contact angle without load.
    groove_radius_m : float
        Of the circle of the inner groove centres.
    preload_m : float
        Radial approach of the centred rings.
    """

    radii_m: tuple[float, float]
    free_angle_rad: float
    groove_radius_m: float
    preload_m: float = 0.0

    @property
    def distance_m(self) -> float:
        """Return the distance of both groove centres, (f_i + f_o - 1) D_w."""
        return sum(self.radii_m)


def ball_loads(
    along: Floats, across: Floats, grooves: Grooves, races: Races
) -> tuple[tuple[Floats, Floats], tuple[Floats, Floats]]:
    """Return loads, N, and contact angles, rad, of balls on the inner and on the outer race.

    A ball is in equilibrium under both contact forces and its centrifugal force (Jones 1960;
    Harris and Kotzalas, *Advanced Concepts of Bearing Technology*, chapter 3, from memory); the
    gyroscopic moment is left out. The place of the ball's centre is the minimum of a convex
    energy, which damped Newton steps find. Without centrifugal force the centre lies on the line
    between the groove centres.

    Parameters
    ----------
    along, across : array_like, of the same shape
        Axial and radial distance of the inner groove centre from the outer groove centre, m.
    grooves, races
        Of the bearing.
    """
    centre, force = np.stack([along, across]), races.centrifugal_n
    distance = np.hypot(*centre)
    if force == 0:
        load = races.inner_load(distance - grooves.distance_m)
        angle = np.arctan2(along, across)
        return (load, load), (angle, angle)
    inner, outer = races.softness
    press = np.maximum(distance - grooves.distance_m, 0) * outer / (inner + outer)
    ball = centre / distance * (grooves.radii_m[1] + press + races.lifted_m)
    scale = races.inner_load(distance - grooves.distance_m) + force
    eye = np.eye(2)[:, :, None]

    def contacts(ball: Floats) -> list[tuple[Floats, Floats, Floats]]:
        """Return direction, distance and approach of both contacts."""
        found = []
        for vector, radius in zip((ball - centre, ball), grooves.radii_m, strict=True):
            length = np.hypot(*vector)
            found.append((vector / length, length, np.maximum(length - radius, 0)))
        return found

    def excess(ball: Floats) -> Floats:
        """Return the force that is left, the gradient of the energy."""
        both = zip(races.stiffnesses, contacts(ball), strict=True)
        total = sum(k * delta**races.power * unit for k, (unit, _, delta) in both)
        return np.asarray(total - np.array([[0.0], [force]]))

    left = excess(ball)
    for _ in range(STEPS):
        if np.all(np.hypot(*left) <= BALANCED * scale):
            break
        a, b, d = 0.0, 0.0, 0.0
        for k, (unit, length, delta) in zip(races.stiffnesses, contacts(ball), strict=True):
            normal = unit[:, None] * unit[None, :]
            along_it = races.power * k * delta ** (races.power - 1)
            bent = along_it * normal + k * delta**races.power / length * (eye - normal)
            a, b, d = a + bent[0, 0], b + bent[0, 1], d + bent[1, 1]
        step = np.stack([b * left[1] - d * left[0], b * left[0] - a * left[1]]) / (a * d - b * b)
        step = np.where(np.hypot(*left) <= BALANCED * scale, 0.0, step)
        slope, share = (left * step).sum(axis=0), np.ones_like(across)
        for _ in range(STEPS):
            left = excess(ball + share * step)
            beyond = (left * step).sum(axis=0) > -slope / 2
            if not beyond.any():
                break
            share = np.where(beyond, share / 2, share)
        ball = ball + share * step
    loads, angles = [], []
    for sign, k, (unit, _, delta) in zip((-1, 1), races.stiffnesses, contacts(ball), strict=True):
        loads.append(k * delta**races.power)
        angles.append(np.arctan2(sign * unit[0], sign * unit[1]))
    return (loads[0], loads[1]), (angles[0], angles[1])
