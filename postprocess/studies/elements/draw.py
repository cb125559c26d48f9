"""Elements drawn over the range of catalogues: dimensions, loads, speeds, oils.

Ranges of bearings, gears and cams are the ranges of :mod:`studies.atlas`, with their sources.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from ehlwave import Oil
from ehlwave.contact.viscosity_grade import ISO_GRADES
from ehlwave.elements import (
    AngularContactBallBearing,
    BallOnDisc,
    CamFollower,
    CylindricalRollerBearing,
    DeepGrooveBallBearing,
    HelicalGearPair,
    MiniTraction,
    SpurGearPair,
    TaperedRollerBearing,
    TwoDisc,
)
from ehlwave.elements.bearing import RINGS, RollingBearing
from ehlwave.elements.boundary import FILLING_DEG
from ehlwave.elements.load_zone import ROLLER_HALF_LOADED
from ehlwave.elements.place import ElementContact
from ehlwave.errors import SurfaceError
from studies.atlas import bearings, cams, gears
from studies.atlas.bearings import log_uniform

Random = np.random.Generator
Places = list[ElementContact]

SEED = 5800
CELSIUS = (40.0, 100.0)
WARM = {"heat": True}
ROLLER_LENGTH = (1.0, 1.6)
"""Effective length over diameter of cylindrical rollers (Harris and Kotzalas 2007)."""
TAPER_DEG = (10.0, 30.0)
"""Contact angles of the series 2 to 7 of ISO 355."""
TAPER_LENGTH = (1.2, 2.0)
AXIAL_OVER_OWN = (1.0, 3.0)
"""Axial load of tapered bearings over the load at which half of the rollers bear load."""
RADIAL_OVER_AXIAL = (0.0, 1.0)
WIDTH_OVER_MODULE = (6.0, 15.0)
HELIX_DEG = (8.0, 30.0)
"""Usual of spur and helical gears (Niemann and Winter 2003)."""
RISE_DEG, CAM_WIDTH_M = (55.0, 75.0), (8e-3, 2e-2)
SPRING_N, SPRING_N_PER_M, TRAIN_KG = (150.0, 400.0), (2e4, 6e4), (0.05, 0.2)
"""Valve trains of cars (Heywood 1988; Taylor 1994)."""
BALLS_M, DISC_LOADS_N, DISC_SPEEDS = (0.0127, 0.01905, 0.0254), (5.0, 50.0), (0.02, 4.0)
TRACTION_LOADS_N, TRACTION_SPEEDS, TRACTION_SLIP = (5.0, 75.0), (0.05, 3.5), (0.01, 1.9)
"""Ranges of commercial rigs: data sheets, from memory."""
DISCS_M, DISC_WIDTH_M, DISC_PA = (0.03, 0.12), (4e-3, 2e-2), (4e8, 1.8e9)
DISC_RATES, DISC_SLIP = (0.5, 15.0), (0.005, 0.5)


def oil(random: Random, viscosity: tuple[float, float], slides: bool = True) -> Oil:
    """Return a mineral oil of a grade at a temperature, with a viscosity in this range.

    Surfaces that slide need the Eyring stress, which no data sheet has; others have none.
    """
    flow = {"eyring_stress_pa": log_uniform(random, gears.EYRING_PA)} if slides else {}
    while True:
        found = Oil.from_grade(
            iso_vg=float(random.choice([one for one in ISO_GRADES if 15 <= one <= 460])),
            viscosity_index=95,
            temperature_k=273.15 + random.uniform(*CELSIUS),
            **flow,
        )
        if viscosity[0] <= found.viscosity_pa_s <= viscosity[1]:
            return found


def _inside(random: Random, share: tuple[float, float], series: tuple[str, ...]) -> Any:  # noqa: ANN401
    """Return diameter of balls or rollers, pitch diameter and number by the usual filling angle."""
    known = bearings.BOUNDARIES_MM[str(random.choice(series))]
    bore, outer = known[random.integers(len(known))]
    size, pitch = (outer - bore) * random.uniform(*share), (bore + outer) / 2
    filled = 1 + np.radians(FILLING_DEG / 2) / np.arcsin(size / pitch)
    return 1e-3 * size, 1e-3 * pitch, round(float(filled))


def _zone(random: Random, bearing: RollingBearing, **loads: float) -> Places:
    """Return the most and the least loaded contact of both rings."""
    speed = log_uniform(random, bearings.SPEED_FACTOR) / (1e3 * bearing.pitch_diameter_m)
    own = oil(random, bearings.VISCOSITY_PA_S, slides=False)
    found = []
    for ring in RINGS:
        every = bearing.contacts(ring=ring, inner_speed_rpm=speed, oil=own, options=WARM, **loads)
        every.sort(key=lambda place: place.load_n)
        found += [every[-1], every[0]] if len(every) > 1 else every
    return found


def _rated_n(bearing: RollingBearing, pressure_pa: float, power: int, angle: float = 0.0) -> float:
    """Return the load of an element at which the inner race has a Hertz pressure."""
    bodies, length = bearing.bodies("inner", angle), bearing.length_m()
    thin = Oil(viscosity_pa_s=0.01, pressure_viscosity_per_pa=2e-8)
    one = ElementContact(bodies, thin, (1.0, 1.0), 1.0, length)
    return float((pressure_pa / one.hertz_pressure_pa) ** power)


def deep_groove(random: Random) -> Places:
    """Return contacts of a deep groove bearing under a radial load."""
    size, pitch, balls = _inside(random, bearings.BALL_SHARE, ("60", "62", "63"))
    grooves = tuple(random.uniform(*bearings.OSCULATION, 2))
    bearing = DeepGrooveBallBearing(
        ball_diameter_m=size, pitch_diameter_m=pitch, balls=balls, conformity=grooves
    )
    most = _rated_n(bearing, bearings.RATED_PA, 3) * log_uniform(random, bearings.LOAD_SHARE)
    return _zone(random, bearing, radial_load_n=most * balls / 5)


def angular_contact(random: Random) -> Places:
    """Return contacts of an angular contact bearing under thrust and a radial load."""
    size, pitch, _ = _inside(random, bearings.BALL_SHARE, ("60", "62", "63"))
    angle = float(random.choice([one for one in bearings.ANGLES_DEG if one]))
    balls = int(0.85 * np.pi * pitch / size)
    bearing = AngularContactBallBearing(
        ball_diameter_m=size,
        pitch_diameter_m=pitch,
        balls=balls,
        contact_angle_deg=angle,
        conformity=tuple(random.uniform(*bearings.OSCULATION, 2)),
    )
    most = _rated_n(bearing, bearings.RATED_PA, 3, angle)
    most *= log_uniform(random, bearings.LOAD_SHARE)
    axial = balls * most * float(np.sin(np.radians(angle))) / 2
    radial = axial * random.uniform(*RADIAL_OVER_AXIAL)
    return _zone(random, bearing, axial_load_n=axial, radial_load_n=radial)


def cylindrical(random: Random) -> Places:
    """Return contacts of a cylindrical roller bearing."""
    size, pitch, _ = _inside(random, bearings.ROLLER_SHARE, bearings.ROLLER_SERIES)
    rollers = int(0.8 * np.pi * pitch / size)
    bearing = CylindricalRollerBearing(
        roller_diameter_m=size,
        roller_length_m=size * random.uniform(*ROLLER_LENGTH),
        pitch_diameter_m=pitch,
        rollers=rollers,
    )
    most = _rated_n(bearing, bearings.RATED_LINE_PA, 2) * log_uniform(random, bearings.LOAD_SHARE)
    return _zone(random, bearing, radial_load_n=most * rollers / 4)


def tapered(random: Random) -> Places:
    """Return contacts of a tapered bearing, the apexes of whose cones meet."""
    size, pitch, _ = _inside(random, bearings.ROLLER_SHARE, bearings.ROLLER_SERIES)
    outer = random.uniform(*TAPER_DEG)
    half = np.degrees(np.arctan(size * np.sin(np.radians(outer)) / pitch))
    rollers = int(0.8 * np.pi * pitch / size)
    bearing = TaperedRollerBearing(
        roller_diameter_m=size,
        roller_length_m=size * random.uniform(*TAPER_LENGTH),
        pitch_diameter_m=pitch,
        rollers=rollers,
        inner_angle_deg=float(outer - 2 * half),
        outer_angle_deg=outer,
    )
    most = _rated_n(bearing, bearings.RATED_LINE_PA, 2) * log_uniform(random, bearings.LOAD_SHARE)
    radial = most * rollers / 4
    half_loaded = ROLLER_HALF_LOADED * radial * float(np.tan(np.radians(outer)))
    axial = half_loaded * random.uniform(*AXIAL_OVER_OWN)
    return _zone(random, bearing, radial_load_n=radial, axial_load_n=axial)


def _gear(random: Random, helix: float | None) -> Places:
    """Return five contacts from A to E."""
    module, teeth = 1e-3 * float(random.choice(gears.MODULES_MM)), random.integers(17, 41)
    dimensions = {
        "module_m": module,
        "teeth": (int(teeth), round(float(teeth) * random.uniform(*gears.RATIO))),
        "face_width_m": module * random.uniform(*WIDTH_OVER_MODULE),
    }
    pair = (
        SpurGearPair(**dimensions)
        if helix is None
        else HelicalGearPair(**dimensions, helix_angle_deg=helix)
    )
    own, wanted = oil(random, gears.VISCOSITY_PA_S), log_uniform(random, gears.PRESSURE_PA)
    pitch = pair.geometry.named_points_m["C"]
    rolling = log_uniform(random, gears.PITCH_LINE_M_PER_S)
    turn = 60 * rolling / (np.pi * module * float(teeth))
    given = {"pinion_speed_rpm": turn, "oil": own, "options": WARM}
    one = pair.contact_at(pitch, pinion_torque_n_m=1.0, **given)
    torque = (wanted / one.hertz_pressure_pa) ** 2
    return pair.places(points=5, pinion_torque_n_m=torque, **given)


def spur(random: Random) -> Places:
    """Return contacts of a spur pair."""
    return _gear(random, None)


def helical(random: Random) -> Places:
    """Return contacts of a helical pair."""
    return _gear(random, random.uniform(*HELIX_DEG))


def cam(random: Random) -> Places:
    """Return 12 contacts of a cam, on a flat or a roller follower, that stay closed."""
    angle = np.arange(0.0, 360.0, 1.0)
    while True:
        rise, most = random.uniform(*RISE_DEG), 1e-3 * random.uniform(*cams.LIFT_MM)
        x = np.clip(1 - np.abs(angle - 180) / rise, 0, 1)
        lift = most * x**3 * (10 - 15 * x + 6 * x**2)
        roller = 1e-3 * random.uniform(*cams.ROLLER_MM) if random.random() < 0.5 else None
        found = CamFollower(
            angle_deg=angle,
            lift_m=lift,
            base_radius_m=1e-3 * random.uniform(*cams.BASE_MM),
            width_m=random.uniform(*CAM_WIDTH_M),
            roller_radius_m=roller,
            preload_n=random.uniform(*SPRING_N),
            spring_rate_n_per_m=random.uniform(*SPRING_N_PER_M),
            mass_kg=random.uniform(*TRAIN_KG),
        )
        speed, own = log_uniform(random, cams.SPEED_PER_MIN), oil(random, cams.VISCOSITY_PA_S)
        given = {"cam_speed_rpm": speed, "oil": own, "options": WARM}
        try:
            places = [found.contact_at(float(one), **given) for one in _angles(rise)]
        except SurfaceError:
            continue  # it lifts off, or is hollow: no catalogue has it
        if max(place.hertz_pressure_pa for place in places) < cams.ROLLER_PA[1]:
            return places


def _angles(rise_deg: float) -> list[float]:
    """Return an angle of the base circle and 11 of the lift."""
    return [0.0, *np.linspace(180 - rise_deg, 180 + rise_deg, 11).tolist()]


def ball_on_disc(random: Random) -> Places:
    """Return three speeds of a rolling ball on a disc of steel or glass."""
    disc = str(random.choice(["steel", "glass"]))
    rig = BallOnDisc(ball_diameter_m=float(random.choice(BALLS_M)), material=("steel", disc))
    return _speeds(random, rig, log_uniform(random, DISC_LOADS_N), DISC_SPEEDS, 0.0)


def mini_traction(random: Random) -> Places:
    """Return three speeds of a mini traction machine, which slides."""
    slip = log_uniform(random, TRACTION_SLIP)
    load = log_uniform(random, TRACTION_LOADS_N)
    return _speeds(random, MiniTraction(), load, TRACTION_SPEEDS, slip)


def two_disc(random: Random) -> Places:
    """Return three speeds of two discs."""
    rig = TwoDisc(
        diameters_m=tuple(random.uniform(*DISCS_M, 2)), width_m=random.uniform(*DISC_WIDTH_M)
    )
    thin = Oil(viscosity_pa_s=0.01, pressure_viscosity_per_pa=2e-8)
    one = rig.contact_at(load_n=1.0, mean_speed_m_per_s=1.0, oil=thin)
    load = (log_uniform(random, DISC_PA) / one.hertz_pressure_pa) ** 2
    return _speeds(random, rig, load, DISC_RATES, log_uniform(random, DISC_SLIP))


def _speeds(
    random: Random, rig: BallOnDisc | TwoDisc, load: float, ends: tuple[float, float], slip: float
) -> Places:
    speeds = [log_uniform(random, ends) for _ in range(3)]
    own = oil(random, bearings.VISCOSITY_PA_S, slides=slip != 0)
    given = {"load_n": load, "oil": own, "slide_to_roll_ratio": slip, "options": WARM}
    return rig.places(mean_speeds_m_per_s=speeds, **given)


KINDS: dict[str, Callable[[Random], Places]] = {
    "DeepGrooveBallBearing": deep_groove,
    "AngularContactBallBearing": angular_contact,
    "CylindricalRollerBearing": cylindrical,
    "TaperedRollerBearing": tapered,
    "SpurGearPair": spur,
    "HelicalGearPair": helical,
    "CamFollower": cam,
    "BallOnDisc": ball_on_disc,
    "MiniTraction": mini_traction,
    "TwoDisc": two_disc,
}
"""How contacts of each element are drawn."""


def places(number: int) -> tuple[str, Places]:
    """Return the kind of an element and its contacts; kinds follow in turn."""
    kind = list(KINDS)[number % len(KINDS)]
    return kind, KINDS[kind](np.random.default_rng([SEED, number]))
