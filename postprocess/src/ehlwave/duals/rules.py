"""Derivatives of functions of numpy."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

UNDIFFERENTIATED = {
    *(np.equal, np.not_equal, np.less, np.less_equal, np.greater, np.greater_equal),
    *(np.isfinite, np.isnan, np.isinf, np.sign, np.logical_not, np.logical_and, np.logical_or),
    *(np.shape, np.ndim, np.size, np.zeros_like, np.ones_like, np.full_like, np.iscomplexobj),
    *(np.any, np.all, np.allclose),
}
"""Functions of values alone."""

MULTILINEAR = {np.matmul}
"""Functions linear in each argument."""

POSITIONS: dict[Callable[..., Any], tuple[int, ...]] = {
    np.where: (1, 2),
    **dict.fromkeys(
        (
            *(np.concatenate, np.stack, np.column_stack, np.sum, np.mean, np.diff, np.cumsum),
            *(np.reshape, np.ravel, np.broadcast_to, np.transpose, np.squeeze, np.atleast_1d),
            *(np.append, np.real, np.imag),
        ),
        (0,),
    ),
    np.append: (0, 1),
    np.outer: (0,),
}
"""Positions of arguments that functions are linear in, together."""


def _kept(slope: Any, partial: Any) -> Any:  # noqa: ANN401
    """Return their product; 0 where the argument does not change, whatever the derivative is."""
    found = slope * partial
    return found if np.isfinite(found).all() else np.where(slope == 0, 0.0, found)


def _of_one(derivative: Callable[[Any, Any], Any]) -> Callable[..., Any]:
    """Return the rule of a function by its derivative, of its value and argument."""

    def rule(_: int, found: Any, given: Sequence[Any], slope: Any) -> Any:  # noqa: ANN401
        return _kept(slope, derivative(found, given[0]))

    return rule


def _of_two(*partials: Callable[[Any, Any, Any], Any]) -> Callable[..., Any]:
    """Return the rule of a function by its two partial derivatives, of its value and arguments."""

    def rule(k: int, found: Any, given: Sequence[Any], slope: Any) -> Any:  # noqa: ANN401
        return _kept(slope, partials[k](found, *given))

    return rule


def _absolute(_: int, found: Any, given: Sequence[Any], slope: Any) -> Any:  # noqa: ANN401
    one = given[0]
    if not np.iscomplexobj(one):
        return slope * np.sign(one)
    return np.where(found == 0, 0.0, (np.conj(one) * slope).real / found)


PARTIALS: dict[np.ufunc, Callable[..., Any]] = {
    np.add: lambda _k, _f, _g, slope: slope,
    np.subtract: lambda k, _f, _g, slope: -slope if k else slope,
    np.negative: lambda _k, _f, _g, slope: -slope,
    np.positive: lambda _k, _f, _g, slope: slope,
    np.conjugate: lambda _k, _f, _g, slope: np.conj(slope),
    np.absolute: _absolute,
    np.multiply: _of_two(lambda _, _x, y: y, lambda _, x, _y: x),
    np.divide: _of_two(lambda _, _x, y: 1 / y, lambda f, _x, y: -f / y),
    np.power: _of_two(lambda _, x, y: y * x ** (y - 1.0), lambda f, x, _y: f * np.log(x)),
    np.hypot: _of_two(lambda f, x, _y: x / f, lambda f, _x, y: y / f),
    np.arctan2: _of_two(lambda _, x, y: y / (x**2 + y**2), lambda _, x, y: -x / (x**2 + y**2)),
    np.maximum: _of_two(lambda _, x, y: x >= y, lambda _, x, y: x < y),
    np.minimum: _of_two(lambda _, x, y: x <= y, lambda _, x, y: x > y),
    np.logaddexp: _of_two(lambda f, x, _y: np.exp(x - f), lambda f, _x, y: np.exp(y - f)),
    np.exp: _of_one(lambda f, _: f),
    np.expm1: _of_one(lambda f, _: f + 1),
    np.log: _of_one(lambda _, x: 1 / x),
    np.log10: _of_one(lambda _, x: 1 / (x * np.log(10))),
    np.log1p: _of_one(lambda _, x: 1 / (1 + x)),
    np.sqrt: _of_one(lambda f, _: 0.5 / f),
    np.square: _of_one(lambda _, x: 2 * x),
    np.sin: _of_one(lambda _, x: np.cos(x)),
    np.cos: _of_one(lambda _, x: -np.sin(x)),
    np.tan: _of_one(lambda f, _: 1 + f**2),
    np.arctan: _of_one(lambda _, x: 1 / (1 + x**2)),
    np.sinh: _of_one(lambda _, x: np.cosh(x)),
    np.cosh: _of_one(lambda _, x: np.sinh(x)),
    np.tanh: _of_one(lambda f, _: 1 - f**2),
    np.arcsinh: _of_one(lambda _, x: 1 / np.sqrt(1 + x**2)),
    np.radians: _of_one(lambda _f, _x: np.pi / 180),
    np.degrees: _of_one(lambda _f, _x: 180 / np.pi),
}
"""Contributions of an argument to the derivatives: by its number, the value, all arguments, and
its own derivatives."""
