"""numpy and math that take numbers with derivatives, too, and solutions of equations."""

from __future__ import annotations

import math as plain_math
from collections.abc import Callable
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy
import scipy

from ehlwave.duals.dual import Dual, count_of, linear, part_of, valued


def to_float(given: Any) -> Any:  # noqa: ANN401 - a number
    """Return a number as a float; one with derivatives as it is."""
    return given if isinstance(given, Dual) else float(given)


def to_complex(given: Any) -> Any:  # noqa: ANN401 - a number
    """Return a number as a complex number; one with derivatives as it is."""
    return given if isinstance(given, Dual) else complex(given)


def implicit(solution: float, excess: Callable[[Any], Any]) -> Any:  # noqa: ANN401
    """Return the solution of ``excess(x) = 0`` with its derivatives, by the implicit function.

    Parameters
    ----------
    solution : float
        Its value.
    excess : callable
        The equation; its other arguments may have derivatives.
    """
    still = excess(solution)
    if not isinstance(still, Dual):
        return solution
    count = len(still.slopes)
    by_solution = excess(Dual(solution, numpy.ones(count))).slopes - still.slopes
    return Dual(solution, -still.slopes / by_solution)


def root(excess: Callable[[Any], Any], low: float, high: float, **options: float) -> Any:  # noqa: ANN401
    """Return the root of ``excess`` between two ends with its derivatives, by Brent's method."""
    found = scipy.optimize.brentq(lambda x: valued(excess(x)), valued(low), valued(high), **options)
    return implicit(float(found), excess)


def spline(x: Any, y: Any, at: Any) -> Any:  # noqa: ANN401 - plain x and at
    """Return a cubic spline through (x, y) at places; y along the first axis."""

    def of(values: Any) -> Any:  # noqa: ANN401
        return scipy.interpolate.CubicSpline(x, values)(at)

    return linear(of, y) if isinstance(y, Dual) else of(y)


def placed(mask: Any, inside: Any, rest: Any = 0.0) -> Any:  # noqa: ANN401
    """Return an array with values where a mask is true, and other values elsewhere."""
    count = count_of([inside, rest])
    if count:
        parts = [placed(mask, part_of(inside, k), part_of(rest, k)) for k in range(count)]
        return Dual(placed(mask, valued(inside), valued(rest)), numpy.stack(parts))
    kind = numpy.result_type(inside, rest)
    found = numpy.array(numpy.broadcast_to(rest, mask.shape), dtype=kind)
    found[mask] = inside
    return found


def _asarray(given: Any, dtype: Any = None, **options: Any) -> Any:  # noqa: ANN401
    count = count_of(given)
    if not count:
        return numpy.asarray(given, dtype, **options)
    if isinstance(given, Dual):
        return given.astype(dtype) if dtype in (complex, numpy.complex128) else given
    parts = [numpy.asarray(part_of(given, k)) for k in range(count)]
    return Dual(numpy.asarray(valued(given), dtype, **options), numpy.stack(parts))


def _array(given: Any, dtype: Any = None) -> Any:  # noqa: ANN401
    found = _asarray(given, dtype)
    return found if isinstance(found, Dual) else numpy.array(given, dtype)


def _vectorize(function: Callable[..., Any], otypes: Any = None) -> Callable[..., Any]:  # noqa: ANN401
    plain = numpy.vectorize(function, otypes=otypes)

    def each(*given: Any) -> Any:  # noqa: ANN401
        if not count_of(given):
            return plain(*given)
        columns = _broadcast_arrays(*given)
        if columns[0].ndim == 0:
            return function(*columns)
        flat = zip(*(column.ravel() for column in columns), strict=True)
        return _asarray([function(*row) for row in flat]).reshape(columns[0].shape)

    return each


def _broadcast_arrays(*given: Any) -> Any:  # noqa: ANN401
    if not count_of(given):
        return numpy.broadcast_arrays(*given)
    shape = numpy.broadcast_shapes(*map(numpy.shape, given))
    return [
        numpy.broadcast_to(_asarray(one), shape)
        if not isinstance(one, Dual)
        else Dual(
            numpy.broadcast_to(one.value, shape),
            numpy.stack([numpy.broadcast_to(slope, shape) for slope in one.slopes]),
        )
        for one in given
    ]


def _clip(given: Any, low: Any, high: Any) -> Any:  # noqa: ANN401
    if not count_of((given, low, high)):
        return numpy.clip(given, low, high)
    least = given if low is None else numpy.maximum(given, low)
    return least if high is None else numpy.minimum(least, high)


def _interp(x: Any, places: Any, values: Any) -> Any:  # noqa: ANN401
    """Return linear interpolation in values that may have derivatives, at places that may, too."""
    if not count_of((x, values)):
        return numpy.interp(x, places, values)
    at = valued(x)
    found = (
        linear(lambda one: numpy.interp(at, places, one), values)
        if isinstance(values, Dual)
        else numpy.interp(at, places, values)
    )
    if not isinstance(x, Dual):
        return found
    table = numpy.asarray(valued(values))
    left = numpy.clip(numpy.searchsorted(places, at, side="right") - 1, 0, len(places) - 2)
    rise = numpy.diff(table)[left] / numpy.diff(places)[left]
    inside = (at >= places[0]) & (at <= places[-1])
    return found + (x - at) * numpy.where(inside, rise, 0.0)


def _geomspace(low: Any, high: Any, count: int) -> Any:  # noqa: ANN401
    found = numpy.geomspace(valued(low), valued(high), count)
    if not isinstance(high, Dual):
        return found
    share = numpy.linspace(0, 1, count)
    return Dual(found, high.slopes[:, None] / high.value * share * found)


def _std(given: Any, **options: Any) -> Any:  # noqa: ANN401 - a Dual as a whole
    found = numpy.std(valued(given), **options)
    if not isinstance(given, Dual):
        return found
    about = given.value - numpy.mean(given.value)
    return Dual(found, numpy.stack([(about * one).mean() for one in given.slopes]) / found)


def _math(name: str, of_numpy: str | None = None) -> Callable[..., Any]:
    plain, other = getattr(plain_math, name), getattr(numpy, of_numpy or name)

    def function(*given: Any) -> Any:  # noqa: ANN401
        return other(*given) if any(isinstance(one, Dual) for one in given) else plain(*given)

    return function


if TYPE_CHECKING:
    import math

    import numpy as np
else:

    class _Numpy(SimpleNamespace):
        def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - modules that numpy loads late
            return getattr(numpy, name)

    np = _Numpy(
        **vars(numpy)
        | {
            "asarray": _asarray,
            "array": _array,
            "vectorize": _vectorize,
            "broadcast_arrays": _broadcast_arrays,
            "clip": _clip,
            "interp": _interp,
            "geomspace": _geomspace,
            "std": _std,
        }
    )
    _SAME = ("exp", "log", "log10", "sqrt", "isfinite", "isnan", "isinf", "hypot", "cos", "sin")
    math = SimpleNamespace(
        **vars(plain_math)
        | {name: _math(name) for name in _SAME}
        | {"atan": _math("atan", "arctan")}
    )
"""numpy and math of laws."""
