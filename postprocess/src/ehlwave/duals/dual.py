"""Forward differentiation: a value and its derivatives by several parameters.

Griewank and Walther, *Evaluating Derivatives* (2008), chapter 3. Choices follow the value.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from ehlwave.duals.rules import MULTILINEAR, PARTIALS, POSITIONS, UNDIFFERENTIATED


class Dual(NDArrayOperatorsMixin):
    """A number or an array with its derivatives.

    Attributes
    ----------
    value : number or ndarray
        Value.
    slopes : ndarray
        Derivatives by all parameters, the first axis; then the axes of the value.
    """

    __slots__ = ("slopes", "value")

    def __init__(self, value: Any, slopes: Any) -> None:  # noqa: ANN401 - numbers or arrays
        """Take a value and its derivatives."""
        self.value, self.slopes = value, np.asarray(slopes)

    def __repr__(self) -> str:
        """Return the value and the derivatives."""
        return f"Dual({self.value!r}, {self.slopes!r})"

    def __format__(self, code: str) -> str:
        """Return the value as text, for messages."""
        return format(self.value, code)

    def __bool__(self) -> bool:
        """Return whether the value is not 0."""
        return bool(self.value)

    def __float__(self) -> float:
        """Refuse: derivatives would be lost."""
        raise TypeError("a number with derivatives: take to_float of ehlwave.duals")

    def __array__(self, *_: object, **__: object) -> Any:  # noqa: ANN401
        """Refuse: derivatives would be lost."""
        raise TypeError("a number with derivatives: take np of ehlwave.duals")

    def __hash__(self) -> int:
        """Return an own hash: caches hold equal values with other derivatives apart."""
        return id(self)

    def __round__(self, digits: int = 0) -> Dual:
        """Return the value rounded."""
        return Dual(round(float(self.value), digits), self.slopes)

    def __len__(self) -> int:
        """Return the length of the first axis of the value."""
        return len(self.value)

    def __iter__(self) -> Iterator[Dual]:
        """Iterate over the first axis of the value."""
        return (self[k] for k in range(len(self)))

    def __getitem__(self, index: Any) -> Dual:  # noqa: ANN401
        """Return a part."""
        every = index if isinstance(index, tuple) else (index,)
        return Dual(self.value[index], self.slopes[(slice(None), *every)])

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401
        """Return shape, size and others of the value."""
        if name in ("shape", "size", "ndim", "dtype"):
            return getattr(np.asarray(self.value), name)
        if name in ("ravel", "reshape", "sum", "mean"):
            return lambda *args, **options: linear(
                lambda one: getattr(np.asarray(one), name)(*args, **options), self
            )
        if name in ("astype", "copy"):
            return lambda *args: Dual(
                *(getattr(np.asarray(one), name)(*args) for one in (self.value, self.slopes))
            )
        if name in ("max", "min"):
            return lambda: self.ravel()[int(getattr(np, f"arg{name}")(self.value))]
        if name in ("any", "all"):
            return getattr(np.asarray(self.value), name)
        raise AttributeError(name)

    @property
    def real(self) -> Dual:
        """Return the real part."""
        return Dual(np.real(self.value), self.slopes.real)

    @property
    def imag(self) -> Dual:
        """Return the imaginary part."""
        return Dual(np.imag(self.value), self.slopes.imag)

    @property
    def T(self) -> Dual:  # noqa: N802 - as numpy names it
        """Return the transposed array."""
        return linear(np.transpose, self)

    def __array_ufunc__(
        self,
        ufunc: np.ufunc,
        method: str,
        *given: Any,  # noqa: ANN401
        out: Any = (),  # noqa: ANN401
        **options: Any,  # noqa: ANN401
    ) -> Any:  # noqa: ANN401
        """Return a function of numpy with its derivatives, by the table of partial derivatives."""
        if method != "__call__" or options or any(not isinstance(one, Dual) for one in out):
            return NotImplemented
        values = [valued(one) for one in given]
        if ufunc in UNDIFFERENTIATED:
            return ufunc(*values)
        if ufunc in MULTILINEAR:
            return _multilinear(ufunc, range(len(given)), given)
        if ufunc not in PARTIALS:
            return NotImplemented
        found, total = ufunc(*values), 0.0
        values = [np.asarray(one) for one in values]
        with np.errstate(divide="ignore", invalid="ignore"):
            for k, one in enumerate(given):
                if isinstance(one, Dual):
                    total = total + PARTIALS[ufunc](k, found, values, spread(one, np.ndim(found)))
        shape = (len(total), *np.shape(found))
        return Dual(found, total if total.shape == shape else np.broadcast_to(total, shape))

    def __array_function__(
        self,
        function: Callable[..., Any],
        _types: object,
        given: tuple[Any, ...],
        options: Mapping[str, Any],
    ) -> Any:  # noqa: ANN401
        """Return a function of numpy that is linear in its arguments, or of values alone."""
        if function in POSITIONS:
            return _multilinear(function, POSITIONS[function], given, options)
        if function in UNDIFFERENTIATED:
            return function(*map(valued, given), **options)
        return NotImplemented


def valued(given: Any) -> Any:  # noqa: ANN401
    """Return a number, an array or a list of them without derivatives."""
    if isinstance(given, Dual):
        return given.value
    return type(given)(map(valued, given)) if isinstance(given, (list, tuple)) else given


def seeded(values: Mapping[str, float]) -> dict[str, Dual]:
    """Return numbers whose derivatives are those by their own logarithms."""
    units = np.eye(len(values))
    return {
        key: Dual(value, value * unit)
        for (key, value), unit in zip(values.items(), units, strict=True)
    }


def log_slopes(number: Any, count: int) -> list[float]:  # noqa: ANN401 - perhaps None
    """Return the derivatives of ln|number|; 0 of a plain number, NaN of None, NaN and 0."""
    if not number or not np.isfinite(valued(number)):
        return [np.nan] * count
    return (number.slopes / number.value).tolist() if isinstance(number, Dual) else [0.0] * count


def spread(one: Dual, axes: int) -> Any:  # noqa: ANN401
    """Return derivatives of a value that numpy takes as an array of so many axes."""
    shape = one.slopes.shape
    return one.slopes.reshape(shape[0], *(1,) * (axes - len(shape) + 1), *shape[1:])


def count_of(given: Any) -> int:  # noqa: ANN401
    """Return the number of parameters of the first Dual among arguments; 0: there is none."""
    if isinstance(given, Dual):
        return len(given.slopes)
    return next(filter(None, map(count_of, given)), 0) if isinstance(given, (list, tuple)) else 0


def part_of(given: Any, k: int) -> Any:  # noqa: ANN401
    """Return the derivatives by parameter k, 0 of plain numbers."""
    if isinstance(given, Dual):
        return given.slopes[k]
    if isinstance(given, (list, tuple)):
        return [part_of(one, k) for one in given]
    return np.zeros_like(given, dtype=float)


def linear(function: Callable[[Any], Any], one: Dual) -> Dual:
    """Return a linear function of an array with its derivatives."""
    return Dual(function(one.value), np.stack([function(slope) for slope in one.slopes]))


def _multilinear(
    function: Callable[..., Any],
    positions: Any,  # noqa: ANN401
    given: tuple[Any, ...],
    options: Mapping[str, Any] | None = None,
) -> Dual:
    """Return a function with derivatives that is linear in each, or all at once, of its arguments.

    Positions of a tuple are linear together, as of `np.where`; others one after another.
    """
    options, values = options or {}, [valued(one) for one in given]
    together = [tuple(positions)] if isinstance(positions, tuple) else [(k,) for k in positions]
    total: Any = 0.0
    for group in together:
        count = count_of([given[k] for k in group])
        if count:
            rows = []
            for k in range(count):
                own = [
                    part_of(given[i], k) if i in group else value for i, value in enumerate(values)
                ]
                rows.append(function(*own, **options))
            total = total + np.stack(rows)
    return Dual(function(*values, **options), total)
