"""Fits of laws, and their errors at whole operating conditions that were left out in turn."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]
Law = Callable[[Floats], Floats]
"""Values of all rows by coefficients."""

FOLDS = 12
SEED = 20000


def grouped_folds(condition: NDArray[np.intp], count: int = FOLDS, seed: int = SEED) -> list[Mask]:
    """Return the test sets of ``count`` folds; all points of a condition are in the same set.

    Raises ValueError if there are fewer conditions than folds.
    """
    labels = np.unique(condition)
    if labels.size < count:
        raise ValueError(f"{labels.size} operating conditions for {count} folds")
    shuffled = np.random.default_rng(seed).permutation(labels)
    return [np.isin(condition, shuffled[first::count]) for first in range(count)]


def fitted(
    law: Law,
    y: Floats,
    start: Sequence[float] | Floats,
    rows: slice | NDArray[Any] = slice(None),
    **how: Any,  # noqa: ANN401
) -> Floats:
    """Return the coefficients of a law that fit these rows best."""
    return least_squares(lambda p: (law(p) - y)[rows], start, **how).x


def held_out(
    law: Law,
    y: Floats,
    start: Sequence[float],
    group: NDArray[Any],
    **how: Any,  # noqa: ANN401
) -> tuple[Floats, Floats]:
    """Return coefficients of a law of all rows, and errors of rows by fits to other groups."""
    best = fitted(law, y, start, **how)
    errors = np.zeros_like(y)
    for one in np.unique(group):
        errors[group == one] = (law(fitted(law, y, best, group != one, **how)) - y)[group == one]
    return best, errors
