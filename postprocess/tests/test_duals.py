"""Numbers with derivatives: every rule against differences, and equations solved with them."""

import copy
import math as plain_math

import numpy
import pytest
import scipy.special

from ehlwave.contact.scales import (
    ellipticity,
    first_integral,
    integral_combinations,
    second_integral,
)
from ehlwave.duals import (
    Dual,
    implicit,
    math,
    np,
    placed,
    root,
    seeded,
    spline,
    to_complex,
    to_float,
    valued,
)
from ehlwave.duals.rules import PARTIALS

STEP = 1e-6
RNG = numpy.random.default_rng(3)
A, B = RNG.uniform(0.1, 0.9, (2, 3, 2))
SLOPES = RNG.uniform(-1, 1, (2, 4, 3, 2))


def differences(function, values, slopes):  # noqa: ANN001, ANN201
    """Return derivatives of a function by four parameters that move its arguments."""
    return numpy.stack(
        [
            (
                function(*(v + STEP * s[k] for v, s in zip(values, slopes, strict=True)))
                - function(*(v - STEP * s[k] for v, s in zip(values, slopes, strict=True)))
            )
            / (2 * STEP)
            for k in range(4)
        ]
    )


def same(function, *values, slopes=SLOPES, tolerance=1e-8):  # noqa: ANN001, ANN002, ANN201
    """Compare value and derivatives of a function of one or two arrays."""
    own = slopes[: len(values)]
    found = function(*(Dual(v, s) for v, s in zip(values, own, strict=True)))
    assert numpy.array_equal(found.value, function(*values))
    assert found.slopes == pytest.approx(differences(function, values, own), abs=tolerance)


@pytest.mark.parametrize("ufunc", PARTIALS, ids=lambda one: one.__name__)
def test_rules(ufunc: numpy.ufunc) -> None:
    """Both arguments move, one moves, and shapes differ."""
    values = (A, B)[: ufunc.nin]
    same(ufunc, *values)
    if ufunc.nin == 2:
        same(lambda a: ufunc(a, B), A)
        same(lambda b: ufunc(A, b), B)
        same(lambda a: ufunc(a[0], B), A)
        same(lambda a: ufunc(a[:, :1], 0.7), A)


@pytest.mark.parametrize(
    "function",
    [
        lambda a, b: np.where(a > b, a, b**2),
        lambda a, b: np.stack([a, b, A]).sum(axis=0),
        lambda a, b: np.concatenate([a, b], axis=1)[:, 1:3],
        lambda a, b: a.T @ b,
        lambda a, b: A.T @ b + a.mean(),
        lambda a, b: np.sum(a * b, axis=1) * np.ones(3),
        lambda a, b: np.array([[a[0, 0], 2.0], [b[1, 1], a[1, 0]]]),
        lambda a, b: np.column_stack([a[:, 0], b[:, 1]]),
        lambda a, b: np.clip(a, 0.3, 0.6) * b,
        lambda a, b: np.interp(a, [0.0, 0.25, 1.0], np.append(0.0, b[:2, 0])),
        lambda a, b: np.geomspace(1, 1 + a[0, 0], 4) * b[1, 0],
        lambda a, b: np.vectorize(lambda x, y: x * math.exp(y))(a, b[0]),
        lambda a, b: placed(A > 0.5, a[A > 0.5], b),
        lambda a, b: spline([0.0, 1.0, 3.0], a, numpy.linspace(0, 3, 5))[:, 0] * b[0, 0],
        lambda a, b: abs((a + 1j * b) * numpy.exp(1j)),
        lambda a, b: (np.exp(1j * a) / (b + 2j)).imag,
        lambda a, b: np.broadcast_arrays(a[0], b)[0].reshape(2, 3),
        lambda a, b: a.max() * b.min() * np.std(a),
        lambda a, b: np.diff(np.cumsum(np.outer(a[:, 0], B[0]), axis=0), axis=0) * b[0, 1],
    ],
)
def test_functions_of_arrays(function) -> None:  # noqa: ANN001
    same(function, A, B)


def test_solutions_of_equations() -> None:
    """x^3 + p x = q: by differences of the solution; also by a known solution."""

    def solution(p, q):  # noqa: ANN001, ANN202
        return root(lambda x: x**3 + p * x - q, 0.0, 10.0, xtol=1e-15)

    numbers = seeded({"p": 2.0, "q": 5.0})
    found = solution(**numbers)
    for k, key in enumerate(("p", "q")):
        up, down = (
            solution(**{**{"p": 2.0, "q": 5.0}, key: valued(numbers[key]) * plain_math.exp(x)})
            for x in (STEP, -STEP)
        )
        assert found.slopes[k] == pytest.approx((up - down) / (2 * STEP), rel=1e-7)
    assert implicit(found.value, lambda x: x**3 + 2 * x - numbers["q"]).slopes[1] == pytest.approx(
        found.slopes[1]
    )


@pytest.mark.parametrize("kappa", [0.05, 0.6, 0.9999, 1.0])
def test_elliptic_integrals(kappa: float) -> None:
    """Derivatives of K, E and their combinations, also where a circle makes differences cancel."""
    step = 1e-5 if kappa == 1 else 1e-6
    for function in (
        first_integral,
        second_integral,
        lambda k: integral_combinations(k)[0],
        lambda k: integral_combinations(k)[1],
    ):
        found = function(Dual(kappa, numpy.array([1.0])))
        expected = (function(kappa + step) - function(kappa - step)) / (2 * step)
        assert found.slopes[0] == pytest.approx(expected, rel=1e-7)
    assert first_integral(kappa) == pytest.approx(scipy.special.ellipk(1 - kappa**2), rel=1e-12)
    assert second_integral(kappa) == pytest.approx(scipy.special.ellipe(1 - kappa**2), rel=1e-12)
    assert ellipticity(Dual(1.0, numpy.array([1.0]))).slopes[0] == pytest.approx(2 / 3)


def test_derivatives_are_not_lost() -> None:
    """Conversions that would drop them are refused; messages, choices and copies take the value."""
    one = Dual(0.5, numpy.array([1.0]))
    for lose in (float, numpy.asarray, numpy.array, plain_math.exp, complex, int):
        with pytest.raises(TypeError):
            lose(one)
    with pytest.raises(ValueError, match="sequence"):  # numpy hides its TypeError
        numpy.zeros(2)[0] = one
    assert to_float(one) is one
    assert to_complex(one) is one
    assert f"{one:.2f}" == "0.50"
    assert max(one, 0.2) is one
    assert one in {one}
    assert round(one, 1).slopes[0] == 1
    assert copy.deepcopy(one).slopes[0] == 1
    assert "Dual(0.5" in repr(one)
    same(lambda a: np.power(a, 0.5), A)
    still = np.power(Dual(0.0, numpy.zeros(1)), 0.5)  # its derivative is infinite, and 0 of it
    assert still.slopes[0] == 0
