"""Cams of valve trains on flat and on roller followers: line contacts along the cam.

The cam consists of circular arcs: base circle, flanks and nose. At the nose of a cam on a flat
follower the surfaces move against each other, S below 0 or above 2: no key has that, and those
places are not drawn.
"""

from collections.abc import Iterator

import numpy as np

import ehlwave
from studies.atlas.bearings import CONTACTS, log_uniform, oil_of
from studies.atlas.gears import EYRING_PA, contact

BASE_MM, LIFT_MM = (14.0, 20.0), (6.0, 11.0)
"""Radius of the base circle, and lift: valve trains of cars (Heywood 1988; Taylor 1994)."""

FLANK_OVER_BASE, NOSE_OVER_BASE = (3.0, 7.0), (0.2, 0.6)
"""Radii of flank and nose: usual of cams of circular arcs (Norton 2009)."""

FLANK_DEG = (0.0, 30.0)
"""Turned from where the flank begins."""

ROLLER_MM = (7.0, 13.0)
"""Radius of a roller."""

OBLIQUITY = (0.87, 1.0)
"""Cosine of the angle between normal and lift of roller followers: at most 30 degrees."""

ROLLER_SLIP = (0.001, 0.1)
"""Slide-to-roll ratio of rollers, of either sign for a cam over its follower (Lee and Patterson
1995; Khurram, Mufti, Zahid, Afzal and Bhutta 2015).
"""

SPEED_PER_MIN = (300.0, 3500.0)
"""Speed of the camshaft: engines at 600 to 7000 a minute."""

FLAT_PA, ROLLER_PA = (1.5e8, 7e8), (3e8, 1.3e9)
"""Hertz pressures from springs and inertia (Taylor 1994; Dowson, Taylor and Zhu 1992)."""

VISCOSITY_PA_S = (0.004, 0.1)
"""Engine oils, SAE 30 and 40 and multigrade, at 40 to 130 C."""

SEED = 1994


def cam_contacts(
    eyring: bool = True, count: int = CONTACTS, seed: int = SEED
) -> Iterator[ehlwave.Contact]:
    """Yield contacts of cams, flat and roller followers in turn, with either surface rough."""
    random = np.random.default_rng(seed)
    for number in range(count):
        base, lift = random.uniform(*BASE_MM), random.uniform(*LIFT_MM)
        turn = log_uniform(random, SPEED_PER_MIN) * np.pi / 30 * 1e-3
        draw = _roller if number % 2 else _flat
        radii, speeds, pressures = draw(random, base, lift)
        first, second = (1, 0) if number // 2 % 2 else (0, 1)
        bodies = 1e-3 * radii[first], 1e-3 * radii[second]
        moving = turn * speeds[first], turn * speeds[second]
        wanted = log_uniform(random, pressures)
        oil = oil_of(random, VISCOSITY_PA_S)
        stress = log_uniform(random, EYRING_PA)
        if eyring:
            oil["eyring_stress_pa"] = stress
        one = contact(*bodies, moving, 1.0, oil)
        yield contact(*bodies, moving, (wanted / one.conditions.hertz_pa) ** 2, oil)


Place = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]
"""Radii of cam and follower, mm, their speeds over the shaft's, mm, and pressures."""


def _flat(random: np.random.Generator, base: float, lift: float) -> Place:
    """Return a place on the flank: there the contact moves along the follower as the lift's s''."""
    flank = base * random.uniform(*FLANK_OVER_BASE)
    along = (flank - base) * float(np.cos(np.radians(random.uniform(*FLANK_DEG))))
    return (flank, np.inf), (flank, along), FLAT_PA


def _roller(random: np.random.Generator, base: float, lift: float) -> Place:
    """Return a place on base circle, flank or nose: the contact turns about the arc's centre."""
    roller = random.uniform(*ROLLER_MM)
    place = random.integers(3)
    arcs = (base, base * random.uniform(*FLANK_OVER_BASE), base * random.uniform(*NOSE_OVER_BASE))
    arc, height = arcs[place], (0.0, lift * random.random(), lift)[place]
    distance = (base + height + roller) * random.uniform(*OBLIQUITY)
    speed = arc * distance / (arc + roller)
    half = log_uniform(random, ROLLER_SLIP) / 2 * random.choice((-1, 1))
    return (arc, roller), (speed * (1 + half), speed * (1 - half)), ROLLER_PA
