"""Derivatives of answers of laws, within the law and the chart that answer at the place itself."""

from collections.abc import Callable, Mapping

from ehlwave.errors import RangeError, SurfaceError

STEP = 1e-5
"""Step in a logarithm: laws are computed in double precision, which leaves 1e-8."""

Answer = tuple[Mapping[str, float], str]
"""Numbers, and their source."""

CENTRED = {1: 0.5, -1: -0.5}
ONE_SIDED = ({0: -1.5, 1: 2.0, 2: -0.5}, {0: 1.5, -1: -2.0, -2: 0.5})


def slopes_of(answer: Callable[[float], Answer]) -> dict[str, float]:
    """Return the derivatives of numbers at 0 by differences of second order.

    Centred where the same source answers on both sides, else to the side where it does: where two
    charts meet they differ by their errors, which are no derivative.

    Parameters
    ----------
    answer : callable
        Numbers and their source, by the change of a logarithm; raises RangeError outside.

    Raises
    ------
    RangeError
        If the source of the place itself answers on neither side.
    """
    found: dict[int, Mapping[str, float]] = {}
    found[0], source = answer(0.0)

    def holds(place: int) -> bool:
        if place not in found:
            try:
                numbers, other = answer(place * STEP)
            except (RangeError, SurfaceError):
                return False
            if law_of(other) != law_of(source):
                return False
            found[place] = numbers
        return True

    for weights in (CENTRED, *ONE_SIDED):
        if all(map(holds, weights)):
            return {
                name: sum(weight * found[place][name] for place, weight in weights.items()) / STEP
                for name in found[0]
            }
    raise RangeError(f"{source} has no neighbours on either side")


def law_of(source: str) -> str:
    """Return a source without numbers of the contact: the factor of a starved film follows."""
    return source.split(",")[0]
