"""Smallest over central film of contacts that roll, of the wide atlas.

The grids of that atlas resolve central films, but not the narrow constriction beside the centre of
heavy contacts. ln of the ratio is a polynomial in ln(M/1000), ln(L/10) and ln(D/0.1), fitted to
contacts computed on finer grids by ``scripts/study judged``, which writes ``constriction.json``.
"""

import json
import math
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from itertools import combinations_with_replacement

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.conditions import MOES_KEYS

Floats = NDArray[np.float64]

CENTRE = (1000.0, 10.0, 0.1)
"""M, L and D of which the logarithms count."""
DEGREE = 4
LARGEST_M = 12000.0
"""Largest M of the computed contacts."""


@cache
def fitted() -> Mapping[str, Sequence[float]]:
    """Return the results of the study: ``coefficients``, ``error``, ``low`` and ``high``."""
    text = (files("ehlwave.laws.atlas") / "constriction.json").read_text(encoding="utf-8")
    found: Mapping[str, Sequence[float]] = json.loads(text)
    return found


def terms(m: ArrayLike, l: ArrayLike, d: ArrayLike) -> Floats:  # noqa: E741 - the paper's letter
    """Return the terms of the polynomial, shape (contacts, terms)."""
    values = (np.log(np.atleast_1d(x) / c) for x, c in zip((m, l, d), CENTRE, strict=True))
    columns = list(values)
    powers = [
        np.prod([columns[i] for i in chosen], axis=0) if chosen else np.ones_like(columns[0])
        for degree in range(DEGREE + 1)
        for chosen in combinations_with_replacement(range(3), degree)
    ]
    return np.stack(powers, axis=1)


def constriction(m: float, l: float, d: float) -> tuple[float, float]:  # noqa: E741
    """Return the smallest over the central film, and its relative error.

    Values of the polynomial are held within the computed range. Beyond the loads that grids resolve
    both are NaN.

    Examples
    --------
    >>> from ehlwave.laws.atlas.constriction import constriction
    >>> ratio, error = constriction(7902, 13.2, 0.031)
    >>> print(f"{ratio:.2f} within {error:.0%}")
    0.91 within 5%
    """
    if m > LARGEST_M:
        return math.nan, math.nan
    found = fitted()
    value = float((terms(m, l, d) @ np.asarray(found["coefficients"]))[0])
    return math.exp(min(max(value, found["low"][0]), found["high"][0])), found["error"][0]


def constriction_of(keys: Mapping[str, float]) -> tuple[float, float]:
    """Return the same by the keys of a contact."""
    return constriction(*(keys[key] for key in MOES_KEYS))
