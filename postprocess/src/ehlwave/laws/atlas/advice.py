"""Advice for a contact outside the atlas, in the quantities that it was given by."""

import math
from collections.abc import Callable, Mapping

import numpy as np
import scipy

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.moes_parameters import moes_values
from ehlwave.contact.thinning import MOST_LOSS
from ehlwave.duals import valued
from ehlwave.errors import RangeError, SurfaceError, see
from ehlwave.inputs.slip import RATIO, SLIP, ratio_of
from ehlwave.laws.atlas.kind import Kind, is_within
from ehlwave.quantities import PLAUSIBLE, unit_of

Ranges = Mapping[str, tuple[float, float]]

COSTS = {
    "load_n": 1.0,
    "load_n_per_m": 1.0,
    "mean_speed_m_per_s": 1.5,
    "viscosity_pa_s": 3.0,
    "eyring_stress_pa": 3.0,
    "radius_x_m": 30.0,
    "radius_y_m": 30.0,
    "pressure_viscosity_per_pa": 100.0,
    "reduced_modulus_pa": 100.0,
}
"""Quantities in the order in which people would change them, and how much they would mind."""

FREE = ("load_parameter_m", "lubricant_parameter_l")
"""Coordinates that limits of a kind are about."""

LETTERS = {"load_parameter_m": "M", "lubricant_parameter_l": "L", "radius_ratio_d": "D"}
STRESS = "stress_modulus_pa2"
NOWHERE = "no change of the given quantities leads into the atlas"
_STEP, _MARGIN = 1e-4, 0.02
_DIGITS = 3
_TRIED = 200
"""Values of an interval at which limits are looked at."""
_HALVINGS = 6
"""Halvings of the step between two of them, to find an end."""
_SHARES = (0.0, 0.1, 0.2, 0.3, 0.4)
"""Shares of the ranges, left free at their ends in turn, until a contact is inside all limits."""
_LARGEST_CHANGE = 1e3
"""Largest advised change of one quantity; beyond it the advice changes several."""


def refuse_outside(contact: Conditions, kind: Kind) -> None:
    """Raise RangeError where a contact lies outside ranges, with values that would lie inside.

    A contact given by M, L and D is left to the message of the atlas itself.
    """
    place, ranges = {key: valued(value) for key, value in contact.atlas_keys().items()}, kind.ranges
    wrong = [key for key, (low, high) in ranges.items() if not is_within(place[key], low, high)]
    given = {key: valued(value) for key, value in contact.given}
    if "slip_parameter" in wrong:
        raise RangeError(_slip_text(contact, ranges["slip_parameter"]))
    beyond = "" if wrong else kind.beyond(place)
    if "mean_speed_m_per_s" not in given or not (beyond or _follow(wrong)):
        return
    powers = {key: _powers(given, key, ranges) for key in COSTS if key in given}
    single = {
        key: _within_limits(kind, place, power, _interval(place, power, ranges))
        for key, power in powers.items()
    }
    names = {key: (name, factor) for key, name, factor in contact.names}
    texts = [
        (key, *_plausible(key, given[key] * ends[0], given[key] * ends[1]))
        for key, ends in single.items()
        if ends is not None
    ]
    texts = [one for one in texts if one[1] < one[2]]
    small = [one for one in texts if _is_small(given[one[0]], *one[1:])]
    nearest = "" if small else _nearest(place, given, powers, kind, names)
    texts = small or (texts if nearest == NOWHERE else [])
    said = beyond or ", ".join(_coordinate(key, place[key], ranges[key]) for key in wrong)
    if texts:
        first, low, high = texts[0]
        name, factor = names.get(first, (first, 1.0))
        text = (
            f"{name} = {given[first] * factor:.4g} gives {said}; with the rest unchanged the atlas "
            f"holds {_ends(low * factor, high * factor)} {_unit(first, name)}"
        )
        if len(texts) > 1:
            key, low, high = texts[1]
            name, factor = names.get(key, (key, 1.0))
            text += f", or {name} of {_ends(low * factor, high * factor)} {_unit(key, name)}"
    else:
        text = f"this contact has {said}; {nearest}"
    raise RangeError(f"{text}; or compute it: ehlwave-case, ehlwave.Case{see('atlas')}")


