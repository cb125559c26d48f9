"""The slip parameter by its other name, the slide-to-roll ratio.

S = u1/ubar and SRR = (u1 - u2)/ubar, ubar = (u1 + u2)/2, so that S = 1 + SRR/2. Surface 1 is the
rough surface. The programs use the same formulas in ``src/case/input_completion.f90``.
"""

from collections.abc import Mapping
from typing import Any

from ehlwave.errors import SurfaceError, see
from ehlwave.quantities import number

SLIP, RATIO = "slip_parameter", "slide_to_roll_ratio"
DECIMALS = 12
"""Decimals that are kept, as in the programs: S = 0.98 and a ratio of -0.04 are the same number."""


def slip_of(ratio: float) -> float:
    """Return S of a slide-to-roll ratio."""
    return round(1 + ratio / 2, DECIMALS)


def ratio_of(slip: float) -> float:
    """Return the slide-to-roll ratio of S."""
    return round(2 * (slip - 1), DECIMALS)


def refuse_both(keys: Mapping[str, Any], place: str) -> None:
    """Raise SurfaceError where both names are given."""
    if keys.get(SLIP) is not None and keys.get(RATIO) is not None:
        raise SurfaceError(
            f"{place}: {SLIP} = {keys[SLIP]} and {RATIO} = {keys[RATIO]} are two words for one "
            f"speed: remove {SLIP}, or {RATIO}{see('slip')}"
        )


def merged(keys: Mapping[str, Any], later: Mapping[str, Any]) -> dict[str, Any]:
    """Return keys overridden by later ones; the later of the two names counts."""
    dropped = {SLIP, RATIO} if {SLIP, RATIO} & set(later) else set()
    return {key: value for key, value in keys.items() if key not in dropped} | dict(later)


def slip_given(slip: float | None, ratio: float | None, where: str) -> float | None:
    """Return the slip parameter of an argument, by either of its names; None: neither is given."""
    refuse_both({SLIP: slip, RATIO: ratio}, where)
    if ratio is None:
        return None if slip is None else number(slip, SLIP, where)
    return slip_of(number(ratio, RATIO, where))
