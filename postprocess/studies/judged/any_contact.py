"""Random contacts of catalogues and at the ends of the ranges of the laws.

Half of the contacts have the other kind; some are starved, some warm.
"""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from ehlwave.contact.starvation import FILM_RANGES
from ehlwave.errors import EhlwaveError
from ehlwave.laws.atlas.kinds import KINDS
from studies.atlas.bearings import ball_contacts, roller_contacts
from studies.atlas.cams import cam_contacts
from studies.atlas.gears import gear_contacts
from studies.judged.drawn_contacts import Drawn, drawn
from studies.judged.runs import log_uniform

SEED = 5264
CATALOGUE = ("any", "balls", "any", "lines")
"""Kinds of catalogue; a half of all contacts."""
ENDS = ("rolling_wide", "sliding", "line", "starved", "sliding_wide", "line_sliding")
"""Kinds at the ends of ranges: atlases, and the law of starved contacts."""
NEAR, MODULUS_PA, HOT_SHARE, STARVED_SHARE = 0.03, 2.26e11, 0.4, 0.15
"""Share of a logarithmic range that is its end; E'; shares of contacts of elements."""
WAVES = (0.25, 3.0)


def kind_of(number: int) -> str:
    """Return the kind of the contact of a number."""
    place, is_end = divmod(number, 2)
    kinds = ENDS if is_end else CATALOGUE
    return kinds[place % len(kinds)]


def contact(number: int, seed: int = SEED) -> tuple[str, Drawn]:
    """Return kind, contact and wave of a number."""
    random = np.random.default_rng([seed, number])
    kind = kind_of(number)
    if number % 2:
        return kind, _at_ends(kind, random)
    if kind == "any":
        return kind, drawn(1, int(random.integers(2**31)))[0]
    return kind, _of_element(kind, number, random)


def _of_element(kind: str, number: int, random: np.random.Generator) -> Drawn:
    """Return a contact of a bearing, a gear or a cam, some hot or starved."""
    given = ball_contacts if kind == "balls" else _LINES[number // 8 % len(_LINES)]
    (one,) = given(count=1, seed=int(random.integers(2**31)))
    keys: dict[str, Any] = dict(one.conditions.given)
    keys |= {"slip_parameter": one.conditions.slip_parameter}
    chance = random.random()
    if kind == "balls" and chance < STARVED_SHARE:
        keys["oil_over_flooded"] = log_uniform(random, *FILM_RANGES["r"])
    is_hot = chance > 1 - HOT_SHARE
    return Drawn(keys, is_hot, *_wave(random, kind != "balls"))


_LINES: Sequence[Callable[..., Any]] = (
    roller_contacts,
    gear_contacts,
    cam_contacts,
    partial(gear_contacts, False),
)


def _at_ends(kind: str, random: np.random.Generator) -> Drawn:
    """Return a contact whose data lie at ends of the ranges, each with a chance of one half."""
    while True:
        keys = {name: _end(random, *ends) for name, ends in _ranges(kind).items()}
        if "slip_parameter" in keys:
            keys["reduced_modulus_pa"] = MODULUS_PA
            keys["eyring_stress_pa"] = keys.pop("stress_modulus_pa2") / MODULUS_PA
        is_line = kind.startswith("line")
        keys = {name: float(f"{value:.5g}") for name, value in keys.items()}
        keys |= {"radius_ratio_d": 0.0} if is_line else {}
        found = Drawn(keys, False, *_wave(random, is_line))
        try:
            found.contact().film(by="laws")
        except EhlwaveError:
            continue
        return found


def _ranges(kind: str) -> dict[str, tuple[float, float]]:
    if kind != "starved":
        return dict(KINDS[kind].ranges)
    own = {"load_parameter_m": "M", "lubricant_parameter_l": "L", "radius_ratio_d": "D"}
    own |= {"oil_over_flooded": "r"}
    more = {name: KINDS["rolling"].ranges[name] for name in _OIL}
    return {name: FILM_RANGES[letter] for name, letter in own.items()} | more


_OIL = ("pressure_viscosity_per_pa", "roelands_index")


def _end(random: np.random.Generator, low: float, high: float) -> float:
    share = random.random()
    if random.random() < 0.5:
        share = NEAR * share if random.random() < 0.5 else 1 - NEAR * share
    return low + (high - low) * share if low <= 0 else low * (high / low) ** share


def _wave(random: np.random.Generator, is_line: bool) -> tuple[float, float]:
    angle = 0.0 if is_line or random.random() < 0.3 else random.uniform(0, 90)
    angle = 90.0 if not is_line and random.random() < 0.2 else angle
    return log_uniform(random, *WAVES), float(f"{angle:.4g}")
