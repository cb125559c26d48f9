"""Smallest over central film of contacts that roll, of the wide atlas.

The grids of that atlas resolve central films, but not the narrow constriction beside the centre of
heavy contacts. ln of the ratio is a polynomial in ln(M/1000), ln(L/10) and ln(D/0.1), plus ln of
the ratio of the networks of the atlas times another one. Both are fitted to contacts computed on
finer grids by ``scripts/study judged``, which writes ``constriction.json``.
"""

import json
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from itertools import combinations_with_replacement

from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.conditions import MOES_KEYS
from ehlwave.duals import math, np, to_float

Floats = NDArray[np.float64]

CENTRE = (1000.0, 10.0, 0.1)
"""M, L and D of which the logarithms count."""
DEGREES = (4, 2)
"""Degrees of the polynomial, and of the factor of the networks."""
LARGEST_M = 12000.0
"""Largest M of the computed contacts."""


@cache
def fitted() -> Mapping[str, Sequence[float]]:
    """Return the results of the study: ``coefficients``, ``error``, ``low`` and ``high``."""
    text = (files("ehlwave.laws.atlas") / "constriction.json").read_text(encoding="utf-8")
    found: Mapping[str, Sequence[float]] = json.loads(text)
    return found


def terms(m: ArrayLike, l: ArrayLike, d: ArrayLike, log_networks: ArrayLike) -> Floats:  # noqa: E741 - the paper's letter
    """Return the terms of the fit, shape (contacts, terms).

    Parameters
    ----------
    m, l, d : array_like
        Of the contacts.
    log_networks : array_like
        ln of the smallest over the central film, by the networks.
    """
    values = (np.log(np.atleast_1d(x) / c) for x, c in zip((m, l, d), CENTRE, strict=True))
    columns = list(values)
    factors = (np.ones_like(columns[0]), np.atleast_1d(log_networks))
    powers = [
        factor * math.prod((columns[i] for i in chosen), start=np.ones_like(factor))
        for factor, most in zip(factors, DEGREES, strict=True)
        for degree in range(most + 1)
        for chosen in combinations_with_replacement(range(3), degree)
    ]
    return np.stack(powers, axis=1)


def constriction(keys: Mapping[str, float], networks: float) -> tuple[float, float]:
    """Return the smallest over the central film, and its relative error.

    Values are held within the computed range. Beyond the loads that grids resolve both are NaN.

    Parameters
    ----------
    keys : mapping
        Of the contact: M, L and D.
    networks : float
        The same ratio by the networks.
    """
    m, l, d = (keys[key] for key in MOES_KEYS)  # noqa: E741 - the paper's letter
    if m > LARGEST_M:
        return math.nan, math.nan
    found = fitted()
    value = to_float((terms(m, l, d, math.log(networks)) @ np.asarray(found["coefficients"]))[0])
    return math.exp(min(max(value, found["low"][0]), found["high"][0])), found["error"][0]