def thinned_text(contact: Conditions) -> str:
    """Return why the atlas has no film of an oil that thins too much."""
    pressure, slip = contact.stresses_in_inlet
    return (
        f"in the inlet pressure shears this oil by {pressure:.3g} times the stress at which it "
        f"thins, slip by {slip:.3g} times. The atlas holds Ree-Eyring oils within its ranges, and "
        f"others where thinning takes at most {MOST_LOSS:.0%} of the film: compute it "
        f"(ehlwave.Case, ehlwave-case){see('atlas')}"
    )


def _follow(wrong: list[str]) -> bool:
    """Return whether a range follows from several quantities; others are reported directly."""
    return any(key in LETTERS or key == STRESS for key in wrong)


def _coordinate(key: str, value: float, ends: tuple[float, float]) -> str:
    name = LETTERS.get(key, "eyring_stress_pa reduced_modulus_pa" if key == STRESS else key)
    return f"{name} = {value:.3g} (of {ends[0]:g} to {ends[1]:g})"


def _coordinates(values: Mapping[str, float]) -> dict[str, float]:
    """Return the coordinates in the atlas that quantities give, those that depend on them."""
    found = moes_values(values, "contact")
    found["pressure_viscosity_per_pa"] = values.get("pressure_viscosity_per_pa", 1.0)
    if "eyring_stress_pa" in values:
        found[STRESS] = values["eyring_stress_pa"] * values["reduced_modulus_pa"]
    return found


def _powers(given: Mapping[str, float], key: str, ranges: Ranges) -> dict[str, float]:
    """Return with which power of a quantity each coordinate goes; all are fourths."""
    before = _coordinates(given)
    for step in (1 + _STEP, 1 / (1 + _STEP)):
        try:
            after = _coordinates({**given, key: given[key] * step})
        except SurfaceError:  # D just beyond its end
            continue
        return {
            name: round(4 * math.log(after[name] / before[name]) / math.log(step)) / 4
            for name in ranges
            if name in after and before[name] > 0
        }
    return {}


def _interval(
    place: Mapping[str, float], powers: Mapping[str, float], ranges: Ranges
) -> tuple[float, float] | None:
    """Return by which factors a quantity may change so that all lies inside.

    None: by none, or the quantity moves no coordinate, as the Eyring stress in pure rolling.
    """
    least, most = 0.0, math.inf
    for key, ends in ranges.items():
        power = powers.get(key, 0.0)
        if power == 0:
            if not is_within(place[key], *ends):
                return None
            continue
        factors = sorted((end / place[key]) ** (1 / power) for end in ends)
        least, most = max(least, factors[0]), min(most, factors[1])
    is_moving = math.isfinite(most)
    return (least, most) if is_moving and least < most * (1 - _MARGIN) else None


def _moved(
    place: Mapping[str, float], powers: Mapping[str, float], factor: float
) -> dict[str, float]:
    """Return a place after a quantity has changed by a factor."""
    return {key: value * factor ** powers.get(key, 0.0) for key, value in place.items()}


def _within_limits(
    kind: Kind,
    place: Mapping[str, float],
    powers: Mapping[str, float],
    factors: tuple[float, float] | None,
) -> tuple[float, float] | None:
    """Return the part of an interval that no limit of the kind excludes; None: there is none."""
    if factors is None:
        return None

    def is_inside(factor: float) -> bool:
        return not kind.beyond(_moved(place, powers, factor))

    tried = np.geomspace(*factors, _TRIED).tolist()
    inside = [number for number, factor in enumerate(tried) if is_inside(factor)]
    if len(inside) < 2:
        return None
    ends = []
    for last, step in ((inside[0], -1), (inside[-1], 1)):
        within, without = tried[last], tried[min(max(last + step, 0), _TRIED - 1)]
        for _ in range(_HALVINGS):
            middle = math.sqrt(within * without)
            within, without = (middle, without) if is_inside(middle) else (within, middle)
        ends.append(within)
    return ends[0], ends[1]


