"""Spur gears along the line of action: standard teeth, usual loads, speeds and gear oils."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

import ehlwave
from studies.atlas.bearings import CONTACTS, log_uniform, oil_of

MODULES_MM = (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10)
"""Series I of ISO 54 up to 10 mm."""

ANGLE_DEG, ADDENDUM = 20.0, 1.0
"""Pressure angle, and addendum over module, of the basic rack of ISO 53."""

PINION_TEETH = (17, 40)
"""From the fewest without undercut."""

RATIO = (1.0, 5.0)
"""Ratio of teeth, of one stage, usual of spur gears (Niemann and Winter 2003)."""

PITCH_LINE_M_PER_S = (1.0, 20.0)
"""Usual of spur gears: ISO 1328 classes 6 to 9 (Niemann and Winter 2003)."""

PRESSURE_PA = (4e8, 1.3e9)
"""Hertz pressure at the pitch point: up to the limit of ISO 6336-5 for case-hardened steel (1300 to
1650 MPa) less the usual safety; the lower end is normalised steel.
"""

LEAST_SHARE = 1 / 3
"""Load of a tooth where its contact begins and ends, with two pairs in contact: ISO/TS 6336-22,
rising linearly to twice this where a single pair bears all.
"""

VISCOSITY_PA_S = (0.008, 0.25)
"""Where they run: ISO VG 68 to 460 at 50 to 100 C."""

EYRING_PA = (1e6, 1e7)
"""Usual of gear oils (Johnson and Tevaarwerk 1977; Evans and Johnson 1986)."""

SEED = 54


class Mesh(NamedTuple):
    """Two gears of a module of 1: teeth of both."""

    pinion: int
    wheel: int

    @property
    def base(self) -> tuple[float, float]:
        """Radii of the base circles."""
        cosine = np.cos(np.radians(ANGLE_DEG))
        return self.pinion * cosine / 2, self.wheel * cosine / 2

    @property
    def path(self) -> tuple[float, float]:
        """Where contact begins and ends along the line of action, from the pinion's base circle."""
        whole = (self.pinion + self.wheel) / 2 * np.sin(np.radians(ANGLE_DEG))
        tips = [
            float(np.sqrt((teeth / 2 + ADDENDUM) ** 2 - base**2))
            for teeth, base in zip(self, self.base, strict=True)
        ]
        return max(float(whole) - tips[1], 0.0), min(tips[0], float(whole))

    def radii(self, place: float) -> tuple[float, float]:
        """Return the radii of both flanks at a place of the line of action."""
        whole = (self.pinion + self.wheel) / 2 * np.sin(np.radians(ANGLE_DEG))
        return place, float(whole) - place

    def share(self, place: float) -> float:
        """Return the share of the load that the pair in contact at a place has."""
        first, last = self.path
        pitch = np.pi * np.cos(np.radians(ANGLE_DEG))
        alone = last - pitch, first + pitch
        if alone[0] <= place <= alone[1]:
            return 1.0
        way = (place - first) if place < alone[0] else (last - place)
        return float(LEAST_SHARE * (1 + way / (alone[0] - first)))


def gear_contacts(
    eyring: bool = True, count: int = CONTACTS, seed: int = SEED
) -> Iterator[ehlwave.Contact]:
    """Yield contacts of gears, the rough flank on the pinion and on the wheel in turn."""
    random = np.random.default_rng(seed)
    for number in range(count):
        teeth = int(random.integers(*PINION_TEETH, endpoint=True))
        mesh = Mesh(teeth, round(teeth * random.uniform(*RATIO)))
        module = 1e-3 * float(random.choice(MODULES_MM))
        place = float(random.uniform(*mesh.path))
        radii = mesh.radii(place)
        turn = log_uniform(random, PITCH_LINE_M_PER_S) / (mesh.pinion / 2)
        speeds = turn * radii[0], turn * mesh.pinion / mesh.wheel * radii[1]
        wanted = log_uniform(random, PRESSURE_PA)
        oil = oil_of(random, VISCOSITY_PA_S)
        stress = log_uniform(random, EYRING_PA)
        if eyring:
            oil["eyring_stress_pa"] = stress
        pinion, wheel = mesh.radii(float(mesh.base[0] * np.tan(np.radians(ANGLE_DEG))))
        at_pitch = contact(module * pinion, module * wheel, (1.0, 1.0), 1.0, oil)
        load = (wanted / at_pitch.conditions.hertz_pa) ** 2 * mesh.share(place)
        first, second = (1, 0) if number % 2 else (0, 1)
        flanks = module * radii[first], module * radii[second]
        yield contact(*flanks, (speeds[first], speeds[second]), load, oil)


def contact(
    first_m: float,
    second_m: float,
    speeds: tuple[float, ...],
    load_n_per_m: float,
    oil: dict[str, Any],
) -> ehlwave.Contact:
    """Return a line contact of two steel bodies of these radii."""
    bodies = (ehlwave.Body(radius_x_m=radius, material="steel") for radius in (first_m, second_m))
    return ehlwave.Contact.from_bodies(
        *bodies, load_n_per_m=load_n_per_m, speeds_m_per_s=speeds, **oil
    )
