"""Histories of stress of material points of either body while they pass a rough contact."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.stress.midplane import hertz_midplane_stress
from ehlwave.stress.passage import edge_factor_below, ripple_stresses
from ehlwave.stress.waves import COMPONENTS
from ehlwave.surface.ripple import hertz_pressure_of
from ehlwave.surface.rough_pressure import Ripple

Floats = NDArray[np.float64]
Stresses = dict[str, Floats]

INSIDE = 40
"""Places inside the contact, one in each of so many parts of it: no wave is in step with them."""

REACH = 1.3
"""In semi-axes: beyond it nothing is felt of the ripple."""

OUTSIDE = (1.0, 1.08, 1.25, 1.6, 2.5)
"""Places before and behind it, in semi-axes."""

POINTS = 128
"""Most points of a surface that are followed, evenly spread."""

EXTREMES = 24
"""Points followed besides: where the pressure ripple is largest and smallest."""


@dataclass(frozen=True)
class Histories:
    """Stresses of material points of a body over their passage, at places X of the contact."""

    places_m: Floats
    """X, 0 the contact centre; shape shape (time,)."""
    depths_m: Floats
    """Depths; shape shape (z,)."""
    points_m: Floats
    """Place on the body, m: along its motion, of ridges along rolling across it; shape shape
    (points,)."""
    even: int
    """How many of the points, the first, are evenly spread."""
    met: tuple[tuple[Floats, NDArray[np.intp]], ...]
    """Indices of the points on each rough surface, and of their lines."""
    fall: Floats
    """Ripple over the ripple at the centre, shape (time, z)."""
    ripple: Stresses
    smooth: Stresses
    """`ripple`, `smooth`: stresses by component, Pa: of the ripple over (time, z, points), and of
    the smooth contact over (time, z, 1)."""

    @property
    def total(self) -> Stresses:
        """Return their sum."""
        return {name: self.smooth[name] + self.ripple[name] for name in COMPONENTS}


def places_of(semi_axis_m: float) -> Floats:
    """Return places X at which points are followed, m."""
    part = 2 / INSIDE
    # Fractions of the golden ratio are spread evenly, and repeat nothing.
    within = (np.arange(INSIDE) * 0.6180339887498949) % 1
    inside = -1 + part * (np.arange(INSIDE) + within)
    outside = np.array(OUTSIDE)
    return semi_axis_m * np.concatenate([-outside[::-1], inside, outside])


def follow(
    conditions: Conditions,
    ripples: Sequence[Ripple],
    own: Ripple | None,
    slip: float,
    depths_m: Floats,
    friction: float,
    poisson_ratio: float,
    smooth: xr.Dataset | None = None,
) -> Histories:
    """Return the histories of points of a body.

    Parameters
    ----------
    conditions : Conditions
        Of the contact.
    ripples : sequence of Ripple
        Of all rough surfaces.
    own : Ripple or None
        Slip parameter of the body; None: it is smooth, and followed where it meets the first.
    slip : float
        S of the body.
    depths_m : ndarray
        Depths.
    friction, poisson_ratio : float
        Traction on the body along +x over the pressure; Poisson's ratio.
    smooth : Dataset, optional
        Stresses of the smooth contact in the plane y = 0, over (z, x), 0 the centre; else Hertz'.
    """
    a, b = conditions.semi_axis_a_m, conditions.semi_axis_b_m
    places = places_of(a)
    leader = own or ripples[0]
    at, lines, even = _chosen(leader)
    step = leader.length_m / leader.points
    points = at * step * slip / leader.slip if leader.moves else leader.lines_m[lines]
    shape = (places.size, depths_m.size, at.size)
    ripple = {name: np.zeros(shape) for name in COMPONENTS}
    fall = edge_factor_below(places / a, depths_m / a, b / a)
    near = np.abs(places) < REACH * a
    fall[~near] = 0
    met = []
    for one in ripples:
        meets = at if one is leader else _met(one, points * one.slip / slip)
        rows = lines % one.lines_m.size
        met.append((meets, rows))
        found = ripple_stresses(
            one, places[near], depths_m, one.slip / slip, friction, poisson_ratio
        )
        for time, stresses in zip(np.flatnonzero(near), found, strict=True):
            for name, values in stresses.items():
                ripple[name][time] += fall[time][:, None] * _picked(values, meets, rows)
    if smooth is None:
        hertz = hertz_pressure_of(conditions)
        known = hertz_midplane_stress(places, depths_m, (a, b), hertz, friction, poisson_ratio)
    else:
        x = smooth["x"].values
        known = {
            name: np.array([np.interp(places, x, line) for line in smooth[name].values])
            for name in COMPONENTS
        }
    over_time = {name: np.asarray(known[name]).T[..., None] for name in COMPONENTS}
    return Histories(places, depths_m, points, even, tuple(met), fall, ripple, over_time)


def _chosen(ripple: Ripple) -> tuple[Floats, NDArray[np.intp], int]:
    """Return indices of points and of lines to follow, and how many of them are evenly spread."""
    pressure = ripple.pressure()[: ripple.measured]
    count, lines = pressure.shape
    along = POINTS // lines if ripple.moves else 1
    rows = np.unique(np.linspace(0, count - 1, min(count, along)).round().astype(int))
    across = lines if ripple.moves else min(lines, POINTS)
    columns = np.unique(np.linspace(0, lines - 1, across).round().astype(int))
    even = np.stack([part.ravel() for part in np.meshgrid(rows, columns, indexing="ij")])
    extremes = np.array(np.unravel_index(_extremes(pressure), pressure.shape))
    chosen = np.concatenate([even, extremes], axis=1)
    return chosen[0].astype(float), chosen[1], even.shape[1]


def _extremes(pressure: Floats) -> NDArray[np.intp]:
    """Return flat indices of the largest and the smallest values that neighbours do not exceed."""
    axis = 0 if pressure.shape[0] > 1 else 1
    ahead, behind = np.roll(pressure, -1, axis), np.roll(pressure, 1, axis)
    turns = (pressure - ahead) * (pressure - behind) > 0
    flat = np.flatnonzero(turns.ravel())
    order = np.argsort(-np.abs(pressure.ravel()[flat]))
    return flat[order[:EXTREMES]]


def _met(ripple: Ripple, place_m: Floats) -> Floats:
    """Return the indices of points of another surface at places of it."""
    if not ripple.moves:
        return np.zeros(place_m.shape)
    return np.asarray(place_m / ripple.length_m * ripple.points % ripple.points)


def _picked(values: Floats, at: Floats, lines: NDArray[np.intp]) -> Floats:
    """Return values of (z, points, lines) between points, (z, chosen)."""
    low = np.floor(at).astype(int)
    share = at - low
    count = values.shape[1]
    first, second = values[:, low % count, lines], values[:, (low + 1) % count, lines]
    return first + share * (second - first)