def _plausible(key: str, low: float, high: float) -> tuple[float, float]:
    """Return the part of a range that contacts have."""
    known = PLAUSIBLE[key]
    return max(low, known.low), min(high, known.high)


def _is_small(value: float, low: float, high: float) -> bool:
    return max(low / value, value / high) <= _LARGEST_CHANGE


def _nearest(
    place: Mapping[str, float],
    given: Mapping[str, float],
    powers: Mapping[str, Mapping[str, float]],
    kind: Kind,
    names: Mapping[str, tuple[str, float]],
) -> str:
    """Return the smallest change of several quantities that leads inside, by linear programming.

    Logarithms of coordinates are linear in logarithms of quantities. Weights are largest for
    quantities that people change last. A corner solution changes few of them. Where a limit of the
    kind excludes it, the ends of M and L are left free.
    """
    keys = list(powers)
    ranges = {key: ends for key, ends in kind.ranges.items() if key != SLIP}  # may begin at 0
    matrix = np.array([[powers[key].get(name, 0.0) for key in keys] for name in ranges])
    now = np.log([place[name] for name in ranges])
    low, high = (np.log([ends[i] for ends in ranges.values()]) for i in (0, 1))
    is_free = np.array([name in FREE for name in ranges])
    changes = [(PLAUSIBLE[key].high / given[key], given[key] / PLAUSIBLE[key].low) for key in keys]
    bounds = [(0.0, math.log(max(change[i], 1.0))) for i in (0, 1) for change in changes]
    both = np.vstack([matrix, -matrix])
    sides, cost = np.hstack([both, -both]), np.tile([COSTS[key] for key in keys], 2)
    for share in _SHARES:
        room = np.maximum(share * (high - low), np.minimum(_MARGIN, 0.25 * (high - low)))
        # Values inside may stay, also at an end of the range: circular contacts have D = 1.
        stays = (share == 0) | ~is_free
        most = np.where(stays & (now <= high), np.maximum(high - room, now), high - room)
        least = np.where(stays & (now >= low), np.minimum(low + room, now), low + room)
        upper = np.concatenate([most - now, now - least]) + 1e-12
        found = scipy.optimize.linprog(cost, A_ub=sides, b_ub=upper, bounds=bounds, method="highs")
        if not found.success:
            continue
        steps = np.exp(found.x[: len(keys)] - found.x[len(keys) :]).tolist()
        said = {
            key: f"{given[key] * names.get(key, (key, 1.0))[1] * step:.{_DIGITS}g}"
            for key, step in zip(keys, steps, strict=True)
            if abs(step - 1) > 1e-9
        }
        there = dict(place)
        for key, text in said.items():
            factor = names.get(key, (key, 1.0))[1]
            there = _moved(there, powers[key], float(text) / (given[key] * factor))
        if not kind.beyond(there):
            break
    else:
        return NOWHERE
    parts = []
    for key, text in said.items():
        name = names.get(key, (key, 1.0))[0]
        parts.append(f"{name} = {text} {_unit(key, name)}")
    return f"the nearest inside the atlas has {' and '.join(parts)}"


def _slip_text(contact: Conditions, ends: tuple[float, float]) -> str:
    slip, (low, high) = contact.slip_parameter, ends
    return (
        f"slip_parameter = {slip:g} ({RATIO} = {ratio_of(slip):g}) lies outside the atlas, which "
        f"holds {low:g} to {high:g} ({RATIO} {ratio_of(low):g} to {ratio_of(high):g}){see('slip')}"
    )


def _ends(low: float, high: float) -> str:
    """Return both ends with three digits, rounded inwards."""
    return f"{_rounded(low, math.ceil)} to {_rounded(high, math.floor)}"


def _rounded(value: float, towards: Callable[[float], int]) -> str:
    if value <= 0 or not math.isfinite(value):
        return f"{value:g}"
    unit = 10.0 ** (math.floor(math.log10(value)) - _DIGITS + 1)
    return f"{towards(value / unit) * unit:.4g}"


def _unit(key: str, name: str) -> str:
    return unit_of(name if unit_of(name) else key).replace("*", " ")
