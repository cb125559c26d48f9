"""Formulas for Ad/Ai to compare: from eq. (18) to more general formulas."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ehlwave.contact.formula import (
    PAPER_C1,
    PAPER_C2,
    amplitude_ratio_formula,
    power_ratio,
    recommended_ratio,
)
from studies.paper.cases import DIRECTIONS
from studies.paper.fit_points import Floats, Points

Parameters = NDArray[np.float64]


@dataclass(frozen=True)
class Candidate:
    """A formula: ``curve(parameters, points)`` is Ad/Ai; ``start`` holds a number per parameter."""

    name: str
    text: str
    names: tuple[str, ...]
    start: tuple[float, ...]
    curve: Callable[[Parameters, Points], Floats]


def _eq18(c: Parameters, p: Points) -> Floats:
    return _reciprocal(p.f_v, c[0], c[1])


def _eq18_free(c: Parameters, p: Points) -> Floats:
    factor = np.exp(np.append(0.0, c[2:]))[p.direction]
    x = factor * p.shorter * np.sqrt(p.load / p.lubricant)
    return _reciprocal(x, c[0], c[1])


def _reciprocal(x: Floats, c1: float, c2: float) -> Floats:
    # Not below zero: a pole among the points is no formula, but must not stop the search.
    return np.asarray(1 / np.maximum(1 + x * (c1 + x * c2), 1e-3))


def _powers(c: Parameters, p: Points) -> Floats:
    factor = p.f_v / (p.shorter * np.sqrt(p.load / p.lubricant))
    return _curve(c[0], factor * p.shorter * p.load ** c[1] * p.lubricant ** -c[2], c[3])


def _norm(c: Parameters, p: Points) -> Floats:
    x = p.wave * p.load ** c[1] * p.lubricant ** -c[2] * np.exp(c[3] * (1 - p.along))
    return _curve(c[0], x, c[4])


def _one(c: Parameters, p: Points) -> Floats:
    return _curve(c[0], _x(p, c[1]), c[2])


def _sharp_from_1(c: Parameters, p: Points) -> Floats:
    return _curve(c[0], _x(p, c[1]), 1 + c[2] / p.lubricant)


def _sharp(c: Parameters, p: Points) -> Floats:
    return _curve(c[0], _x(p, c[1]), c[2] + c[3] / p.lubricant)


def _free_load(c: Parameters, p: Points) -> Floats:
    x = _x(p, c[1]) * p.load ** (c[4] - 0.5)
    return _curve(c[0], x, c[2] + c[3] / p.lubricant)


def _kappa(c: Parameters, p: Points) -> Floats:
    return _curve(c[0], _x(p, c[1]) * p.kappa ** c[4], c[2] + c[3] / p.lubricant)


def _inlet(c: Parameters, p: Points) -> Floats:
    x = _x(p, c[1]) / (1 + c[4] * p.lambdabar**0.4 * np.sqrt(p.load / p.lubricant))
    return _curve(c[0], x, c[2] + c[3] / p.lubricant)


def _tail(c: Parameters, p: Points) -> Floats:
    return _curve(c[0], _x(p, c[1]), c[2] + c[3] / p.lubricant) ** c[4]


def _wave_sharp(c: Parameters, p: Points) -> Floats:
    return _curve(c[0], _x(p, c[1]), c[2] + c[3] * p.wave ** c[4] / p.lubricant)


def _general(c: Parameters, p: Points) -> Floats:
    across = 1 - p.along
    x = p.wave * p.load ** c[4] * p.lubricant ** -(c[1] + c[5] * across) * np.exp(c[6] * across)
    sharpness = c[2] + c[3] * np.exp(c[7] * across) / p.lubricant
    return _curve(c[0], x, sharpness) ** (1 + c[8] * across)


def _x(p: Points, exponent: float) -> Floats:
    return np.asarray(p.wave * np.sqrt(p.load) * p.lubricant ** (-exponent * p.along))


def _curve(scale: float, x: Floats, sharpness: Floats | float) -> Floats:
    # Bounds only keep a search from leaving the numbers; no fit ends at one.
    return power_ratio(max(scale, 1e-6) * x, np.clip(sharpness, 0.2, 60))


_X = "x = C (lambda_n/a) (gamma M)^(1/2) L^(-q cos^2 theta)"
_FORM = "(1 + x^n)^(-1/n)"
_FOUR = (0.26, 0.33, 1.5, 10.0)

PAPER = Candidate(
    "paper", "(18), c1 = 0.15, c2 = 0.015", (), (), lambda _, p: amplitude_ratio_formula(p.f_v)
)
REFITTED = Candidate("refitted", "(18), c1 and c2", ("c1", "c2"), (PAPER_C1, PAPER_C2), _eq18)
RECOMMENDED = Candidate(
    "n of L", f"{_FORM}, {_X}, n = n0 + n1/L", ("C", "q", "n0", "n1"), _FOUR, _sharp
)
ROUNDED = Candidate(
    "rounded",
    f"{_FORM}, x = 0.263 (lambda_n/a) (gamma M)^(1/2) L^(-cos^2(theta)/3), n = 1.5 + 10/L",
    (),
    (),
    lambda _, p: recommended_ratio(p.load_m, p.lubricant, p.gamma, p.wave_x, p.wave_y),
)
ONE_PARAMETER = Candidate(
    "one parameter", f"{_FORM}, {_X}, n the same everywhere", ("C", "q", "n"), (0.2, 0.33, 3), _one
)
LADDER = (
    PAPER,
    REFITTED,
    Candidate(
        "f free",
        "(18), c1 and c2, a factor f for each r",
        ("c1", "c2", *(f"ln f({r:g})" for r in DIRECTIONS[1:])),
        (0.05, 0.03, *(0.0,) * 4, 0.5, 0.8, 1.0, 1.0),
        _eq18_free,
    ),
    Candidate(
        "free powers",
        f"{_FORM}, x = C f(r) (lambda/a) (gamma M)^p L^-q",
        ("C", "p", "q", "n"),
        (0.2, 0.5, 0.2, 2.5),
        _powers,
    ),
    Candidate(
        "wave number",
        f"{_FORM}, x = C (lambda_n/a) (gamma M)^p L^-q exp(d sin^2 theta)",
        ("C", "p", "q", "d", "n"),
        (0.2, 0.5, 0.2, 0.6, 2.5),
        _norm,
    ),
    ONE_PARAMETER,
    Candidate(
        "n = 1 + n1/L",
        f"{_FORM}, {_X}, n = 1 + n1/L",
        ("C", "q", "n1"),
        (0.26, 0.33, 17),
        _sharp_from_1,
    ),
    RECOMMENDED,
    Candidate(
        "+ power of M", "n of L, (gamma M)^p", (*RECOMMENDED.names, "p"), (*_FOUR, 0.5), _free_load
    ),
    Candidate(
        "+ kappa", "n of L, x times kappa^t", (*RECOMMENDED.names, "t"), (*_FOUR, 0.0), _kappa
    ),
    Candidate(
        "+ inlet length",
        "n of L, x / (1 + t lambdabar^(2/5) (gamma M/L)^(1/2))",
        (*RECOMMENDED.names, "t"),
        (*_FOUR, 0.01),
        _inlet,
    ),
    Candidate(
        "+ slope", "n of L, (1 + x^n)^(-m/n)", (*RECOMMENDED.names, "m"), (*_FOUR, 1.0), _tail
    ),
    Candidate(
        "+ wavelength",
        "n of L, n = n0 + n1 (lambda_n/a)^t/L",
        (*RECOMMENDED.names, "t"),
        (*_FOUR, 0.2),
        _wave_sharp,
    ),
    Candidate(
        "general",
        "n of L; power of M; q, C, n1 and the slope change with direction",
        (*RECOMMENDED.names, "p", "q1", "d", "n1'", "m1"),
        (*_FOUR, 0.5, -0.3, 0.0, 0.0, 0.0),
        _general,
    ),
    ROUNDED,
)
